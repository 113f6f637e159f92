// A path as points at equal distances: an elastic band that rounds its corners and keeps it off
// obstacles, with directions, curvature and a speed profile.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

namespace otter_nav::trajectory {

// The point `distance_m` along a polyline, from its start or, negative, from its end.
[[nodiscard]] Eigen::Vector2d pointAlong(const std::vector<Eigen::Vector2d>& polyline,
                                         double distance_m);

// Keeps its memory from call to call.
class PathLine {
 public:
  struct Point {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
    double curvature_per_m = 0.0;  // positive to port
    double speed_mps = 0.0;
  };

  // Points no farther apart than `spacing_m` along a polyline of at least two, in `least_parts`
  // parts or more.
  void resample(const std::vector<Eigen::Vector2d>& polyline, double spacing_m, int least_parts);

  // The elastic band: in each round a point moves to the middle of its neighbours, and off what is
  // nearer than `clearance_m` by `smooth` (of a position: distance_m and gradient). The ends stay,
  // and so many points next to them.
  template <typename Smooth>
  void relax(const Smooth& smooth, double clearance_m, int rounds, std::size_t held_head = 0,
             std::size_t held_tail = 0);

  // By chords over a window; the curvature by their change.
  void setDirections();

  // The speed profile: no faster than `most(curvature)`; from the first point's `start_mps` faster
  // by no more than the acceleration `gain(speed)`, and down to the last one's `end_mps` slower by
  // no more than `loss(speed)`, as it is from a start faster than on any line. Needs directions.
  template <typename Most, typename Gain, typename Loss>
  void setSpeeds(const Most& most, const Gain& gain, const Loss& loss, double start_mps,
                 double end_mps);

  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] double spacing() const { return spacing_m_; }
  // As it is now; after the band was relaxed it differs a little from the polyline's.
  [[nodiscard]] double length() const {
    return spacing_m_ * static_cast<double>(points_.size() - 1);
  }
  // A place on the line: between points `index` and the next, `share` of the way.
  struct Place {
    std::size_t index;
    double share;
  };
  [[nodiscard]] Place locate(double s_m) const;  // clamped to the line
  [[nodiscard]] Point at(const Place& place) const;

 private:
  void measure();

  double spacing_m_ = 1.0;
  std::vector<Point> points_;
  std::vector<Eigen::Vector2d> moved_;
  std::vector<double> to_spare_m_;
};

template <typename Smooth>
void PathLine::relax(const Smooth& smooth, double clearance_m, int rounds, std::size_t held_head,
                     std::size_t held_tail) {
  constexpr double kLargestPushM = 0.5;
  constexpr double kLeastGradient = 0.3;
  // A distance is taken to fall by no more than this for each metre that its place moves, what
  // comes nearer in the time that takes included. So a point that was found clear by more than it
  // has moved since needs no other look.
  constexpr double kSteepest = 3.0;
  moved_.resize(points_.size());
  to_spare_m_.assign(points_.size(), 0.0);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 1 + held_head; i + 1 + held_tail < points_.size(); ++i) {
      Eigen::Vector2d p =
          0.5 * points_[i].position + 0.25 * (points_[i - 1].position + points_[i + 1].position);
      to_spare_m_[i] -= kSteepest * (p - points_[i].position).norm();
      if (to_spare_m_[i] > 0.0) {
        moved_[i] = p;
        continue;
      }
      const auto d = smooth(p);
      to_spare_m_[i] = d.distance_m - clearance_m;
      if (d.distance_m < clearance_m) {
        const double steep = std::max(d.gradient.norm(), kLeastGradient);
        p += std::min(clearance_m - d.distance_m, kLargestPushM) / (steep * steep) * d.gradient;
      }
      moved_[i] = p;
    }
    for (std::size_t i = 1 + held_head; i + 1 + held_tail < points_.size(); ++i) {
      points_[i].position = moved_[i];
    }
  }
  measure();
}

template <typename Most, typename Gain, typename Loss>
void PathLine::setSpeeds(const Most& most, const Gain& gain, const Loss& loss, double start_mps,
                         double end_mps) {
  const auto reached = [&](double speed, double accel) {
    return std::sqrt(speed * speed + 2.0 * spacing_m_ * accel);
  };
  const std::size_t last = points_.size() - 1;
  for (Point& point : points_) {
    point.speed_mps = most(std::abs(point.curvature_per_m));
  }
  points_[0].speed_mps = start_mps;
  for (std::size_t i = 1; i <= last && start_mps > most(0.0); ++i) {
    const double before = points_[i - 1].speed_mps;
    const double slowed = before * before - 2.0 * spacing_m_ * loss(before);
    if (slowed < points_[i].speed_mps * points_[i].speed_mps) {
      break;
    }
    points_[i].speed_mps = std::sqrt(slowed);
  }
  points_[last].speed_mps = end_mps;
  for (std::size_t i = 1; i <= last; ++i) {
    const double speed = points_[i - 1].speed_mps;
    points_[i].speed_mps = std::min(points_[i].speed_mps, reached(speed, gain(speed)));
  }
  for (std::size_t i = last - 1; i > 0; --i) {
    const double speed = points_[i + 1].speed_mps;
    points_[i].speed_mps = std::min(points_[i].speed_mps, reached(speed, loss(speed)));
  }
}

}  // namespace otter_nav::trajectory
