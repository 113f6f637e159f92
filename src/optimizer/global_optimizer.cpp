#include "otter_nav/optimizer/global_optimizer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "otter_nav/optimizer/initial_way.hpp"
#include "otter_nav/optimizer/spline_problem.hpp"
#include "piece_check.hpp"
#include "spline_solver.hpp"
#include "stop_and_spin.hpp"
#include "way_ends.hpp"

namespace otter_nav::optimizer {
namespace {

// A cell's square reaches this far beyond its centre, in cells (DistanceField::smooth measures to
// centres), as seen from most directions.
constexpr double kSquareCells = 0.7;
constexpr double kArrivalSpeedMaxShare = 0.9;  // of the speed aimed at
constexpr double kHullMarginM = 0.03;

}  // namespace

class GlobalOptimizer::Solver {
 public:
  Solver(const GlobalOptions& options, const vessel::Parameters& vessel)
      : options_(options), vessel_(vessel), problem_(vessel), way_({}, vessel) {}

  [[nodiscard]] CheckOptions checkOptions(double clearance_m) const {
    CheckOptions check;
    check.clearance_m = clearance_m > 0.0 ? clearance_m : options_.clearance_m;
    check.check_hull = options_.keep_hull_clear;
    check.thrust_share = options_.thrust_share;
    check.speed_max_mps = options_.speed_max_mps * 1.01;
    check.yaw_rate_max_radps = std::max(options_.yaw_rate_max_radps * 1.05, kSpinRateMax);
    check.heading_force_min_n = 0.4 * options_.heading_force_min_n;
    return check;
  }

  Result<Optimized> run(const map::DistanceField& field, const std::vector<Eigen::Vector2d>& way,
                        const Boundary& start, const Boundary& goal, const Budget& budget,
                        double clearance_m) {
    if (way.size() < 2) {
      return failure("the way to optimise has " + std::to_string(way.size()) +
                     " points, at least 2 are needed");
    }
    field_ = &field;
    start_ = &start;
    goal_ = &goal;
    budget_ = &budget;
    check_ = checkOptions(clearance_m);
    result_ = Optimized();
    for (int i = 0; i < std::min(budget.max_attempts, kManners); ++i) {
      if (attempt(way, mannerOf(i))) {
        return std::move(result_);
      }
      if (outOfTime()) {
        break;
      }
    }
    if (budget.max_attempts < kManners) {
      return failure("optimisation failed: " + result_.verification.reason);
    }
    return lastResort(way);
  }

 private:
  static constexpr double kSpinRateMax = 2.0;

  // How an attempt is made; later ones are more careful.
  struct Manner {
    bool careful;
    double thrust_factor;
    double weight_factor;
    double length_factor;   // of the pieces
    double arrival_factor;  // of the speed at which the arrival begins
  };

  static constexpr int kManners = 4;
  [[nodiscard]] static Manner mannerOf(int attempt) {
    switch (attempt) {
      case 0:
        return {false, 1.0, 1.0, 1.0, 1.0};
      case 1:
        return {false, 1.0, 1.0, 0.7, 0.7};
      case 2:
        return {true, 1.0, 3.0, 0.9, 0.5};
      default:
        return {true, 0.8, 10.0, 0.7, 0.3};
    }
  }

  [[nodiscard]] bool outOfTime() const {
    return result_.iterations >= budget_->max_iterations ||
           (budget_->elapsed_s && budget_->elapsed_s() >= budget_->budget_s);
  }

  [[nodiscard]] SpinLimits spinLimits() const {
    SpinLimits limits;
    limits.thrust_share = std::min(options_.spin_thrust_share, options_.thrust_share);
    return limits;
  }

