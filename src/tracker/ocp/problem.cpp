#include "tracker/ocp/problem.hpp"

#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::tracker {
namespace {

constexpr double kRegularization = 1e-9;  // added to the thrusts' Hessian

}  // namespace

vessel::State stateWeights(const OcpOptions& options, const OcpReference& reference, int stage) {
  vessel::State w = stage == options.stages ? options.weights.terminal : options.weights.state;
  w *= std::exp(-reference.fading_per_s * stage * options.step_s);
  w.segment<3>(vessel::kPsi) *= reference.attitude[static_cast<std::size_t>(stage)];
  return w;
}

double nearness(const vessel::State& x, const vessel::State& reference, double far_m) {
  return 1.0 / std::sqrt(1.0 + (x - reference).head<2>().squaredNorm() / (far_m * far_m));
}

ControlProblem::ControlProblem(const OcpOptions& options)
    : options_(options), hull_(options.length_m, options.beam_m) {
  lower_.fill(options.lower_n);
  upper_.fill(options.upper_n);
}

void ControlProblem::limitRates(const vessel::Thrusts& acting, double rate_nps) {
  for (int k = 0; k < options_.stages; ++k) {
    const double reach = (k + 0.5) * options_.step_s * rate_nps;
    lower_[k] = options_.lower_n.cwiseMax((acting.array() - reach).matrix());
    upper_[k] = options_.upper_n.cwiseMin((acting.array() + reach).matrix());
  }
}

vessel::Thrusts ControlProblem::clampToBounds(int stage, const vessel::Thrusts& thrusts) const {
  return thrusts.cwiseMax(lower_[stage]).cwiseMin(upper_[stage]);
}

// A hull without a thruster abeam turns to make good an error there, or backs off and drives ahead
// again, as a car parks. The share is that of the headings as they are, without its slope by them.
Eigen::Matrix2d ControlProblem::positionShare(const vessel::State& state,
                                              const vessel::State& reference,
                                              double free_abeam_m) const {
  Eigen::Matrix2d share = Eigen::Matrix2d::Identity();
  if (free_abeam_m > 0.0) {
    const Eigen::Vector2d abeam = across(unitVector(state[vessel::kPsi]));
    const double off_m = std::abs(abeam.dot((state - reference).head<2>()));
    const double free = off_m > free_abeam_m ? free_abeam_m / off_m : 1.0;
    share -= free * (1.0 - options_.free_share) * abeam * abeam.transpose();
  }
  return share;
}

// A square of what is missing, by quarter, of the room that the reference has. No more than that is
// asked for: a hull without a thruster abeam moves aside by turning, which brings its other end
// nearer first, and one that leaves its trajectory is where nobody has verified it. What the
// reference leads into is for a new plan to lead round. The diagonal that bounds a slope's square
// stands for it.
void ControlProblem::keepOff(const vessel::State& state, const vessel::State& reference,
                             const NearObstacles& near, qp::StateCost& cost) const {
  const double weight = options_.crowded * options_.step_s;
  for (const Lack& lack : hull_.lacks(near, state, reference, options_.room_m)) {
    const Eigen::Vector3d curvature = weight * lack.slope.cwiseAbs() * lack.slope.lpNorm<1>();
    const Eigen::Vector3d gradient = -weight * lack.missing_m * lack.slope;
    for (int axis = 0; axis < 2; ++axis) {
      cost.weight_p[axis] += curvature[axis];
      cost.gradient_p[axis] += gradient[axis];
    }
    cost.weight_q[0] += curvature[2];
    cost.gradient_q[0] += gradient[2];
  }
}

void ControlProblem::expand(const Plan& plan, const OcpReference& reference, qp::BoxQp& qp) const {
  const int n = options_.stages;
  for (int k = 0; k <= n; ++k) {
    vessel::State w = stateWeights(options_, reference, k);
    w.head<2>() *= nearness(plan.states[k], reference.states[k], options_.far_m);
    const vessel::State g = w.cwiseProduct(plan.states[k] - reference.states[k]);
    qp::StateCost& cost = qp.state_costs[k];
    cost.weight_q = Pack{w[2], w[3], w[4], w[5]};
    cost.gradient_q = Pack{g[2], g[3], g[4], g[5]};
    // A square of the speed over ground beyond the limit: a limit of surge alone would be worth a
    // slalom, which gains way by sliding. Its curvature counts where it is exceeded; the diagonal
    // that bounds it stands for the coupling of surge and sway.
    const Eigen::Vector2d velocity = plan.states[k].segment<2>(vessel::kSurge);
    const double speed = velocity.norm();
    const double over = speed - reference.speed_max_mps[k];
    if (over > 0.0) {
      const double weight = options_.overspeed * options_.step_s;
      const Eigen::Vector2d along = velocity / speed;
      const Eigen::Vector2d curvature = weight * along.cwiseAbs() * along.lpNorm<1>();
      cost.weight_q[1] += curvature.x();
      cost.weight_q[2] += curvature.y();
      cost.gradient_q[1] += weight * over * along.x();
      cost.gradient_q[2] += weight * over * along.y();
    }
    const HeadingCorridor& corridor = reference.corridor;
    const double off = wrapAngle(plan.states[k][vessel::kPsi] - corridor.psi_rad);
    const double astray = std::abs(off) - corridor.half_width_rad;
    if (astray > 0.0) {
      const double weight = options_.astray * options_.step_s;
      cost.weight_q[0] += weight;
      cost.gradient_q[0] += weight * std::copysign(astray, off);
    }
    // The diagonal that bounds it stands for the coupling of x and y.
    const Eigen::Matrix2d share =
        positionShare(plan.states[k], reference.states[k], reference.free_abeam_m);
    const Eigen::Vector2d slope = share * g.head<2>();
    for (int i = 0; i < 2; ++i) {
      cost.weight_p[i] = w[i] * share.row(i).lpNorm<1>();
      cost.gradient_p[i] = slope[i];
    }
    if (reference.near != nullptr && k * options_.step_s <= options_.crowded_s) {
      keepOff(plan.states[k], reference.states[k], *reference.near, cost);
    }
  }
  const vessel::Thrusts& w = options_.weights.thrusts;
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < 2; ++i) {
      qp.input_costs[k].weight[i] = w[i] + kRegularization;
      qp.input_costs[k].gradient[i] = w[i] * (plan.thrusts[k][i] - reference.thrusts[k][i]);
      qp.lower[k][i] = lower_[k][i] - plan.thrusts[k][i];
      qp.upper[k][i] = upper_[k][i] - plan.thrusts[k][i];
    }
  }
}

}  // namespace otter_nav::tracker
