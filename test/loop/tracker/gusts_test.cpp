// The tracker against the plant in gusts that nearly take the moment that holds the heading.
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "vessel_at_sea.hpp"

namespace otter_nav::tracker {
namespace {

struct Held {
  double lost_s = 0.0;      // heading more than 0.8 rad off the wind
  double farthest_m = 0.0;  // from the spot
};

// Bow to an eastward wind that gusts as in `hard`, with its waves, pushed north by `push_n`.
Held hold(double wind_mps, double push_n, int seed) {
  constexpr double kSettlesS = 10.0;
  constexpr double kLastsS = 180.0;
  constexpr double kLostRad = 0.8;
  const auto vessel = vessel::loadParameters(test::kSource + "/config/vessels/otter_gazebo.yaml");
  const auto options = config::load<Options>(test::kSource + "/config/tracker.yaml");
  auto sea = plant::loadOptions(*vessel, test::kSource + "/config/plant.yaml",
                                test::kSource + "/config/disturbances/hard.yaml");
  sea->disturbance.wind.speed_mps = wind_mps;
  sea->disturbance.wind.direction_rad = 0.0;
  sea->disturbance.current = {};
  sea->disturbance.force_n = {0.0, push_n};
  plant::Simulator plant(*sea, map::OccupancyGrid{}, static_cast<std::uint64_t>(seed));
  plant.placeAt({0.0, 0.0}, kPi);
  const std::unique_ptr<Tracker> tracker = Tracker::create(*options, *vessel);
  tracker->requestStop("hold", plant.time(), 1);
  Held held;
  while (plant.time() < kLastsS) {
    tracker->addOdometry(plant.odometry().stamp_s, plant.odometry().state, 0.0);
    plant.step(tracker->step(plant.time()).thrusts, test::kPeriodS);
    if (plant.time() < kSettlesS) {
      continue;
    }
    const vessel::State& x = plant.truth().planar;
    const bool lost = std::abs(wrapAngle(x[vessel::kPsi] - kPi)) > kLostRad;
    held.lost_s += lost ? test::kPeriodS : 0.0;
    held.farthest_m = std::max(held.farthest_m, x.head<2>().norm());
  }
  return held;
}

TEST(Gusts, WithoutACurrentHeadingAndPlaceAreHeld) {
  for (const int seed : {1, 2, 3}) {
    const Held held = hold(9.0, 0.0, seed);
    EXPECT_EQ(held.lost_s, 0.0) << seed;
    EXPECT_LT(held.farthest_m, 0.3) << seed;
  }
}

// What a current of half a metre a second does to otter_gazebo takes 0.5 rad off the wind to
// balance, where gusts take the heading. With the corridor it is lost for 10.6 s on average,
// without for 15.8 s.
TEST(Gusts, AcrossACurrentTheHeadingIsSeldomLost) {
  double lost_s = 0.0;
  for (const double wind_mps : {9.0, 9.5}) {
    for (const int seed : {1, 2, 3}) {
      const Held held = hold(wind_mps, 8.0, seed);
      lost_s += held.lost_s / 6.0;
      EXPECT_LT(held.farthest_m, 8.0) << wind_mps << " m/s, " << seed;
    }
  }
  EXPECT_LT(lost_s, 13.0);
}

}  // namespace
}  // namespace otter_nav::tracker
