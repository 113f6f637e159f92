#include "otter_nav/planner/guide_line.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::planner {
namespace {

constexpr double kDirectionWindowM = 1.0;
constexpr double kLargestPushM = 0.5;
constexpr double kLeastGradient = 0.3;

// The greatest speed at which thrust `force` holds a turn of curvature `curvature`, its moment left
// out, as the edges' check does: (m1 k v^2)^2 + (d1 v)^2 = force^2.
double turningSpeed(const vessel::PaperModel& model, double force, double curvature) {
  const double a = model.m1_kg * curvature;
  const double drag2 = model.d1_kgps * model.d1_kgps;
  if (a < 1e-9) {
    return force / model.d1_kgps;
  }
  const double v2 =
      (std::sqrt(drag2 * drag2 + 4.0 * a * a * force * force) - drag2) / (2.0 * a * a);
  return std::sqrt(v2);
}

}  // namespace

void GuideLine::build(const std::vector<Eigen::Vector2d>& points, const map::DistanceField& field,
                      const vessel::Parameters& vessel, const GuideLineOptions& options) {
  resample(points, options.spacing_m);
  relax(field, options);
  setDirections();
  setSpeeds(vessel, options);
  for (Point& point : held_) {
    point.half_width_m =
        std::clamp(field.clearance(point.position), options.half_width_min_m, options.corridor_m);
  }
}

void GuideLine::resample(const std::vector<Eigen::Vector2d>& points, double spacing_m) {
  length_m_ = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    length_m_ += (points[i] - points[i - 1]).norm();
  }
  const int parts = std::max(2, static_cast<int>(std::ceil(length_m_ / spacing_m)));
  spacing_m_ = length_m_ / parts;
  held_.assign(static_cast<std::size_t>(parts) + 1, Point{});
  std::size_t segment = 1;
  double passed = 0.0;  // length before `segment`
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const double s = spacing_m_ * static_cast<double>(i);
    double part = (points[segment] - points[segment - 1]).norm();
    while (segment + 1 < points.size() && passed + part < s) {
      passed += part;
      ++segment;
      part = (points[segment] - points[segment - 1]).norm();
    }
    const double share = part > 0.0 ? std::clamp((s - passed) / part, 0.0, 1.0) : 0.0;
    held_[i].position = points[segment - 1] + share * (points[segment] - points[segment - 1]);
  }
}

// An elastic band: each point moves towards the middle of its neighbours, and off what is nearer
// than the safe distance, so that curves between its points have room on the inner side.
void GuideLine::relax(const map::DistanceField& field, const GuideLineOptions& options) {
  moved_.resize(held_.size());
  for (int round = 0; round < options.relaxations; ++round) {
    for (std::size_t i = 1; i + 1 < held_.size(); ++i) {
      Eigen::Vector2d p =
          0.5 * held_[i].position + 0.25 * (held_[i - 1].position + held_[i + 1].position);
      const map::DistanceField::Smooth d = field.smooth(p);
      if (d.distance_m < options.safe_distance_m) {
        const double steep = std::max(d.gradient.norm(), kLeastGradient);
        const double push = std::min(options.safe_distance_m - d.distance_m, kLargestPushM);
        p += push / (steep * steep) * d.gradient;
      }
      moved_[i] = p;
    }
    for (std::size_t i = 1; i + 1 < held_.size(); ++i) {
      held_[i].position = moved_[i];
    }
  }
  length_m_ = 0.0;
  for (std::size_t i = 1; i < held_.size(); ++i) {
    length_m_ += (held_[i].position - held_[i - 1].position).norm();
  }
  spacing_m_ = length_m_ / static_cast<double>(held_.size() - 1);
}

// Directions by chords over a window, curvature by their change.
void GuideLine::setDirections() {
  const int window = std::max(1, static_cast<int>(kDirectionWindowM / std::max(spacing_m_, 1e-9)));
  const int last = static_cast<int>(held_.size()) - 1;
  for (int i = 0; i <= last; ++i) {
    const auto from = static_cast<std::size_t>(std::max(0, i - window));
    const auto to = static_cast<std::size_t>(std::min(last, i + window));
    const Eigen::Vector2d chord = held_[to].position - held_[from].position;
    if (chord.norm() > 1e-9) {
      held_[static_cast<std::size_t>(i)].direction = chord.normalized();
    }
  }
  for (std::size_t i = 1; i + 1 < held_.size(); ++i) {
    const Eigen::Vector2d& a = held_[i - 1].direction;
    const Eigen::Vector2d& b = held_[i + 1].direction;
    const double turn = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    held_[i].curvature_per_m = turn / (2.0 * spacing_m_);
  }
}

// Bounded by the turn at each point, then by what the thrusters can gain or lose between points.
void GuideLine::setSpeeds(const vessel::Parameters& vessel, const GuideLineOptions& options) {
  const vessel::PaperModel& model = vessel.paper;
  const auto last = held_.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const double turning =
        turningSpeed(model, options.force_ahead_n, std::abs(held_[i].curvature_per_m));
    held_[i].speed_mps = std::min(options.speed_mps, turning);
  }
  const auto gained = [&](double speed, double force) {
    return std::sqrt(speed * speed + 2.0 * spacing_m_ * options.ramp_share * force / model.m1_kg);
  };
  held_[0].speed_mps = std::min(held_[0].speed_mps, options.speed_start_mps);
  held_[last].speed_mps = 0.0;
  for (std::size_t i = 1; i <= last; ++i) {
    const double speed = held_[i - 1].speed_mps;
    const double force = std::max(0.0, options.force_ahead_n - model.d1_kgps * speed);
    held_[i].speed_mps = std::min(held_[i].speed_mps, gained(speed, force));
  }
  for (std::size_t i = last; i > 0; --i) {
    const double speed = held_[i].speed_mps;
    const double force = std::min(2.0 * vessel.thrusters.astern_max_n, options.force_ahead_n);
    held_[i - 1].speed_mps = std::min(held_[i - 1].speed_mps, gained(speed, force));
  }
}

GuideLine::Point GuideLine::at(double s_m) const {
  const double x = std::clamp(s_m / spacing_m_, 0.0, static_cast<double>(held_.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(x), held_.size() - 2);
  const double share = x - static_cast<double>(i);
  const Point& a = held_[i];
  const Point& b = held_[i + 1];
  Point p;
  p.position = a.position + share * (b.position - a.position);
  p.direction = a.direction + share * (b.direction - a.direction);
  const double norm = p.direction.norm();
  p.direction = norm > 1e-6 ? Eigen::Vector2d(p.direction / norm) : a.direction;
  p.curvature_per_m = a.curvature_per_m + share * (b.curvature_per_m - a.curvature_per_m);
  p.speed_mps = a.speed_mps + share * (b.speed_mps - a.speed_mps);
  p.half_width_m = a.half_width_m + share * (b.half_width_m - a.half_width_m);
  return p;
}

}  // namespace otter_nav::planner
