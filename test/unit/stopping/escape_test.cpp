#include "otter_nav/stopping/escape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../mission/waters.hpp"
#include "../vessel_of.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/rk4.hpp"
#include "otter_nav/feasibility/hull_cover.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::stopping {
namespace {

namespace test = mission::test;
using Eigen::Vector2d;

// Of otter_gazebo's kind.
vessel::Parameters windTurned() {
  vessel::Parameters vessel;
  vessel.manoeuvring.wind_surge_kgpm = 0.5;
  vessel.manoeuvring.wind_sway_kgpm = 0.5;
  vessel.manoeuvring.wind_yaw_kg = -0.66;
  return vessel;
}

vessel::Disturbance blowing(double east_mps) {
  vessel::Disturbance disturbance;
  disturbance.wind_mps = {east_mps, 0.0};
  return disturbance;
}

// So far off the bow to the wind, which blows east, at the origin.
vessel::State lying(double off_rad, double drifts_mps = 0.0) {
  vessel::State state;
  const double psi = kPi + off_rad;
  state << 0.0, 0.0, psi, drifts_mps * std::cos(psi), -drifts_mps * std::sin(psi), 0.0;
  return state;
}

double outlineAt(const vessel::Hull& hull, const vessel::State& x,
                 const map::DistanceField& field) {
  return feasibility::outlineClearance(hull, x.head<2>(), x[vessel::kPsi],
                                       [&](const Vector2d& p) { return field.clearance(p); });
}

// What the outline keeps clear while both thrusters turn the hull to the wind.
double turningClears(vessel::State x, const vessel::Parameters& vessel,
                     const vessel::Disturbance& disturbance, const map::DistanceField& field) {
  constexpr double kStepS = 0.05;
  double least = outlineAt(vessel.hull, x, field);
  for (double t = 0.0; t < 6.0; t += kStepS) {
    const double to_bow = wrapAngle(kPi - x[vessel::kPsi]);
    const double most = vessel.thrusters.ahead_max_n;
    const vessel::Thrusts thrusts =
        to_bow > 0.0 ? vessel::Thrusts(-most, most) : vessel::Thrusts(most, -most);
    x = rk4Step(
        [&](double, const vessel::State& s) {
          return vessel::stateDerivative(s, thrusts, vessel.manoeuvring, vessel.thrusters,
                                         disturbance);
        },
        0.0, x, kStepS);
    least = std::min(least, outlineAt(vessel.hull, x, field));
  }
  return least;
}

TEST(Escape, PassesWhatItDriftsOntoWhileItTurns) {
  map::OccupancyGrid grid = test::openWater();
  test::block(grid, {4.0, -1.0}, {6.0, 1.0});
  const map::DistanceField field = test::fieldOf(grid);
  const vessel::Parameters vessel = windTurned();
  const vessel::Disturbance disturbance = blowing(11.5);
  for (const double off_rad : {0.8, 1.3, -0.8, -1.5, 2.0}) {
    const vessel::State state = lying(off_rad, 0.8);
    ASSERT_LE(turningClears(state, vessel, disturbance, field), 0.0) << off_rad;
    const Escape way = escape(state, field, vessel, disturbance);
    EXPECT_GT(way.clearance_m, 0.8) << off_rad;
    const vessel::State begins = way.path.sample(0.0, vessel, disturbance).state;
    EXPECT_NEAR((begins.head<2>() - state.head<2>()).norm(), 0.0, 1e-9);
    EXPECT_NEAR(wrapAngle(begins[vessel::kPsi] - state[vessel::kPsi]), 0.0, 1e-9);
    EXPECT_NEAR((begins.tail<3>() - state.tail<3>()).norm(), 0.0, 1e-6);
    for (double t = 0.0; t < way.path.duration(); t += 0.05) {
      EXPECT_GT(outlineAt(vessel.hull, way.path.sample(t, vessel, disturbance).state, field),
                way.clearance_m - 0.02)
          << off_rad << ", " << t;
    }
  }
}

// What moves the hull along it is within the thrusters' limits, and nothing pushes it abeam.
TEST(Escape, IsAMotionThatTheThrustersMake) {
  map::OccupancyGrid grid = test::openWater();
  test::block(grid, {4.0, -1.0}, {6.0, 1.0});
  const map::DistanceField field = test::fieldOf(grid);
  const vessel::Parameters vessel = windTurned();
  vessel::Disturbance disturbance = blowing(11.0);
  disturbance.current_mps = {0.1, -0.4};
  const Escape way = escape(lying(1.0, 0.5), field, vessel, disturbance);
  ASSERT_FALSE(way.path.empty());
  for (const trajectory::Piece& piece : way.path.pieces()) {
    ASSERT_EQ(piece.kind, trajectory::PieceKind::kSpin);
    const double t = 0.5 * piece.duration_s;
    const vessel::FlatPoint z = piece.flat(t);
    const Eigen::Vector3d psi = piece.spinHeading(t);
    const vessel::Demand demand = vessel::demandOf(vessel.manoeuvring, disturbance, psi[0], psi[1],
                                                   psi[2], z.velocity, z.acceleration);
    EXPECT_GT(vessel::thrustMargin(vessel::thrustsFromTau(demand.tau, vessel.thrusters),
                                   vessel.thrusters),
              0.0);
    EXPECT_LT(std::abs(demand.sway_n), 2.0);
  }
}

TEST(Escape, ComesToRestInTheWindsLine) {
  const map::OccupancyGrid grid = test::openWater(200.0);
  const map::DistanceField field = test::fieldOf(grid);
  const vessel::Parameters vessel = windTurned();
  for (const double off_rad : {0.5, -0.5, 2.7}) {
    const Escape way = escape(lying(off_rad, 0.8), field, vessel, blowing(9.0));
    const vessel::State end = way.path.sample(way.path.duration(), vessel).state;
    EXPECT_LT(std::abs(std::sin(end[vessel::kPsi])), 0.4) << off_rad;
    EXPECT_LE(vessel::speedOf(end), vessel::kRestMps) << off_rad;
    EXPECT_NEAR(end[vessel::kYawRate], 0.0, 1e-9) << off_rad;
    EXPECT_LT(way.path.duration(), 6.5) << off_rad;
  }
}

// A current pushes by the drag alone.
TEST(Escape, ComesToRestInACurrent) {
  const map::OccupancyGrid grid = test::openWater(200.0);
  const map::DistanceField field = test::fieldOf(grid);
  const vessel::Parameters vessel = vessel::test::vesselOf("otter");
  vessel::Disturbance disturbance;
  for (const double current_mps : {0.8, 1.0, 1.3}) {
    disturbance.current_mps = {current_mps, 0.0};
    for (const double off_rad : {0.5, -0.8}) {
      const Escape way = escape(lying(off_rad, 0.8), field, vessel, disturbance);
      const vessel::State end = way.path.sample(way.path.duration(), vessel).state;
      EXPECT_LT(std::abs(std::sin(end[vessel::kPsi])), 0.4) << current_mps << ", " << off_rad;
      EXPECT_LE(vessel::speedOf(end), vessel::kRestMps) << current_mps << ", " << off_rad;
    }
  }
}

// Before the wind full thrust makes it faster than a vessel can, which the tracker refuses.
TEST(Escape, IsNoFasterThanTheVesselCan) {
  map::OccupancyGrid grid = test::openWater(200.0);
  test::block(grid, {-20.0, 2.0}, {8.0, 4.0});  // a channel, and more room beyond it
  test::block(grid, {-20.0, -4.0}, {8.0, -2.0});
  const map::DistanceField field = test::fieldOf(grid);
  const vessel::Parameters vessel = windTurned();
  const vessel::Disturbance disturbance = blowing(14.0);
  vessel::State running = lying(kPi, 0.0);
  running[vessel::kSurge] = 0.95 * vessel.top_speed_mps;
  const Escape way = escape(running, field, vessel, disturbance);
  double fastest = 0.0;
  for (double t = 0.0; t < way.path.duration(); t += 0.05) {
    fastest = std::max(fastest, way.path.flat(t).velocity.norm());
  }
  EXPECT_GT(fastest, 0.9 * vessel.top_speed_mps);
  EXPECT_LE(fastest, 1.01 * vessel.top_speed_mps);
}

// What comes after the last instant asked for doesn't count, nor what was before the first.
TEST(Escape, TheLeastClearanceIsThatOfTheTimeAskedFor) {
  map::OccupancyGrid grid = test::openWater();
  test::block(grid, {10.0, -5.0}, {12.0, 5.0});
  const map::DistanceField field = test::fieldOf(grid);
  const vessel::Hull hull;
  vessel::Foreseen foreseen{100.0, 1.0, {}};
  for (int k = 0; k <= 8; ++k) {
    foreseen.poses.push_back({{1.0 * k, 0.0}, 0.0});
  }
  const auto least = [&](double from_s, double to_s) {
    return leastClearance(foreseen, from_s, to_s, field, hull);
  };
  EXPECT_NEAR(least(100.0, 103.0), 7.0 - 0.5 * hull.length_m, 0.4);
  EXPECT_NEAR(least(100.0, 108.0), 2.0 - 0.5 * hull.length_m, 0.4);
  EXPECT_TRUE(std::isinf(least(109.0, 120.0)));
  EXPECT_TRUE(std::isinf(leastClearance({}, 0.0, 1000.0, field, hull)));
  std::reverse(foreseen.poses.begin(), foreseen.poses.end());
  EXPECT_NEAR(least(105.0, 108.0), 7.0 - 0.5 * hull.length_m, 0.4);
}

// A drift goes on as it was in the end; way, and what is too short to tell, is left as it is.
TEST(Escape, WhatDriftsIsForeseenToDriftOn) {
  const auto foreseen = [](double mps, int poses) {
    vessel::Foreseen motion{100.0, 0.5, {}};
    for (int k = 0; k < poses; ++k) {
      motion.poses.push_back({{3.0, 0.5 * mps * k}, 0.3});
    }
    return motion;
  };
  const vessel::Foreseen drifts = driftingOn(foreseen(0.4, 13), 110.0);
  ASSERT_EQ(drifts.poses.size(), 21U);  // to 110 s
  EXPECT_NEAR(drifts.poses.back().position.x(), 3.0, 1e-9);
  EXPECT_NEAR(drifts.poses.back().position.y(), 4.0, 1e-9);
  EXPECT_EQ(drifts.poses.back().psi_rad, 0.3);
  EXPECT_EQ(driftingOn(foreseen(1.2, 13), 110.0).poses.size(), 13U);
  EXPECT_EQ(driftingOn(foreseen(0.4, 4), 110.0).poses.size(), 4U);
  EXPECT_TRUE(driftingOn({}, 110.0).poses.empty());
}

}  // namespace
}  // namespace otter_nav::stopping
