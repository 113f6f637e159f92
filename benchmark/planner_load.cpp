#include "planner_load.hpp"

#include <algorithm>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/trajectory/motion_along.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::benchmark {
namespace {

void turnIntoLoad(const vessel::Parameters& vessel, const vessel::Disturbance& load,
                  trajectory::Boundary& end) {
  if (vessel::isFirmLoad(vessel, load)) {
    end.psi_rad = wrapAngle(vessel::headingIntoLoad(vessel.manoeuvring, load, end.psi_rad));
  }
}

}  // namespace

planner::Query underLoad(planner::Query query, const Load& load, const vessel::Parameters& vessel,
                         const map::DistanceField& field) {
  constexpr double kLessM = 0.1;  // than the room at the ends
  double clearance_m = query.limits.clearance_m;
  if (load.beside_m) {
    const double room = std::min(field.clearance(query.start.flat.position),
                                 field.clearance(query.goal.flat.position));
    clearance_m = std::min(0.5 * vessel.hull.beam_m + *load.beside_m, room - kLessM);
  }
  query.limits =
      feasibility::SafetyLimits::of(vessel, clearance_m, load.thrust_share.value_or(1.0));
  query.limits.hull_margin_m = load.hull_margin_m.value_or(0.0);
  query.limits.disturbance = load.disturbance;
  turnIntoLoad(vessel, load.disturbance, query.start);
  turnIntoLoad(vessel, load.disturbance, query.goal);
  return query;
}

planner::Query underWay(planner::Query query, const trajectory::Trajectory& sailed,
                        const UnderWay& change, const vessel::Parameters& vessel) {
  constexpr double kMore = 1.05;  // than it takes at that moment
  feasibility::SafetyLimits& limits = query.limits;
  limits.disturbance.force_n = change.force_n.value_or(limits.disturbance.force_n);
  limits.disturbance.current_mps = change.current_mps.value_or(limits.disturbance.current_mps);
  const trajectory::Sample sample = trajectory::MotionAlong(sailed, vessel, limits.disturbance)
                                        .sample(change.at_share * sailed.duration());
  query.start.flat = sample.flat;
  query.start.psi_rad = sample.state[vessel::kPsi];
  limits.thrust_share =
      std::max(limits.thrust_share, kMore * vessel::shareOfLimit(sample.thrusts, vessel.thrusters));
  limits.limitSpeed(change.speed_max_mps.value_or(0.0));
  turnIntoLoad(vessel, limits.disturbance, query.goal);
  return query;
}

}  // namespace otter_nav::benchmark
