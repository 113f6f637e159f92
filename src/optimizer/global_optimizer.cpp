#include "otter_nav/optimizer/global_optimizer.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "optimizer/objective/spline_problem.hpp"
#include "optimizer/solve/assembly.hpp"
#include "optimizer/solve/attempt.hpp"
#include "optimizer/solve/initial_spline.hpp"
#include "optimizer/solve/spline_solver.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/feasibility/lean.hpp"
#include "otter_nav/optimizer/ends.hpp"
#include "otter_nav/trajectory/motion_along.hpp"
#include "otter_nav/trajectory/polynomial/quadrature.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// An attempt that after so many rounds still exceeds a limit by this share is given up.
constexpr int kPatience = 3;
constexpr double kHopeless = 0.5;
// Under a load thrusts spike where the force along the hull nearly vanishes: that takes longer.
constexpr int kPatienceUnderLoad = 4;
constexpr double kHopelessUnderLoad = 3.0;
constexpr int kRoundsUnderLoad = 8;
// From a moving start, after each round: what asks for so much more than there is, mostly right
// behind the start, hardly ever comes within the limits. Another clearance is better than more.
constexpr double kHopelessUnderWay[] = {kInfinity, kInfinity, 3.0, 0.2};
// Of the limits of thrust and yaw rate, on the spot.
constexpr double kSpinShare = 0.97;
constexpr double kTurnShare = 0.905;

constexpr int kRoundsUnloaded = 5;
constexpr double kMostKeptShare = 0.5;  // of a thruster's force, for what the objective leaves out
constexpr int kIterationsPerRound = 12;
constexpr double kWeightGrowth = 1.5;  // of the weights of what fails, from round to round
constexpr double kSlower = 0.97;       // wanted, where a speed failed
// Of the force |w| that is wanted while turning, from round to round, where a thrust exceeds its
// limit by more than a share: next to w = 0 the heading turns at any rate, and slowing down or a
// reserve of thrust mends nothing. In a load that is where the vessel rounds up to its goal, with
// any hull; in still water only the paper's model has it.
constexpr double kFirmerHeading = 2.5;
constexpr double kSpike = 0.1;
// Asks for so much more than a thruster has only while the bow goes round the wrong way.
constexpr double kBowGoesRound = 1.0;
constexpr double kCornerSlower = 2.0;
// A trajectory that asks for this share too much of a thruster is slowed down to suit.
constexpr double kDilationMax = 0.06;
// After the first feasible result.
constexpr int kQuickenRounds = 2;
constexpr double kQuickenGrowth = 2.0;  // of the weight of time
// What the ends' manoeuvres take of a step, in pieces.
constexpr int kWorkOfEnds = 8;
// While the first shape is found.
constexpr double kFirstWeightOriginal = 0.3;
constexpr double kFirstWeightSmooth = 0.1;
constexpr double kFirstDynamics = 1e-3;  // of their weight later
// A path in two parts: a corner's turn is what the path turns within so far to both sides.
constexpr double kCornerM = 3.0;
constexpr int kAttemptsOfParts = 2;
constexpr double kPauseS = 0.5;

}  // namespace

class GlobalOptimizer::Solver {
 public:
  Solver(const GlobalOptions& options, const vessel::Parameters& vessel)
      : options_(options), vessel_(vessel), problem_(vessel), initial_(vessel) {}

  // Under a low speed limit all is done in slow motion: the spline's time runs so that the limit is
  // what the vessel usually sails, and scales, weights and the number of pieces stay as they are.
  void slowTo(double slow) {
    if (slow == slow_) {
      return;
    }
    slow_ = slow;
    const vessel::Parameters other = inSlowMotion(vessel_, slow);
    problem_ = SplineProblem(other);
    initial_ = InitialSpline(other);
  }

