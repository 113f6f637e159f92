#include "otter_nav/vessel/parameters.hpp"

#include <gtest/gtest.h>

namespace otter_nav::vessel {
namespace {

const std::string kShipped =
    std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/otter_gazebo.yaml";

TEST(LoadParameters, ShippedVesselRoundTrips) {
  const auto loaded = loadParameters(kShipped);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->name, "otter_gazebo");
  EXPECT_EQ(loaded->plant_model, "otter_gazebo");
  const auto again = readParameters({YAML::Load(toYaml(*loaded)), "text"});
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(toYaml(*again), toYaml(*loaded));
}

TEST(WithThrustShare, LeavesEverythingButThrustAndSpeed) {
  const Parameters whole;
  Parameters less = withThrustShare(whole, 0.8);
  EXPECT_DOUBLE_EQ(less.thrusters.ahead_max_n, 40.0);
  EXPECT_DOUBLE_EQ(less.thrusters.astern_max_n, 40.0);
  EXPECT_DOUBLE_EQ(less.top_speed_mps, 4.0);
  less.thrusters = whole.thrusters;
  less.top_speed_mps = whole.top_speed_mps;
  EXPECT_EQ(toYaml(less), toYaml(whole));
}

TEST(LoadParameters, SailsItsOwnModelUnlessTheFileSaysElse) {
  YAML::Node node = YAML::Load(toYaml(Parameters{}));
  node.remove("plant_model");
  EXPECT_EQ(readParameters({node, "text"})->plant_model, "planar");
  node["plant_model"] = "raft";
  const auto refused = readParameters({node, "text"});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("'plant_model'"), std::string::npos);
}

TEST(LoadParameters, NamesTheOffender) {
  const auto message = [](const std::string& from, const std::string& to) {
    std::string text = toYaml(Parameters{});
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    text.replace(at, from.size(), to);
    const auto result = readParameters({YAML::Load(text), "vessel.yaml"});
    EXPECT_FALSE(result);
    return result ? std::string() : result.error().message;
  };
  EXPECT_NE(message("m1_kg: 35", "m1_kg: -1").find("'m1_kg'"), std::string::npos);
  EXPECT_NE(message("m1_kg: 35", "m1_kg: .nan").find("allowed range"), std::string::npos);
  EXPECT_NE(message("m1_kg: 35", "m1_kg: heavy").find("not a number"), std::string::npos);
  EXPECT_NE(message("m1_kg: 35", "m_kg: 35").find("'m1_kg' is missing"), std::string::npos);
  EXPECT_NE(message("hull:", "colour: red\nhull:").find("unknown parameter 'colour'"),
            std::string::npos);
}

TEST(LoadParameters, AbsentFileIsNamed) {
  const auto result = loadParameters("/nonexistent/vessel.yaml");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("/nonexistent/vessel.yaml"), std::string::npos);
}

}  // namespace
}  // namespace otter_nav::vessel
