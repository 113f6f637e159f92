#include "otter_nav/optimizer/global_optimizer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/optimizer/initial_way.hpp"
#include "otter_nav/optimizer/spin.hpp"
#include "otter_nav/optimizer/spline_problem.hpp"
#include "piece_check.hpp"
#include "spline_solver.hpp"
#include "stop_and_spin.hpp"

namespace otter_nav::optimizer {
namespace {

// A cell's square reaches this far beyond its centre, in cells (DistanceField::smooth measures to
// centres), as seen from most directions.
constexpr double kSquareCells = 0.7;
constexpr double kBrakeM = 5.0;  // the last straight's first guess, at full piece length
constexpr double kHullMarginM = 0.03;
constexpr double kLookAheadM = 8.0;  // how far the way's first direction is taken

Eigen::Vector2d unit(double angle_rad) {
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

double angleOf(const Eigen::Vector2d& v) {
  return std::atan2(v.y(), v.x());
}

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
    for (const Manner& manner : {Manner{false, 1.0, 1.0, 1.0}, Manner{false, 1.0, 1.0, 0.7},
                                 Manner{true, 1.0, 3.0, 0.9}, Manner{true, 0.8, 10.0, 0.7}}) {
      if (attempt(way, manner)) {
        return std::move(result_);
      }
      if (outOfTime()) {
        break;
      }
    }
    return lastResort(way);
  }

 private:
  static constexpr double kSpinRateMax = 2.0;

  // How an attempt is made; later ones are more careful.
  struct Manner {
    bool spin_always;
    double thrust_factor;
    double weight_factor;
    double length_factor;  // of the pieces
  };

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
    weights.smooth_straight = options_.weight_smooth_straight;
    weights.clearance = options_.weight_clearance * manner.weight_factor;
    weights.dynamics = options_.weight_dynamics * manner.weight_factor;
    weights.original = 0.0;
    problem_.field = field_;
    WayOptions& way = way_.options();
    way.piece_length_m = options_.piece_length_m * manner.length_factor;
    way.force_share = 0.9 * share;
    way.speed_max_mps = 0.97 * limits.speed_mps;
    way.brake_m = kBrakeM * manner.length_factor * manner.length_factor;
    way.clearance_m = limits.clearance_m;
  }

  void chooseEnds(const std::vector<Eigen::Vector2d>& way, const Manner& manner) {
    ends_.start = *start_;
    ends_.goal = *goal_;
    ends_.start_at_rest = atRest(*start_);
    const double threshold = manner.spin_always ? 0.02 : options_.spin_angle_rad;
    const double leave = angleOf(pointAlong(way, kLookAheadM) - start_->flat.position);
    const double arrive = angleOf(goal_->flat.position - pointAlong(way, -kLookAheadM));
    start_turn_ = wrapAngle(leave - start_->psi_rad);
    goal_turn_ = wrapAngle(goal_->psi_rad - arrive);
    ends_.start_after_spin = ends_.start_at_rest && std::abs(start_turn_) > threshold;
    ends_.goal_before_spin = std::abs(goal_turn_) > threshold;
    ends_.leave = unit(ends_.start_after_spin ? leave : start_->psi_rad);
    ends_.arrive = unit(ends_.goal_before_spin ? arrive : goal_->psi_rad);
  }

