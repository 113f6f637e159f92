#include "outline_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::traffic {
namespace {

constexpr int kDirections = 30;
constexpr double kLeastDistanceM = 0.03;  // nearer is as good as on the side: the lidar's noise

// Distance of a projection to the nearer end of its span.
double toEnd(double value, const Span& span) {
  return std::min(value - span.low, span.high - value);
}

// Sum over the points of what `weigh` makes of their distance to the nearest side of the rectangle
// round them.
template <typename Weigh>
double sumOverRectangle(const std::vector<Eigen::Vector2d>& points, double direction_rad,
                        Weigh weigh) {
  const Eigen::Vector2d ahead = unitVector(direction_rad);
  const Eigen::Vector2d port = across(ahead);
  const Span along = spanOf(points, ahead);
  const Span athwart = spanOf(points, port);
  double sum = 0.0;
  for (const Eigen::Vector2d& p : points) {
    sum += weigh(std::min(toEnd(ahead.dot(p), along), toEnd(port.dot(p), athwart)));
  }
  return sum;
}

}  // namespace

Span spanOf(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& axis) {
  Span span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Eigen::Vector2d& p : points) {
    const double along = axis.dot(p);
    span.low = std::min(span.low, along);
    span.high = std::max(span.high, along);
  }
  return span;
}

double rectangleDirection(const std::vector<Eigen::Vector2d>& points) {
  double best = 0.0;
  double best_closeness = -1.0;
  for (int k = 0; k < kDirections; ++k) {
    const double direction = 0.5 * kPi * k / kDirections;
    const double closeness = sumOverRectangle(
        points, direction, [](double off) { return 1.0 / std::max(off, kLeastDistanceM); });
    if (closeness > best_closeness) {
      best_closeness = closeness;
      best = direction;
    }
  }
  return best;
}

double rectangleDeviation(const std::vector<Eigen::Vector2d>& points, double direction_rad) {
  const double sum = sumOverRectangle(points, direction_rad, [](double off) { return off * off; });
  return std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace otter_nav::traffic
