// Tracking: the solver's preparation, its feedback, and what stands in when it fails.
#include <algorithm>
#include <cmath>

#include "tracker/core.hpp"

namespace otter_nav::tracker {

using vessel::kPsi;

OcpOptions Tracker::Core::ocpOptions(const Options& o, const vessel::Parameters& vessel) {
  const Weights& w = o.method == Method::kPlain ? o.plain : o.flatness;
  OcpOptions ocp;
  ocp.stages = o.stages;
  ocp.step_s = o.horizon_s / o.stages;
  vessel::State q;
  q << w.position, w.position, w.heading, w.surge, w.sway, w.yaw_rate;
  ocp.weights.state = q * ocp.step_s;
  ocp.weights.terminal = q * w.terminal_gain_s;
  ocp.weights.thrusts = vessel::Thrusts::Constant(w.thrust * ocp.step_s);
  ocp.lower_n.setConstant(-o.thrust_share * vessel.thrusters.astern_max_n);
  ocp.upper_n.setConstant(o.thrust_share * vessel.thrusters.ahead_max_n);
  ocp.far_m = o.far_m;
  return ocp;
}

RtiOptions Tracker::Core::rtiOptions(const Options& o) {
  RtiOptions rti;
  rti.heading_step_rad = o.heading_step_rad;
  rti.step_share = o.step_share;
  return rti;
}

void Tracker::Core::prepareSolver(double start_s, double psi_rad) {
  solver_.setDisturbance(navigator_.disturbance());
  if (options_.plan_thrust_rate) {
    solver_.limitRates(last_thrusts_, options_.thrust_rate_nps);
  }
  reference_source_.fill(start_s, prediction_.step_s, options_.stages, psi_rad,
                         navigator_.disturbance(), reference_);
  if (plan_valid_) {
    solver_.shift((start_s - solved_for_s_) / prediction_.step_s);
  } else {
    solver_.initialize(reference_);
  }
  solved_for_s_ = start_s;
  prepared_for_s_ = start_s;
  prepared_ = true;
  solver_.prepare(reference_);
}

void Tracker::Core::prepare(double next_s) {
  if (mode_ == Mode::kTracking && plan_valid_) {
    const double start_s = next_s + vessel_.thrusters.lag_s;
    prepareSolver(start_s, solver_.states()[0][kPsi]);
  }
}

vessel::Thrusts Tracker::Core::track(double now_s, const vessel::State& state, Command& command) {
  // The thrusters follow with their lag, so the plan starts where the vessel will be by then.
  const double start_s = now_s + vessel_.thrusters.lag_s;
  const vessel::State start = vessel_.thrusters.lag_s > 0.0 ? navigator_.predict(start_s) : state;
  if (!prepared_ || std::abs(prepared_for_s_ - start_s) > 0.5 * options_.period_s) {
    prepareSolver(start_s, start[kPsi]);
  }
  prepared_ = false;
  command.solver = solver_.feedback(start);
  command.solver_iterations = solver_.iterations();
  if (!usable(command.solver)) {
    plan_valid_ = false;
    return afterFailure(now_s, state, command);
  }
  plan_valid_ = true;
  last_good_s_ = now_s;
  keepPlan(start_s);
  return solver_.thrusts()[0];
}

// The last good plan carries on for a while; then the vessel brakes.
vessel::Thrusts Tracker::Core::afterFailure(double now_s, const vessel::State& state,
                                            Command& command) {
  command.reason = "no plan: the last one is kept";
  const double since = now_s + vessel_.thrusters.lag_s - prediction_.start_s;
  const int stage = static_cast<int>(since / prediction_.step_s);
  if (prediction_.size == 0 || now_s - last_good_s_ > options_.keep_plan_s || stage < 0 ||
      stage >= options_.stages) {
    beginStop("no usable plan");
    return keeper_.brake(state, navigator_.disturbance());
  }
  return plan_thrusts_[static_cast<std::size_t>(stage)];
}

void Tracker::Core::keepPlan(double start_s) {
  prediction_.start_s = start_s;
  prediction_.size = options_.stages + 1;
  std::copy_n(solver_.states().begin(), prediction_.size, prediction_.states.begin());
  plan_thrusts_ = solver_.thrusts();
}

}  // namespace otter_nav::tracker
