// Stop and spin: few stops where the path bends, and only where the legs between are clear.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/optimizer/ends.hpp"

namespace otter_nav::optimizer {
namespace {

const SpinLimits kSpin{0.9, 1.8};

constexpr double kWallM = 0.8;  // from which the path's bend stays

trajectory::Boundary berth(double x, double y, double psi_rad) {
  trajectory::Boundary end;
  end.flat.position << x, y;
  end.psi_rad = psi_rad;
  return end;
}

// Land where x < 0 and y > 0: its corner is the origin.
map::DistanceField corner() {
  map::OccupancyGrid grid;
  grid.geometry = {200, 200, 0.1, {-10.0, -10.0}};
  grid.cells.assign(200 * 200, map::Cell::kFree);
  for (int row = 100; row < 200; ++row) {
    for (int column = 0; column < 100; ++column) {
      grid.cells[grid.geometry.index(column, row)] = map::Cell::kOccupied;
    }
  }
  return {grid, {}};
}

// Round the corner as near as may be: eastward, then north, with a point every ten degrees.
std::vector<Eigen::Vector2d> bend() {
  constexpr double kRadiusM = kWallM + 0.02;
  std::vector<Eigen::Vector2d> path = {{-6.0, -kRadiusM}};
  for (int k = 0; k <= 9; ++k) {
    const double angle = kPi / 18.0 * k;
    path.emplace_back(kRadiusM * std::sin(angle), -kRadiusM * std::cos(angle));
  }
  path.emplace_back(kRadiusM, 6.0);
  return path;
}

TEST(StopAndSpin, GoesRoundABendWithFewStops) {
  const map::DistanceField field = corner();
  const std::vector<Eigen::Vector2d> path = bend();
  const trajectory::Boundary start = berth(path.front().x(), path.front().y(), 0.0);
  const trajectory::Boundary goal = berth(path.back().x(), path.back().y(), 0.5 * kPi);
  const vessel::Parameters vessel;
  auto limits = feasibility::SafetyLimits::of(vessel);
  limits.clearance_m = kWallM;
  const StopAndSpin spinning(vessel, kSpin, limits);
  const std::vector<Eigen::Vector2d> stops = spinning.quickestStops(field, path, start, goal);
  EXPECT_LE(stops.size(), 5U);
  EXPECT_EQ(stops.front(), path.front());
  EXPECT_EQ(stops.back(), path.back());
  const trajectory::Trajectory quick = spinning.follow(stops, start, goal);
  EXPECT_LT(quick.duration(), 0.6 * spinning.follow(path, start, goal).duration());
  for (double t = 0.0; t < quick.duration(); t += 0.02) {
    EXPECT_GE(field.clearance(quick.flat(t).position), kWallM - 1e-6) << "at " << t << " s";
  }
}

TEST(StopAndSpin, KeepsThePathThatIsNotClear) {
  const map::DistanceField field = corner();
  const std::vector<Eigen::Vector2d> path = {{-6.0, -2.0}, {-3.0, 3.0}, {3.0, 3.0}};
  auto limits = feasibility::SafetyLimits::of(vessel::Parameters{});
  limits.clearance_m = 3.5;
  const vessel::Parameters vessel;
  EXPECT_EQ(StopAndSpin(vessel, kSpin, limits)
                .quickestStops(field, path, berth(-6.0, -2.0, 0.0), berth(3.0, 3.0, 0.0)),
            path);
}

}  // namespace
}  // namespace otter_nav::optimizer
