#include "otter_nav/vessel/steady_motion.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::vessel {
namespace {

constexpr int kHeadings = 144;  // between which the sway force is looked at for changes of sign
constexpr int kHeadingHalvings = 40;
constexpr double kNothingN = 1e-6;

}  // namespace

SteadyMotion steadyOn(double psi_rad, const Eigen::Vector2d& velocity, const Parameters& vessel,
                      const Disturbance& disturbance) {
  const Demand demand = demandOf(vessel.manoeuvring, disturbance, psi_rad, 0.0, 0.0, velocity,
                                 Eigen::Vector2d::Zero());
  SteadyMotion motion;
  motion.psi_rad = wrapAngle(psi_rad);
  motion.thrusts = thrustsFromTau(demand.tau, vessel.thrusters);
  motion.thrust_share = shareOfLimit(motion.thrusts, vessel.thrusters);
  motion.sway_n = demand.sway_n;
  return motion;
}

std::vector<SteadyMotion> steadyHeadings(const Eigen::Vector2d& velocity, double psi_near_rad,
                                         const Parameters& vessel, const Disturbance& disturbance) {
  const auto on = [&](double psi) { return steadyOn(psi, velocity, vessel, disturbance); };
  std::vector<SteadyMotion> found;
  SteadyMotion before = on(psi_near_rad);
  if (std::abs(before.sway_n) <= kNothingN) {
    found.push_back(before);
  }
  constexpr double kStepRad = 2.0 * kPi / kHeadings;
  for (int k = 0; k < kHeadings; ++k) {
    double low = psi_near_rad + k * kStepRad;
    double high = low + kStepRad;
    const SteadyMotion after = on(high);
    const bool either = std::min(std::abs(before.sway_n), std::abs(after.sway_n)) <= kNothingN;
    if (!either && before.sway_n * after.sway_n < 0.0) {
      for (int i = 0; i < kHeadingHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        (on(middle).sway_n * before.sway_n > 0.0 ? low : high) = middle;
      }
      found.push_back(on(0.5 * (low + high)));
    } else if (k + 1 < kHeadings && std::abs(after.sway_n) <= kNothingN &&
               std::abs(before.sway_n) > kNothingN) {
      found.push_back(after);
    }
    before = after;
  }
  std::sort(found.begin(), found.end(), [&](const SteadyMotion& a, const SteadyMotion& b) {
    return std::abs(wrapAngle(a.psi_rad - psi_near_rad)) <
           std::abs(wrapAngle(b.psi_rad - psi_near_rad));
  });
  return found;
}

}  // namespace otter_nav::vessel
