#include "pipeline.hpp"

#include <algorithm>
#include <utility>

#include "otter_nav/planner/sampler.hpp"
#include "ways.hpp"

namespace otter_nav::planner {
namespace {

// Beyond the clearance, that the guide line is pushed out to.
constexpr double kRoomM = 0.7;

feasibility::EdgeLimits edgeLimits(const Options& options, const vessel::Parameters& vessel) {
  feasibility::EdgeLimits limits;
  limits.clearance_m = options.clearance_m;
  limits.speed_max_mps = options.speed_share * vessel.top_speed_mps;
  limits.force_ahead_n = 2.0 * options.force_share * vessel.thrusters.ahead_max_n;
  limits.force_astern_n = 2.0 * options.force_share * vessel.thrusters.astern_max_n;
  return limits;
}

SearchOptions searchOptions(const Options& options, const vessel::Parameters& vessel) {
  SearchOptions search;
  search.sigma = options.sigma;
  search.neighbours = options.neighbours;
  search.max_nodes = options.max_nodes;
  search.edge_max_m = options.edge_max_m;
  search.repair_edges = options.local_optimization;
  search.limits = edgeLimits(options, vessel);
  return search;
}

}  // namespace

Planner::Pipeline::Pipeline(const Options& options, const vessel::Parameters& vessel)
    : options_(options),
      vessel_(vessel),
      limits_(edgeLimits(options, vessel)),
      finder_(options.topology),
      finder_clearance_m_(options.topology.clearance_m),
      search_(searchOptions(options, vessel), options.local, vessel),
      optimizer_(options.global, vessel) {}

Plan Planner::Pipeline::plan(const map::DistanceField& field, const Query& query,
                             const Termination& termination) {
  Run run{field, query, termination};
  run.clearance_m = query.clearance_m > 0.0 ? query.clearance_m : options_.clearance_m;
  run.start = {query.start, query.start_psi_rad};
  run.goal.flat.position = query.goal;
  run.goal.psi_rad = query.goal_psi_rad;
  run.samples_left = termination.max_iterations;
  const double began = run.now();
  if (checkEnds(run) && !planNearby(run) && findGuide(run)) {
    tryWarmStart(run);
    prepareSearch(run);
    const int attempts = std::max(options_.max_attempts, options_.improve_attempts + 1);
    for (int attempt = 0; attempt < attempts && !done(run); ++attempt) {
      attemptOnce(run, attempt);
    }
    keepTrees(run);
  }
  conclude(run);
  run.plan.figures.total_ms = 1e3 * (run.now() - began);
  return std::move(run.plan);
}

// A goal within reach of the hull: straight there, turning on the spot.
bool Planner::Pipeline::planNearby(Run& run) {
  constexpr double kNearM = 0.3;
  if (!trajectory::atRest(run.start) ||
      (run.goal.flat.position - run.start.flat.position).norm() > kNearM) {
    return false;
  }
  const double began = run.now();
  auto nearby = optimizer_.stopAndSpin(run.field, {run.start.flat.position, run.goal.flat.position},
                                       run.start, run.goal, run.clearance_m);
  run.plan.figures.optimize_ms += 1e3 * (run.now() - began);
  if (nearby) {
    accept(run, std::move(nearby->trajectory), false);
  }
  return nearby.has_value();
}

bool Planner::Pipeline::done(const Run& run) const {
  const bool sound = run.plan.outcome == Outcome::kSolved && !run.stopgap;
  const bool improve = run.plan.figures.attempts <= options_.improve_attempts;
  return run.timeUp() || run.samples_left <= 0 || (sound && !improve);
}

// A tree's way, optimised; failing that the guide path, and failing that the tree's way made sound
// by the least that will do. Later attempts draw other samples.
void Planner::Pipeline::attemptOnce(Run& run, int attempt) {
  ++run.plan.figures.attempts;
  if (!options_.global_optimization) {
    if (searchTrees(run, attempt, Roots::kLaunched)) {
      closeTreesWay(run);
    }
    return;
  }
  if (searchTrees(run, attempt, Roots::kAtEnds)) {
    run.plan.figures.tree_cost = search_.bestCost();
    optimizeWay(run, trajectory::Trajectory(search_.recall()));
  }
  if (attempt == 0 && !done(run)) {
    optimizeGuide(run);
  }
  if (!done(run) && run.query.warm_start != nullptr && attempt == 0) {
    optimizeWay(run, *run.query.warm_start);
  }
  const bool poor = run.plan.outcome != Outcome::kSolved || (run.stopgap && attempt == 0);
  if (poor && !run.timeUp() && searchTrees(run, attempt, Roots::kLaunched)) {
    closeTreesWay(run);
  }
}

void Planner::Pipeline::prepareSearch(Run& run) {
  GuideLineOptions line;
  line.speed_mps = options_.sample_speed_share * vessel_.top_speed_mps;
  line.speed_start_mps = run.query.start.velocity.norm();
  line.force_ahead_n = limits_.force_ahead_n;
  line.corridor_m = options_.corridor_m;
  line.safe_distance_m = run.clearance_m + kRoomM;
  line_.build(guide_.points, run.field, vessel_, line);
  feasibility::EdgeLimits limits = limits_;
  limits.clearance_m = run.clearance_m;
  search_.setLimits(limits);
}

// Roots at the ends themselves where the whole will be optimised: which way to leave is chosen
// there. Without it, after a straight launch and before a straight stop along the guide path.
void Planner::Pipeline::placeRoots(Run& run, Roots roots) {
  KinoState start;
  start.position = run.query.start.position;
  start.velocity = run.query.start.velocity;
  start.acceleration = run.query.start.acceleration;
  KinoState goal;
  goal.position = run.query.goal;
  launch_.reset();
  stop_.reset();
  if (roots == Roots::kLaunched) {
    stop_ = stopAt(goal.position, line_.at(line_.length()).direction, vessel_.top_speed_mps);
    goal = stop_->root;
    if (trajectory::atRest(run.start)) {
      launch_ = launchFrom(start.position, line_.at(0.0).direction, vessel_.top_speed_mps);
      start = launch_->root;
    }
  }
  search_.reset(run.field, start, goal);
}

// Samples until the trees meet, then improve_samples more.
bool Planner::Pipeline::searchTrees(Run& run, int attempt, Roots roots) {
  const double began = run.now();
  placeRoots(run, roots);

  SamplerOptions options;
  options.key_spacing_m = options_.key_spacing_m / (1.0 + 0.5 * attempt);
  options.uniform_share = options_.uniform_share;
  options.accel_mps2 = options_.sample_accel_mps2;
  options.speed_max_mps = options_.sample_speed_share * vessel_.top_speed_mps;
  Sampler sampler(options, line_, run.field,
                  run.query.seed + 0x9e3779b97f4a7c15ULL * static_cast<std::uint64_t>(attempt));
  search_.joinRoots();
  int budget = std::min(run.samples_left, options_.attempt_samples);
  int improving = options_.improve_samples;
  while (budget-- > 0 && !run.timeUp()) {
    if (search_.solved() && improving-- <= 0) {
      break;
    }
    search_.extend(sampler.next());
    if (search_.solved() && run.plan.figures.first_solution_ms == 0.0) {
      run.plan.figures.first_solution_ms = 1e3 * run.now();
    }
  }
  const SearchCounts counts = search_.counts();
  Figures& figures = run.plan.figures;
  figures.samples += counts.samples;
  figures.nodes += counts.joined;
  figures.local_repairs += counts.repairs;
  figures.tree_ms += 1e3 * (run.now() - began);
  run.samples_left -= counts.samples;
  return search_.solved();
}

void Planner::Pipeline::closeTreesWay(Run& run) {
  const double began = run.now();
  std::vector<trajectory::Piece> whole;
  if (launch_) {
    whole.push_back(launch_->piece);
  }
  const std::vector<trajectory::Piece> way = search_.recall();
  whole.insert(whole.end(), way.begin(), way.end());
  whole.push_back(stop_->piece);
  run.plan.figures.tree_cost = search_.bestCost();
  auto closed = closeWay(whole, run.start, run.goal, run.field, vessel_,
                         optimizer_.checkOptions(run.clearance_m));
  run.plan.figures.verify_ms += 1e3 * (run.now() - began);
  if (closed) {
    accept(run, std::move(*closed), options_.global_optimization);
  } else if (run.plan.outcome != Outcome::kSolved) {
    run.plan.reason = closed.error().message;
  }
}

optimizer::Budget Planner::Pipeline::optimizerBudget(const Run& run) const {
  optimizer::Budget budget;
  budget.elapsed_s = run.termination.elapsed_s;
  budget.budget_s = run.termination.budget_s;
  return budget;
}

// One attempt only: the guide path's way is a better second one.
void Planner::Pipeline::optimizeWay(Run& run, const trajectory::Trajectory& way) {
  const double began = run.now();
  optimizer::Budget budget = optimizerBudget(run);
  budget.max_attempts = 1;
  auto optimized =
      optimizer_.optimize(run.field, way, run.start, run.goal, budget, run.clearance_m);
  run.plan.figures.optimize_ms += 1e3 * (run.now() - began);
  if (optimized) {
    run.plan.figures.iterations += optimized->iterations;
    accept(run, std::move(optimized->trajectory), optimized->last_resort);
  } else if (run.plan.outcome != Outcome::kSolved) {
    run.plan.reason = optimized.error().message;
  }
}

// The tree's way could not be made sound: the guide path itself may be.
void Planner::Pipeline::optimizeGuide(Run& run) {
  const double began = run.now();
  auto optimized = optimizer_.optimize(run.field, guide_.points, run.start, run.goal,
                                       optimizerBudget(run), run.clearance_m);
  run.plan.figures.optimize_ms += 1e3 * (run.now() - began);
  if (optimized) {
    run.plan.figures.iterations += optimized->iterations;
    accept(run, std::move(optimized->trajectory), optimized->last_resort);
  }
}

// What is being sailed stays a candidate, improved if that can be done.
void Planner::Pipeline::tryWarmStart(Run& run) {
  if (run.query.warm_start == nullptr || run.query.warm_start->empty()) {
    return;
  }
  const double began = run.now();
  const auto verification =
      feasibility::verify(*run.query.warm_start, run.field, vessel_, run.start, run.goal,
                          optimizer_.checkOptions(run.clearance_m));
  run.plan.figures.verify_ms += 1e3 * (run.now() - began);
  if (verification.ok) {
    accept(run, *run.query.warm_start, false);
  }
}

}  // namespace otter_nav::planner
