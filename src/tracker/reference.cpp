#include "tracker/reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::tracker {
namespace {

using Eigen::Vector2d;
using vessel::kPsi;
using vessel::kSurge;
using vessel::kSway;
using vessel::kYawRate;

// The sway balance's slope over the heading, N per rad, is about the thrust ahead that the way asks
// for. Below the least (at rest, coasting, braking, wind from astern as strong as the drag) the
// position hardly says where the bow should point, and the trajectory's own heading is taken.
// Under more than a light load that heading is only a wish: the plan finds its own from the
// position, and more and more the flat one as the slope grows by kSteadySlopeN.
constexpr double kLeastSlopeN = 10.0;
constexpr double kSteadySlopeN = 30.0;
constexpr double kLightLoadN = 5.0;
constexpr double kSameHeadingRad = 0.5;
constexpr double kSlowMps = 0.05;
constexpr double kLeastWaitingSpeedMps = 0.3;
// The reference waits for a vessel that is farther behind it (at the start, or where the thrust is
// spent), and catches up by at most so many seconds a second.
constexpr double kLeashLengths = 1.0;
constexpr double kCatchUpRate = 0.5;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

// The trajectory at one time, with what it says of the heading.
struct ReferenceSource::Course {
  vessel::FlatPoint flat;
  double psi_rad;   // of the trajectory's own flatness
  double yaw_rate;  // of the same
  bool spins;
};

ReferenceSource::ReferenceSource(const Options& options, const vessel::Parameters& vessel)
    : method_(options.method), vessel_(vessel) {}

void ReferenceSource::wait(double now_s, const Vector2d& position) {
  const vessel::FlatPoint z = flat(now_s);
  const double speed = z.velocity.norm();
  const double elapsed = now_s - waited_at_s_;
  waited_at_s_ = now_s;
  lag_s_ = std::max(0.0, lag_s_ - kCatchUpRate * elapsed);
  const double behind = speed > 0.0 ? (z.position - position).dot(z.velocity) / speed : 0.0;
  const double leash_m = kLeashLengths * vessel_.hull.length_m;
  if (behind > leash_m) {
    lag_s_ = std::min(lag_s_ + (behind - leash_m) / std::max(speed, kLeastWaitingSpeedMps),
                      now_s - start_s_);
  }
}

void ReferenceSource::start(const trajectory::Trajectory* trajectory, double start_s,
                            double now_s) {
  trajectory_ = trajectory;
  start_s_ = start_s;
  lag_s_ = 0.0;
  waited_at_s_ = now_s;
  joins_ = false;
  // The heading in force goes on where the new trajectory's own is about the same.
  const double psi = course(now_s).psi_rad;
  if (!started_ || std::abs(wrapAngle(psi - psi_rad_)) > kSameHeadingRad) {
    psi_rad_ = psi;
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

double ReferenceSource::end() const {
  return trajectory_ == nullptr ? start_s_ : start_s_ + trajectory_->duration() + lag_s_;
}

vessel::FlatPoint ReferenceSource::flat(double time_s) const {
  vessel::FlatPoint z = trajectory_->flat(time_s - start_s_ - lag_s_);
  if (time_s >= end()) {
    z.velocity.setZero();
    z.acceleration.setZero();
    z.jerk.setZero();
    z.snap.setZero();
  }
  const double t = time_s - joining_start_s_;
  if (joins_ && t < joining_.duration_s) {
    const vessel::FlatPoint offset = joining_.flat(std::max(t, 0.0));
    z.position += offset.position;
    z.velocity += offset.velocity;
    z.acceleration += offset.acceleration;
    z.jerk += offset.jerk;
    z.snap += offset.snap;
  }
  return z;
}

trajectory::Sample ReferenceSource::at(double time_s) const {
  return trajectory_->sample(time_s - start_s_ - lag_s_, vessel_);
}

ReferenceSource::Course ReferenceSource::course(double time_s) const {
  const trajectory::Sample sample = at(time_s);
  Course c;
  c.flat = flat(time_s);
  c.psi_rad = sample.state[kPsi];
  c.yaw_rate = sample.state[kYawRate];
  c.spins = std::isinf(sample.heading_force_n);
  const bool joining = joins_ && time_s - joining_start_s_ < joining_.duration_s;
  if (joining && c.flat.velocity.norm() > kSlowMps) {
    const vessel::FlatState state = vessel::stateFromFlat(c.flat, vessel_.paper, c.flat.velocity);
    c.psi_rad = state.state[kPsi];
    c.yaw_rate = state.state[kYawRate];
    c.spins = false;
  }
  return c;
}

ReferenceSource::Heading ReferenceSource::heading(const Course& c, double psi_rad, double dt_s,
                                                  const vessel::Disturbance& d) const {
  const vessel::ManoeuvringModel& m = vessel_.manoeuvring;
  const Vector2d w = c.flat.velocity - d.current_mps;
  double psi = unwrapNear(psi_rad, c.psi_rad);
  const double before = psi;
  if (c.spins) {
    return {c.psi_rad, 1.0};
  }
  double slope = 0.0;
  for (int iteration = 0; iteration < 3; ++iteration) {
    const Vector2d e(std::cos(psi), std::sin(psi));
    const double u = e.dot(w);
    const double v = cross(e, w);
    const double drag = m.sway_drag_kgps + m.sway_drag_quadratic_kgpm * std::abs(v);
    const double drag_slope = m.sway_drag_kgps + 2.0 * m.sway_drag_quadratic_kgpm * std::abs(v);
    const vessel::OutsideLoad load = vessel::outsideLoad(psi, m, d);
    const double balance =
        load.sway_n - drag * v - m.sway_inertia_kg * cross(e, c.flat.acceleration);
    slope = drag_slope * u + m.sway_inertia_kg * e.dot(c.flat.acceleration) + load.sway_slope_n;
    const double turning = (m.sway_centripetal_kg - m.sway_inertia_kg) * u + m.sway_from_yaw_kgmps;
    if (slope < kLeastSlopeN || turning > 0.0) {
      psi = c.psi_rad;
      break;
    }
    psi -= (turning * (psi - before) / dt_s - balance) / (turning / dt_s - slope);
  }
  const vessel::OutsideLoad load = vessel::outsideLoad(psi, m, d);
  const double calm = 2.0 - std::hypot(load.surge_n, load.sway_n) / kLightLoadN;
  const double steady = (slope - kLeastSlopeN) / kSteadySlopeN;
  return {psi, std::clamp(std::max(calm, steady), 0.0, 1.0)};
}

// Surge and sway from the heading, thrusts from the equations of motion.
void ReferenceSource::setDynamics(const Course& c, double yaw_acceleration,
                                  const vessel::Disturbance& d, vessel::State& x,
                                  vessel::Thrusts& thrusts) const {
  const vessel::ManoeuvringModel& m = vessel_.manoeuvring;
  const Vector2d e(std::cos(x[kPsi]), std::sin(x[kPsi]));
  const double r = x[kYawRate];
  const Vector2d w = c.flat.velocity - d.current_mps;
  const double u = e.dot(w);
  const double v = cross(e, w);
  x[kSurge] = e.dot(c.flat.velocity);
  x[kSway] = cross(e, c.flat.velocity);
  const vessel::OutsideLoad load = vessel::outsideLoad(x[kPsi], m, d);
  vessel::Tau tau;
  tau.surge_n = m.surge_inertia_kg * (e.dot(c.flat.acceleration) + r * v) -
                m.surge_centripetal_kg * v * r - load.surge_n +
                (m.surge_drag_kgps + m.surge_drag_quadratic_kgpm * std::abs(u)) * u;
  tau.yaw_nm = m.yaw_inertia_kgm2 * yaw_acceleration - load.yaw_nm + m.munk_kg * u * v +
               m.yaw_from_sway_kgmps * v +
               (m.yaw_drag_kgm2ps + m.yaw_drag_quadratic_kgm2 * std::abs(r)) * r;
  thrusts = vessel::clampThrusts(vessel::thrustsFromTau(tau, vessel_.thrusters), vessel_.thrusters);
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
      const Heading next = heading(courses[k], psi, step_s, disturbance);
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
    vessel::Thrusts thrusts;
    setDynamics(courses[k], acceleration, disturbance, reference.states[k], thrusts);
    if (k < stages) {
      reference.thrusts[k] = thrusts;
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
      psi = unwrapNear(std::atan2(c.flat.velocity.y(), c.flat.velocity.x()), psi);
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
    fillFlat(start_s, step_s, stages, disturbance, reference);
  }
  const double turns =
      unwrapNear(reference.states[0][kPsi], psi_near_rad) - reference.states[0][kPsi];
  for (int k = 0; k <= stages; ++k) {
    reference.states[k][kPsi] += turns;
  }
}

}  // namespace otter_nav::tracker
