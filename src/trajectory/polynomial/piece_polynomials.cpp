#include "otter_nav/trajectory/polynomial/piece_polynomials.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::trajectory {
namespace {

constexpr double kStraightShare = 1e-9;  // of a coefficient, that may point off the line

}  // namespace

Eigen::Vector2d lineOf(const Piece& piece) {
  Eigen::Vector2d longest = Eigen::Vector2d::Zero();
  double longest_m = 0.0;
  std::array<double, kCoefficients> size{};
  double power = 1.0;
  for (int k = 1; k < kCoefficients; ++k) {
    power *= piece.duration_s;
    const double length = piece.position.col(k).norm() * power;
    size[static_cast<std::size_t>(k)] = power;
    if (length > longest_m) {
      longest_m = length;
      longest = piece.position.col(k).normalized();
    }
  }
  for (int k = 1; k < kCoefficients; ++k) {
    const double off = std::abs(cross(longest, piece.position.col(k)));
    if (off * size[static_cast<std::size_t>(k)] > kStraightShare * longest_m) {
      return Eigen::Vector2d::Zero();
    }
  }
  // Ahead is where the piece ends.
  const Eigen::Vector2d chord = piece.flat(piece.duration_s).position - piece.flat(0.0).position;
  return chord.dot(longest) < 0.0 ? Eigen::Vector2d(-longest) : longest;
}

// The control polygon of the velocity (Bernstein form) holds all its values.
double speedBound(const Eigen::Matrix<double, 2, 7>& velocity, double duration_s) {
  constexpr int kN = 6;
  constexpr double kBinomial[kN + 1] = {1, 6, 15, 20, 15, 6, 1};
  // b_i = sum over k <= i of C(i, k) / C(n, k) c_k T^k, by repeated differences of columns.
  double bound = 0.0;
  std::array<double, kN + 1> power{};
  power[0] = 1.0;
  for (std::size_t k = 1; k <= kN; ++k) {
    power[k] = power[k - 1] * duration_s;
  }
  for (int i = 0; i <= kN; ++i) {
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    double choose = 1.0;  // C(i, k)
    for (int k = 0; k <= i; ++k) {
      b += choose / kBinomial[k] * power[static_cast<std::size_t>(k)] * velocity.col(k);
      choose = choose * (i - k) / (k + 1);
    }
    bound = std::max(bound, b.norm());
  }
  return bound;
}

}  // namespace otter_nav::trajectory
