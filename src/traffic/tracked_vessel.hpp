// One vessel that is, or may be, there: its motion, its outline and how sure it is.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "motion_filter.hpp"
#include "otter_nav/ais/message.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/traffic/track.hpp"
#include "outline_fit.hpp"

namespace otter_nav::traffic {

constexpr double kLongAgoS = -1e9;

struct TrackedVessel {
  TrackedVessel(int the_id, const Measurement& first, double time_s, Source source)
      : id(the_id),
        motion(first, time_s),
        begun_s(time_s),
        first_s(time_s),
        last_s(time_s),
        plots(source == kRadar ? 1 : 0),
        sources(source) {}

  int id;
  MotionFilter motion;
  double existence = 0.2;
  bool confirmed = false;
  bool has_moved = false;  // for certain, at some time
  double begun_s;
  double first_s;  // since when nothing has cast a doubt on it
  double last_s;   // when it was last seen or heard
  int hits = 1;
  int moving_hits = 0;            // scans in which it was met in water seen free before
  double last_new_s = kLongAgoS;  // the last of those
  int missed = 0;                 // scans in a row that ought to have shown it and didn't

  Track::Met met;
  int plots;  // of the radar's
  std::uint32_t sources;

  // Outline. A size is taken as a guess until something measures it.
  enum class Size { kGuessed, kSeen, kReported };
  Size size = Size::kGuessed;
  double length_m = 7.0;
  double beam_m = 2.5;
  // How well the heading was known along which that was measured, rad.
  double sized_within_rad = kPi;
  std::optional<double> heading_rad;
  double leeway_rad = 0.0;  // heading less course, by the last report of both
  // Along and athwart, as the last echoes showed it among many, and how often in a row alike.
  Eigen::Vector2d shown_m = Eigen::Vector2d::Zero();
  int shown_alike = 0;

  std::uint32_t mmsi = 0;
  double last_ais_s = kLongAgoS;
  std::optional<Measurement> reported;  // by AIS, then
  bool keeps_place = false;             // at anchor, moored, or an aid to navigation
  std::optional<ais::Message> dimensions;

  std::vector<Eigen::Vector2d> unconfirmed_points;  // echoes that went into the map meanwhile

  // Where it has been all along since then, to within what the estimate wanders.
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  double placed_s = kLongAgoS;
  bool stays = false;  // has for long enough to be taken to lie there
  // To be called whenever it was seen or heard.
  void findPlace(double now_s);

  // Since when each look of the lidar's has met mostly what stands, and nothing told of a course.
  double stands_since_s = kLongAgoS;
  double looked_s = kLongAgoS;
  bool is_mapped = false;                      // lies where the map has her outline
  std::vector<Eigen::Vector2d> mapped_points;  // that it was given of it

  // To be called with each cluster that is hers.
  void lookedAt(const Cluster& cluster, double now_s);
  [[nodiscard]] bool liesStill(double now_s, double for_s) const;

  // How unlike one another the lidar's looks since the last doubt are, means over the last ones: by
  // what part what shows grew or shrank, and by how much its place surprised (a squared Mahalanobis
  // distance).
  int looks = 0;
  double shows_m = 0.0;  // from the last look's first echo to its last one
  double changes = 0.0;
  double surprises2 = 0.0;
  // To be called with each cluster that is hers.
  void compare(const Cluster& cluster, double surprise2);
  // A hull keeps her shape, or else her course; clutter that follows on clutter neither.
  [[nodiscard]] bool isAlike() const;

  // Begins to count anew: what was met now may be something else than before.
  void doubt(double time_s) {
    first_s = time_s;
    hits = 1;
    moving_hits = 0;
    looks = 0;
  }

  // Course, if the motion tells one.
  [[nodiscard]] std::optional<double> course() const;
  // Takes the course, with the leeway reported, as the heading where there is one.
  // Whether it is the first one.
  bool followCourse();
  [[nodiscard]] bool isUnderWay() const;
  // How long, how broad and how it lies; else the track's outline is what may hold it.
  [[nodiscard]] bool knowsOutline() const { return heading_rad && size != Size::kGuessed; }
  // Of that, a little inside; none where it isn't known.
  [[nodiscard]] std::vector<Eigen::Vector2d> pointsWithin() const;
  [[nodiscard]] Track track() const;

  // The direction of the sides that a cluster shows, but for quarters of a turn; none if it shows
  // none clearly.
  [[nodiscard]] static std::optional<double> sidesOf(const Cluster& cluster);
  // The direction of the sides that a cluster shows next to the heading, which has to be known;
  // none if it shows none clearly.
  [[nodiscard]] std::optional<double> headingBySides(const Cluster& cluster) const;
  // The direction of the longer side, but for half a turn, where a cluster shows both of them whole
  // and one is clearly longer: how a hull lies, whatever her course.
  [[nodiscard]] static std::optional<double> axisOf(const Cluster& cluster,
                                                    const Eigen::Vector2d& eye);
  // Standard deviation of the heading; of who reports herself it is taken as known.
  [[nodiscard]] double headingDeviation() const;
  // Unit vector; asks for a heading.
  [[nodiscard]] Eigen::Vector2d ahead() const;
  // From the outline's middle to its side, along a unit vector.
  [[nodiscard]] double halfDepth(const Eigen::Vector2d& along) const;
  // Where the outline's middle is if `cluster`, seen from `eye`, is this vessel: not the points'
  // middle, but the sides that are seen, with half the size from there on. `among_many`: along the
  // sides where they tell a heading, for the course of who turns at once, or all the time, lags
  // behind.
  [[nodiscard]] Measurement measure(const Cluster& cluster, const Eigen::Vector2d& eye,
                                    bool among_many = false) const;
  // The first heading is known now: the hull's middle is followed from here on.
  void followMiddle(const Cluster& cluster, const Eigen::Vector2d& eye, bool among_many = false);
  // What a cluster that is this vessel says of its size; that the middle lies elsewhere by a new
  // size is no motion.
  void learnSize(const Cluster& cluster, const Eigen::Vector2d& eye);
  // The same among many: it may be a part of her that something hides, or two who pass close by, so
  // that only a rectangle counts that is shown the same again and again.
  void learnSizeAmongMany(const Cluster& cluster, const Eigen::Vector2d& eye);
  // To be called with each size that echoes show: whether the last few were alike.
  bool isShownAgain(const Eigen::Vector2d& size_m);
  // Dimensions reported by AIS: the size, and where in the outline the reported position is. Of a
  // hull beyond kLongestM they say nothing.
  void takeDimensions(const ais::Message& message);
  [[nodiscard]] Eigen::Vector2d middleFromReported() const;
};

}  // namespace otter_nav::traffic