  Result<Optimized> run(const feasibility::Obstacles& obstacles,
                        const std::vector<Eigen::Vector2d>& path, const trajectory::Boundary& start,
                        const trajectory::Boundary& goal, const Budget& budget,
                        const feasibility::SafetyLimits& limits) {
    if (path.size() < 2) {
      return failure("the path to optimise has " + std::to_string(path.size()) +
                     " points, at least 2 are needed");
    }
    obstacles_ = &obstacles;
    start_ = &start;
    goal_ = &goal;
    budget_ = &budget;
    limits_ = limits.startingAt(start.flat.velocity.norm(), vessel_);
    slowTo(feasibility::speedShare(vessel_, limits_));
    result_ = Optimized();
    for (int i = budget.first_attempt; i < std::min(budget.max_attempts, kAttempts); ++i) {
      if (attempt(path, i)) {
        return std::move(result_);
      }
      if (outOfTime()) {
        break;
      }
    }
    if (budget.max_attempts < kAttempts) {
      return failure("optimisation failed: " + result_.verification.reason);
    }
    return lastResort(path);
  }

  void beginWork() { work_ = 0; }
  [[nodiscard]] int work() const { return work_; }

  Result<Optimized> stopAndSpin(const feasibility::Obstacles& obstacles,
                                const std::vector<Eigen::Vector2d>& path,
                                const trajectory::Boundary& start, const trajectory::Boundary& goal,
                                const feasibility::SafetyLimits& limits) const {
    const StopAndSpin spinning(vessel_, spinLimits(limits), limits);
    Optimized plain;
    plain.last_resort = true;
    for (const auto& stops : {spinning.quickestStops(obstacles.field(), path, start, goal), path}) {
      plain.trajectory = spinning.follow(stops, start, goal);
      plain.verification =
          feasibility::verify(plain.trajectory, obstacles, vessel_, start, goal, limits);
      if (plain.verification.ok) {
        return plain;
      }
    }
    return failure("following the path from stop to stop failed: " + plain.verification.reason);
  }

 private:
  [[nodiscard]] bool outOfTime() const {
    return result_.iterations >= budget_->max_iterations || work_ >= budget_->max_work ||
           (budget_->elapsed_s && budget_->elapsed_s() >= budget_->budget_s);
  }

  [[nodiscard]] static SpinLimits spinLimits(const feasibility::SafetyLimits& limits) {
    SpinLimits spin;
    spin.thrust_share = kSpinShare * limits.thrust_share;
    spin.yaw_rate_max_radps = kTurnShare * limits.yaw_rate_max_radps;
    return spin;
  }

  void prepare(int number) {
    const Attempt attempt =
        attemptOf(number, options_, vessel_, limits_, obstacles_->field().geometry().resolution_m);
    problem_.targets.limits = attempt.limits;
    problem_.targets.weights = attempt.weights;
    problem_.targets.obstacles = obstacles_;
    still_ = obstacles_->lyingStill();
    problem_.targets.still = obstacles_->rateBound() > 0.0 ? &*still_ : nullptr;
    problem_.targets.kept_n.clear();
    problem_.targets.knows_curvature = false;
    problem_.targets.clock = 1.0 / slow_;
    problem_.setDisturbance(inSlowMotion(limits_.disturbance, slow_));
    leaning_ =
        vessel::InverseDynamics(inSlowMotion(vessel_, slow_), inSlowMotion(limits_.felt, slow_));
    problem_.targets.leaning = feasibility::leansInto(vessel_, limits_.felt) ? &leaning_ : nullptr;
    initial_.options = attempt.initial;
    end_options_ = attempt.ends;
  }

