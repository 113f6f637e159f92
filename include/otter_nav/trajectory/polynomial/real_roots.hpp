// Real roots of a small polynomial without allocation.
#pragma once

#include <array>

namespace otter_nav::trajectory {

constexpr int kMaxPolynomialDegree = 6;

// Coefficients by ascending power, up to degree 6.
using Polynomial = std::array<double, kMaxPolynomialDegree + 1>;

struct Roots {
  std::array<double, kMaxPolynomialDegree> value{};
  int count = 0;
};

// The distinct real roots in (low, high), ascending. Between neighbouring stationary points a
// polynomial is monotone, so the derivatives' roots, found from the linear one upwards, bracket
// every root; a bracket is closed by Newton's step, or by halving where that step leaves it. A root
// of even multiplicity is found only as a sign change would show it, which for a minimum of the
// integral is what counts.
[[nodiscard]] Roots realRoots(const Polynomial& polynomial, double low, double high);

// No root of the polynomial is larger in magnitude than this (Fujiwara 1916); zero when it is
// constant.
[[nodiscard]] double rootBound(const Polynomial& polynomial);

}  // namespace otter_nav::trajectory
