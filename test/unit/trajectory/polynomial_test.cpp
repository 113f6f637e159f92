#include <gtest/gtest.h>

#include "otter_nav/trajectory/polynomial/real_roots.hpp"

namespace otter_nav::trajectory {
namespace {

TEST(RealRoots, FindsTheRootsOfAProduct) {
  // (x - 1)(x - 2)(x - 3)(x + 4)(x^2 + 1)
  const Polynomial p = {-24.0, 38.0, -37.0, 36.0, -12.0, -2.0, 1.0};
  const Roots roots = realRoots(p, -10.0, 10.0);
  ASSERT_EQ(roots.count, 4);
  const std::array<double, 4> expected = {-4.0, 1.0, 2.0, 3.0};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(roots.value[i], expected[i], 1e-9);
  }
  EXPECT_GE(rootBound(p), 4.0);
}

TEST(RealRoots, StaysWithinTheInterval) {
  const Polynomial p = {-6.0, 11.0, -6.0, 1.0};  // 1, 2, 3
  const Roots roots = realRoots(p, 1.5, 2.5);
  ASSERT_EQ(roots.count, 1);
  EXPECT_NEAR(roots.value[0], 2.0, 1e-12);
}

TEST(RealRoots, OfAConstantAreNone) {
  EXPECT_EQ(realRoots({5.0}, -1.0, 1.0).count, 0);
  EXPECT_EQ(rootBound({5.0}), 0.0);
}

}  // namespace
}  // namespace otter_nav::trajectory
