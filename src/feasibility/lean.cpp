#include "otter_nav/feasibility/lean.hpp"

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"

namespace otter_nav::feasibility {
namespace {

constexpr double kLittleShare = 0.01;  // of both thrusters' force
constexpr double kSettledS = 10.0;     // longer than a hull takes to settle on a heading

}  // namespace

bool leansInto(const vessel::Parameters& vessel, const vessel::Disturbance& felt) {
  return vessel::InverseDynamics(vessel, felt).greatestLoadAbeam() >
         kLittleShare * 2.0 * vessel.thrusters.ahead_max_n;
}

Eigen::Vector2d leaningBow(const vessel::Parameters& vessel, const vessel::Disturbance& felt,
                           const Eigen::Vector2d& velocity, const Eigen::Vector2d& acceleration,
                           const Eigen::Vector2d& ahead) {
  const double psi = angleOf(ahead);
  const auto settled = [&](const vessel::Disturbance& disturbance) {
    return vessel::swayHeading(vessel, disturbance, velocity, acceleration, psi, psi, kSettledS)
        .psi_rad;
  };
  return turned(ahead, wrapAngle(settled(felt) - settled({})));
}

}  // namespace otter_nav::feasibility
