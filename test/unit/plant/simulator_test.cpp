#include "otter_nav/plant/simulator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::plant {
namespace {

Options optionsFor(const std::string& vessel, const std::string& disturbance = "none") {
  const std::string config = std::string(OTTER_NAV_SOURCE_DIR) + "/config/";
  return loadOptions(vessel::loadParameters(config + "vessels/" + vessel + ".yaml").value(),
                     config + "plant.yaml", config + "disturbances/" + disturbance + ".yaml")
      .value();
}

map::OccupancyGrid island() {
  map::OccupancyGrid grid;
  grid.geometry = {80, 80, 0.25, Eigen::Vector2d(-10.0, -10.0)};
  grid.cells.assign(80 * 80, map::Cell::kFree);
  grid.cells[grid.geometry.index(60, 40)] = map::Cell::kOccupied;  // from (5, 0) to (5.25, 0.25)
  return grid;
}

class EveryVessel : public testing::TestWithParam<const char*> {};

TEST_P(EveryVessel, StartAtRestWhereTheyArePlaced) {
  Simulator simulator(optionsFor(GetParam()), {}, 1);
  simulator.placeAt({3.0, -2.0}, 2.0);
  for (int i = 0; i < 200; ++i) simulator.step({0.0, 0.0}, 0.01);
  const vessel::State planar = simulator.truth().planar;
  EXPECT_NEAR(planar[vessel::kX], 3.0, 1e-6);
  EXPECT_NEAR(planar[vessel::kY], -2.0, 1e-6);
  EXPECT_NEAR(planar[vessel::kPsi], 2.0, 1e-6);
  EXPECT_NEAR(simulator.time(), 2.0, 1e-9);
}

// A voyage begins in the sea that it goes on in: none is tossed about more as it is set afloat than
// by the waves that follow.
TEST_P(EveryVessel, RideTheWavesFromTheFirstMomentOn) {
  constexpr int kPlaces = 24;
  constexpr double kFirstS = 2.0;
  constexpr double kThenS = 30.0;
  constexpr double kAsMuch = 1.2;
  struct Tossed {
    double tilt_rad = 0.0;
    double heave_mps = 0.0;
    void by(const Truth& truth) {
      tilt_rad = std::max({tilt_rad, std::abs(truth.roll_rad), std::abs(truth.pitch_rad)});
      heave_mps = std::max(heave_mps, std::abs(truth.velocity_in_body.z()));
    }
  };
  Tossed at_first;
  Tossed then;
  for (int k = 0; k < kPlaces; ++k) {
    Simulator simulator(optionsFor(GetParam(), "hard"), {}, static_cast<std::uint64_t>(k) + 1);
    simulator.placeAt({17.0 * k, -9.0 * k}, 0.7 * k);
    while (simulator.time() < kThenS) {
      (simulator.time() < kFirstS ? at_first : then).by(simulator.truth());
      simulator.step({0.0, 0.0}, 0.01);
    }
  }
  EXPECT_LT(at_first.tilt_rad, kAsMuch * then.tilt_rad);
  EXPECT_LT(at_first.heave_mps, kAsMuch * then.heave_mps);
}

TEST_P(EveryVessel, SailWhereTheyPointAndTurnTowardsTheWeakerSide) {
  Simulator simulator(optionsFor(GetParam()), {}, 1);
  simulator.placeAt({0.0, 0.0}, 0.5 * kPi);
  for (int i = 0; i < 100; ++i) simulator.step({30.0, 30.0}, 0.01);
  EXPECT_GT(simulator.truth().planar[vessel::kY], 0.1);
  EXPECT_NEAR(simulator.truth().planar[vessel::kX], 0.0, 1e-9);
  for (int i = 0; i < 100; ++i) simulator.step({10.0, 40.0}, 0.01);
  EXPECT_GT(simulator.truth().planar[vessel::kYawRate], 0.02);  // to port
  EXPECT_GT(simulator.truth().planar[vessel::kPsi], 0.5 * kPi);
}

// The planar velocities are the position's derivatives, whatever the tilt.
TEST_P(EveryVessel, PlanarVelocityIsThePositionsDerivative) {
  Simulator simulator(optionsFor(GetParam(), "hard"), {}, 3);
  for (int i = 0; i < 500; ++i) simulator.step({40.0, 30.0}, 0.01);
  const Truth before = simulator.truth();
  simulator.step({40.0, 30.0}, 1e-4);
  const Truth after = simulator.truth();
  const double c = std::cos(before.yaw_rad);
  const double s = std::sin(before.yaw_rad);
  const Eigen::Vector2d velocity = (after.planar - before.planar).head<2>() / 1e-4;
  EXPECT_NEAR(before.planar[vessel::kSurge], c * velocity.x() + s * velocity.y(), 1e-3);
  EXPECT_NEAR(before.planar[vessel::kSway], c * velocity.y() - s * velocity.x(), 1e-3);
  EXPECT_NEAR(before.planar[vessel::kYawRate], (after.yaw_rad - before.yaw_rad) / 1e-4, 1e-3);
}

TEST_P(EveryVessel, AreTheSameForASeedAndDifferForAnother) {
  Options options = optionsFor(GetParam(), "hard");
  options.odometry.position_noise_m = 0.1;
  Simulator one(options, island(), 5);
  Simulator same(options, island(), 5);
  Simulator other(options, island(), 6);
  for (int i = 0; i < 300; ++i) {
    one.step({40.0, 30.0}, 0.01);
    same.step({40.0, 30.0}, 0.01);
    other.step({40.0, 30.0}, 0.01);
  }
  EXPECT_EQ(one.truth().planar, same.truth().planar);
  EXPECT_EQ(one.odometry().state, same.odometry().state);
  EXPECT_NE(one.truth().planar, other.truth().planar);
  const Scan& scan = one.scan();
  const Scan& same_scan = same.scan();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    ASSERT_TRUE(scan.ranges_m[i] == same_scan.ranges_m[i] || std::isnan(scan.ranges_m[i]));
  }
}

