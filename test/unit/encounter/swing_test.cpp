#include "encounter/swing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::encounter {
namespace {

// Waves of 0.09 m and 0.02 m are now in step, now against each other.
TEST(Swing, IsWhatWavesReachInStep) {
  constexpr double kStepS = 0.5;
  const Eigen::Vector2d steered(0.0, 1.4);
  for (const double phase : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) {
    const auto aside = [&](double t) {
      return 0.09 * std::sin(2.0 * kPi / 5.0 * t) + 0.02 * std::sin(2.0 * kPi / 6.3 * t + phase);
    };
    Swing swing;
    double told = 0.0;
    double most = 0.0;
    for (double t = 0.0; t < 120.0; t += kStepS) {
      told = swing.seen(t, {aside(t), 0.0}, steered);
      most = std::max(most, std::abs(aside(t) - aside(t - kCourseS)) / kCourseS);
    }
    EXPECT_GT(told, 0.93 * most) << phase;
    EXPECT_LT(told, 1.15 * most) << phase;
  }
}

}  // namespace
}  // namespace otter_nav::encounter
