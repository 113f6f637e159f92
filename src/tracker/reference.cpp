#include "tracker/reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::tracker {
namespace {

using Eigen::Vector2d;
using vessel::kPsi;
using vessel::kSurge;
using vessel::kSway;
using vessel::kYawRate;

constexpr double kSameHeadingRad = 0.5;
constexpr double kSlowMps = 0.05;
constexpr double kLeastWaitingSpeedMps = 0.3;
// The reference waits for a vessel that is farther behind it (at the start, or where the thrust is
// spent), and catches up by at most so many seconds a second.
constexpr double kLeashLengths = 1.0;
constexpr double kCatchUpRate = 0.5;
constexpr double kTurnBackRadps = 0.3;
constexpr double kOverReference = 1.01;  // of a reference faster than its limit

}  // namespace

// The trajectory at one time, with what it says of the heading.
struct ReferenceSource::Course {
  vessel::FlatPoint flat;
  double psi_rad;   // of the trajectory's own flatness
  double yaw_rate;  // of the same
  bool spins;
};

ReferenceSource::ReferenceSource(const Options& options, const vessel::Parameters& vessel)
    : method_(options.method), vessel_(vessel), inverse_(vessel) {}

void ReferenceSource::wait(double now_s, const Vector2d& position) {
  const vessel::FlatPoint z = flat(now_s);
  const double speed = z.velocity.norm();
  const double elapsed = now_s - waited_at_s_;
  waited_at_s_ = now_s;
  const double spare = speed > 0.0 ? std::max(0.0, speed_max_mps_ / speed - 1.0) : kCatchUpRate;
  lag_s_ = std::max(0.0, lag_s_ - std::min(kCatchUpRate, spare) * elapsed);
  const double behind = speed > 0.0 ? (z.position - position).dot(z.velocity) / speed : 0.0;
  const double leash_m = kLeashLengths * vessel_.hull.length_m;
  if (behind > leash_m) {
    lag_s_ = std::min(lag_s_ + (behind - leash_m) / std::max(speed, kLeastWaitingSpeedMps),
                      now_s - start_s_);
  }
}

void ReferenceSource::start(const trajectory::TimedTrajectory& sailed, double now_s) {
  trajectory_ = &sailed.trajectory;
  start_s_ = sailed.start_time_s;
  speed_max_mps_ = sailed.speed_max_mps;
  rolled_out_ = sailed.rolled_out;
  lag_s_ = 0.0;
  waited_at_s_ = now_s;
  joins_ = false;
  rests_ = false;
  // The heading in force goes on where the new trajectory's own is about the same, and where the
  // wind says how the hull lies.
  const Course c = course(now_s);
  const bool goes_on =
      !rolled_out_ &&
      (in_corridor_ || (started_ && (std::abs(wrapAngle(c.psi_rad - psi_rad_)) <= kSameHeadingRad ||
                                     isAstern(c, psi_rad_))));
  if (!goes_on) {
    psi_rad_ = c.psi_rad;
    psi_time_s_ = now_s;
    started_ = true;
  }
}

void ReferenceSource::join(double now_s, const Vector2d& offset, const Vector2d& velocity_offset,
                           double duration_s) {
  vessel::FlatPoint from;
  from.position = offset;
  from.velocity = velocity_offset;
  joining_ = trajectory::hermitePiece(from, vessel::FlatPoint{}, duration_s);
  joining_start_s_ = now_s;
  joins_ = true;
}

bool ReferenceSource::joining(double time_s) const {
  return joins_ && time_s - joining_start_s_ < joining_.duration_s;
}

void ReferenceSource::rest(const Vector2d& position, double psi_rad, double free_abeam_m) {
  rests_ = true;
  joins_ = false;
  rest_position_ = position;
  rest_psi_rad_ = psi_rad;
  rest_free_abeam_m_ = free_abeam_m;
}

double ReferenceSource::end() const {
  return trajectory_ == nullptr ? start_s_ : start_s_ + trajectory_->duration() + lag_s_;
}