  bool attempt(const std::vector<Eigen::Vector2d>& path, int number) {
    prepare(number);
    chosen_ = chooser_.choose(obstacles_->field(), path, *start_, *goal_);
    solver_.restart();
    startWhereTheManoeuvreEnds();
    initial_.options.start_s = problem_.targets.start_s;
    initial_.options.clock = problem_.targets.clock;
    initial_.build(*obstacles_, path, inSplineTime(chooser_.splineEnds(chosen_, *start_)), spline_);
    SplineSolver::Stop stop;
    stop.max_iterations = kIterationsPerRound;
    stop.out_of_time = [this] { return outOfTime(); };
    smoothFirst(stop);
    const bool loaded = underLoad();
    const int rounds = loaded ? kRoundsUnderLoad : kRoundsUnloaded;
    for (int round = 0; round < rounds; ++round) {
      improveWithEnds(stop);
      const bool last = round + 1 == rounds;
      verifyDilated(last ? 2.0 * kDilationMax : kDilationMax);
      if (result_.verification.ok) {
        quicken(stop);
        return true;
      }
      if (isHopeless(round, loaded) || outOfTime()) {
        return false;
      }
      tighten();
      slowWhereTheBowGoesRound();
    }
    return false;
  }

  void improve(const SplineSolver::Stop& stop) {
    const int iterations = solver_.improve(problem_, stop, spline_);
    result_.iterations += iterations;
    work_ += iterations * (static_cast<int>(spline_.spans.size()) + kWorkOfEnds);
  }

  // After that round, numbered from 0.
  [[nodiscard]] bool isHopeless(int round, bool loaded) const {
    if (!loaded && !trajectory::atRest(*start_)) {
      const auto last = static_cast<int>(std::size(kHopelessUnderWay)) - 1;
      return excess_ > kHopelessUnderWay[std::min(round, last)];
    }
    return round >= (loaded ? kPatienceUnderLoad : kPatience) &&
           excess_ > (loaded ? kHopelessUnderLoad : kHopeless);
  }

  template <typename Action>
  void inRealTime(const Action& action) {
    if (slow_ != 1.0) {
      stretch(1.0 / slow_, spline_);
    }
    action();
    if (slow_ != 1.0) {
      stretch(slow_, spline_);
    }
  }
  [[nodiscard]] SplineEnds inSplineTime(SplineEnds ends) const {
    for (vessel::FlatPoint* z : {&ends.start, &ends.goal}) {
      z->velocity /= slow_;
      z->acceleration /= slow_ * slow_;
      z->jerk /= slow_ * slow_ * slow_;
    }
    return ends;
  }
  [[nodiscard]] trajectory::Trajectory assembled() {
    trajectory::Trajectory whole;
    inRealTime([&] { whole = assemble(chosen_, spline_); });
    return whole;
  }

  // The spline's obstacles are met after the manoeuvre that leads to it.
  void startWhereTheManoeuvreEnds() {
    problem_.targets.start_s = chosen_.start.manoeuvre.duration_s;
  }
  void improveWithEnds(const SplineSolver::Stop& stop) {
    inRealTime([&] { chooser_.guide(chosen_, spline_); });
    improve(stop);
    inRealTime([&] { chooser_.follow(spline_, chosen_); });
    startWhereTheManoeuvreEnds();
  }

  // A feasible trajectory gets quicker: time weighs more, and what verifies and is better is kept.
  // First by steps that know the limits' curvature, which make straight what the rounds before may
  // have left bent; then by squares alone, which end nearer to a low speed limit.
  void quicken(const SplineSolver::Stop& stop) {
    Optimized best = std::move(result_);
    for (int round = 0; round < kQuickenRounds; ++round) {
      result_.iterations = best.iterations;
      if (outOfTime()) {
        break;
      }
      problem_.targets.weights.time *= kQuickenGrowth;
      problem_.targets.knows_curvature = round == 0;
      improveWithEnds(stop);
      best.iterations = result_.iterations;
      verifyDilated(kDilationMax);
      if (result_.verification.ok && rank(result_.trajectory) < rank(best.trajectory)) {
        best.trajectory = std::move(result_.trajectory);
        best.verification = result_.verification;
      } else if (!result_.verification.ok) {
        tighten();
      }
    }
    result_ = std::move(best);
  }

