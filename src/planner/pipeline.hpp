// The planner's stages for one query, in order.
#pragma once

#include <optional>
#include <vector>

#include "otter_nav/optimizer/global_optimizer.hpp"
#include "otter_nav/planner/guide_line.hpp"
#include "otter_nav/planner/planner.hpp"
#include "otter_nav/planner/search.hpp"
#include "otter_nav/topology/guide_path.hpp"
#include "ways.hpp"

namespace otter_nav::planner {

class Planner::Pipeline {
 public:
  Pipeline(const Options& options, const vessel::Parameters& vessel);
  [[nodiscard]] Plan plan(const map::DistanceField& field, const Query& query,
                          const Termination& termination);

 private:
  // What one query's stages share.
  struct Run {
    Run(const map::DistanceField& on, const Query& asked, const Termination& until)
        : field(on), query(asked), termination(until) {}
    const map::DistanceField& field;
    const Query& query;
    const Termination& termination;
    double clearance_m = 0.0;
    trajectory::Boundary start;
    trajectory::Boundary goal;
    Plan plan;
    int samples_left = 0;
    double rank = 0.0;     // of plan.trajectory, once there is one; less is better
    bool stopgap = false;  // it could not be optimised

    [[nodiscard]] double now() const {
      return termination.elapsed_s ? termination.elapsed_s() : 0.0;
    }
    [[nodiscard]] bool timeUp() const {
      return termination.elapsed_s && termination.elapsed_s() >= termination.budget_s;
    }
  };

  enum class Roots { kAtEnds, kLaunched };

  [[nodiscard]] bool done(const Run& run) const;
  void attemptOnce(Run& run, int attempt);
  bool checkEnds(Run& run) const;
  bool planNearby(Run& run);
  bool findGuide(Run& run);
  void prepareSearch(Run& run);
  void placeRoots(Run& run, Roots roots);
  bool searchTrees(Run& run, int attempt, Roots roots);
  void keepTrees(Run& run) const;
  void closeTreesWay(Run& run);
  void optimizeWay(Run& run, const trajectory::Trajectory& way);
  void optimizeGuide(Run& run);
  void tryWarmStart(Run& run);
  void accept(Run& run, trajectory::Trajectory trajectory, bool stopgap);
  void conclude(Run& run);
  [[nodiscard]] optimizer::Budget optimizerBudget(const Run& run) const;

  Options options_;
  vessel::Parameters vessel_;
  feasibility::EdgeLimits limits_;
  topology::GuidePathFinder finder_;
  double finder_clearance_m_;
  topology::GuidePath guide_;
  GuideLine line_;
  Search search_;
  std::optional<Launch> launch_;
  std::optional<Launch> stop_;
  optimizer::GlobalOptimizer optimizer_;
};

}  // namespace otter_nav::planner
