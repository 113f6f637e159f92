#include "planner/obvp.hpp"

#include <limits>

#include "otter_nav/trajectory/polynomial/real_roots.hpp"

namespace otter_nav::planner {

// The quadratic form of Mueller et al. (2015) in (dp, dv, da), expanded in powers of 1/T.
SteerCost::SteerCost(const KinoState& from, const KinoState& to, double sigma) : sigma_(sigma) {
  const Eigen::Vector2d dp = to.position - from.position;
  const Eigen::Vector2d dv = to.velocity - from.velocity;
  const Eigen::Vector2d da = to.acceleration - from.acceleration;
  const Eigen::Vector2d& v0 = from.velocity;
  const Eigen::Vector2d& a0 = from.acceleration;
  c5_ = 720.0 * dp.dot(dp);
  c4_ = -1440.0 * dp.dot(v0) - 720.0 * dp.dot(dv);
  c3_ = 720.0 * v0.dot(v0) + 720.0 * v0.dot(dv) + 192.0 * dv.dot(dv) + 120.0 * da.dot(dp);
  c2_ = -24.0 * a0.dot(dv) - 120.0 * da.dot(v0) - 72.0 * da.dot(dv);
  c1_ = 12.0 * a0.dot(a0) + 12.0 * da.dot(a0) + 9.0 * da.dot(da);
}

double SteerCost::at(double duration_s) const {
  const double s = 1.0 / duration_s;
  return sigma_ * duration_s + s * (c1_ + s * (c2_ + s * (c3_ + s * (c4_ + s * c5_))));
}

std::optional<double> SteerCost::bestDuration() const {
  constexpr double kShortestS = 1e-3;
  const trajectory::Polynomial slope = {-5.0 * c5_, -4.0 * c4_, -3.0 * c3_, -2.0 * c2_,
                                        -c1_,       0.0,        sigma_};
  const trajectory::Roots roots =
      trajectory::realRoots(slope, kShortestS, 1.01 * trajectory::rootBound(slope) + kShortestS);
  std::optional<double> best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (int i = 0; i < roots.count; ++i) {
    const double duration = roots.value[static_cast<std::size_t>(i)];
    const double cost = at(duration);
    if (cost < best_cost) {
      best_cost = cost;
      best = duration;
    }
  }
  return best;
}

std::optional<Steer> steer(const KinoState& from, const KinoState& to, double sigma) {
  const SteerCost cost(from, to, sigma);
  const auto duration = cost.bestDuration();
  if (!duration) {
    return std::nullopt;
  }
  return Steer{*duration, cost.at(*duration)};
}

trajectory::Piece quinticPiece(const KinoState& from, const KinoState& to, double duration_s) {
  const auto end = [](const KinoState& state) {
    trajectory::QuinticEnd values;
    values << state.position, state.velocity, state.acceleration;
    return values;
  };
  return trajectory::quinticPiece(end(from), end(to), duration_s);
}

double pieceCost(const trajectory::Piece& piece, double sigma) {
  return sigma * piece.duration_s + trajectory::squaredJerk(piece);
}

}  // namespace otter_nav::planner
