#include "identify/report.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "simulated.hpp"

namespace otter_nav::identification {
namespace {

Options shippedOptions() {
  const std::string path = OTTER_NAV_SOURCE_DIR "/config/identification.yaml";
  const Result<Options> options = config::load<Options>(path);
  EXPECT_TRUE(options) << options.error().message;
  return *options;
}

TEST(IdentificationOptions, ShippedFileHoldsTheDefaults) {
  EXPECT_EQ(config::toYaml(shippedOptions()), config::toYaml(Options()));
}

class Report : public ::testing::Test {
 protected:
  void SetUp() override {
    const vessel::PaperModel h{92.0, 31.0, 71.0, 140.0, 55.0};
    testing::RandomSteps steps(3);
    const Recording recording = testing::record(
        testing::paperModel(h), [&](double t) { return steps.at(t); }, 90.0, 0.05,
        testing::odometryNoise(), 4);
    vessel::Parameters guess;
    guess.name = "tested";
    guess.thrusters = testing::paperModel(h).thrusters;
    guess.paper = {80.0, 40.0, 60.0, 120.0, 50.0};
    guess.manoeuvring = vessel::ManoeuvringModel::fromPaper(guess.paper);
    auto result = identify(recording, guess, shippedOptions());
    ASSERT_TRUE(result) << result.error().message;
    result_ = *std::move(result);
    folder_ = std::filesystem::path(::testing::TempDir()) /
              "otter_nav_skipper's report";  // as paths may be
    std::filesystem::remove_all(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Identification result_;
  std::filesystem::path folder_;
};

std::string contentOf(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(Report, VesselFileIsReadByTheStrictReader) {
  std::filesystem::create_directories(folder_);
  const std::filesystem::path path = folder_ / "vessel.yaml";
  std::ofstream(path) << vesselFileText(result_, "a test");
  const Result<vessel::Parameters> read = vessel::loadParameters(path.string());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->name, "tested");
  EXPECT_EQ(read->paper.m2_kgm2, result_.vessel.paper.m2_kgm2);
  EXPECT_EQ(coefficientsOf(read->manoeuvring), coefficientsOf(result_.vessel.manoeuvring));
  EXPECT_EQ(read->thrusters.lever_arm_m, 0.395);
  EXPECT_NE(contentOf(path).find("#   m1_kg: "), std::string::npos);
}

TEST_F(Report, HoldsTablesAndPlots) {
  const Status status = writeReport(result_, "a test", folder_.string());
  ASSERT_TRUE(status) << status.error().message;
  const std::string text = contentOf(folder_ / "report.txt");
  for (const char* part : {"m1_kg", "munk_kg", "std. error", "horizon", "guess, paper"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  for (const char* plot :
       {"velocities.png", "track.png", "residuals.png", "prediction_error.png"}) {
    EXPECT_EQ(contentOf(folder_ / plot).substr(1, 3), "PNG") << plot;
  }
}

TEST_F(Report, SaysWhereItCannotWrite) {
  std::filesystem::create_directories(folder_);
  const std::filesystem::path file = folder_ / "a_file";
  std::ofstream(file) << "no directory";
  const Status status = writeReport(result_, "a test", (file / "report").string());
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("a_file"), std::string::npos);
}

}  // namespace
}  // namespace otter_nav::identification