  [[nodiscard]] double rank(const trajectory::Trajectory& trajectory) const {
    return trajectory.duration() + options_.weight_length * trajectory::length(trajectory);
  }

  // The first shape: durations held, limits of thrust left out, near the path. Nearly quadratic.
  void smoothFirst(SplineSolver::Stop stop) {
    originals_.resize(spline_.spans.size());
    for (std::size_t i = 0; i < spline_.spans.size(); ++i) {
      spline_.spans[i].duration_free = false;
      for (std::size_t k = 0; k < trajectory::kLobattoPoints; ++k) {
        const trajectory::SepticBasis basis = trajectory::scaleBasis(
            trajectory::septicBasis(trajectory::kLobatto.at[k]), spline_.spans[i].duration_s);
        originals_[i][k] = spline_.knots[i].state * basis.row(0).head<4>().transpose() +
                           spline_.knots[i + 1].state * basis.row(0).tail<4>().transpose();
      }
    }
    const SplineWeights later = problem_.targets.weights;
    problem_.targets.weights.dynamics = kFirstDynamics * later.dynamics;
    problem_.targets.weights.original = kFirstWeightOriginal;
    problem_.targets.weights.smooth = kFirstWeightSmooth;
    problem_.targets.originals = &originals_;
    stop.max_iterations = 4;
    stop.relative_decrease = 0.05;
    improve(stop);
    problem_.targets.weights = later;
    problem_.targets.originals = nullptr;
    for (Span& span : spline_.spans) {
      span.duration_free = true;
    }
  }

  // Verifies; what asks for a little too much thrust is slowed down: between the manoeuvres time
  // runs slower by a factor, which leaves the shape as it is but for the pieces next to them.
  void verifyDilated(double dilation_max) {
    constexpr int kTries = 6;
    constexpr double kLeastGain = 0.95;  // of a try, on the excess before
    const Spline shape = spline_;
    std::vector<bool> inside(shape.knots.size(), false);
    for (std::size_t k = 2; k + 2 < inside.size(); ++k) {
      inside[k] = true;
    }
    const bool by_paper = vessel::paperHolds(vessel_);
    std::optional<trajectory::MotionAlong> motion;
    double before = kInfinity;
    for (int i = 0; i <= kTries; ++i) {
      result_.trajectory = assembled();
      if (!by_paper) {
        motion.emplace(result_.trajectory, vessel_, limits_.disturbance, start_->psi_rad);
      }
      excesses_ = by_paper ? excesses(result_.trajectory, vessel_, limits_)
                           : excesses(*motion, vessel_, limits_);
      excess_ = *std::max_element(excesses_.begin(), excesses_.end());
      work_ +=
          static_cast<int>(result_.trajectory.duration());  // a second takes as much as a piece
      if (i == 0 && motion) {
        lacking_n_ = excessAlong(*motion, chosen_.start.manoeuvre.pieces.size(),
                                 spline_.spans.size(), vessel_, limits_);
      }
      // Next to the ends nothing is slowed down: what is too much there stays so.
      if (excess_ <= 0.0 || excess_ > dilation_max || excess_ > kLeastGain * before) {
        break;
      }
      before = excess_;
      slowDown(inside, 1.0 + 0.7 * excess_ + 0.001, spline_);
    }
    result_.verification = feasibility::verify(result_.trajectory, *obstacles_, vessel_, *start_,
                                               *goal_, limits_, {}, motion ? &*motion : nullptr);
    spline_ = shape;
  }

  [[nodiscard]] bool underLoad() const {
    return vessel::InverseDynamics(vessel_, limits_.disturbance).greatestLoad() > 0.0;
  }

