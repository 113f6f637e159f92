// The bound of what gusts set a tracked hull aside by, against what they do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mission/weather.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/map/occupancy_grid.hpp"
#include "otter_nav/plant/simulator.hpp"
#include "otter_nav/tracker/tracker.hpp"

namespace otter_nav::mission {
namespace {

const std::string kSource = OTTER_NAV_SOURCE_DIR;

struct Outcome {
  double worst_m = 0.0;
  double reach_m = 0.0;  // as learned by the end
};

// A straight leg from rest to rest in a gusting wind without waves and current: in the first third
// the weather is learned.
Outcome sail(double course_rad, double mean_mps, std::uint64_t seed) {
  const auto vessel = vessel::loadParameters(kSource + "/config/vessels/otter_gazebo.yaml");
  const auto options = config::load<tracker::Options>(kSource + "/config/tracker.yaml");
  auto plant = plant::loadOptions(*vessel, kSource + "/config/plant.yaml",
                                  kSource + "/config/disturbances/none.yaml");
  EXPECT_TRUE(vessel && options && plant);
  plant->disturbance.wind.speed_mps = mean_mps;
  plant->disturbance.wind.gust_intensity = 0.15;
  plant::Simulator sea(*plant, map::OccupancyGrid{}, seed);
  const auto tracker = tracker::Tracker::create(*options, *vessel);
  Weather weather(*vessel);
  constexpr double kDurationS = 60.0;
  constexpr double kMeanMps = 0.25;
  vessel::FlatPoint start;
  vessel::FlatPoint end;
  end.position =
      kMeanMps * kDurationS * Eigen::Vector2d(std::cos(course_rad), std::sin(course_rad));
  sea.placeAt({0.0, 0.0}, kPi);  // bow to the wind
  EXPECT_TRUE(tracker->setTrajectory(
      {trajectory::Trajectory({trajectory::hermitePiece(start, end, kDurationS)}), 0.0}));
  Outcome outcome;
  for (int k = 0; k < static_cast<int>(100.0 * kDurationS); ++k) {
    tracker->addOdometry(sea.odometry().stamp_s, sea.odometry().state);
    const tracker::Command command = tracker->step(sea.time());
    if (k % 10 == 0) {
      weather.feel(sea.time(), command.disturbance.mean);
    }
    if (sea.time() > kDurationS / 3.0) {
      outcome.worst_m = std::max(outcome.worst_m, command.tracking_error_m);
    }
    sea.step(command.thrusts, 0.01);
  }
  outcome.reach_m = weather.gustReach();
  return outcome;
}

TEST(GustReach, BoundsTheErrorOnALegThatCanBeHeld) {
  for (const double course_rad : {0.0, 0.5 * kPi, kPi}) {
    for (const std::uint64_t seed : {1, 2}) {
      const Outcome outcome = sail(course_rad, 6.0, seed);
      EXPECT_LT(outcome.worst_m, outcome.reach_m) << course_rad << ", seed " << seed;
      EXPECT_LT(outcome.reach_m, 2.0);  // and is no use if it is far too wide
    }
  }
}

}  // namespace
}  // namespace otter_nav::mission