  void aim(const Manner& manner) {
    const double cell = field_->geometry().resolution_m;
    SplineLimits& limits = problem_.limits;
    limits.clearance_m = check_.clearance_m + options_.clearance_margin_m + kSquareCells * cell;
    const HullCircles hull = hullCircles(vessel_.hull);
    limits.hull_offset_m = check_.check_hull ? hull.offset_m : 0.0;
    limits.hull_clearance_m = hull.radius_m + kHullMarginM + kSquareCells * cell;
    const double share = (options_.thrust_share - options_.thrust_margin) * manner.thrust_factor;
    limits.thrust_ahead_n = share * vessel_.thrusters.ahead_max_n;
    limits.thrust_astern_n = share * vessel_.thrusters.astern_max_n;
    limits.speed_mps = options_.speed_max_mps * manner.thrust_factor;
    limits.yaw_rate_radps = options_.yaw_rate_max_radps;
    limits.heading_force_n = options_.heading_force_min_n;
    SplineWeights& weights = problem_.weights;
    weights.time = options_.weight_time;
    weights.length = options_.weight_length;
    weights.smooth = options_.weight_smooth;
    weights.clearance = options_.weight_clearance * manner.weight_factor;
    weights.dynamics = options_.weight_dynamics * manner.weight_factor;
    weights.original = 0.0;
    problem_.field = field_;
    WayOptions& way = way_.options();
    way.piece_length_m = options_.piece_length_m * manner.length_factor;
    way.force_share = 0.9 * share;
    way.speed_max_mps = 0.97 * limits.speed_mps;
    way.clearance_m = limits.clearance_m;
    aimEnds(share, manner);
  }

  void aimEnds(double thrust_share, const Manner& manner) {
    end_options_.limits.thrust_share = thrust_share;
    end_options_.limits.yaw_rate_max_radps = options_.spin_rate_max_radps;
    end_options_.limits.drift_mps = options_.drift_mps;
    end_options_.turn_least_rad = options_.spin_angle_rad;
    end_options_.careful = manner.careful;
    const double top =
        std::min(2.0 * thrust_share * vessel_.thrusters.ahead_max_n / vessel_.paper.d1_kgps,
                 options_.speed_max_mps);
    end_options_.arrival_speed_mps = options_.arrival_speed_share * manner.arrival_factor * top;
    end_options_.arrival_speed_max_mps = kArrivalSpeedMaxShare * top;
  }

  bool attempt(const std::vector<Eigen::Vector2d>& way, const Manner& manner) {
    aim(manner);
    chosen_ = chooser_.choose(*field_, way, *start_, *goal_);
    solver_.restart();
    way_.build(*field_, way, chooser_.wayEnds(chosen_, *start_), spline_);
    SplineSolver::Stop stop;
    stop.max_iterations = options_.iterations_per_round;
    stop.out_of_time = [this] { return outOfTime(); };
    smoothFirst(stop);
    chooser_.guide(chosen_, spline_);
    for (int round = 0; round < options_.rounds; ++round) {
      result_.iterations += solver_.improve(problem_, stop, spline_);
      chooser_.follow(spline_, chosen_);
      const bool last = round + 1 == options_.rounds;
      verifyDilated(last ? 2.0 * options_.dilation_max : options_.dilation_max);
      if (result_.verification.ok) {
        quicken(stop);
        return true;
      }
      if (outOfTime()) {
        return false;
      }
      tighten();
    }
    return false;
  }

