#include "otter_nav/trajectory/polynomial/real_roots.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::trajectory {
namespace {

double valueAt(const Polynomial& c, int degree, double x) {
  double value = c[static_cast<std::size_t>(degree)];
  for (int k = degree - 1; k >= 0; --k) {
    value = value * x + c[static_cast<std::size_t>(k)];
  }
  return value;
}

// The root of a monotone stretch whose ends have opposite signs.
double closeBracket(const Polynomial& c, const Polynomial& derivative, int degree, double low,
                    double high, double value_low) {
  constexpr int kIterations = 60;
  constexpr double kRelative = 1e-13;
  double x = 0.5 * (low + high);
  for (int i = 0; i < kIterations && high - low > kRelative * std::abs(high); ++i) {
    const double value = valueAt(c, degree, x);
    if (value == 0.0) {
      return x;
    }
    (std::signbit(value) == std::signbit(value_low) ? low : high) = x;
    const double slope = valueAt(derivative, degree - 1, x);
    const double newton = slope == 0.0 ? low : x - value / slope;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (std::abs(next - x) <= kRelative * std::abs(x)) {
      return next;
    }
    x = next;
  }
  return x;
}

Polynomial differentiate(const Polynomial& c, int degree) {
  Polynomial d{};
  for (int k = 1; k <= degree; ++k) {
    d[static_cast<std::size_t>(k - 1)] = k * c[static_cast<std::size_t>(k)];
  }
  return d;
}

}  // namespace

Roots realRoots(const Polynomial& polynomial, double low, double high) {
  int degree = kMaxPolynomialDegree;
  while (degree > 0 && polynomial[static_cast<std::size_t>(degree)] == 0.0) {
    --degree;
  }
  std::array<Polynomial, kMaxPolynomialDegree + 1> chain{};
  chain[static_cast<std::size_t>(degree)] = polynomial;
  for (int k = degree; k > 0; --k) {
    chain[static_cast<std::size_t>(k - 1)] = differentiate(chain[static_cast<std::size_t>(k)], k);
  }
  Roots stationary;
  for (int k = 1; k <= degree; ++k) {
    const Polynomial& c = chain[static_cast<std::size_t>(k)];
    Roots roots;
    double from = low;
    double value_from = valueAt(c, k, from);
    for (int i = 0; i <= stationary.count; ++i) {
      const double to = i < stationary.count ? stationary.value[static_cast<std::size_t>(i)] : high;
      const double value_to = valueAt(c, k, to);
      if (value_from * value_to < 0.0) {
        roots.value[static_cast<std::size_t>(roots.count++)] =
            closeBracket(c, chain[static_cast<std::size_t>(k - 1)], k, from, to, value_from);
      }
      from = to;
      value_from = value_to;
    }
    stationary = roots;
  }
  return stationary;
}

double rootBound(const Polynomial& polynomial) {
  int degree = kMaxPolynomialDegree;
  while (degree > 0 && polynomial[static_cast<std::size_t>(degree)] == 0.0) {
    --degree;
  }
  double bound = 0.0;
  for (int k = 1; k <= degree; ++k) {
    const double ratio = std::abs(polynomial[static_cast<std::size_t>(degree - k)] /
                                  polynomial[static_cast<std::size_t>(degree)]);
    bound = std::max(bound, std::pow(ratio, 1.0 / k));
  }
  return 2.0 * bound;
}

}  // namespace otter_nav::trajectory
