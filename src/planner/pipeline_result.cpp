// After the search: what is kept, and what is told of it.
#include <string>
#include <utility>

#include "pipeline.hpp"

namespace otter_nav::planner {

// The best by the optimiser's own measure: it trades seconds for jerk at another rate than the
// trees. A stopgap (from stop to stop, or slowed down) is better than nothing, and worse than
// anything optimised.
void Planner::Pipeline::accept(Run& run, trajectory::Trajectory trajectory, bool stopgap) {
  const double jerk = trajectoryCost(trajectory, 0.0);
  const double rank = trajectory.duration() + options_.global.weight_smooth * jerk;
  const bool first = run.plan.outcome != Outcome::kSolved;
  if (!first && (stopgap && !run.stopgap)) {
    return;
  }
  if (!first && stopgap == run.stopgap && rank >= run.rank) {
    return;
  }
  run.rank = rank;
  run.stopgap = stopgap;
  run.plan.trajectory = std::move(trajectory);
  run.plan.outcome = Outcome::kSolved;
}

void Planner::Pipeline::conclude(Run& run) {
  Figures& figures = run.plan.figures;
  figures.node_utilization =
      figures.samples > 0 ? static_cast<double>(figures.nodes) / figures.samples : 0.0;
  if (run.plan.outcome == Outcome::kSolved) {
    run.plan.reason.clear();
    figures.length_m = trajectory::length(run.plan.trajectory);
    figures.duration_s = run.plan.trajectory.duration();
    figures.cost = trajectoryCost(run.plan.trajectory, options_.sigma);
    return;
  }
  if (run.timeUp()) {
    run.plan.outcome = Outcome::kTimeUp;
    run.plan.reason = "the time is up" + (run.plan.reason.empty() ? "" : ": " + run.plan.reason);
  } else if (run.plan.reason.empty()) {
    run.plan.reason = "no way was found in " + std::to_string(figures.samples) + " samples";
  }
}

void Planner::Pipeline::keepTrees(Run& run) const {
  if (!options_.keep_trees) {
    return;
  }
  constexpr int kPointsPerPiece = 8;
  run.plan.guide_path = guide_.points;
  std::vector<trajectory::Piece> pieces;
  for (const Tree* tree : {&search_.fromStart(), &search_.toGoal()}) {
    for (int i = 1; i < tree->size(); ++i) {
      pieces.clear();
      search_.appendEdge(*tree, i, pieces);
      Plan::Branch branch;
      branch.from_goal = tree->direction() == Direction::kToRoot;
      for (const trajectory::Piece& piece : pieces) {
        for (int k = 0; k <= kPointsPerPiece; ++k) {
          branch.points.push_back(piece.flat(piece.duration_s * k / kPointsPerPiece).position);
        }
      }
      run.plan.trees.push_back(std::move(branch));
    }
  }
}

}  // namespace otter_nav::planner
