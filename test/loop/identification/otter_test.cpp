// Identification on the plant: what it was made for.
#include <gtest/gtest.h>

#include "otter_nav/identification/identify.hpp"
#include "otter_nav/identification/manoeuvres.hpp"
#include "otter_nav/plant/simulator.hpp"

namespace otter_nav::identification {
namespace {

constexpr double kPeriod = 0.02;  // s

vessel::Parameters vesselOf(const char* name) {
  const auto parameters =
      vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR "/config/vessels/") + name);
  EXPECT_TRUE(parameters) << parameters.error().message;
  return *parameters;
}

ManoeuvreOptions manoeuvre(ManoeuvreKind kind, double ahead, double turn, double angle_rad,
                           int count, double seconds) {
  return {kind, ahead, turn, angle_rad, count, seconds};
}

// Other manoeuvres than the shipped list.
std::vector<ManoeuvreOptions> someManoeuvres() {
  return {manoeuvre(ManoeuvreKind::kSpeedStep, 0.6, 0.0, 0.0, 0, 10.0),
          manoeuvre(ManoeuvreKind::kZigzag, 0.6, 0.25, 0.26, 5, 40.0),
          manoeuvre(ManoeuvreKind::kCircle, 0.6, -0.2, 5.0, 0, 40.0),
          manoeuvre(ManoeuvreKind::kSpeedStep, 0.2, 0.0, 0.0, 0, 10.0),
          manoeuvre(ManoeuvreKind::kCircle, 0.35, 0.3, 6.0, 0, 40.0),
          manoeuvre(ManoeuvreKind::kZigzag, 0.8, 0.15, 0.3, 6, 60.0),
          manoeuvre(ManoeuvreKind::kSpiral, 0.5, 0.3, 3, 4, 5.0),
          manoeuvre(ManoeuvreKind::kSpeedStep, 0.9, 0.0, 0.0, 0, 10.0)};
}

Recording recordOtter(const plant::OdometryOptions& odometry) {
  auto options = plant::loadOptions("otter", OTTER_NAV_SOURCE_DIR "/config/plant.yaml",
                                    OTTER_NAV_SOURCE_DIR "/config/disturbances/none.yaml");
  EXPECT_TRUE(options) << options.error().message;
  options->odometry = odometry;
  plant::Simulator simulator(*options, map::OccupancyGrid{}, 7);
  Excitation excitation(someManoeuvres(), vesselOf("otter_textbook.yaml").thrusters);
  Recording recording;
  recording.odometry_name = "odometry";
  recording.command_name = "commands";
  while (!excitation.finished()) {
    const vessel::State state = simulator.odometry().state;
    const vessel::Thrusts thrusts = excitation.step(simulator.time(), state);
    recording.odometry.push_back({simulator.time(), state});
    recording.commands.push_back({simulator.time(), thrusts});
    simulator.step(thrusts, kPeriod);
  }
  return recording;
}

double fiveSecondError(const DataSet& data, const std::vector<Stretch>& blocks,
                       const vessel::ManoeuvringModel& coefficients,
                       const vessel::Thrusters& thrusters) {
  return predictionError(data, blocks, {coefficients, thrusters}, 5.0, 1.0).position_m;
}

TEST(IdentifyOtter, HalvesTheTextbooksPredictionError) {
  const vessel::Parameters textbook = vesselOf("otter_textbook.yaml");
  const auto result = identify(recordOtter({}), textbook, Options());
  ASSERT_TRUE(result) << result.error().message;
  const auto error = [&](const vessel::ManoeuvringModel& m) {
    return fiveSecondError(result->data, result->split.validation_blocks, m, textbook.thrusters);
  };
  const double guessed = error(vessel::ManoeuvringModel::fromPaper(textbook.paper));
  EXPECT_LT(error(vessel::ManoeuvringModel::fromPaper(result->vessel.paper)), 0.5 * guessed);
  EXPECT_LT(error(result->vessel.manoeuvring), 0.1 * guessed);
}

TEST(IdentifyOtter, WorksOnNoisyOdometry) {
  plant::OdometryOptions noise;
  noise.position_noise_m = 0.02;
  noise.heading_noise_rad = 0.005;
  noise.velocity_noise_mps = 0.02;
  noise.yaw_rate_noise_radps = 0.01;
  const vessel::Parameters textbook = vesselOf("otter_textbook.yaml");
  const auto result = identify(recordOtter(noise), textbook, Options());
  ASSERT_TRUE(result) << result.error().message;
  // Judged on the clean motion.
  const auto clean = assemble(recordOtter({}), DataOptions(), textbook.thrusters.lag_s);
  const auto error = [&](const vessel::ManoeuvringModel& m) {
    return fiveSecondError(*clean, clean->stretches, m, textbook.thrusters);
  };
  const double guessed = error(vessel::ManoeuvringModel::fromPaper(textbook.paper));
  EXPECT_LT(error(result->vessel.manoeuvring), 0.15 * guessed);
}

// The shipped file was found from other manoeuvres than these.
TEST(IdentifyOtter, ShippedVesselPredictsUnseenManoeuvres) {
  const vessel::Parameters textbook = vesselOf("otter_textbook.yaml");
  const vessel::Parameters shipped = vesselOf("otter.yaml");
  const auto data = assemble(recordOtter({}), DataOptions(), shipped.thrusters.lag_s);
  ASSERT_TRUE(data) << data.error().message;
  const auto error = [&](const vessel::ManoeuvringModel& m) {
    return fiveSecondError(*data, data->stretches, m, shipped.thrusters);
  };
  const double guessed = error(vessel::ManoeuvringModel::fromPaper(textbook.paper));
  EXPECT_LT(error(vessel::ManoeuvringModel::fromPaper(shipped.paper)), 0.5 * guessed);
  EXPECT_LT(error(shipped.manoeuvring), 0.1 * guessed);
}

}  // namespace
}  // namespace otter_nav::identification