  bool attempt(const std::vector<Eigen::Vector2d>& way, const Manner& manner) {
    aim(manner);
    chooseEnds(way, manner);
    solver_.restart();
    way_.build(*field_, way, ends_, spline_);
    SplineSolver::Stop stop;
    stop.max_iterations = options_.iterations_per_round;
    stop.out_of_time = [this] { return outOfTime(); };
    smoothFirst(stop);
    for (int round = 0; round < options_.rounds; ++round) {
      result_.iterations += solver_.improve(problem_, stop, spline_);
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
      const Spline shape = spline_;
      verifyDilated(options_.dilation_max);
      if (result_.verification.ok && rank(result_.trajectory) < rank(best.trajectory)) {
        best.trajectory = std::move(result_.trajectory);
        best.verification = result_.verification;
      } else if (!result_.verification.ok) {
        tighten();
      }
      spline_ = shape;
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
    problem_.weights.smooth_straight = options_.weight_smooth_first;
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

  // Verifies; from rest to rest, what asks for a little too much thrust is slowed down: time runs
  // slower by a factor everywhere, which leaves the shape as it is.
  void verifyDilated(double dilation_max) {
    constexpr int kTries = 3;
    result_.trajectory = assemble();
    for (int i = 0; i < kTries && ends_.start_at_rest; ++i) {
      const double excess = worstExcess();
      if (excess <= 0.0 || excess > dilation_max) {
        break;
      }
      dilate(1.0 + 0.7 * excess + 0.001);
      result_.trajectory = assemble();
    }
    result_.verification = verify(result_.trajectory, *field_, vessel_, *start_, *goal_, check_);
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

  void dilate(double factor) {
    double scale = 1.0;
    for (int m = 1; m < 4; ++m) {
      scale /= factor;
      for (Knot& knot : spline_.knots) {
        knot.state.col(m) *= scale;
      }
    }
    for (Span& span : spline_.spans) {
      span.duration_s *= factor;
    }
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

  // A straight piece exactly along the line: its coefficients are numbers times one direction.
  static trajectory::Piece straightPiece(const Knot& from, const Knot& to,
                                         const Eigen::Vector2d& direction, double duration_s) {
    const auto along = [&](const Knot& knot) {
      const Eigen::Vector4d s = (direction.transpose() * knot.state).transpose();
      vessel::FlatPoint z;
      z.position.x() = direction.dot(knot.state.col(0) - from.state.col(0));
      z.velocity.x() = s[1];
      z.acceleration.x() = s[2];
      z.jerk.x() = s[3];
      return z;
    };
    trajectory::Piece piece = trajectory::hermitePiece(along(from), along(to), duration_s);
    const Eigen::Matrix<double, 1, trajectory::kCoefficients> c = piece.position.row(0);
    piece.position = direction * c;
    piece.position.col(0) = from.state.col(0);
    return piece;
  }

  // Rounding aside, line knots are on their lines already; the pieces beside share the same state.
  static void snapToLine(const Eigen::Vector2d& anchor, Knot& knot) {
    const Eigen::Vector2d& e = knot.direction;
    knot.state.col(0) = anchor + e.dot(knot.state.col(0) - anchor) * e;
    for (int m = 1; m < 4; ++m) {
      knot.state.col(m) = e.dot(knot.state.col(m)) * e;
    }
  }

  trajectory::Trajectory assemble() {
    std::vector<trajectory::Piece> pieces;
    pieces.reserve(spline_.spans.size() + 12);
    const SpinLimits limits = spinLimits();
    if (ends_.start_after_spin) {
      start_turn_ = wrapAngle(angleOf(lineOf(spline_, 0)) - start_->psi_rad);
      appendSpin(start_->flat.position, start_->psi_rad, start_turn_, vessel_, limits, pieces);
    }
    const std::size_t last = spline_.spans.size() - 1;
    if (ends_.start_at_rest) {
      snapToLine(start_->flat.position, spline_.knots[0]);
      snapToLine(start_->flat.position, spline_.knots[1]);
    }
    snapToLine(goal_->flat.position, spline_.knots[last]);
    snapToLine(goal_->flat.position, spline_.knots[last + 1]);
    const auto point = [](const Knot& knot) {
      vessel::FlatPoint z;
      z.position = knot.state.col(0);
      z.velocity = knot.state.col(1);
      z.acceleration = knot.state.col(2);
      z.jerk = knot.state.col(3);
      return z;
    };
    for (std::size_t i = 0; i <= last; ++i) {
      const Knot& a = spline_.knots[i];
      const Knot& b = spline_.knots[i + 1];
      const double duration = spline_.spans[i].duration_s;
      pieces.push_back(spline_.spans[i].straight
                           ? straightPiece(a, b, lineOf(spline_, i), duration)
                           : trajectory::hermitePiece(point(a), point(b), duration));
    }
    if (ends_.goal_before_spin) {
      goal_turn_ = wrapAngle(goal_->psi_rad - angleOf(lineOf(spline_, last)));
      appendSpin(goal_->flat.position, goal_->psi_rad - goal_turn_, goal_turn_, vessel_, limits,
                 pieces);
    }
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
  WayEnds ends_;
  double start_turn_ = 0.0;
  double goal_turn_ = 0.0;
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