vessel::FlatPoint ReferenceSource::flat(double time_s) const {
  if (rests_) {
    vessel::FlatPoint there;
    there.position = rest_position_;
    return there;
  }
  vessel::FlatPoint z = trajectory_->flat(time_s - start_s_ - lag_s_);
  if (time_s >= end()) {
    z.velocity.setZero();
    z.acceleration.setZero();
    z.jerk.setZero();
    z.snap.setZero();
  }
  if (joining(time_s)) {
    const vessel::FlatPoint offset = joining_.flat(std::max(time_s - joining_start_s_, 0.0));
    z.position += offset.position;
    z.velocity += offset.velocity;
    z.acceleration += offset.acceleration;
    z.jerk += offset.jerk;
    z.snap += offset.snap;
  }
  return z;
}

trajectory::Sample ReferenceSource::at(double time_s) const {
  if (rests_) {
    trajectory::Sample there;
    there.flat = flat(time_s);
    there.state << rest_position_, rest_psi_rad_, 0.0, 0.0, 0.0;
    there.heading_force_n = std::numeric_limits<double>::infinity();
    return there;
  }
  return trajectory_->sample(time_s - start_s_ - lag_s_, vessel_);
}

ReferenceSource::Course ReferenceSource::course(double time_s) const {
  const trajectory::Sample sample = at(time_s);
  Course c;
  c.flat = flat(time_s);
  c.psi_rad = sample.state[kPsi];
  c.yaw_rate = sample.state[kYawRate];
  c.spins = std::isinf(sample.heading_force_n);
  if (joining(time_s) && c.flat.velocity.norm() > kSlowMps) {
    const vessel::FlatState state = inverse_.state(c.flat, c.flat.velocity);
    c.psi_rad = state.state[kPsi];
    c.yaw_rate = state.state[kYawRate];
    c.spins = false;
  }
  return c;
}

// Where a plan goes astern for a moment the course turns round and the hull does not.
bool ReferenceSource::isAstern(const Course& c, double psi_rad) {
  return c.flat.velocity.norm() < vessel::kWalkingMps && !c.spins &&
         std::cos(c.psi_rad - psi_rad) < 0.0;
}

vessel::SwayHeading ReferenceSource::heading(const Course& c, double psi_rad, double dt_s,
                                             const vessel::Disturbance& disturbance) const {
  const double psi_path_rad = isAstern(c, psi_rad) ? psi_rad : c.psi_rad;
  if (rests_) {
    return {c.psi_rad, 1.0};
  }
  // A heading on which the hull would be set aside yields to the position; not where the plan has
  // it carried there.
  const auto holds = [&] {
    return vessel::setOff(vessel_.manoeuvring, disturbance, c.psi_rad, c.yaw_rate, c.flat.velocity,
                          c.flat.acceleration) <= vessel::kRestMps + c.flat.velocity.norm();
  };
  if (!c.spins || !(rolled_out_ || holds())) {
    // Stern to the wind thrust astern holds it, as thrust ahead does on the reverse heading.
    const double turned_rad = stern_to_wind_ ? kPi : 0.0;
    vessel::SwayHeading held =
        vessel::swayHeading(vessel_, disturbance, c.flat.velocity, c.flat.acceleration,
                            psi_rad - turned_rad, psi_path_rad, dt_s);
    held.psi_rad += turned_rad;
    return held;
  }
  // Back from where it yielded it turns, and doesn't jump.
  const double most_rad = (std::abs(c.yaw_rate) + kTurnBackRadps) * dt_s;
  return {psi_rad + std::clamp(wrapAngle(c.psi_rad - psi_rad), -most_rad, most_rad), 1.0};
}