  // What failed is wanted more strictly, and its weight raised.
  void tighten() {
    const feasibility::Verification& v = result_.verification;
    if ((vessel::paperHolds(vessel_) || underLoad()) && excess_ > kSpike) {
      double& wanted_n = problem_.targets.limits.heading_force_n;
      wanted_n = std::min(kFirmerHeading * wanted_n, mostHeadingForce(vessel_, limits_));
    }
    if (v.thrust_share > limits_.thrust_share && !vessel::paperHolds(vessel_)) {
      keepThrustWhereItLacks();
    } else if (v.thrust_share > limits_.thrust_share) {
      // Slowing down takes little off what a load asks for: then the worst of it counts, wherever.
      const double excess = std::min(
          underLoad() ? limits_.thrust_share * excess_ : v.thrust_share - limits_.thrust_share,
          0.04);
      problem_.targets.limits.thrust_ahead_n -= (excess + 0.003) * vessel_.thrusters.ahead_max_n;
      problem_.targets.limits.thrust_astern_n -= (excess + 0.003) * vessel_.thrusters.astern_max_n;
      problem_.targets.weights.dynamics *= kWeightGrowth;
    } else if (v.fault == feasibility::Fault::kSpeed) {
      problem_.targets.limits.slowing.start_mps *= kSlower;
      problem_.targets.limits.speed_mps *= kSlower;
      problem_.targets.weights.dynamics *= kWeightGrowth;
    } else {
      const double missing = limits_.clearance_m - leastWhereItFails(v);
      problem_.targets.limits.clearance_m += std::clamp(missing + 0.02, 0.02, 0.2);
      problem_.targets.limits.hull_clearance_m += 0.03;
      problem_.targets.limits.leaning_clearance_m += 0.03;
      problem_.targets.weights.clearance *= kWeightGrowth;
      problem_.targets.weights.dynamics *= kWeightGrowth;
    }
  }

  // The verifier stops where the clearance begins to lack. What lies still is mended bit by bit;
  // what moves is met for a moment, and its whole depth is wanted back.
  [[nodiscard]] double leastWhereItFails(const feasibility::Verification& v) const {
    constexpr double kStepS = 0.05;
    constexpr int kMostSteps = 100;
    double least = v.clearance_m;
    if (obstacles_->rateBound() <= 0.0 || v.fault != feasibility::Fault::kClearance) {
      return least;
    }
    for (int k = 1; k <= kMostSteps; ++k) {
      const double t = v.fault_s + k * kStepS;
      const double here = obstacles_->clearance(result_.trajectory.flat(t).position, t);
      if (t > result_.trajectory.duration() || here >= limits_.clearance_m) {
        break;
      }
      least = std::min(least, here);
    }
    return least;
  }

  // Braking hard into a corner, w can pass its zero on the wrong side: the bow has to go round the
  // other way, at any rate, and no small step mends that. Slowly enough w points along the
  // velocity; from there the corner gets faster again with w on the right side.
  void slowWhereTheBowGoesRound() {
    if (!vessel::paperHolds(vessel_)) {
      return;
    }
    std::vector<bool> knots(spline_.knots.size(), false);
    const std::size_t first = chosen_.start.manoeuvre.pieces.size();
    for (std::size_t i = 1; i + 2 < knots.size(); ++i) {
      if (excesses_[first + i] > kBowGoesRound) {
        knots[i] = knots[i + 1] = true;
      }
    }
    slowDown(knots, kCornerSlower, spline_);
  }

  // The objective's thrusts are the paper's model's. Where the manoeuvring model asks for more, as
  // much is kept back.
  void keepThrustWhereItLacks() {
    constexpr double kMoreN = 0.01;  // of a thruster's force
    const double most_n = vessel_.thrusters.ahead_max_n;
    AtPoints& kept_n = problem_.targets.kept_n;
    kept_n.resize(lacking_n_.size());
    for (std::size_t i = 0; i < lacking_n_.size(); ++i) {
      for (std::size_t k = 0; k < lacking_n_[i].size(); ++k) {
        if (lacking_n_[i][k] > 0.0) {
          kept_n[i][k] =
              std::min(kept_n[i][k] + lacking_n_[i][k] + kMoreN * most_n, kMostKeptShare * most_n);
        }
      }
    }
    problem_.targets.weights.dynamics *= kWeightGrowth;
  }

