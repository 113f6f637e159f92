#include <algorithm>
#include <cmath>

#include "otter_nav/map/distance_field.hpp"

namespace otter_nav::map {
namespace {

constexpr double kShortestStep_m = 1e-4;
constexpr double kLeastClearance_m = 1e-6;
// Quick bounds above this times the squared clearance make steps long enough.
constexpr double kEnough = 2.0;

}  // namespace

bool segmentIsClear(const DistanceField& field, const Eigen::Vector2d& from,
                    const Eigen::Vector2d& to, double clearance_m) {
  const double needed = std::max(clearance_m, kLeastClearance_m);
  const double needed2 = needed * needed;
  const double enough = kEnough * needed2;
  double here = field.squaredBound(from, enough);  // squared, as all distances below
  if (here < needed2 || field.squaredBound(to, enough) < needed2 || needed > field.maxDistance()) {
    return false;
  }
  const double length = (to - from).norm();
  if (!(length > 0.0)) {
    return true;
  }
  const Eigen::Vector2d direction = (to - from) / length;
  double at = 0.0;
  double step = length;
  while (at < length) {
    // Twice the half chord would do if the distance stayed the same.
    const double chord = 2.0 * std::sqrt(here - needed2);
    step = std::min({length - at, std::max(chord, kShortestStep_m), 2.0 * step});
    double there = field.squaredBound(from + (at + step) * direction, enough);
    while (there >= needed2 && leastSquaredBetween(here, there, step) < needed2) {
      step *= 0.5;
      if (step < kShortestStep_m) {
        return false;
      }
      there = field.squaredBound(from + (at + step) * direction, enough);
    }
    if (there < needed2) {
      return false;
    }
    here = there;
    at += step;
  }
  return true;
}

}  // namespace otter_nav::map
