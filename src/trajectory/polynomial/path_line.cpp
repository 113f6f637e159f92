#include "otter_nav/trajectory/polynomial/path_line.hpp"

#include "otter_nav/base/parts.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::trajectory {

Eigen::Vector2d pointAlong(const std::vector<Eigen::Vector2d>& polyline, double distance_m) {
  const bool backward = distance_m < 0.0;
  double left = std::abs(distance_m);
  const std::size_t n = polyline.size();
  for (std::size_t i = 1; i < n; ++i) {
    const Eigen::Vector2d& a = polyline[backward ? n - i : i - 1];
    const Eigen::Vector2d& b = polyline[backward ? n - i - 1 : i];
    const double length = (b - a).norm();
    if (length >= left && length > 0.0) {
      return a + left / length * (b - a);
    }
    left -= length;
  }
  return backward ? polyline.front() : polyline.back();
}

void PathLine::resample(const std::vector<Eigen::Vector2d>& polyline, double spacing_m,
                        int least_parts) {
  const double length = lengthOf(polyline);
  const int parts = partsOf(length, spacing_m, least_parts);
  spacing_m_ = std::max(length / parts, 1e-6);
  points_.assign(static_cast<std::size_t>(parts) + 1, Point{});
  std::size_t segment = 1;
  double passed = 0.0;  // length before `segment`
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const double s = spacing_m_ * static_cast<double>(i);
    double part = (polyline[segment] - polyline[segment - 1]).norm();
    while (segment + 1 < polyline.size() && passed + part < s) {
      passed += part;
      ++segment;
      part = (polyline[segment] - polyline[segment - 1]).norm();
    }
    const double share = part > 0.0 ? std::clamp((s - passed) / part, 0.0, 1.0) : 0.0;
    points_[i].position =
        polyline[segment - 1] + share * (polyline[segment] - polyline[segment - 1]);
  }
  points_.back().position = polyline.back();
}

void PathLine::measure() {
  double length = 0.0;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    length += (points_[i].position - points_[i - 1].position).norm();
  }
  spacing_m_ = std::max(length / static_cast<double>(points_.size() - 1), 1e-6);
}

void PathLine::setDirections() {
  constexpr double kWindowM = 1.0;
  const int window = std::max(1, static_cast<int>(kWindowM / std::max(spacing_m_, 1e-9)));
  const int last = static_cast<int>(points_.size()) - 1;
  for (int i = 0; i <= last; ++i) {
    const auto from = static_cast<std::size_t>(std::max(0, i - window));
    const auto to = static_cast<std::size_t>(std::min(last, i + window));
    const Eigen::Vector2d chord = points_[to].position - points_[from].position;
    if (chord.norm() > 1e-9) {
      points_[static_cast<std::size_t>(i)].direction = chord.normalized();
    }
  }
  for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
    const Eigen::Vector2d& a = points_[i - 1].direction;
    const Eigen::Vector2d& b = points_[i + 1].direction;
    points_[i].curvature_per_m = std::atan2(cross(a, b), a.dot(b)) / (2.0 * spacing_m_);
  }
}

PathLine::Place PathLine::locate(double s_m) const {
  const double x = std::clamp(s_m / spacing_m_, 0.0, static_cast<double>(points_.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(x), points_.size() - 2);
  return {i, x - static_cast<double>(i)};
}

PathLine::Point PathLine::at(const Place& place) const {
  const Point& a = points_[place.index];
  const Point& b = points_[place.index + 1];
  const double share = place.share;
  Point p;
  p.position = a.position + share * (b.position - a.position);
  p.direction = a.direction + share * (b.direction - a.direction);
  const double norm = p.direction.norm();
  p.direction = norm > 1e-6 ? Eigen::Vector2d(p.direction / norm) : a.direction;
  p.curvature_per_m = a.curvature_per_m + share * (b.curvature_per_m - a.curvature_per_m);
  p.speed_mps = a.speed_mps + share * (b.speed_mps - a.speed_mps);
  return p;
}

}  // namespace otter_nav::trajectory
