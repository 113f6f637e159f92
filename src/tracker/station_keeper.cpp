#include "tracker/station_keeper.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::tracker {

using Eigen::Vector2d;
using vessel::kPsi;
using vessel::kSurge;
using vessel::kYawRate;

namespace {

// The vessel on its spot as a mass on a spring: natural frequencies and relative dampings, the
// hull's own linear drag included.
constexpr double kSurgeRadps = 0.845;
constexpr double kSurgeDamping = 0.845;
constexpr double kYawRadps = 1.508;
constexpr double kYawDamping = 1.206;
constexpr double kThrustShare = 0.8;  // of the limits; the rest is for what comes of a sudden
constexpr double kYawShare = 0.6;     // of that for turning, so that some is left for the surge
// Abeam, over length times beam, as wind and waves push; lighter, the heading may be held again.
constexpr double kSideLoadNpm2 = 15.0 / 2.16;
constexpr double kHeldRad = 0.17;

// What `inertia` takes beside its own `drag`.
double damping(double relative, double radps, double inertia, double drag) {
  return std::max(0.0, 2.0 * relative * radps * inertia - drag);
}

}  // namespace

StationKeeper::StationKeeper(const HoldingOptions& options, const vessel::Parameters& vessel)
    : options_(options), vessel_(vessel) {
  const vessel::ManoeuvringModel& m = vessel.manoeuvring;
  surge_gain_npm_ = kSurgeRadps * kSurgeRadps * m.surge_inertia_kg;
  surge_damping_kgps_ = damping(kSurgeDamping, kSurgeRadps, m.surge_inertia_kg, m.surge_drag_kgps);
  yaw_gain_nm_ = kYawRadps * kYawRadps * m.yaw_inertia_kgm2;
  yaw_damping_nms_ = damping(kYawDamping, kYawRadps, m.yaw_inertia_kgm2, m.yaw_drag_kgm2ps);
  side_load_n_ = kSideLoadNpm2 * vessel.hull.length_m * vessel.hull.beam_m;
}

bool StationKeeper::holds(const vessel::State& state) const {
  return !weathervanes_ && (state.head<2>() - position_).norm() < options_.weathervane_radius_m &&
         std::abs(wrapAngle(state[kPsi] - psi_rad_)) < kHeldRad;
}

void StationKeeper::start(const Vector2d& position, double psi_rad) {
  position_ = position;
  psi_rad_ = psi_rad;
  weathervanes_ = false;
}

// Within the diamond; the yaw moment has priority, since without it no surge force points right.
vessel::Thrusts StationKeeper::thrusts(double surge_n, double yaw_nm) const {
  const vessel::Thrusters& t = vessel_.thrusters;
  const double ahead = kThrustShare * t.ahead_max_n;
  const double astern = kThrustShare * t.astern_max_n;
  const double half_range = 0.5 * (ahead + astern);
  const double difference =
      std::clamp(0.5 * yaw_nm / t.lever_arm_m, -kYawShare * half_range, kYawShare * half_range);
  const double mean =
      std::clamp(0.5 * surge_n, -astern + std::abs(difference), ahead - std::abs(difference));
  return {mean - difference, mean + difference};
}

Vector2d StationKeeper::load(double psi_rad, const vessel::Disturbance& disturbance) const {
  const vessel::Demand at_rest = vessel::demandOf(vessel_.manoeuvring, disturbance, psi_rad, 0.0,
                                                  0.0, Vector2d::Zero(), Vector2d::Zero());
  const Vector2d e(std::cos(psi_rad), std::sin(psi_rad));
  return -at_rest.tau.surge_n * e - at_rest.sway_n * Vector2d(-e.y(), e.x());
}

vessel::Thrusts StationKeeper::step(const vessel::State& state,
                                    const vessel::Disturbance& disturbance) {
  const double psi = state[kPsi];
  const Vector2d e(std::cos(psi), std::sin(psi));
  const Vector2d error = position_ - state.head<2>();
  const Vector2d velocity = state[kSurge] * e + state[vessel::kSway] * Vector2d(-e.y(), e.x());
  const Vector2d wanted =
      surge_gain_npm_ * error - surge_damping_kgps_ * velocity - load(psi, disturbance);
  const double distance = error.norm();
  if (distance > options_.weathervane_radius_m) {
    weathervanes_ = true;
  } else if (distance < options_.heading_radius_m && weathervanes_) {
    // Heading may be held again only where the load along the beam is light.
    const Vector2d port(-std::sin(psi_rad_), std::cos(psi_rad_));
    weathervanes_ = std::abs(port.dot(load(psi_rad_, disturbance))) > side_load_n_;
  }
  double heading = psi_rad_;
  if (weathervanes_ && wanted.norm() > 1.0) {
    const bool ahead = e.dot(wanted) >= 0.0;
    heading = std::atan2(wanted.y(), wanted.x()) + (ahead ? 0.0 : kPi);
  } else if (weathervanes_) {
    heading = psi;
  }
  const double turn = std::clamp(wrapAngle(heading - psi), -0.7, 0.7);
  const double yaw = yaw_gain_nm_ * turn - yaw_damping_nms_ * state[kYawRate] -
                     vessel::outsideLoad(psi, vessel_.manoeuvring, disturbance).yaw_nm;
  return thrusts(e.dot(wanted), yaw);
}

vessel::Thrusts StationKeeper::brake(const vessel::State& state,
                                     const vessel::Disturbance& disturbance) const {
  const double surge = -2.0 * surge_damping_kgps_ * state[kSurge];
  const double yaw = -yaw_damping_nms_ * state[kYawRate] -
                     vessel::outsideLoad(state[kPsi], vessel_.manoeuvring, disturbance).yaw_nm;
  return thrusts(surge, yaw);
}

}  // namespace otter_nav::tracker
