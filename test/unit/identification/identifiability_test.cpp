// What the data cannot tell is named, not made up.
#include <gtest/gtest.h>

#include "expect_names.hpp"
#include "otter_nav/identification/identify.hpp"
#include "simulated.hpp"

namespace otter_nav::identification {
namespace {

using testing::expectNames;

vessel::Parameters guess() {
  vessel::Parameters parameters;
  parameters.thrusters = {0.395, 119.7, 66.7};
  parameters.paper = {80.0, 40.0, 70.0, 120.0, 50.0};
  parameters.manoeuvring = vessel::ManoeuvringModel::fromPaper(parameters.paper);
  return parameters;
}

template <typename Input>
std::string errorFor(Input input, const testing::Noise& noise) {
  const Model model = testing::paperModel({92.0, 31.0, 71.0, 140.0, 55.0});
  const Recording recording = testing::record(model, input, 80.0, 0.05, noise, 3);
  const auto result = identify(recording, guess(), Options());
  return result ? "" : result.error().message;
}

TEST(Identifiability, ConstantInputNamesTheInertias) {
  const auto straight = [](double) { return vessel::Thrusts(50.0, 50.0); };
  expectNames(errorFor(straight, {}), {"m1_kg", "m2_kgm2", "d3_kgm2ps", "not identifiable"});
  const auto turning = [](double) { return vessel::Thrusts(40.0, 60.0); };
  expectNames(errorFor(turning, testing::odometryNoise()), {"m1_kg", "m2_kgm2"});
  vessel::Parameters lagging = guess();
  lagging.thrusters.lag_s = 0.1;
  const Model model = testing::paperModel({92.0, 31.0, 71.0, 140.0, 55.0});
  const auto result =
      identify(testing::record(model, straight, 80.0, 0.05, {}, 3), lagging, Options());
  ASSERT_FALSE(result);
  expectNames(result.error().message, {"m1_kg", "m2_kgm2"});
}

TEST(Identifiability, StraightRunsNameWhatTurningWouldShow) {
  testing::RandomSteps steps(4);
  const auto straight = [&](double t) {
    const double ahead_n = steps.at(t).sum() / 2.0;
    return vessel::Thrusts(ahead_n, ahead_n);
  };
  const std::string message = errorFor(straight, testing::odometryNoise());
  expectNames(message, {"m2_kgm2", "d2_kgps", "d3_kgm2ps"});
  EXPECT_EQ(message.find("m1_kg"), std::string::npos) << message;
}

// Turning on the spot shows nothing of the way ahead, though the input changes.
TEST(Identifiability, TurnsOnTheSpotNameSurge) {
  testing::RandomSteps steps(5);
  const auto spin = [&](double t) {
    const vessel::Thrusts f = steps.at(t);
    const double turn_n = f[vessel::kRight] - f[vessel::kLeft];
    return vessel::Thrusts(-turn_n, turn_n);
  };
  expectNames(errorFor(spin, testing::odometryNoise()), {"m1_kg", "d1_kgps", "d2_kgps"});
}

TEST(Identifiability, NoWindowInTheSpeedRangeIsAnError) {
  testing::RandomSteps steps(6);
  const Model model = testing::paperModel({92.0, 31.0, 71.0, 140.0, 55.0});
  const Recording recording = testing::record(
      model, [&](double t) { return steps.at(t); }, 60.0, 0.05, {}, 3);
  Options options;
  options.paper_speed_min_mps = 8.0;
  const auto result = identify(recording, guess(), options);
  ASSERT_FALSE(result);
  expectNames(result.error().message, {"no window's mean surge speed"});
}

}  // namespace
}  // namespace otter_nav::identification