  Result<Optimized> lastResort(const std::vector<Eigen::Vector2d>& path) {
    const std::string reason = result_.verification.reason;
    const trajectory::Boundary start = *start_;
    const trajectory::Boundary goal = *goal_;
    // A vessel under way does better with another clearance or path than with a stop.
    if (!trajectory::atRest(start)) {
      return failure("optimisation from a moving start failed: " + reason);
    }
    if (auto parts = inTwoParts(path, start, goal)) {
      return std::move(*parts);
    }
    auto plain = stopAndSpin(*obstacles_, path, start, goal, limits_);
    if (!plain) {
      return failure("optimisation failed: " + reason + "; " + plain.error().message);
    }
    return plain;
  }

  // Where nothing leads round the sharpest corner under way: a stop there, and a turn on the spot.
  std::optional<Optimized> inTwoParts(const std::vector<Eigen::Vector2d>& path,
                                      const trajectory::Boundary& start,
                                      const trajectory::Boundary& goal) {
    const std::size_t corner = sharpestCorner(path);
    if (corner == 0 || outOfTime()) {
      return std::nullopt;
    }
    const auto middle = path.begin() + static_cast<std::ptrdiff_t>(corner);
    trajectory::Boundary stop;
    stop.flat.position = *middle;
    const Eigen::Vector2d onward = trajectory::pointAlong({middle, path.end()}, kCornerM) - *middle;
    stop.psi_rad = angleOf(onward);
    Budget budget = *budget_;
    budget.first_attempt = 0;
    budget.max_attempts = kAttemptsOfParts;
    const feasibility::Obstacles& whole_time = *obstacles_;
    const auto part = [&](const std::vector<Eigen::Vector2d>& points,
                          const trajectory::Boundary& from, const trajectory::Boundary& to,
                          double start_s) {
      const feasibility::Obstacles obstacles = whole_time.startingAt(start_s);
      auto optimized = run(obstacles, points, from, to, budget, limits_);
      obstacles_ = &whole_time;
      return optimized || !trajectory::atRest(from)
                 ? std::move(optimized)
                 : stopAndSpin(obstacles, points, from, to, limits_);
    };
    const auto first = part({path.begin(), middle + 1}, start, stop, 0.0);
    const auto second =
        first ? part({middle, path.end()}, stop, goal, first->trajectory.duration() + kPauseS)
              : first;
    if (!second || (first->last_resort && second->last_resort)) {
      return std::nullopt;
    }
    Optimized whole;
    // At rest, but for what is left of the thrust: that dies away in a moment's pause.
    std::vector<trajectory::Piece> pieces = first->trajectory.pieces();
    trajectory::Piece pause =
        trajectory::spinPiece(stop.flat.position, stop.psi_rad, stop.psi_rad, kPauseS);
    pause.position = trajectory::hermitePiece(pieces.back().flat(pieces.back().duration_s),
                                              second->trajectory.flat(0.0), kPauseS)
                         .position;
    pieces.push_back(pause);
    pieces.insert(pieces.end(), second->trajectory.pieces().begin(),
                  second->trajectory.pieces().end());
    whole.trajectory = trajectory::Trajectory(std::move(pieces));
    whole.iterations = first->iterations + second->iterations;
    whole.last_resort = true;
    whole.verification =
        feasibility::verify(whole.trajectory, *obstacles_, vessel_, start, goal, limits_);
    return whole.verification.ok ? std::optional<Optimized>(std::move(whole)) : std::nullopt;
  }

