#include "planner/guide_line.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::planner {
namespace {

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
  line_.resample(points, options.spacing_m, 2);
  line_.relax([&](const Eigen::Vector2d& p) { return field.smooth(p); }, options.safe_distance_m,
              options.relaxations);
  line_.setDirections();
  const vessel::PaperModel& model = vessel.paper;
  const double share = options.ramp_share / model.m1_kg;
  const double astern = std::min(2.0 * vessel.thrusters.astern_max_n, options.force_ahead_n);
  line_.setSpeeds(
      [&](double curvature) {
        return std::min(options.speed_mps, turningSpeed(model, options.force_ahead_n, curvature));
      },
      [&](double speed) {
        return share * std::max(0.0, options.force_ahead_n - model.d1_kgps * speed);
      },
      [&](double /*speed*/) { return share * astern; }, options.speed_start_mps, 0.0);
  half_width_m_.clear();
  for (const trajectory::PathLine::Point& point : line_.points()) {
    half_width_m_.push_back(
        std::clamp(field.clearance(point.position), options.half_width_min_m, options.corridor_m));
  }
}

GuideLine::Point GuideLine::at(double s_m) const {
  const trajectory::PathLine::Place place = line_.locate(s_m);
  const double width = half_width_m_[place.index];
  return {line_.at(place), width + place.share * (half_width_m_[place.index + 1] - width)};
}

}  // namespace otter_nav::planner
