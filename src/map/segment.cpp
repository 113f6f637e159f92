#include <algorithm>
#include <cmath>

#include "otter_nav/map/distance_field.hpp"

namespace otter_nav::map {
namespace {

constexpr double kShortestStep_m = 1e-4;

}  // namespace

bool segmentIsClear(const DistanceField& field, const Eigen::Vector2d& from,
                    const Eigen::Vector2d& to, double clearance_m) {
  const double needed = std::max(clearance_m, 1e-6);
  const double needed2 = needed * needed;
  const double length = (to - from).norm();
  double here = field.clearance(from);
  if (!(here >= needed) || !field.isClear(to, needed)) {
    return false;
  }
  if (!(length > 0.0)) {
    return true;
  }
  const Eigen::Vector2d direction = (to - from) / length;
  double at = 0.0;
  double step = length;
  while (at < length) {
    // Twice the half chord would do if the distance stayed the same.
    const double chord = 2.0 * std::sqrt(std::max(0.0, here * here - needed2));
    step = std::min({length - at, std::max(chord, kShortestStep_m), 2.0 * step});
    double there = field.clearance(from + (at + step) * direction);
    if (there < needed) {
      return false;
    }
    while (leastSquaredBetween(here * here, there * there, step) < needed2) {
      step *= 0.5;
      if (step < kShortestStep_m) {
        return false;
      }
      there = field.clearance(from + (at + step) * direction);
      if (there < needed) {
        return false;
      }
    }
    here = there;
    at += step;
  }
  return true;
}

}  // namespace otter_nav::map
