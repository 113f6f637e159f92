// This project's planner in OMPL's clothes, so that ompl::tools::Benchmark can run it beside
// OMPL's own on the same problem definitions. The planner itself needs no OMPL.
#pragma once

#include <ompl/base/Planner.h>

#include <functional>

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/planner/planner.hpp"
#include "otter_nav/topology/dubins.hpp"

namespace otter_nav::planner {

// How poses are kept in the states of whatever space a problem is posed in.
struct StateAdapter {
  std::function<topology::Pose(const ompl::base::State*)> pose;
  std::function<void(const trajectory::Sample&, ompl::base::State*)> write;
};

// SE2StateSpace: x, y, yaw.
[[nodiscard]] StateAdapter se2Adapter();

class OmplPlanner : public ompl::base::Planner {
 public:
  // `field` must outlive the planner. Rest to rest between the first start state and the goal,
  // which must be a GoalState. In a control space (two thrusts, RealVectorControlSpace) the
  // solution is a PathControl, else a PathGeometric.
  OmplPlanner(const ompl::base::SpaceInformationPtr& space, const Options& options,
              const vessel::Parameters& vessel, const map::DistanceField& field,
              StateAdapter adapter);

  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& stop) override;
  void clear() override;
  using ompl::base::Planner::solve;

  void setSeed(std::uint64_t seed) { seed_ = seed; }
  // The last query's plan: what the sampled path given to OMPL leaves out.
  [[nodiscard]] const Plan& plan() const { return plan_; }

 private:
  [[nodiscard]] ompl::base::PathPtr statePath() const;
  [[nodiscard]] ompl::base::PathPtr controlPath() const;

  vessel::Parameters vessel_;
  planner::Planner planner_;
  const map::DistanceField* field_;
  StateAdapter adapter_;
  std::uint64_t seed_ = 1;
  Plan plan_;
};

}  // namespace otter_nav::planner
