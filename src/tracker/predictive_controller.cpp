#include "tracker/predictive_controller.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "otter_nav/vessel/thrusters.hpp"
#include "tracker/estimator.hpp"

namespace otter_nav::tracker {
namespace {

using vessel::kPsi;

constexpr double kKeepPlanS = 0.3;  // how long the last good plan stands in for a failing solver
constexpr double kTerminalGainS = 1.0;  // the last state weighs as this many seconds
constexpr double kFarLengths = 0.25;    // position errors beyond weigh in proportion, not squared
// Whole steps swing between two plans when thrust is spent, and may turn the plan's headings so far
// that the iteration diverges.
constexpr double kStepShare = 0.5;
constexpr double kHeadingStepRad = 0.5;
constexpr double kFiniteTurnRad = 0.3;  // by which a plan bow to the wind sees the way aside
// Under way, where the water carries the hull, what waves do to it is foreseen for about so long.
// In a load across which no hull lies still it is that which counts, and it lasts.
constexpr double kForeseenS = 3.0;
constexpr double kLightMps = 0.5 * vessel::kRestMps;
// A change of course by which a hull's quickness in turning is told.
constexpr double kTurnRad = 0.2;

// Of the plain method, tuned on its own: its headings and sway are wrong by nature.
Weights plainWeights() {
  Weights w;
  w.heading = 1.0;
  w.sway = 0.0;
  w.yaw_rate = 0.0;
  return w;
}

// The share of the heading's weight that a hull is due. A vessel off its path by e heads back by
// e sqrt(position / heading); what asks for headings quicker than the hull can take them only
// swings it, so that root, in metres, grows with the way made while its full moment turns it a
// little.
double headingShare(const vessel::Parameters& vessel) {
  const double turn_s =
      vessel::turnLaw(vessel, vessel::greatestMoment(vessel.thrusters)).timeTo(kTurnRad);
  return turn_s * turn_s;
}

// How fast the errors to come weigh less.
double fading(const vessel::ManoeuvringModel& model, const vessel::Disturbance& disturbance) {
  const double across = vessel::headingIntoLoad(model, disturbance, 0.0) + kPi / 2.0;
  const double aside_mps = vessel::setAside(model, disturbance, across);
  const double lasts = (aside_mps - kLightMps) / (vessel::kRestMps - kLightMps);
  return (1.0 - std::clamp(lasts, 0.0, 1.0)) / kForeseenS;
}

OcpWeights weightsOf(const Weights& w, double heading_share, double step_s) {
  vessel::State q;
  q << w.position, w.position, w.heading * heading_share, w.surge, w.sway, w.yaw_rate;
  OcpWeights weights;
  weights.state = q * step_s;
  weights.terminal = q * kTerminalGainS;
  weights.thrusts = vessel::Thrusts::Constant(w.thrust * step_s);
  return weights;
}

OcpOptions problemOf(const Options& o, const vessel::Parameters& vessel, double heading_share) {
  OcpOptions ocp;
  ocp.stages = o.stages;
  ocp.step_s = o.horizon_s / o.stages;
  ocp.weights = o.method == Method::kPlain ? weightsOf(plainWeights(), 1.0, ocp.step_s)
                                           : weightsOf(o.flatness, heading_share, ocp.step_s);
  ocp.lower_n.setConstant(-vessel.thrusters.astern_max_n);
  ocp.upper_n.setConstant(vessel.thrusters.ahead_max_n);
  ocp.far_m = kFarLengths * vessel.hull.length_m;
  ocp.length_m = vessel.hull.length_m;
  ocp.beam_m = vessel.hull.beam_m;
  return ocp;
}

RtiOptions iterationOf() {
  RtiOptions rti;
  rti.heading_step_rad = kHeadingStepRad;
  rti.step_share = kStepShare;
  rti.finite_turn_rad = kFiniteTurnRad;
  return rti;
}

}  // namespace

PredictiveController::PredictiveController(const Options& options, const vessel::Parameters& vessel)
    : model_(vessel.manoeuvring),
      flatness_(options.method == Method::kFlatness),
      stages_(options.stages),
      period_s_(options.period_s),
      thrust_rate_nps_(options.thrust_rate_nps),
      lag_s_(vessel.thrusters.lag_s),
      corridor_(vessel),
      heading_share_(headingShare(vessel)),
      solver_(problemOf(options, vessel, heading_share_), iterationOf(), vessel.manoeuvring,
              vessel.thrusters) {
  prediction_.step_s = options.horizon_s / options.stages;
}

void PredictiveController::setWeights(const Weights& weights) {
  if (flatness_) {
    solver_.setWeights(weightsOf(weights, heading_share_, prediction_.step_s));
    prepared_ = false;
  }
}

void PredictiveController::keepOff(const NearObstacles* near) {
  reference_.near = near;
  prepared_ = false;
}

void PredictiveController::start(bool keep_plan) {
  plan_valid_ = plan_valid_ && keep_plan;
  prepared_ = false;
}

void PredictiveController::prepareFor(double start_s, double psi_rad, const vessel::Thrusts& last,
                                      const Navigator& navigator, ReferenceSource& source) {
  solver_.setDisturbance(navigator.disturbance());
  std::array<WaterMotion, kMaxStages> water;
  for (int k = 0; k < stages_; ++k) {
    water[static_cast<std::size_t>(k)] = navigator.water(start_s + (k + 0.5) * prediction_.step_s);
  }
  solver_.setWater(water);
  solver_.limitRates(last, thrust_rate_nps_);
  corridor_.feel(start_s, navigator.disturbance().wind_mps);
  reference_.corridor =
      flatness_ && !source.isRolledOut() ? corridor_.about(psi_rad) : HeadingCorridor{};
  const bool under_way = flatness_ && !source.rests() && !source.isRolledOut();
  reference_.fading_per_s =
      under_way && tellsCurrent(model_) ? fading(model_, navigator.disturbance()) : 0.0;
  source.fill(start_s, prediction_.step_s, stages_, psi_rad, navigator.disturbance(), reference_);
  if (plan_valid_) {
    solver_.shift((start_s - solved_for_s_) / prediction_.step_s);
  } else {
    solver_.initialize(reference_);
  }
  solved_for_s_ = start_s;
  prepared_for_s_ = start_s;
  prepared_ = true;
  // Where the heading that a path asks for jumps, the reference turns so fast that steps of the
  // model explode about it.
  if (solver_.prepare(reference_) == SolverStatus::kIndefinite && !plan_valid_) {
    solver_.initializeAtRest(reference_);
    solver_.prepare(reference_);
  }
}

void PredictiveController::prepare(double next_s, const vessel::Thrusts& last,
                                   const Navigator& navigator, ReferenceSource& source) {
  if (plan_valid_) {
    prepareFor(next_s + lag_s_, solver_.states()[0][kPsi], last, navigator, source);
  }
}

std::optional<vessel::Thrusts> PredictiveController::step(double now_s, const vessel::State& state,
                                                          const vessel::Thrusts& last,
                                                          const Navigator& navigator,
                                                          ReferenceSource& source,
                                                          Command& command) {
  // The thrusters follow with their lag, so the plan starts where the vessel will be by then.
  const double start_s = now_s + lag_s_;
  const vessel::State start = lag_s_ > 0.0 ? navigator.predict(start_s) : state;
  if (!prepared_ || std::abs(prepared_for_s_ - start_s) > 0.5 * period_s_) {
    prepareFor(start_s, start[kPsi], last, navigator, source);
  }
  prepared_ = false;
  command.solver = solver_.feedback(start);
  command.solver_iterations = solver_.iterations();
  plan_valid_ = usable(command.solver);
  if (!plan_valid_) {
    command.reason = "no plan: the last one is kept";
    return fromLastPlan(now_s);
  }
  last_good_s_ = now_s;
  prediction_.start_s = start_s;
  prediction_.size = stages_ + 1;
  std::copy_n(solver_.states().begin(), prediction_.size, prediction_.states.begin());
  plan_thrusts_ = solver_.thrusts();
  return plan_thrusts_[0];
}

std::optional<vessel::Thrusts> PredictiveController::fromLastPlan(double now_s) const {
  if (prediction_.size == 0 || now_s - last_good_s_ > kKeepPlanS) {
    return std::nullopt;
  }
  const double since = now_s + lag_s_ - prediction_.start_s;
  const int stage = static_cast<int>(since / prediction_.step_s);
  if (stage < 0 || stage >= stages_) {
    return std::nullopt;
  }
  return plan_thrusts_[static_cast<std::size_t>(stage)];
}

}  // namespace otter_nav::tracker
