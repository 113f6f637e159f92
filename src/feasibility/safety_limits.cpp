#include "otter_nav/feasibility/safety_limits.hpp"

namespace otter_nav::feasibility {

SafetyLimits SafetyLimits::of(const vessel::Parameters& vessel) {
  SafetyLimits limits;
  limits.hull = vessel.hull;
  limits.speed_max_mps = vessel.top_speed_mps;
  return limits;
}

}  // namespace otter_nav::feasibility
