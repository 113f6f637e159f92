#include "pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "otter_nav/planner/sampler.hpp"
#include "ways.hpp"

namespace otter_nav::planner {
namespace {

// Beyond the clearance, that the guide line is pushed out to.
constexpr double kRoomM = 0.7;

EdgeLimits edgeLimits(const Options& options, const vessel::Parameters& vessel) {
  EdgeLimits limits;
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

std::string describe(const Eigen::Vector2d& p) {
  std::ostringstream text;
  text.precision(5);
  text << "(" << p.x() << ", " << p.y() << ") m";
  return text.str();
}

// Why a vessel can't be at `p`, or nothing.
std::string blocked(const map::DistanceField& field, const Eigen::Vector2d& p, double psi_rad,
                    double clearance_m) {
  if (!p.allFinite() || !std::isfinite(psi_rad)) {
    return "is not a finite pose";
  }
  if (!field.geometry().contains(p)) {
    return describe(p) + " is outside the map";
  }
  const double clearance = field.clearance(p);
  if (clearance < clearance_m) {
    std::ostringstream text;
    text.precision(3);
    text << describe(p) << " is " << clearance << " m from an obstacle, " << clearance_m
         << " m are asked for";
    return text.str();
  }
  return "";
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
  if (checkEnds(run) && findGuide(run)) {
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

bool Planner::Pipeline::checkEnds(Run& run) const {
  const std::string start =
      blocked(run.field, run.query.start.position, run.query.start_psi_rad, run.clearance_m);
  if (!start.empty()) {
    run.plan.outcome = Outcome::kStartBlocked;
    run.plan.reason = "the start " + start;
    return false;
  }
  const std::string goal =
      blocked(run.field, run.query.goal, run.query.goal_psi_rad, run.clearance_m);
  if (!goal.empty()) {
    run.plan.outcome = Outcome::kGoalBlocked;
    run.plan.reason = "the goal " + goal;
    return false;
  }
  return true;
}

bool Planner::Pipeline::findGuide(Run& run) {
  if (run.query.guide_path.size() >= 2) {
    guide_.points = run.query.guide_path;
    guide_.points.front() = run.query.start.position;
    guide_.points.back() = run.query.goal;
    return true;
  }
  const double began = run.now();
  if (run.clearance_m != finder_clearance_m_) {
    topology::Options options = options_.topology;
    options.clearance_m = run.clearance_m;
    options.safe_distance_m = std::max(options.safe_distance_m, run.clearance_m);
    finder_ = topology::GuidePathFinder(options);
    finder_clearance_m_ = run.clearance_m;
  }
  const Eigen::Vector2d& velocity = run.query.start.velocity;
  const double psi =
      velocity.norm() > 0.1 ? std::atan2(velocity.y(), velocity.x()) : run.query.start_psi_rad;
  const auto found = finder_.find(run.field, {run.query.start.position, psi},
                                  {run.query.goal, run.query.goal_psi_rad}, guide_);
  run.plan.figures.guide_ms = 1e3 * (run.now() - began);
  if (!found) {
    run.plan.reason = found.error().message;
    run.plan.outcome =
        found.error().failure == topology::Failure::kStartBlocked  ? Outcome::kStartBlocked
        : found.error().failure == topology::Failure::kGoalBlocked ? Outcome::kGoalBlocked
                                                                   : Outcome::kNoWay;
    return false;
  }
  return true;
}

void Planner::Pipeline::prepareSearch(Run& run) {
  GuideLineOptions line;
  line.speed_mps = options_.sample_speed_share * vessel_.top_speed_mps;
  line.speed_start_mps = run.query.start.velocity.norm();
  line.force_ahead_n = limits_.force_ahead_n;
  line.corridor_m = options_.corridor_m;
  line.safe_distance_m = run.clearance_m + kRoomM;
  line_.build(guide_.points, run.field, vessel_, line);
  EdgeLimits limits = limits_;
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
    if (optimizer::atRest(run.start)) {
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
  const auto verification = optimizer::verify(*run.query.warm_start, run.field, vessel_, run.start,
                                              run.goal, optimizer_.checkOptions(run.clearance_m));
  run.plan.figures.verify_ms += 1e3 * (run.now() - began);
  if (verification.ok) {
    accept(run, *run.query.warm_start, false);
  }
}

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