TEST_P(EveryVessel, StopThrustWhenNoCommandComes) {
  Simulator simulator(optionsFor(GetParam()), {}, 1);
  EXPECT_TRUE(simulator.commandTimedOut());
  ASSERT_TRUE(simulator.command({30.0, 20.0}));
  simulator.advance(0.49);
  EXPECT_FALSE(simulator.commandTimedOut());
  EXPECT_GT(simulator.truth().thrusts_n[vessel::kLeft], 29.0);
  simulator.advance(0.02);
  EXPECT_TRUE(simulator.commandTimedOut());
  simulator.advance(1.0);  // ten times the propellers' lag
  EXPECT_NEAR(simulator.truth().thrusts_n.norm(), 0.0, 1e-3);
}

TEST_P(EveryVessel, RefuseCommandsThatAreNotNumbers) {
  Simulator simulator(optionsFor(GetParam()), {}, 1);
  EXPECT_FALSE(simulator.command({std::numeric_limits<double>::quiet_NaN(), 0.0}));
  EXPECT_FALSE(simulator.command({0.0, std::numeric_limits<double>::infinity()}));
  simulator.advance(0.1);
  EXPECT_TRUE(simulator.truth().planar.allFinite());
}

TEST_P(EveryVessel, SayWhenTheyTouch) {
  const Options options = optionsFor(GetParam());
  const double half_length = 0.5 * options.vessel.hull.length_m;
  const double half_beam = 0.5 * options.vessel.hull.beam_m;
  Simulator simulator(options, island(), 1);
  simulator.placeAt({1.0 - half_length, 0.0}, 0.0);
  EXPECT_FALSE(simulator.inContact());
  EXPECT_NEAR(simulator.clearance(), 4.0, 1e-9);
  simulator.placeAt({5.125, half_beam + 0.12}, 0.0);
  EXPECT_TRUE(simulator.inContact());
  EXPECT_EQ(simulator.clearance(), 0.0);
  simulator.placeAt({4.5 - half_length, 0.1}, 0.0);
  EXPECT_FALSE(simulator.hadContact());
  for (int i = 0; i < 300; ++i) simulator.step({1e4, 1e4}, 0.01);
  EXPECT_TRUE(simulator.hadContact());
}

INSTANTIATE_TEST_SUITE_P(Simulator, EveryVessel, testing::Values("otter", "otter_gazebo", "wam_v"));

TEST(Simulator, ForceTowardsNorthPushesNorth) {
  Simulator simulator(optionsFor("otter_gazebo", "force10"), {}, 1);
  for (int i = 0; i < 6000; ++i) simulator.step({0.0, 0.0}, 0.01);
  const vessel::State planar = simulator.truth().planar;
  EXPECT_NEAR(planar[vessel::kX], 0.0, 1e-9);
  // 10 N on 20 N s/m of drag, heading east: half a metre a second to port.
  EXPECT_NEAR(planar[vessel::kSway], 0.5, 1e-3);
}

