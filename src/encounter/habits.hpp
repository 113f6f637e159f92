// Where others have been and how they went on from there. Who comes by again on the same course, on
// a round or to and fro, will probably go on so again, corners and all.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include "encounter/met_motion.hpp"
#include "encounter/parting_ways.hpp"
#include "otter_nav/traffic/track.hpp"

namespace otter_nav::encounter {

class Habits {
 public:
  // Several times a second.
  void observe(const std::vector<traffic::Track>& tracks);

  // Places after each step of `step_s` from `from_s` on, the first then: how somebody went on who
  // was there on such a course before. Empty: nobody was, or nothing much came of it.
  [[nodiscard]] std::vector<Eigen::Vector2d> foretell(const traffic::Track& track, double from_s,
                                                      double step_s, int steps) const;
  // All the ways that somebody went on from there; foretell() tells the first one.
  [[nodiscard]] std::vector<Way> ways(const traffic::Track& track, double from_s, double step_s,
                                      int steps) const;
  // Adds all places within `range_m` of one at which anybody has been.
  void placesWithin(const Eigen::Vector2d& of, double range_m,
                    std::vector<Eigen::Vector2d>& places) const;
  // How fast her course has been turning for a while, rad/s, if it has done so steadily.
  [[nodiscard]] std::optional<double> steadyTurn(const traffic::Track& track) const;

 private:
  struct Record {
    double time_s = 0.0;
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
    int id = 0;
    // As she was tracked then: x, y, v_x, v_y.
    Eigen::Vector4d tracked = Eigen::Vector4d::Zero();
    Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
    // Of the same track.
    int before = -1;
    int next = -1;
  };
  struct Match {
    int record = -1;
    double share = 0.0;  // of the stretch to the next one
  };
  // Somebody whose way is asked for.
  struct Seen {
    Eigen::Vector2d position;
    Eigen::Vector2d velocity;
    double variance_m2 = 0.0;  // of her place, each axis
    int id = 0;
    double before_s = 0.0;  // what was later is no way yet
  };
  // One time that somebody went a way, where she who is seen would be on it.
  struct Pass {
    Match at;
    double unlikely = 0.0;
    double last_s = 0.0;
  };
  // Where a track is on the way it goes again.
  struct Place {
    Match at;
    double stamp_s = 0.0;   // of the track
    double off_s = 0.0;     // for so long she has been off it
    double sought_s = 0.0;  // when another was looked for
  };
  [[nodiscard]] const Record& record(int index) const {
    return records_[static_cast<std::size_t>(index)];
  }
  // Of one track.
  struct Known {
    MetMotion motion;
    int last = -1;  // record
    Place place;
    double told_s = 0.0;  // when she was last among the tracks
  };
  void remember(const traffic::Track& track);
  void follow(const traffic::Track& track);
  // Beside a way that the radar alone has met there may be one that is known well.
  void followBetterKnown(const traffic::Track& track, Place& place) const;
  // Places from one on a way on; where that breaks off another may lead on, and where none does it
  // is straight ahead. Empty: nothing much comes of it.
  [[nodiscard]] Told tell(Match found, Seen seen, double step_s, int steps) const;
  // The likeliest first.
  [[nodiscard]] std::vector<Pass> passesOf(const Seen& seen) const;
  // `by_s` later on the way, negative: before; whether the way goes so far.
  [[nodiscard]] bool moveAlong(Match& at, double by_s) const;
  void smoothBefore(int last);
  [[nodiscard]] static Seen seen(const traffic::Track& track, double at_s);
  [[nodiscard]] Match match(const Seen& seen) const;
  // Visits where she might be on a way again, and how far beside it, m.
  template <typename Visit>
  void eachSameWay(const Seen& seen, const Visit& visit) const;
  // The negative logarithm of how likely she is on that way.
  [[nodiscard]] double unlikely(const Seen& seen, const Match& at, double beside_m) const;
  // How well a place on a way is known, m^2, each axis; and the next seconds of it.
  [[nodiscard]] static double variance(const Record& record) {
    return 0.5 * (record.covariance(0, 0) + record.covariance(1, 1));
  }
  [[nodiscard]] double varianceAhead(const Match& at) const;
  void forgetOldest();
  void forgetWhoIsGone(const std::vector<traffic::Track>& tracks);

  std::vector<Record> records_;
  std::map<int, Known> known_;  // by the tracks' numbers
};

}  // namespace otter_nav::encounter
