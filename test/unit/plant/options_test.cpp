#include "otter_nav/plant/options.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../vessel_of.hpp"
#include "otter_nav/plant/plant_model.hpp"

namespace otter_nav::plant {
namespace {

const std::string kConfig = std::string(OTTER_NAV_SOURCE_DIR) + "/config/";

std::string preset(const std::string& name) {
  return kConfig + "disturbances/" + name + ".yaml";
}

TEST(PlantOptions, ShippedFilesLoad) {
  for (const char* vessel : {"otter", "otter_gazebo", "wam_v"}) {
    for (const char* name : {"none", "force10", "paper", "hard"}) {
      const Result<Options> options =
          loadOptions(vessel::test::vesselOf(vessel), kConfig + "plant.yaml", preset(name));
      ASSERT_TRUE(options) << options.error().message;
      EXPECT_EQ(options->vessel.name, vessel);
      EXPECT_EQ(options->disturbance.name, name);
      EXPECT_TRUE(makePlantModel(*options));
    }
  }
}

TEST(PlantOptions, ShippedFilesHoldTheDefaults) {
  EXPECT_EQ(config::toYaml(config::load<Options>(kConfig + "plant.yaml").value()),
            config::toYaml(Options()));
  EXPECT_EQ(config::toYaml(loadDisturbance(preset("none")).value()),
            config::toYaml(EnvironmentOptions()));
}

TEST(PlantOptions, DisturbancesSurviveARoundTrip) {
  const std::string text = config::toYaml(loadDisturbance(preset("paper")).value());
  const Result<EnvironmentOptions> again =
      config::read<EnvironmentOptions>({YAML::Load(text), "paper"});
  ASSERT_TRUE(again) << again.error().message << "\n" << text;
  EXPECT_EQ(again->waves.components.size(), 3U);
  EXPECT_EQ(config::toYaml(*again), text);
}

TEST(PlantOptions, PresetsAreWhatTheyAreNamedFor) {
  const EnvironmentOptions none = loadDisturbance(preset("none")).value();
  EXPECT_EQ(none.wind.speed_mps + none.wind.slow_deviation_mps + none.current.speed_mps +
                none.current.slow_deviation_mps + none.waves.spectrum.significant_height_m +
                none.force_n.norm(),
            0.0);
  EXPECT_TRUE(none.waves.components.empty());

  const EnvironmentOptions force = loadDisturbance(preset("force10")).value();
  EXPECT_EQ(force.force_n, Eigen::Vector2d(0.0, 10.0));
  EXPECT_EQ(force.wind.speed_mps + force.current.speed_mps, 0.0);

  const EnvironmentOptions paper = loadDisturbance(preset("paper")).value();
  EXPECT_EQ(paper.wind.speed_mps, 3.0);
  EXPECT_EQ(paper.wind.gust_intensity, 0.0);
  ASSERT_EQ(paper.waves.components.size(), 3U);
  EXPECT_EQ(paper.waves.components[0].amplitude_m, 0.09);
  EXPECT_EQ(paper.waves.components[0].period_s, 5.0);
  EXPECT_NEAR(std::cos(paper.waves.components[0].direction_rad), -1.0, 1e-12);
  EXPECT_NEAR(std::sin(paper.waves.components[1].direction_rad), std::sqrt(0.5), 1e-12);

  const EnvironmentOptions hard = loadDisturbance(preset("hard")).value();
  EXPECT_EQ(hard.wind.speed_mps, 8.0);
  EXPECT_GT(hard.wind.gust_intensity, 0.0);
  EXPECT_EQ(hard.current.speed_mps, 0.5);
  EXPECT_NE(hard.current.turning_radps, 0.0);
  EXPECT_EQ(hard.waves.spectrum.significant_height_m, 0.3);
}

void expectError(const YAML::Node& node, const std::string& word) {
  const Result<Options> options = readOptions({node, "plant.yaml"});
  ASSERT_FALSE(options);
  EXPECT_NE(options.error().message.find(word), std::string::npos) << options.error().message;
}

TEST(PlantOptions, BadValuesAreNamed) {
  const auto shipped = [] { return config::loadFile(kConfig + "plant.yaml").value(); };
  YAML::Node node = shipped();
  node["payload"]["mass_kg"] = 60.0;
  expectError(node, "mass_kg");
  node = shipped();
  node["lidar"].remove("beams");
  expectError(node, "beams");
  node = shipped();
  node["lidar"]["rnage_max_m"] = 10.0;
  expectError(node, "rnage_max_m");
  node = shipped();
  node["command_timeout_s"] = "soon";
  expectError(node, "command_timeout_s");
  node = shipped();
  node["lidar"]["range_min_m"] = 8.0;
  node["lidar"]["range_max_m"] = 8.0;
  expectError(node, "plant.yaml/lidar: parameter 'range_min_m' is not below 'range_max_m'");
}

TEST(PlantOptions, BadWavesAndVesselsAreNamed) {
  YAML::Node node = config::loadFile(preset("paper")).value();
  node["waves"]["components"][1]["period_s"] = 0.0;
  const Result<EnvironmentOptions> options = config::read<EnvironmentOptions>({node, "paper.yaml"});
  ASSERT_FALSE(options);
  EXPECT_NE(options.error().message.find("components[1]"), std::string::npos);
  EXPECT_NE(options.error().message.find("period_s"), std::string::npos);

  Options rowed;
  rowed.vessel.plant_model = "raft";
  const auto model = makePlantModel(rowed);
  ASSERT_FALSE(model);
  EXPECT_NE(model.error().message.find("raft"), std::string::npos);
}

}  // namespace
}  // namespace otter_nav::plant