void ReferenceSource::fillFlat(double start_s, double step_s, int stages,
                               const vessel::Disturbance& disturbance, OcpReference& reference) {
  std::array<Course, kMaxStages + 1> courses;
  courses[0] = course(start_s);
  const double elapsed = start_s - psi_time_s_;
  if (elapsed > 0.0) {
    psi_rad_ = heading(courses[0], psi_rad_, elapsed, disturbance).psi_rad;
    psi_time_s_ = start_s;
  }
  double psi = psi_rad_;
  for (int k = 0; k <= stages; ++k) {
    if (k > 0) {
      courses[k] = course(start_s + k * step_s);
      const vessel::SwayHeading next = heading(courses[k], psi, step_s, disturbance);
      psi = unwrapNear(next.psi_rad, psi);
      reference.attitude[k] = next.trust;
    }
    reference.states[k] << courses[k].flat.position, psi, 0.0, 0.0, 0.0;
  }
  reference.attitude[0] = reference.attitude[1];
  // Yaw rate and acceleration by differences: central, one-sided at the ends.
  const auto psiAt = [&](int k) { return reference.states[k][kPsi]; };
  for (int k = 0; k <= stages; ++k) {
    const int centre = std::clamp(k, 1, std::max(1, stages - 1));
    double rate = courses[k].yaw_rate;
    double acceleration = 0.0;
    if (stages >= 2) {
      acceleration =
          (psiAt(centre + 1) - 2.0 * psiAt(centre) + psiAt(centre - 1)) / (step_s * step_s);
      rate = (psiAt(centre + 1) - psiAt(centre - 1)) / (2.0 * step_s) +
             (k - centre) * step_s * acceleration;
    }
    reference.states[k][kYawRate] = rate;
    const vessel::FlatPoint& z = courses[k].flat;
    const vessel::Demand demand = vessel::demandOf(vessel_.manoeuvring, disturbance, psiAt(k), rate,
                                                   acceleration, z.velocity, z.acceleration);
    reference.states[k][kSurge] = demand.surge_mps;
    reference.states[k][kSway] = demand.sway_mps;
    if (k < stages) {
      reference.thrusts[k] = vessel::clampThrusts(
          vessel::thrustsFromTau(demand.tau, vessel_.thrusters), vessel_.thrusters);
    }
  }
}

void ReferenceSource::fillPlain(double start_s, double step_s, int stages,
                                OcpReference& reference) const {
  double psi = psi_rad_;
  reference.attitude.fill(1.0);
  for (int k = 0; k <= stages; ++k) {
    const Course c = course(start_s + k * step_s);
    const double speed = c.flat.velocity.norm();
    if (c.spins || speed < kSlowMps) {
      psi = unwrapNear(c.psi_rad, psi);
    } else {
      psi = unwrapNear(angleOf(c.flat.velocity), psi);
    }
    reference.states[k] << c.flat.position, psi, speed, 0.0, 0.0;
    if (k < stages) {
      reference.thrusts[k].setZero();
    }
  }
}

void ReferenceSource::fill(double start_s, double step_s, int stages, double psi_near_rad,
                           const vessel::Disturbance& disturbance, OcpReference& reference) {
  if (method_ == Method::kPlain) {
    fillPlain(start_s, step_s, stages, reference);
  } else {
    in_corridor_ = std::isfinite(reference.corridor.half_width_rad);
    if (stern_to_wind_ != reference.corridor.is_sterns) {
      stern_to_wind_ = reference.corridor.is_sterns;
      psi_rad_ = psi_near_rad;
    }
    fillFlat(start_s, step_s, stages, disturbance, reference);
  }
  reference.free_abeam_m = rests_ ? rest_free_abeam_m_ : 0.0;
  const double turns =
      unwrapNear(reference.states[0][kPsi], psi_near_rad) - reference.states[0][kPsi];
  for (int k = 0; k <= stages; ++k) {
    reference.states[k][kPsi] += turns;
    // A trajectory may begin above the limit; the way to it may not go beyond what either allows.
    const double time_s = start_s + k * step_s;
    const double planned = joining(time_s)
                               ? trajectory_->flat(time_s - start_s_ - lag_s_).velocity.norm()
                               : vessel::speedOf(reference.states[k]);
    reference.speed_max_mps[k] = std::max(speed_max_mps_, kOverReference * planned);
  }
}

}  // namespace otter_nav::tracker
