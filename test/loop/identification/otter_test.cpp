// Identification on the plant: what it was made for.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "identification/prediction.hpp"
#include "identify/report.hpp"
#include "otter_nav/identification/identify.hpp"
#include "otter_nav/identification/manoeuvres.hpp"
#include "otter_nav/plant/simulator.hpp"

namespace otter_nav::identification {
namespace {

constexpr double kPeriod = 0.01;  // s, as of excitation_run

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

config::Section sectionOf(const char* file) {
  const std::string path = std::string(OTTER_NAV_SOURCE_DIR "/config/") + file;
  const auto node = config::loadFile(path);
  EXPECT_TRUE(node) << node.error().message;
  return {*node, path};
}

Recording recordOtter(std::vector<ManoeuvreOptions> manoeuvres,
                      const plant::OdometryOptions& odometry) {
  auto options =
      plant::loadOptions(vesselOf("otter.yaml"), OTTER_NAV_SOURCE_DIR "/config/plant.yaml",
                         OTTER_NAV_SOURCE_DIR "/config/disturbances/none.yaml");
  EXPECT_TRUE(options) << options.error().message;
  options->odometry = odometry;
  plant::Simulator simulator(*options, map::OccupancyGrid{}, 1);
  vessel::Thrusters thrusters;
  thrusters.ahead_max_n = simulator.thrustLimits()[0];
  thrusters.astern_max_n = simulator.thrustLimits()[1];
  Excitation excitation(std::move(manoeuvres), thrusters);
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

// Of 5 s predictions, in shares of the textbook's.
double errorShare(const DataSet& data, const std::vector<Stretch>& blocks,
                  const vessel::ManoeuvringModel& coefficients) {
  const vessel::Parameters textbook = vesselOf("otter_textbook.yaml");
  const auto error = [&](const vessel::ManoeuvringModel& m) {
    return predictionError(data, blocks, {m, textbook.thrusters}, 5.0, 1.0).position_m;
  };
  return error(coefficients) / error(vessel::ManoeuvringModel::fromPaper(textbook.paper));
}

// What scripts/identify_otter.sh does.
class IdentifyOtter : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const auto manoeuvres = readExcitation(sectionOf("excitation.yaml"));
    ASSERT_TRUE(manoeuvres) << manoeuvres.error().message;
    const auto options = config::read<Options>(sectionOf("identification.yaml"));
    ASSERT_TRUE(options) << options.error().message;
    result_ = new Result<Identification>(
        identify(recordOtter(*manoeuvres, {}), vesselOf("otter_textbook.yaml"), *options));
    ASSERT_TRUE(*result_) << result_->error().message;
  }
  static void TearDownTestSuite() { delete result_; }
  void SetUp() override { ASSERT_TRUE(*result_); }

  static Result<Identification>* result_;
};
Result<Identification>* IdentifyOtter::result_ = nullptr;

TEST_F(IdentifyOtter, HalvesTheTextbooksPredictionError) {
  const Identification& r = **result_;
  const auto share = [&](const vessel::ManoeuvringModel& m) {
    return errorShare(r.data, r.split.validation_blocks, m);
  };
  EXPECT_LT(share(vessel::ManoeuvringModel::fromPaper(r.vessel.paper)), 0.5);
  EXPECT_LT(share(r.vessel.manoeuvring), 0.1);
}

// The shipped file, word by word; numbers to a share that compilers and machines may differ by.
TEST_F(IdentifyOtter, FindsTheShippedFile) {
  constexpr double kRounding = 1e-3;
  std::ifstream shipped(OTTER_NAV_SOURCE_DIR "/config/vessels/otter.yaml");
  std::istringstream found(vesselFileText(
      **result_, "the excitation manoeuvres on the plant otter (scripts/identify_otter.sh)"));
  std::string expected;
  std::string actual;
  int words = 0;
  while (shipped >> expected) {
    ASSERT_TRUE(found >> actual) << "ends before '" << expected << "'";
    ++words;
    char* end = nullptr;
    const double value = std::strtod(expected.c_str(), &end);
    if (*end != '\0') {
      EXPECT_EQ(actual, expected) << "word " << words;
    } else {
      EXPECT_NEAR(std::stod(actual), value, kRounding * std::abs(value)) << "word " << words;
    }
  }
  EXPECT_FALSE(found >> actual) << "goes on with '" << actual << "'";
  EXPECT_GT(words, 50);
}

TEST(IdentifyNoisyOtter, PredictsTheCleanMotion) {
  plant::OdometryOptions noise;
  noise.position_noise_m = 0.02;
  noise.heading_noise_rad = 0.005;
  noise.velocity_noise_mps = 0.02;
  noise.yaw_rate_noise_radps = 0.01;
  const vessel::Parameters textbook = vesselOf("otter_textbook.yaml");
  const auto result = identify(recordOtter(someManoeuvres(), noise), textbook, Options());
  ASSERT_TRUE(result) << result.error().message;
  const auto clean =
      assemble(recordOtter(someManoeuvres(), {}), DataOptions(), textbook.thrusters.lag_s);
  ASSERT_TRUE(clean) << clean.error().message;
  EXPECT_LT(errorShare(*clean, clean->stretches, result->vessel.manoeuvring), 0.15);
}

// The shipped file was found from other manoeuvres than these.
TEST(ShippedOtter, PredictsUnseenManoeuvres) {
  const vessel::Parameters shipped = vesselOf("otter.yaml");
  const auto data =
      assemble(recordOtter(someManoeuvres(), {}), DataOptions(), shipped.thrusters.lag_s);
  ASSERT_TRUE(data) << data.error().message;
  const auto share = [&](const vessel::ManoeuvringModel& m) {
    return errorShare(*data, data->stretches, m);
  };
  EXPECT_LT(share(vessel::ManoeuvringModel::fromPaper(shipped.paper)), 0.5);
  EXPECT_LT(share(shipped.manoeuvring), 0.1);
}

// As launches and arrivals do.
TEST(ShippedOtter, StaysWhereItIsTurningOnTheSpot) {
  const vessel::Parameters shipped = vesselOf("otter.yaml");
  const std::vector<ManoeuvreOptions> turns = {
      manoeuvre(ManoeuvreKind::kCircle, 0.0, 0.35, 6.0, 0, 40.0),
      manoeuvre(ManoeuvreKind::kCircle, 0.0, -0.45, 6.0, 0, 40.0)};
  const auto data = assemble(recordOtter(turns, {}), DataOptions(), shipped.thrusters.lag_s);
  ASSERT_TRUE(data) << data.error().message;
  const auto error =
      predictionError(*data, data->stretches, {shipped.manoeuvring, shipped.thrusters}, 5.0, 1.0);
  EXPECT_LT(error.position_m, 0.07);
}

}  // namespace
}  // namespace otter_nav::identification
