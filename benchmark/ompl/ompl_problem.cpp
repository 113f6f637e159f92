#include "ompl_problem.hpp"

#include <ompl/base/goals/GoalState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/control/SimpleSetup.h>
#include <ompl/control/planners/kpiece/KPIECE1.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/planners/sst/SST.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/tools/benchmark/Benchmark.h>
#include <ompl/util/Console.h>

#include <memory>

#include "ompl_planner.hpp"
#include "ompl_recorder.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/rk4.hpp"
#include "otter_nav/vessel/model.hpp"

namespace otter_nav::benchmark {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;
namespace og = ompl::geometric;

constexpr double kStepS = 0.1;
constexpr double kMemoryMb = 2048.0;

ob::RealVectorBounds mapBounds(const map::DistanceField& field) {
  const map::GridGeometry& g = field.geometry();
  ob::RealVectorBounds bounds(2);
  bounds.setLow(0, g.origin.x());
  bounds.setLow(1, g.origin.y());
  bounds.setHigh(0, g.origin.x() + g.resolution_m * g.width);
  bounds.setHigh(1, g.origin.y() + g.resolution_m * g.height);
  return bounds;
}

ob::StateSpacePtr poseSpace(const map::DistanceField& field) {
  auto space = std::make_shared<ob::SE2StateSpace>();
  space->setBounds(mapBounds(field));
  return space;
}

void setPose(ob::SE2StateSpace::StateType& state, const vessel::Pose& pose) {
  state.setXY(pose.position.x(), pose.position.y());
  state.setYaw(pose.psi_rad);
}

ob::PlannerPtr ours(const ob::SpaceInformationPtr& space, const OmplProblem& problem,
                    const planner::StateAdapter& adapter) {
  return std::make_shared<planner::OmplPlanner>(space, problem.options, problem.vessel,
                                                problem.field, adapter);
}

template <typename Setup>
std::vector<OmplRow> run(Setup& setup, const std::vector<ob::PlannerPtr>& planners,
                         const OmplProblem& problem, const planner::StateAdapter& adapter,
                         const OmplBudget& budget, const std::string& name) {
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
  OmplRecorder recorder(problem.field);
  ompl::tools::Benchmark benchmark(setup, name);
  for (const auto& planner : planners) {
    benchmark.addPlanner(planner);
  }
  benchmark.setPostRunEvent(
      [&](const ob::PlannerPtr& planner, ompl::tools::Benchmark::RunProperties&) {
        recorder.record(planner, adapter);
      });
  ompl::tools::Benchmark::Request request;
  request.maxTime = budget.seconds;
  request.maxMem = kMemoryMb;
  request.runCount = static_cast<unsigned>(budget.runs);
  request.displayProgress = true;
  request.saveConsoleOutput = false;
  request.simplify = false;
  benchmark.benchmark(request);
  if (!budget.log.empty()) {
    benchmark.saveResultsToFile((budget.log + "_" + name + ".log").c_str());
  }
  return recorder.rows(benchmark);
}

// Poses, and u, v, r.
constexpr int kPose = 0;
constexpr int kVelocity = 1;

vessel::State readState(const ob::State* state) {
  const auto* compound = state->as<ob::CompoundState>();
  const auto* pose = compound->as<ob::SE2StateSpace::StateType>(kPose);
  const auto* velocity = compound->as<ob::RealVectorStateSpace::StateType>(kVelocity);
  vessel::State x;
  x << pose->getX(), pose->getY(), pose->getYaw(), velocity->values[0], velocity->values[1],
      velocity->values[2];
  return x;
}

void writeState(const vessel::State& x, ob::State* state) {
  auto* compound = state->as<ob::CompoundState>();
  auto* pose = compound->as<ob::SE2StateSpace::StateType>(kPose);
  auto* velocity = compound->as<ob::RealVectorStateSpace::StateType>(kVelocity);
  pose->setXY(x[vessel::kX], x[vessel::kY]);
  pose->setYaw(wrapAngle(x[vessel::kPsi]));
  for (int i = 0; i < 3; ++i) {
    velocity->values[i] = x[vessel::kSurge + i];
  }
}

// Where the vessel is: what KPIECE1 measures its coverage in.
class PositionProjection : public ob::ProjectionEvaluator {
 public:
  explicit PositionProjection(const ob::StateSpace* space) : ob::ProjectionEvaluator(space) {}
  [[nodiscard]] unsigned int getDimension() const override { return 2; }
  void defaultCellSizes() override {
    constexpr double kCellM = 5.0;
    cellSizes_ = {kCellM, kCellM};
  }
  void project(const ob::State* state, Eigen::Ref<Eigen::VectorXd> projection) const override {
    projection = readState(state).head<2>();
  }
};

ob::StateSpacePtr vesselSpace(const OmplProblem& problem) {
  ob::RealVectorBounds velocities(3);
  velocities.setLow(-problem.vessel.top_speed_mps);
  velocities.setHigh(problem.vessel.top_speed_mps);
  velocities.setLow(2, -2.0);
  velocities.setHigh(2, 2.0);
  auto velocity = std::make_shared<ob::RealVectorStateSpace>(3);
  velocity->setBounds(velocities);
  auto space = std::make_shared<ob::CompoundStateSpace>();
  space->addSubspace(poseSpace(problem.field), 1.0);
  space->addSubspace(velocity, 0.3);
  space->registerDefaultProjection(std::make_shared<PositionProjection>(space.get()));
  return space;
}

std::shared_ptr<oc::RealVectorControlSpace> thrustSpace(const ob::StateSpacePtr& states,
                                                        const vessel::Thrusters& thrusters) {
  ob::RealVectorBounds thrusts(2);
  thrusts.setLow(-thrusters.astern_max_n);
  thrusts.setHigh(thrusters.ahead_max_n);
  auto space = std::make_shared<oc::RealVectorControlSpace>(states, 2);
  space->setBounds(thrusts);
  return space;
}

// RK4 of the paper's model under constant thrusts.
void sail(const OmplProblem& problem, const vessel::ManoeuvringModel& model, const ob::State* from,
          const oc::Control* control, double duration, ob::State* to) {
  const double* f = control->as<oc::RealVectorControlSpace::ControlType>()->values;
  const vessel::Thrusts thrusts(f[0], f[1]);
  const auto derivative = [&](double, const vessel::State& x) {
    return vessel::stateDerivative(x, thrusts, model, problem.vessel.thrusters, {});
  };
  writeState(rk4Step(derivative, 0.0, readState(from), duration), to);
}

}  // namespace

