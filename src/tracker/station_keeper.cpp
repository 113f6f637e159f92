#include "tracker/station_keeper.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/rest.hpp"

namespace otter_nav::tracker {

using Eigen::Vector2d;
using vessel::kPsi;
using vessel::kSurge;
using vessel::kYawRate;

namespace {

// Of a mass on a spring, the hull's own linear drag included: what brakes surge and yaw.
constexpr double kSurgeRadps = 0.845;
constexpr double kSurgeDamping = 0.845;
constexpr double kYawRadps = 1.508;
constexpr double kYawDamping = 1.206;
constexpr double kThrustShare = 0.8;  // of the limits; the rest is for what comes of a sudden
constexpr double kYawShare = 0.6;     // of that for turning, so that some is left for the surge
// Once the heading has yielded, it is held again where the load would set the hull aside this much
// more slowly.
constexpr double kAgainShare = 0.6;
constexpr double kTurnRadps = 0.3;
constexpr double kSternShare = 0.5;  // of the thrust astern, at most, for lying stern to the load
constexpr double kHoldsM = 0.8;
constexpr double kHoldsRad = 0.17;

// What `inertia` takes beside its own `drag`.
double damping(double relative, double radps, double inertia, double drag) {
  return std::max(0.0, 2.0 * relative * radps * inertia - drag);
}

}  // namespace

StationKeeper::StationKeeper(const vessel::Parameters& vessel) : vessel_(vessel) {
  const vessel::ManoeuvringModel& m = vessel.manoeuvring;
  surge_damping_kgps_ = damping(kSurgeDamping, kSurgeRadps, m.surge_inertia_kg, m.surge_drag_kgps);
  yaw_damping_nms_ = damping(kYawDamping, kYawRadps, m.yaw_inertia_kgm2, m.yaw_drag_kgm2ps);
}

bool StationKeeper::holds(const vessel::State& state) const {
  return !weathervanes_ && (state.head<2>() - position_).norm() < kHoldsM &&
         std::abs(wrapAngle(state[kPsi] - psi_rad_)) < kHoldsRad;
}

bool StationKeeper::swingsAbout(const vessel::State& state) const {
  constexpr double kSwingM = 0.3;
  constexpr double kSwingRad = 0.3;
  return !weathervanes_ && (state.head<2>() - position_).norm() < kSwingM &&
         std::abs(wrapAngle(state[kPsi] - psi_rad_)) < kSwingRad;
}

void StationKeeper::start(const Vector2d& position, double psi_rad, double heading_rad,
                          double now_s) {
  position_ = position;
  psi_rad_ = psi_rad;
  held_rad_ = heading_rad;
  time_s_ = now_s;
  weathervanes_ = false;
}

double StationKeeper::intoLoad(const vessel::Disturbance& disturbance) const {
  const vessel::ManoeuvringModel& model = vessel_.manoeuvring;
  const double bow = vessel::headingIntoLoad(model, disturbance, held_rad_);
  const double stern = bow + kPi;
  const bool stern_is_nearer = std::cos(bow - held_rad_) < 0.0;
  if (vessel::isFirmLoad(vessel_, disturbance)) {
    return bow;
  }
  const double astern = -vessel::surgeAtRest(model, disturbance, stern);
  return stern_is_nearer && astern < kSternShare * 2.0 * vessel_.thrusters.astern_max_n ? stern
                                                                                        : bow;
}

double StationKeeper::heading(double now_s, const vessel::Disturbance& disturbance) {
  const double most = (weathervanes_ ? kAgainShare : 1.0) * vessel::kRestMps;
  weathervanes_ = vessel::isFirmLoad(vessel_, disturbance) ||
                  !vessel::canLie(vessel_.manoeuvring, disturbance, psi_rad_, most);
  const double wanted = weathervanes_ ? intoLoad(disturbance) : psi_rad_;
  const double step = kTurnRadps * std::max(0.0, now_s - time_s_);
  held_rad_ += std::clamp(wrapAngle(wanted - held_rad_), -step, step);
  time_s_ = now_s;
  return held_rad_;
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

vessel::Thrusts StationKeeper::brake(const vessel::State& state,
                                     const vessel::Disturbance& disturbance) const {
  const double surge = -2.0 * surge_damping_kgps_ * state[kSurge];
  const double yaw = -yaw_damping_nms_ * state[kYawRate] -
                     vessel::outsideLoad(state[kPsi], vessel_.manoeuvring, disturbance).yaw_nm;
  return thrusts(surge, yaw);
}

}  // namespace otter_nav::tracker