TEST(Simulator, WavesCarryTheOtterInThePlaneAndTheGazeboOtterNot) {
  for (const bool in_plane : {true, false}) {
    Options options = optionsFor(in_plane ? "otter" : "otter_gazebo");
    options.disturbance.waves.components = {{0.09, 5.0, 0.0}};
    Simulator simulator(options, {}, 1);
    double low = 0.0;
    double high = 0.0;
    double heave = 0.0;
    for (int i = 0; i < 3000; ++i) {
      simulator.step({0.0, 0.0}, 0.01);
      low = std::min(low, simulator.truth().planar[vessel::kX]);
      high = std::max(high, simulator.truth().planar[vessel::kX]);
      heave = std::max(heave, std::abs(simulator.truth().position.z()));
    }
    EXPECT_GT(heave, 0.08);
    if (in_plane) {
      EXPECT_GT(high - low, 0.15);
    } else {
      EXPECT_LT(high - low, 1e-9);
    }
  }
}

TEST(Simulator, OdometryIsLateAndNoisyAsAsked) {
  Options options = optionsFor("otter_gazebo");
  options.odometry.latency_s = 0.2;
  Simulator late(options, {}, 1);
  std::vector<Truth> truths;
  for (int i = 0; i < 100; ++i) {
    late.step({50.0, 50.0}, 0.01);
    truths.push_back(late.truth());
  }
  EXPECT_NEAR(late.odometry().stamp_s, 0.8, 1e-9);
  EXPECT_EQ(late.odometry().state, truths[79].planar);

  options.odometry.latency_s = 0.0;
  options.odometry.position_noise_m = 0.2;
  Simulator noisy(options, {}, 2);
  double variance = 0.0;
  for (int i = 0; i < 5000; ++i) {
    noisy.step({0.0, 0.0}, 0.01);
    variance += std::pow(noisy.odometry().state[vessel::kX] - noisy.truth().planar[vessel::kX], 2);
  }
  EXPECT_NEAR(std::sqrt(variance / 5000), 0.2, 0.01);
}

TEST(Simulator, ScansComeDueAtTheirRate) {
  Simulator simulator(optionsFor("otter_gazebo"), island(), 1);
  int scans = 0;
  for (int i = 0; i < 1000; ++i) {
    simulator.step({0.0, 0.0}, 0.01);
    if (simulator.scanDue()) {
      (void)simulator.scan();
      ++scans;
    }
  }
  EXPECT_NEAR(scans, 150, 1);
}

// Whatever the steps' sum is off by after a quarter of an hour.
TEST(Simulator, NoScanComesTwice) {
  constexpr double kStepS = 0.01;
  constexpr double kLastS = 900.0;
  Options options = optionsFor("otter_gazebo");
  options.lidar.beams = 1;
  Simulator simulator(options, {}, 1);
  const double period = 1.0 / options.lidar.rate_hz;
  double last = -period;
  double shortest = period;
  int scans = 0;
  while (simulator.time() < kLastS) {
    if (simulator.scanDue()) {
      (void)simulator.scan();
      shortest = std::min(shortest, simulator.time() - last);
      last = simulator.time();
      ++scans;
    }
    simulator.step({0.0, 0.0}, kStepS);
  }
  EXPECT_GT(shortest, period - 1.5 * kStepS);
  EXPECT_NEAR(scans, kLastS / period, 1.5);
}

TEST(Simulator, KnowsItsThrustLimits) {
  EXPECT_NEAR(Simulator(optionsFor("otter"), {}, 1).thrustLimits()[0], 119.7, 0.1);
  EXPECT_NEAR(Simulator(optionsFor("otter"), {}, 1).thrustLimits()[1], 66.7, 0.1);
  EXPECT_EQ(Simulator(optionsFor("otter_gazebo"), {}, 1).thrustLimits()[1], 50.0);
}

TEST(Simulator, RejectsUnknownVesselsAndBrokenGrids) {
  Options options = optionsFor("otter");
  options.vessel.plant_model = "rowing_boat";
  const Result<Simulator> unknown = Simulator::create(options, {}, 1);
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("rowing_boat"), std::string::npos);
  map::OccupancyGrid broken = island();
  broken.cells.pop_back();
  EXPECT_FALSE(Simulator::create(optionsFor("otter"), broken, 1));
}

}  // namespace
}  // namespace otter_nav::plant
