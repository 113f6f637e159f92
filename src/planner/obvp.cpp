#include "otter_nav/planner/obvp.hpp"

#include <array>
#include <cmath>
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
  const double T = duration_s;
  const double T2 = T * T;
  const double T5 = T2 * T2 * T;
  const Eigen::Vector2d dp =
      to.position - from.position - from.velocity * T - from.acceleration * (T2 / 2.0);
  const Eigen::Vector2d dv = to.velocity - from.velocity - from.acceleration * T;
  const Eigen::Vector2d da = to.acceleration - from.acceleration;
  const Eigen::Vector2d alpha = (720.0 * dp - 360.0 * T * dv + 60.0 * T2 * da) / T5;
  const Eigen::Vector2d beta = (-360.0 * T * dp + 168.0 * T2 * dv - 24.0 * T2 * T * da) / T5;
  const Eigen::Vector2d gamma = (60.0 * T2 * dp - 24.0 * T2 * T * dv + 3.0 * T2 * T2 * da) / T5;
  trajectory::Piece piece;
  piece.duration_s = T;
  piece.position.col(0) = from.position;
  piece.position.col(1) = from.velocity;
  piece.position.col(2) = from.acceleration / 2.0;
  piece.position.col(3) = gamma / 6.0;
  piece.position.col(4) = beta / 24.0;
  piece.position.col(5) = alpha / 120.0;
  return piece;
}

double pieceCost(const trajectory::Piece& piece, double sigma) {
  // The jerk has degree 4: five Gauss-Legendre nodes integrate its square exactly.
  constexpr std::array<double, 5> kNodes = {-0.9061798459386640, -0.5384693101056831, 0.0,
                                            0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 5> kWeights = {0.2369268850561891, 0.4786286704993665,
                                              0.5688888888888889, 0.4786286704993665,
                                              0.2369268850561891};
  const double half = 0.5 * piece.duration_s;
  double cost = sigma * piece.duration_s;
  for (std::size_t k = 0; k < kNodes.size(); ++k) {
    cost += kWeights[k] * half * piece.flat(half * (1.0 + kNodes[k])).jerk.squaredNorm();
  }
  return cost;
}

}  // namespace otter_nav::planner
