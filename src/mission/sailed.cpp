#include "sailed.hpp"

#include <algorithm>

#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::mission {

stopping::Off Sailed::off(const Moment& m, const vessel::Parameters& vessel) const {
  if (isEmpty() || !m.situation.state.allFinite()) {
    return {};
  }
  return stopping::offTrajectory(path.trajectory, path.elapsed(m.now_s), m.situation.state, vessel,
                                 plan.limits.disturbance);
}

double Sailed::wayLeft(double now_s) const {
  constexpr double kStepS = 0.5;
  double way_m = 0.0;
  for (double t = path.elapsed(now_s); t < path.trajectory.duration(); t += kStepS) {
    way_m += kStepS * path.trajectory.flat(t).velocity.norm();
  }
  return way_m;
}

double overtaxed(double now_s, const trajectory::TimedTrajectory& path,
                 const vessel::Parameters& vessel, const vessel::Disturbance& disturbance) {
  constexpr double kStepS = 0.25;
  constexpr double kAheadS = 30.0;
  const double from = path.elapsed(now_s);
  const double to = std::min(path.trajectory.duration(), from + kAheadS);
  double longer = 0.0;
  for (double t = from; t < to; t += kStepS) {
    const vessel::Thrusts thrusts = path.trajectory.sample(t, vessel, disturbance).thrusts;
    longer += vessel::thrustMargin(thrusts, vessel.thrusters) < 0.0 ? kStepS : 0.0;
  }
  return longer;
}

}  // namespace otter_nav::mission