  // A sound trajectory gets quicker: time weighs more, and what verifies and is better is kept.
  void quicken(const SplineSolver::Stop& stop) {
    Optimized best = std::move(result_);
    for (int round = 0; round < options_.quicken_rounds; ++round) {
      result_.iterations = best.iterations;
      if (outOfTime()) {
        break;
      }
      problem_.weights.time *= options_.quicken_growth;
      best.iterations += solver_.improve(problem_, stop, spline_);
      chooser_.follow(spline_, chosen_);
      verifyDilated(options_.dilation_max);
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
    return options_.weight_time * trajectory.duration() +
           options_.weight_length * trajectory::length(trajectory);
  }

  // The first shape: durations held, limits of thrust left out, near the way. Nearly quadratic.
  void smoothFirst(SplineSolver::Stop stop) {
    originals_.resize(spline_.spans.size());
    for (std::size_t i = 0; i < spline_.spans.size(); ++i) {
      spline_.spans[i].duration_free = false;
      for (std::size_t k = 0; k < kQuadraturePoints; ++k) {
        const BasisMatrix basis =
            scaleBasis(hermiteBasis(quadraturePoints()[k]), spline_.spans[i].duration_s).value;
        originals_[i][k] = spline_.knots[i].state * basis.row(0).head<4>().transpose() +
                           spline_.knots[i + 1].state * basis.row(0).tail<4>().transpose();
      }
    }
    const SplineWeights aimed = problem_.weights;
    problem_.weights.dynamics = options_.weight_dynamics * 1e-3;
    problem_.weights.original = options_.weight_original;
    problem_.weights.smooth = options_.weight_smooth_first;
    problem_.originals = &originals_;
    stop.max_iterations = 4;
    stop.relative_decrease = 0.05;
    result_.iterations += solver_.improve(problem_, stop, spline_);
    problem_.weights = aimed;
    problem_.originals = nullptr;
    for (Span& span : spline_.spans) {
      span.duration_free = true;
    }
  }

  // Verifies; what asks for a little too much thrust is slowed down: between the manoeuvres time
  // runs slower by a factor, which leaves the shape as it is but for the pieces next to them.
  void verifyDilated(double dilation_max) {
    constexpr int kTries = 3;
    const Spline shape = spline_;
    result_.trajectory = assemble();
    for (int i = 0; i < kTries; ++i) {
      const double excess = worstExcess();
      if (excess <= 0.0 || excess > dilation_max) {
        break;
      }
      dilate(1.0 + 0.7 * excess + 0.001);
      result_.trajectory = assemble();
    }
    result_.verification = verify(result_.trajectory, *field_, vessel_, *start_, *goal_, check_);
    spline_ = shape;
  }

  void dilate(double factor) {
    const std::size_t last = spline_.knots.size() - 1;
    const auto slows = [&](std::size_t k) { return k > 1 && k + 1 < last; };
    for (std::size_t k = 0; k < last; ++k) {
      const int slow = (slows(k) ? 1 : 0) + (slows(k + 1) ? 1 : 0);
      spline_.spans[k].duration_s *= slow == 2 ? factor : slow == 1 ? std::sqrt(factor) : 1.0;
    }
    double scale = 1.0;
    for (int m = 1; m < 4; ++m) {
      scale /= factor;
      for (std::size_t k = 2; k + 1 < last; ++k) {
        spline_.knots[k].state.col(m) *= scale;
      }
    }
  }

  // The largest share by which a limit of thrust or speed is exceeded anywhere.
  [[nodiscard]] double worstExcess() const {
    CheckOptions open = check_;
    open.thrust_share = 1e3;
    open.speed_max_mps = 1e3;
    open.yaw_rate_max_radps = 1e3;
    open.heading_force_min_n = 0.0;
    PieceReport worst;
    for (const trajectory::Piece& piece : result_.trajectory.pieces()) {
      PieceReport report;
      PieceCheck(piece, vessel_, open).checkDynamics(report);
      worst.thrust_share = std::max(worst.thrust_share, report.thrust_share);
      worst.speed_mps = std::max(worst.speed_mps, report.speed_mps);
    }
    return std::max(worst.thrust_share / check_.thrust_share,
                    worst.speed_mps / check_.speed_max_mps) -
           1.0;
  }

  // What failed is aimed at more strictly, and its weight raised.
  void tighten() {
    const Verification& v = result_.verification;
    if (v.thrust_share > check_.thrust_share) {
      const double excess = std::min(v.thrust_share - check_.thrust_share, 0.04);
      problem_.limits.thrust_ahead_n -= (excess + 0.003) * vessel_.thrusters.ahead_max_n;
      problem_.limits.thrust_astern_n -= (excess + 0.003) * vessel_.thrusters.astern_max_n;
      problem_.weights.dynamics *= options_.weight_growth;
    } else {
      const double missing = check_.clearance_m - v.clearance_m;
      problem_.limits.clearance_m += std::clamp(missing + 0.02, 0.02, 0.2);
      problem_.limits.hull_clearance_m += 0.03;
      problem_.weights.clearance *= options_.weight_growth;
      problem_.weights.dynamics *= options_.weight_growth;
    }
  }

  [[nodiscard]] trajectory::Trajectory assemble() const {
    const std::vector<trajectory::Piece>& before = chosen_.start.manoeuvre.pieces;
    const std::vector<trajectory::Piece>& after = chosen_.goal.manoeuvre.pieces;
    std::vector<trajectory::Piece> pieces;
    pieces.reserve(before.size() + spline_.spans.size() + after.size());
    const auto point = [](const Knot& knot) {
      vessel::FlatPoint z;
      z.position = knot.state.col(0);
      z.velocity = knot.state.col(1);
      z.acceleration = knot.state.col(2);
      z.jerk = knot.state.col(3);
      return z;
    };
    pieces.insert(pieces.end(), before.begin(), before.end());
    for (std::size_t i = 0; i < spline_.spans.size(); ++i) {
      pieces.push_back(trajectory::hermitePiece(
          point(spline_.knots[i]), point(spline_.knots[i + 1]), spline_.spans[i].duration_s));
    }
    pieces.insert(pieces.end(), after.begin(), after.end());
    return trajectory::Trajectory(std::move(pieces));
  }

  Result<Optimized> lastResort(const std::vector<Eigen::Vector2d>& way) {
    const std::string reason = result_.verification.reason;
    if (!atRest(*start_)) {
      return failure("optimisation from a moving start failed: " + reason);
    }
    StopAndSpin plain(vessel_, spinLimits(), check_);
    result_.trajectory = plain.follow(way, *start_, *goal_);
    result_.verification = verify(result_.trajectory, *field_, vessel_, *start_, *goal_, check_);
    result_.last_resort = true;
    if (!result_.verification.ok) {
      return failure(
          "optimisation failed: " + reason +
          "; following the way from stop to stop failed: " + result_.verification.reason);
    }
    return std::move(result_);
  }

  GlobalOptions options_;
  vessel::Parameters vessel_;
  SplineProblem problem_;
  InitialWay way_;
  SplineSolver solver_;
  Spline spline_;
  Originals originals_;
  EndOptions end_options_;
  EndChooser chooser_{vessel_, check_, end_options_};
  ChosenEnds chosen_;
  Optimized result_;
  CheckOptions check_;
  const map::DistanceField* field_ = nullptr;
  const Boundary* start_ = nullptr;
  const Boundary* goal_ = nullptr;
  const Budget* budget_ = nullptr;
};

GlobalOptimizer::GlobalOptimizer(const GlobalOptions& options, const vessel::Parameters& vessel)
    : solver_(std::make_unique<Solver>(options, vessel)) {}
GlobalOptimizer::~GlobalOptimizer() = default;
GlobalOptimizer::GlobalOptimizer(GlobalOptimizer&&) noexcept = default;
GlobalOptimizer& GlobalOptimizer::operator=(GlobalOptimizer&&) noexcept = default;

Result<Optimized> GlobalOptimizer::optimize(const map::DistanceField& field,
                                            const std::vector<Eigen::Vector2d>& way,
                                            const Boundary& start, const Boundary& goal,
                                            const Budget& budget, double clearance_m) {
  return solver_->run(field, way, start, goal, budget, clearance_m);
}

Result<Optimized> GlobalOptimizer::optimize(const map::DistanceField& field,
                                            const trajectory::Trajectory& initial,
                                            const Boundary& start, const Boundary& goal,
                                            const Budget& budget, double clearance_m) {
  std::vector<Eigen::Vector2d> way;
  for (const trajectory::Piece& piece : initial.pieces()) {
    constexpr int kParts = 6;
    for (int i = 0; i < kParts && piece.kind == trajectory::PieceKind::kSail; ++i) {
      way.push_back(piece.flat(piece.duration_s * i / kParts).position);
    }
  }
  way.push_back(goal.flat.position);
  return solver_->run(field, way, start, goal, budget, clearance_m);
}

CheckOptions GlobalOptimizer::checkOptions(double clearance_m) const {
  return solver_->checkOptions(clearance_m);
}

}  // namespace otter_nav::optimizer
