#include "tracker/ocp/hull_room.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace otter_nav::tracker {
namespace {

constexpr double kLengthM = 2.0;
constexpr double kBeamM = 1.08;

vessel::State at(double x, double y, double psi_rad) {
  vessel::State state = vessel::State::Zero();
  state.head<3>() << x, y, psi_rad;
  return state;
}

TEST(HullRoom, MeasuresFromTheOutline) {
  const HullRoom hull(kLengthM, kBeamM);
  const vessel::State east = at(10.0, 5.0, 0.0);
  EXPECT_NEAR(hull.gapTo({11.3, 5.2}, east).distance_m, 0.3, 1e-12);  // ahead
  EXPECT_NEAR(hull.gapTo({9.5, 4.2}, east).distance_m, 0.26, 1e-12);  // to starboard
  EXPECT_NEAR(hull.gapTo({8.7, 5.94}, east).distance_m, 0.5, 1e-12);  // off the port quarter
  EXPECT_NEAR(hull.gapTo({10.9, 5.1}, east).distance_m, -0.1, 1e-12);
  EXPECT_NEAR(hull.gapTo({10.0, 5.5}, east).distance_m, -0.04, 1e-12);
  const vessel::State north = at(10.0, 5.0, 0.5 * 3.14159265358979);
  EXPECT_NEAR(hull.gapTo({10.0, 6.3}, north).distance_m, 0.3, 1e-9);
  EXPECT_NEAR(hull.gapTo({10.64, 5.0}, north).distance_m, 0.1, 1e-9);
}

TEST(HullRoom, SlopesAreTheDistances) {
  const HullRoom hull(kLengthM, kBeamM);
  constexpr double kStep = 1e-6;
  for (const double bearing_rad : {0.1, 0.5, 1.3, 2.0, 2.9, 3.6, 4.5, 5.9}) {
    for (const double range_m : {0.3, 0.9, 1.5}) {
      for (const double psi_rad : {-2.5, 0.2, 1.7}) {
        const Eigen::Vector2d point =
            range_m * Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
        const vessel::State state = at(0.02, -0.03, psi_rad);
        const Gap gap = hull.gapTo(point, state);
        for (int axis = 0; axis < 3; ++axis) {
          vessel::State more = state;
          vessel::State less = state;
          more[axis] += kStep;
          less[axis] -= kStep;
          EXPECT_NEAR((hull.gapTo(point, more).distance_m - hull.gapTo(point, less).distance_m) /
                          (2.0 * kStep),
                      gap.slope[axis], 1e-6)
              << "bearing " << bearing_rad << " range " << range_m << " axis " << axis;
        }
      }
    }
  }
}

TEST(HullRoom, TellsByQuarterWhatIsMissingToWhatIsMeant) {
  const HullRoom hull(kLengthM, kBeamM);
  const vessel::State meant = at(0.0, 0.0, 0.0);
  const vessel::State to_port = at(0.0, 0.05, 0.0);
  NearObstacles near;
  near.points = {{0.3, 0.74}, {0.5, 0.64}, {-0.5, 0.79}, {-0.2, 0.99}, {0.0, -0.69}, {5.0, 0.0}};
  const Lacks lacks = hull.lacks(near, to_port, meant, 0.22);
  EXPECT_EQ(lacks[0].missing_m, 0.0);
  EXPECT_EQ(lacks[0].slope.norm(), 0.0);
  EXPECT_NEAR(lacks[1].missing_m, 0.02, 1e-12);  // of 0.22 m; 0.2 m are left
  EXPECT_EQ(lacks[2].missing_m, 0.0);
  EXPECT_NEAR(lacks[3].missing_m, 0.05, 1e-12);
  EXPECT_NEAR(lacks[3].slope.y(), -1.0, 1e-12);
  for (const Lack& lack : hull.lacks(near, meant, meant, 0.22)) {
    EXPECT_EQ(lack.missing_m, 0.0);
  }
}

// As the hull passes it goes from one quarter to another.
TEST(HullRoom, WhatIsMissingChangesWithoutJumps) {
  const HullRoom hull(kLengthM, kBeamM);
  NearObstacles near;
  near.points = {{0.0, 0.6}, {0.02, -0.6}};
  double last_m = 0.0;
  for (double x = -2.0; x < 2.0; x += 0.001) {
    double missing_m = 0.0;
    for (const Lack& lack : hull.lacks(near, at(x, 0.0, 0.0), at(x + 0.03, 0.01, 0.02), 0.25)) {
      missing_m = std::max(missing_m, lack.missing_m);
    }
    if (x > -2.0) {
      EXPECT_NEAR(missing_m, last_m, 0.003) << x;
    }
    last_m = missing_m;
  }
}

TEST(HullRoom, WhatIsMeantToBeTouchedCountsForNothing) {
  const HullRoom hull(kLengthM, kBeamM);
  NearObstacles near;
  near.points = {{0.9, 0.5}};
  for (const Lack& lack : hull.lacks(near, at(0.0, 0.02, 0.0), at(0.0, 0.0, 0.0), 0.25)) {
    EXPECT_EQ(lack.missing_m, 0.0);
  }
}

}  // namespace
}  // namespace otter_nav::tracker
