// On which heading a spot is held.
#include "tracker/station_keeper.hpp"

#include <gtest/gtest.h>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/vessel/rest.hpp"

namespace otter_nav::tracker {
namespace {

// After half a minute, told to lie on `psi_rad`.
double held(const vessel::Parameters& vessel, const vessel::Disturbance& load, double psi_rad) {
  StationKeeper keeper(vessel);
  keeper.start({0.0, 0.0}, psi_rad, psi_rad, 0.0);
  double heading = psi_rad;
  for (int k = 1; k <= 300; ++k) {
    heading = keeper.heading(0.1 * k, load);
  }
  return wrapAngle(heading);
}

vessel::Disturbance eastward(double force_n) {
  vessel::Disturbance load;
  load.force_n = {force_n, 0.0};
  return load;
}

TEST(StationKeeper, KeepsTheHeadingInALightLoad) {
  const vessel::Parameters vessel;
  ASSERT_TRUE(vessel::canLie(vessel.manoeuvring, eastward(1.0), 1.2));
  EXPECT_NEAR(held(vessel, eastward(1.0), 1.2), 1.2, 1e-9);
}

// The stern is nearer, and little thrust would hold it.
TEST(StationKeeper, TurnsTheBowIntoAFirmLoadAndTheNearerEndIntoALighterOne) {
  vessel::Parameters vessel;
  const double firm_n = 0.11 * 2.0 * vessel.thrusters.ahead_max_n;
  const double lighter_n = 0.07 * 2.0 * vessel.thrusters.ahead_max_n;
  ASSERT_TRUE(vessel::isFirmLoad(vessel, eastward(firm_n)));
  ASSERT_FALSE(vessel::isFirmLoad(vessel, eastward(lighter_n)));
  ASSERT_FALSE(vessel::canLie(vessel.manoeuvring, eastward(lighter_n), 1.2));
  EXPECT_NEAR(std::abs(held(vessel, eastward(firm_n), 1.2)), kPi, 1e-6);
  EXPECT_NEAR(held(vessel, eastward(lighter_n), 1.2), 0.0, 1e-6);
}

}  // namespace
}  // namespace otter_nav::tracker
