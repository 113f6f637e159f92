// Thrusts to surge force and yaw moment and back (paper, equation 5).
#pragma once

#include <algorithm>

#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::vessel {

// tau_u = F_r + F_l, tau_r = b (F_r - F_l).
inline Tau tauFromThrusts(const Thrusts& thrusts, const Thrusters& limits) {
  return {thrusts[kRight] + thrusts[kLeft],
          limits.lever_arm_m * (thrusts[kRight] - thrusts[kLeft])};
}

inline Thrusts thrustsFromTau(const Tau& tau, const Thrusters& limits) {
  const double difference = tau.yaw_nm / limits.lever_arm_m;
  return {0.5 * (tau.surge_n - difference), 0.5 * (tau.surge_n + difference)};
}

// How far the worse thruster is inside its limits, N; negative when outside. The set of tau with
// a margin of zero or more is the diamond.
inline double thrustMargin(const Thrusts& thrusts, const Thrusters& limits) {
  return std::min(limits.ahead_max_n - thrusts.maxCoeff(),
                  limits.astern_max_n + thrusts.minCoeff());
}

// Of its limit ahead or astern: 1 is all a thruster has.
inline double shareOfLimit(double thrust_n, const Thrusters& limits) {
  return thrust_n >= 0.0 ? thrust_n / limits.ahead_max_n
                         : -thrust_n / std::max(limits.astern_max_n, 1e-9);
}
// Of the one that gives more of it.
inline double shareOfLimit(const Thrusts& thrusts, const Thrusters& limits) {
  return std::max(shareOfLimit(thrusts[kLeft], limits), shareOfLimit(thrusts[kRight], limits));
}

// With one thruster full ahead and the other full astern, N m.
inline double greatestMoment(const Thrusters& limits) {
  return limits.lever_arm_m * (limits.ahead_max_n + limits.astern_max_n);
}

inline Thrusts clampThrusts(const Thrusts& thrusts, const Thrusters& limits) {
  return thrusts.cwiseMin(limits.ahead_max_n).cwiseMax(-limits.astern_max_n);
}

}  // namespace otter_nav::vessel
