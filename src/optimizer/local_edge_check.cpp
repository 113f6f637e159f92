#include <algorithm>
#include <cmath>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/optimizer/local_optimizer.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kStepS = 0.1;
constexpr double kLeastSlackM = 0.01;
constexpr double kSlowMps = 0.3;        // slower, the start's and goal's pieces are rebuilt anyway
constexpr double kTurningRadps = 0.15;  // a course turning less counts as straight

}  // namespace

EdgeCheck LocalOptimizer::check(const map::DistanceField& field,
                                const trajectory::Piece& piece) const {
  const vessel::InverseDynamics inverse(vessel_);
  const double force_max = options_.force_share * 2.0 * vessel_.thrusters.ahead_max_n;
  const double floor2 = options_.heading_force_min_n * options_.heading_force_min_n;
  const int steps = std::max(2, static_cast<int>(std::ceil(piece.duration_s / kStepS)));
  double fastest = 0.0;
  double hardest = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double t = piece.duration_s * i / steps;
    const vessel::FlatPoint z = piece.flat(t);
    const double speed = z.velocity.norm();
    fastest = std::max(fastest, speed);
    hardest = std::max(hardest, z.acceleration.norm());
    if (speed > options_.speed_max_mps) {
      return {EdgeFault::kSpeed, t};
    }
    const Eigen::Vector2d force = inverse.surgeForce(z.velocity, z.acceleration);
    if (force.squaredNorm() > force_max * force_max) {
      return {EdgeFault::kForce, t};
    }
    const Eigen::Vector2d w = inverse.headingForce(z.velocity, z.acceleration);
    const double force2 = w.squaredNorm();
    if (speed < kSlowMps) {
      continue;
    }
    const Eigen::Vector2d w1 = inverse.headingForceRate(z.acceleration, z.jerk);
    if (std::abs(cross(w, w1)) > options_.yaw_rate_max_radps * std::max(force2, floor2)) {
      return {EdgeFault::kYawRate, t};
    }
    const double turning = std::abs(cross(z.velocity, z.acceleration)) / (speed * speed);
    if (turning > kTurningRadps && (w.dot(z.velocity) < 0.0 || force2 < floor2)) {
      return {EdgeFault::kHeading, t};
    }
  }
  // Between the samples the speed rises by no more than the acceleration allows.
  const double bound = std::max(fastest + hardest * kStepS, 0.1);
  for (double t = 0.0;;) {
    const double slack = field.clearance(piece.flat(t).position) - options_.clearance_m;
    if (slack < kLeastSlackM) {
      return {EdgeFault::kClearance, t};
    }
    if (t >= piece.duration_s) {
      return {};
    }
    t = std::min(t + slack / bound, piece.duration_s);
  }
}

}  // namespace otter_nav::optimizer
