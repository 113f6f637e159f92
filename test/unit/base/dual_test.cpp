#include "otter_nav/base/dual.hpp"

#include <gtest/gtest.h>

namespace otter_nav {
namespace {

TEST(Dual, CarriesExactDerivatives) {
  const auto x = variable<0>(1.5);
  const auto y = variable<3>(-0.4);
  const auto f = 2.0 * x * y - signedSquare(y) / 4.0 + (1.0 - x) * inverse(x) + y / x;
  EXPECT_DOUBLE_EQ(valueOf(f), -1.2 + 0.04 - 0.5 / 1.5 - 0.4 / 1.5);
  EXPECT_DOUBLE_EQ(slope<0>(f), -0.8 - 1.0 / 2.25 + 0.4 / 2.25);
  EXPECT_DOUBLE_EQ(slope<3>(f), 3.0 - 0.2 + 1.0 / 1.5);
  EXPECT_EQ(slope<1>(f), 0.0);
}

TEST(Dual, SlopesThatAreZeroTakeNoRoom) {
  EXPECT_EQ(sizeof(variable<2>(1.0) * variable<5>(2.0)), 3 * sizeof(double));
}

TEST(Dual, OfDualsHoldsSecondDerivatives) {
  const auto x = variable<0>(variable<0>(-3.0));
  const auto f = x * x * x + signedSquare(x);
  EXPECT_DOUBLE_EQ(f.value.value, -36.0);
  EXPECT_DOUBLE_EQ(f.slopes[0].value, 33.0);
  EXPECT_DOUBLE_EQ(f.slopes[0].slopes[0], -20.0);
}

}  // namespace
}  // namespace otter_nav
