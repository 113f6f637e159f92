// The echoes of one thing, and the outline that fits them.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace otter_nav::traffic {

// Echoes that hang together, map frame, in the order of the beams.
struct Cluster {
  std::vector<Eigen::Vector2d> points;
  std::vector<std::size_t> beams;  // that met them
  int new_points = 0;              // in water that was seen free before
  int standing_points = 0;         // met there for a while
  bool out_of_range = false;       // in part: it goes on beyond the range
  bool shared = false;             // two vessels are near: each may have some of the echoes
  bool first_hidden = false;       // it goes on behind something nearer, beyond its first point
  bool last_hidden = false;        // or its last

  // There is more of it than its echoes show.
  [[nodiscard]] bool isCut() const { return out_of_range || first_hidden || last_hidden; }

  // It is seen whole, and nothing of it is where nothing was: of a vessel under way at least the
  // bow would be.
  [[nodiscard]] bool stands() const {
    return !first_hidden && !last_hidden && standing_points == static_cast<int>(points.size());
  }
};

// Along an axis: from `low` to `high`.
struct Span {
  double low = 0.0;
  double high = 0.0;
  [[nodiscard]] double length() const { return high - low; }
  [[nodiscard]] double middle() const { return 0.5 * (low + high); }
};
[[nodiscard]] Span spanOf(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& axis);

// The direction, in [0, pi / 2), along and across which the points lie closest to two sides of a
// rectangle (Zhang and others, Efficient L-shape fitting for vehicle detection using laser
// scanners, IV 2017: search over directions by closeness).
[[nodiscard]] double rectangleDirection(const std::vector<Eigen::Vector2d>& points);

// Of the points' distances to the nearer pair of sides of a rectangle in direction `direction_rad`.
[[nodiscard]] double rectangleDeviation(const std::vector<Eigen::Vector2d>& points,
                                        double direction_rad);

}  // namespace otter_nav::traffic