  // The inner point at which `path` turns most within kCornerM to both sides; 0 without any.
  static std::size_t sharpestCorner(const std::vector<Eigen::Vector2d>& path) {
    std::size_t sharpest = 0;
    double least_cosine = 1.0;
    for (std::size_t k = 1; k + 1 < path.size(); ++k) {
      const auto at = path.begin() + static_cast<std::ptrdiff_t>(k);
      const Eigen::Vector2d before =
          path[k] - trajectory::pointAlong({path.begin(), at + 1}, -kCornerM);
      const Eigen::Vector2d after = trajectory::pointAlong({at, path.end()}, kCornerM) - path[k];
      const double cosine = before.normalized().dot(after.normalized());
      if (cosine < least_cosine) {
        least_cosine = cosine;
        sharpest = k;
      }
    }
    return sharpest;
  }

  GlobalOptions options_;
  vessel::Parameters vessel_;
  double slow_ = 1.0;
  SplineProblem problem_;
  vessel::InverseDynamics leaning_{vessel_};
  InitialSpline initial_;
  SplineSolver solver_;
  Spline spline_;
  Originals originals_;
  EndOptions end_options_;
  EndChooser chooser_{vessel_, limits_, end_options_};
  ChosenEnds chosen_;
  Optimized result_;
  std::vector<double> excesses_;  // of result_'s pieces, as shares of the limit
  double excess_ = 0.0;           // the worst of them
  AtPoints lacking_n_;            // of thrust, by the manoeuvring model, before time was stretched
  int work_ = 0;                  // steps times pieces, since the caller asked
  feasibility::SafetyLimits limits_;
  const feasibility::Obstacles* obstacles_ = nullptr;
  std::optional<feasibility::Obstacles> still_;  // those of them that don't move
  const trajectory::Boundary* start_ = nullptr;
  const trajectory::Boundary* goal_ = nullptr;
  const Budget* budget_ = nullptr;
};

GlobalOptimizer::GlobalOptimizer(const GlobalOptions& options, const vessel::Parameters& vessel)
    : solver_(std::make_unique<Solver>(options, vessel)) {}
GlobalOptimizer::~GlobalOptimizer() = default;
GlobalOptimizer::GlobalOptimizer(GlobalOptimizer&&) noexcept = default;
GlobalOptimizer& GlobalOptimizer::operator=(GlobalOptimizer&&) noexcept = default;

Result<Optimized> GlobalOptimizer::optimize(const feasibility::Obstacles& obstacles,
                                            const std::vector<Eigen::Vector2d>& path,
                                            const trajectory::Boundary& start,
                                            const trajectory::Boundary& goal, const Budget& budget,
                                            const feasibility::SafetyLimits& limits) {
  solver_->beginWork();
  return solver_->run(obstacles, path, start, goal, budget, limits);
}

Result<Optimized> GlobalOptimizer::optimize(const feasibility::Obstacles& obstacles,
                                            const trajectory::Trajectory& initial,
                                            const trajectory::Boundary& start,
                                            const trajectory::Boundary& goal, const Budget& budget,
                                            const feasibility::SafetyLimits& limits) {
  std::vector<Eigen::Vector2d> path;
  for (const trajectory::Piece& piece : initial.pieces()) {
    constexpr int kParts = 6;
    for (int i = 0; i < kParts && piece.kind == trajectory::PieceKind::kSail; ++i) {
      path.push_back(piece.flat(piece.duration_s * i / kParts).position);
    }
  }
  path.push_back(goal.flat.position);
  solver_->beginWork();
  return solver_->run(obstacles, path, start, goal, budget, limits);
}

int GlobalOptimizer::work() const {
  return solver_->work();
}

Result<Optimized> GlobalOptimizer::stopAndSpin(const feasibility::Obstacles& obstacles,
                                               const std::vector<Eigen::Vector2d>& path,
                                               const trajectory::Boundary& start,
                                               const trajectory::Boundary& goal,
                                               const feasibility::SafetyLimits& limits) {
  return solver_->stopAndSpin(obstacles, path, start, goal, limits);
}

}  // namespace otter_nav::optimizer