std::vector<OmplRow> runGeometric(const OmplProblem& problem, const OmplBudget& budget) {
  og::SimpleSetup setup(poseSpace(problem.field));
  const planner::StateAdapter adapter = planner::se2Adapter();
  setup.setStateValidityChecker([&](const ob::State* state) {
    return problem.field.clearance(adapter.pose(state).position) >=
           feasibility::SafetyLimits::of(problem.vessel).clearance_m;
  });
  setup.getSpaceInformation()->setStateValidityCheckingResolution(0.0005);
  ob::ScopedState<ob::SE2StateSpace> start(setup.getStateSpace());
  ob::ScopedState<ob::SE2StateSpace> goal(setup.getStateSpace());
  setPose(*start, problem.mission.start);
  setPose(*goal, problem.mission.goal);
  setup.setStartAndGoalStates(start, goal, 0.5);
  const auto& space = setup.getSpaceInformation();
  return run(setup,
             {ours(space, problem, adapter), std::make_shared<og::RRTConnect>(space),
              std::make_shared<og::InformedRRTstar>(space), std::make_shared<og::RRTstar>(space)},
             problem, adapter, budget, "geometric");
}

std::vector<OmplRow> runKinodynamic(const OmplProblem& problem, const OmplBudget& budget) {
  const ob::StateSpacePtr states = vesselSpace(problem);
  oc::SimpleSetup setup(thrustSpace(states, problem.vessel.thrusters));
  const auto model = vessel::ManoeuvringModel::fromPaper(problem.vessel.paper);
  planner::StateAdapter adapter;
  adapter.pose = [](const ob::State* state) {
    const vessel::State x = readState(state);
    return topology::Pose{x.head<2>(), x[vessel::kPsi]};
  };
  adapter.write = [](const trajectory::Sample& sample, ob::State* state) {
    writeState(sample.state, state);
  };
  setup.setStatePropagator(
      [&](const ob::State* from, const oc::Control* control, double duration, ob::State* to) {
        sail(problem, model, from, control, duration, to);
      });
  const auto& space = setup.getSpaceInformation();
  setup.setStateValidityChecker([&](const ob::State* state) {
    return space->satisfiesBounds(state) &&
           problem.field.clearance(adapter.pose(state).position) >=
               feasibility::SafetyLimits::of(problem.vessel).clearance_m;
  });
  space->setPropagationStepSize(kStepS);
  space->setMinMaxControlDuration(2, 20);
  ob::ScopedState<> start(states);
  ob::ScopedState<> goal(states);
  vessel::State rest = vessel::State::Zero();
  rest << problem.mission.start.position, problem.mission.start.psi_rad, 0.0, 0.0, 0.0;
  writeState(rest, start.get());
  rest << problem.mission.goal.position, problem.mission.goal.psi_rad, 0.0, 0.0, 0.0;
  writeState(rest, goal.get());
  // Within 2 m and a like error of heading and speed: exact goals are out of these planners' reach.
  setup.setStartAndGoalStates(start, goal, 2.0);
  return run(setup,
             {ours(space, problem, adapter), std::make_shared<oc::KPIECE1>(space),
              std::make_shared<oc::RRT>(space), std::make_shared<oc::SST>(space)},
             problem, adapter, budget, "kinodynamic");
}

}  // namespace otter_nav::benchmark
