#include "ompl_planner.hpp"

#include <ompl/base/goals/GoalState.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/control/PathControl.h>
#include <ompl/control/SpaceInformation.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>
#include <ompl/geometric/PathGeometric.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "otter_nav/base/parts.hpp"

namespace otter_nav::planner {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;
constexpr double kPathStepS = 0.1;

// OMPL's condition as the planner's clock: past every budget once the condition holds.
Termination fromOmpl(const ob::PlannerTerminationCondition& stop) {
  const auto began = std::chrono::steady_clock::now();
  Termination termination;
  termination.elapsed_s = [stop, began] {
    return stop() ? std::numeric_limits<double>::infinity()
                  : std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  };
  termination.budget_s = std::numeric_limits<double>::max();
  termination.max_iterations = std::numeric_limits<int>::max();
  return termination;
}

ob::PlannerStatus statusOf(Outcome outcome) {
  switch (outcome) {
    case Outcome::kSolved:
      return ob::PlannerStatus::EXACT_SOLUTION;
    case Outcome::kStartBlocked:
      return ob::PlannerStatus::INVALID_START;
    case Outcome::kGoalBlocked:
      return ob::PlannerStatus::INVALID_GOAL;
    case Outcome::kTimeUp:
      return ob::PlannerStatus::TIMEOUT;
    case Outcome::kNoPath:
      break;
  }
  return ob::PlannerStatus::ABORT;
}

}  // namespace

StateAdapter se2Adapter() {
  using State = ob::SE2StateSpace::StateType;
  StateAdapter adapter;
  adapter.pose = [](const ob::State* state) {
    const auto* se2 = state->as<State>();
    return topology::Pose{{se2->getX(), se2->getY()}, se2->getYaw()};
  };
  adapter.write = [](const trajectory::Sample& sample, ob::State* state) {
    auto* se2 = state->as<State>();
    se2->setXY(sample.state[vessel::kX], sample.state[vessel::kY]);
    se2->setYaw(sample.state[vessel::kPsi]);
  };
  return adapter;
}

OmplPlanner::OmplPlanner(const ob::SpaceInformationPtr& space, const Options& options,
                         const vessel::Parameters& vessel, const map::DistanceField& field,
                         StateAdapter adapter)
    : ob::Planner(space, "otter_nav"),
      vessel_(vessel),
      planner_(options, vessel),
      field_(&field),
      adapter_(std::move(adapter)) {
  specs_.optimizingPaths = true;
  specs_.directed = true;
}

ob::PlannerStatus OmplPlanner::solve(const ob::PlannerTerminationCondition& stop) {
  checkValidity();
  const ob::State* start = pis_.nextStart();
  const auto* goal = dynamic_cast<const ob::GoalState*>(pdef_->getGoal().get());
  if (start == nullptr) {
    return ob::PlannerStatus::INVALID_START;
  }
  if (goal == nullptr) {
    return ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE;
  }
  const topology::Pose from = adapter_.pose(start);
  const topology::Pose to = adapter_.pose(goal->getState());
  Query query;
  query.start.flat.position = from.position;
  query.start.psi_rad = from.psi_rad;
  query.goal.flat.position = to.position;
  query.goal.psi_rad = to.psi_rad;
  query.limits = feasibility::SafetyLimits::of(vessel_);
  query.seed = seed_;
  plan_ = planner_.plan(*field_, query, fromOmpl(stop));
  if (plan_.outcome == Outcome::kSolved) {
    const ob::PathPtr path = dynamic_cast<const oc::SpaceInformation*>(si_.get()) != nullptr
                                 ? controlPath()
                                 : statePath();
    pdef_->addSolutionPath(path, false, 0.0, getName());
  }
  return statusOf(plan_.outcome);
}

ob::PathPtr OmplPlanner::statePath() const {
  auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
  const double duration = plan_.trajectory.duration();
  const int steps = partsOf(duration, kPathStepS, 0);
  ob::ScopedState<> state(si_);
  for (int i = 0; i <= steps; ++i) {
    adapter_.write(plan_.trajectory.sample(duration * i / steps, vessel_), state.get());
    path->append(state.get());
  }
  return path;
}

// Thrusts in the middle of each step, as the benchmark expects where planners choose controls.
ob::PathPtr OmplPlanner::controlPath() const {
  auto path = std::make_shared<oc::PathControl>(si_);
  const auto* space = static_cast<const oc::SpaceInformation*>(si_.get());
  const double duration = plan_.trajectory.duration();
  const int steps = partsOf(duration, kPathStepS, 0);
  ob::ScopedState<> state(si_);
  oc::Control* control = space->allocControl();
  for (int i = 0; i < steps; ++i) {
    adapter_.write(plan_.trajectory.sample(duration * i / steps, vessel_), state.get());
    const vessel::Thrusts thrusts =
        plan_.trajectory.sample(duration * (i + 0.5) / steps, vessel_).thrusts;
    double* values = control->as<oc::RealVectorControlSpace::ControlType>()->values;
    values[0] = thrusts[vessel::kLeft];
    values[1] = thrusts[vessel::kRight];
    path->append(state.get(), control, duration / steps);
  }
  adapter_.write(plan_.trajectory.sample(duration, vessel_), state.get());
  path->append(state.get());
  space->freeControl(control);
  return path;
}

void OmplPlanner::clear() {
  ob::Planner::clear();
  plan_ = Plan();
}

}  // namespace otter_nav::planner
