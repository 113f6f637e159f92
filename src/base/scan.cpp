#include "otter_nav/base/scan.hpp"

namespace otter_nav {

std::string whyUnusable(const Scan& scan) {
  if (scan.ranges_m.empty()) {
    return "no ranges";
  }
  if (!std::isfinite(scan.angle_min_rad) || !std::isfinite(scan.angle_increment_rad) ||
      (scan.angle_increment_rad == 0.0 && scan.ranges_m.size() > 1)) {
    return "angle_min or angle_increment is not a number, or the increment is 0";
  }
  const double turn =
      std::abs(scan.angle_increment_rad) * (static_cast<double>(scan.ranges_m.size()) - 1.0);
  if (turn > 2.0 * 3.15) {
    return std::to_string(scan.ranges_m.size()) + " ranges go more than once round";
  }
  if (!std::isfinite(scan.range_max_m) || !(scan.range_min_m >= 0.0) ||
      !(scan.range_max_m > scan.range_min_m) || scan.range_max_m > 1e4) {
    return "range_min and range_max need 0 <= range_min < range_max <= 10000 m";
  }
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (std::isfinite(scan.ranges_m[i]) && scan.ranges_m[i] < 0.0F) {
      return "range " + std::to_string(i) + " is negative";
    }
  }
  return "";
}

std::string whyBlind(const Scan& scan) {
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (scan.metSomething(i) || scan.metNothing(i)) {
      return "";
    }
  }
  return "no range is one: all are NaN, -inf or beyond range_min and range_max "
         "(REP-117: +inf where nothing was met)";
}

}  // namespace otter_nav
