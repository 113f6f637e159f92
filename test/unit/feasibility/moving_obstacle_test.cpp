// Obstacles that move are met in time: the verifier, the trees' check and the walk they share.
#include <gtest/gtest.h>

#include <cmath>

#include "moving_disc.hpp"
#include "otter_nav/feasibility/clearance_walk.hpp"
#include "otter_nav/feasibility/edge_check.hpp"
#include "otter_nav/feasibility/hull_cover.hpp"
#include "otter_nav/feasibility/verifier.hpp"

namespace otter_nav::feasibility {
namespace {

using Disc = test::MovingDisc;

map::DistanceField openWater() {
  map::OccupancyGrid grid;
  grid.geometry = {200, 200, 0.5, {-50.0, -50.0}};
  grid.cells.assign(40000, map::Cell::kFree);
  return map::DistanceField(grid, {});
}

// East at 3 m/s from (-15, 0), there after 5 s.
trajectory::Trajectory eastward() {
  vessel::FlatPoint from;
  from.position = {-15.0, 0.0};
  from.velocity = {3.0, 0.0};
  vessel::FlatPoint to = from;
  to.position = {15.0, 0.0};
  return trajectory::Trajectory({trajectory::hermitePiece(from, to, 10.0)});
}

Verification verifyBeside(const Disc& disc, double start_s) {
  static const map::DistanceField field = openWater();
  Obstacles obstacles(field);
  obstacles.add(disc);
  return verify(eastward(), obstacles.startingAt(start_s), vessel::Parameters{},
                SafetyLimits::of(vessel::Parameters{}));
}

TEST(MovingObstacle, IsMetOnlyInTime) {
  // Crosses the origin northward at 5 s, when the vessel is there.
  const Disc disc({0.0, -10.0}, {0.0, 2.0}, 1.0);
  const Verification met = verifyBeside(disc, 0.0);
  EXPECT_FALSE(met.ok);
  EXPECT_NEAR(met.fault_s, 4.6, 0.5) << met.reason;
  // The same path begun when the disc has passed, or long before it comes.
  EXPECT_TRUE(verifyBeside(disc, 6.0).ok) << verifyBeside(disc, 6.0).reason;
  EXPECT_TRUE(verifyBeside(disc, -8.0).ok);
}

TEST(MovingObstacle, IsNeverSteppedOver) {
  // A speck at 40 m/s that crosses the bow at every place of the path in turn: in the way for some
  // hundredths of a second only.
  for (double x = -12.0; x <= 12.0; x += 0.37) {
    const double passes_s = (x + 15.0) / 3.0;
    const Disc speck({x, -40.0 * passes_s}, {0.0, 40.0}, 0.01);
    EXPECT_FALSE(verifyBeside(speck, 0.0).ok) << x;
  }
}

TEST(MovingObstacle, IsSeenByTheTreesCheck) {
  const map::DistanceField field = openWater();
  const Disc disc({0.0, -10.0}, {0.0, 2.0}, 1.0);
  Obstacles obstacles(field);
  obstacles.add(disc);
  EdgeCheck check{vessel::Parameters{}};
  check.begin(obstacles, SafetyLimits::of(vessel::Parameters{}));
  const trajectory::Trajectory path = eastward();
  EXPECT_EQ(check.check(path.pieces().front(), 0.0), EdgeFault::kClearance);
  EXPECT_EQ(check.check(path.pieces().front(), 6.0), EdgeFault::kNone);
}

TEST(ClearanceWalk, FindsTheFirstTimeAndEndsAtTheEnd) {
  // A wall reached at 4 s at 2 m/s.
  const auto slack = [](double t) { return 8.0 - 2.0 * t; };
  const auto conflict = firstConflict(0.0, 10.0, 2.0, slack);
  ASSERT_TRUE(conflict);
  EXPECT_NEAR(*conflict, 4.0, 1e-3);
  EXPECT_FALSE(firstConflict(0.0, 3.9, 2.0, slack));
  EXPECT_TRUE(firstConflict(5.0, 10.0, 2.0, slack));
  EXPECT_FALSE(firstConflict(0.0, 10.0, 0.0, [](double) { return 1.0; }));
}

TEST(HullCover, CoversTheRectangle) {
  for (const vessel::Hull hull : {vessel::Hull{2.0, 1.08}, vessel::Hull{4.9, 2.44},
                                  vessel::Hull{3.0, 3.0}, vessel::Hull{12.0, 1.0}}) {
    const HullCover cover(hull);
    for (int i = -20; i <= 20; ++i) {
      for (int k = -20; k <= 20; ++k) {
        const Eigen::Vector2d p(0.5 * hull.length_m * i / 20, 0.5 * hull.beam_m * k / 20);
        double nearest = p.norm();
        for (const double side : {-1.0, 1.0}) {
          nearest = std::min(nearest, (p - Eigen::Vector2d(side * cover.offset_m, 0.0)).norm());
        }
        EXPECT_LE(nearest, cover.radius_m + 1e-12);
        const auto reaches = [&](double x, double y, double radius_m) {
          return (p.cwiseAbs() - Eigen::Vector2d(x, y)).norm() <= radius_m + 1e-12;
        };
        const Eigen::Vector2d& c = cover.corner;
        EXPECT_TRUE(reaches(0.0, 0.0, cover.middle_m) ||
                    reaches(0.5 * c.x(), 0.0, cover.middle_m) ||
                    reaches(c.x(), c.y(), cover.corner_m));
        EXPECT_LE(p.norm(), cover.reach() + 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace otter_nav::feasibility
