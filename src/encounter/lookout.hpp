// What has been between us and each of the others: how they sail, what we have done about them
// since a risk of collision arose, and what is believed of them from now on. Decides nothing.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "encounter/prospect.hpp"
#include "encounter/steady_line.hpp"
#include "encounter/swing.hpp"
#include "otter_nav/encounter/rules.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/traffic/track.hpp"

namespace otter_nav::encounter {

class Lookout {
 public:
  explicit Lookout(const Options& options) : options_(options) {}

  // As Pilot's.
  void listen(double now_s);
  void newGoal(double now_s);
  void observe(double now_s, const Motion& own, const Eigen::Vector2d& steered,
               const std::vector<traffic::Track>& tracks, const Eigen::Vector2d& goal,
               double cruise_mps);

  [[nodiscard]] bool seesNobody() const { return memories_.empty(); }
  // How fast waves move the hull to the side, m/s.
  [[nodiscard]] double swing() const { return swing_mps_; }
  // Where one is heard of others are soon. Who turns to port for the first, as is fair for one that
  // comes from abaft, may have to give way to the next by the other side: until then to starboard,
  // or slower, unless it presses. So too while not all are heard of.
  [[nodiscard]] bool listens() const;
  // While a course is hardly known nearness far off is a guess, and acting for one who may do so
  // herself can't be undone.
  [[nodiscard]] bool mayHaveToStandOn() const;
  // Not all are heard of yet, and a little later is still in time for whoever is known.
  [[nodiscard]] bool hasTimeToListen() const;
  // As they are believed to go on, over this water.
  [[nodiscard]] std::vector<Other> others(const map::DistanceField& field) const;
  // Those with risk of collision.
  [[nodiscard]] std::vector<Encounter> encounters() const;

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  // Where we were, and how we sailed.
  struct Past {
    double time_s = 0.0;
    Motion own;
    bool under_way = false;
  };

  // What is remembered of a track.
  struct Memory {
    traffic::Track track;
    Motion motion;  // now
    Record record;
    double began_s = 0.0;
    double followed_s = 0.0;
    double aspect_rad = 0.0;
    double seen_s = 0.0;
    SteadyLine line;
    double off_since_s = -1.0;  // since when its velocity isn't the line's; negative: it is
    double changed_s = -1.0;    // when it last left a line; negative: never since it was first seen
    double heard_s = 0.0;       // first
    bool met = false;           // there was a risk of collision once
    double acts_since_s = kNever;  // off the course or speed kept
  };

  void remember(double now_s, const Motion& own, const Eigen::Vector2d& steered,
                const Eigen::Vector2d& goal, double cruise_mps);
  void see(double now_s, const traffic::Track& track);
  [[nodiscard]] std::vector<Leg> roundOf(const traffic::Track& track, double until_s) const;
  [[nodiscard]] bool awaitsReports() const;
  [[nodiscard]] bool hasJustHeardOfAll() const;
  template <typename Hurries>
  [[nodiscard]] bool noneHurries(const Hurries& hurries) const;
  [[nodiscard]] bool isLost(const Memory& memory) const;
  [[nodiscard]] std::map<int, Memory>::iterator lostAs(double now_s, const traffic::Track& track);
  [[nodiscard]] static double velocityDeviation(const Memory& memory);
  void recall(Memory& memory) const;
  static void follow(const Past& now, const Motion& she, Memory& memory);
  static void doubt(const Past& now, const Motion& she, Memory& memory);
  [[nodiscard]] double knownFor(const Memory& memory, const map::DistanceField& field) const;

  Options options_;
  std::map<int, Memory> memories_;
  std::deque<std::pair<double, Eigen::Vector2d>> trail_;
  Swing swing_;
  double swing_mps_ = 0.0;
  std::deque<Past> past_;
  Motion own_;
  double now_s_ = 0.0;
  double listens_since_s_ = kNever;
  double goal_time_s_ = 0.0;
  bool under_way_ = false;
};

}  // namespace otter_nav::encounter
