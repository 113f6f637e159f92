#include "otter_nav/vessel/rest.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"

namespace otter_nav::vessel {
namespace {

ManoeuvringModel windyModel() {
  ManoeuvringModel model;
  model.sway_drag_quadratic_kgpm = 15.0;
  model.wind_surge_kgpm = 0.5;
  model.wind_sway_kgpm = 0.5;
  model.wind_yaw_kg = -0.66;
  return model;
}

// The speed at which nothing is left of the sway balance.
TEST(Rest, IsSetAsideUntilTheDragBalancesTheLoad) {
  Disturbance disturbance;
  disturbance.force_n = {0.0, 12.0};
  for (const double psi : {0.0, 0.7, 2.0, -3.0}) {
    const ManoeuvringModel model = windyModel();
    const double speed = setAside(model, disturbance, psi);
    const double port = std::cos(psi) > 0.0 ? speed : -speed;
    const Eigen::Vector2d velocity = port * Eigen::Vector2d(-std::sin(psi), std::cos(psi));
    EXPECT_NEAR(demandOf(model, disturbance, psi, 0.0, 0.0, velocity, {0.0, 0.0}).sway_n, 0.0,
                1e-9);
  }
  Disturbance stream;
  stream.current_mps = {0.0, 0.5};
  EXPECT_NEAR(setAside(windyModel(), stream, 0.0), 0.5, 1e-12);
  EXPECT_NEAR(setAside(windyModel(), stream, 0.5 * kPi), 0.0, 1e-12);
}

// At rest it is what sets the hull aside; carried as the load would, nothing is missing.
TEST(Rest, AHullFallsOffAMotionByWhatThatLacksOfForce) {
  Disturbance push;
  push.force_n = {0.0, 12.0};
  for (const double psi : {0.0, 0.7, 2.0, -3.0}) {
    const double drift = driftAbeam(windyModel(), push, psi);
    const Eigen::Vector2d carried = drift * Eigen::Vector2d(-std::sin(psi), std::cos(psi));
    const Eigen::Vector2d none = Eigen::Vector2d::Zero();
    EXPECT_NEAR(setOff(windyModel(), push, psi, 0.0, none, none), std::abs(drift), 1e-9);
    EXPECT_NEAR(setOff(windyModel(), push, psi, 0.0, carried, none), 0.0, 1e-6);
    EXPECT_GT(setOff(windyModel(), push, psi, 0.0, -carried, none), std::abs(drift));
  }
}

TEST(Rest, LiesOnHeadingsAlongTheLoadAndOnAnyInCalmWater) {
  Disturbance gale;
  gale.wind_mps = {8.0, 0.0};
  EXPECT_TRUE(canLie(windyModel(), {}, 1.0));
  EXPECT_TRUE(canLie(windyModel(), gale, kPi));
  EXPECT_TRUE(canLie(windyModel(), gale, 0.0));
  EXPECT_FALSE(canLie(windyModel(), gale, 0.5 * kPi));
  EXPECT_FALSE(canLie(windyModel(), gale, kPi - 0.7));
}

// 9 % of both thrusters; a wind whose loads turn with the hull is no such load.
TEST(Rest, ALoadIsFirmThatGivesPathsAHeading) {
  Parameters vessel;
  vessel.thrusters.ahead_max_n = 100.0;
  Disturbance push;
  push.force_n = {0.0, 17.0};
  EXPECT_FALSE(isFirmLoad(vessel, push));
  push.force_n = {0.0, 19.0};
  EXPECT_TRUE(isFirmLoad(vessel, push));
  vessel.manoeuvring = windyModel();
  EXPECT_TRUE(isFirmLoad(vessel, push));
  push.wind_mps = {8.0, 0.0};
  EXPECT_FALSE(isFirmLoad(vessel, push));
}

TEST(Rest, TurnsTheBowIntoTheLoad) {
  for (const double seen_from : {-3.0, -1.5, 0.0, 0.1, 1.5, 2.9}) {
    Disturbance weather;
    weather.wind_mps = {5.0, 5.0};
    weather.current_mps = {0.3, -0.2};
    weather.force_n = {2.0, 4.0};
    const double psi = headingIntoLoad(windyModel(), weather, seen_from);
    const Demand demand = demandOf(windyModel(), weather, psi, 0.0, 0.0, {0.0, 0.0}, {0.0, 0.0});
    EXPECT_NEAR(demand.sway_n, 0.0, 1e-6);
    EXPECT_GT(surgeAtRest(windyModel(), weather, psi), 20.0);
  }
  EXPECT_EQ(headingIntoLoad(windyModel(), {}, 0.4), 0.4);
}

}  // namespace
}  // namespace otter_nav::vessel
