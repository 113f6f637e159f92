#include "otter_nav/vessel/parameters.hpp"

#include <gtest/gtest.h>

#include <vector>

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

// Every number of the list is written and read into its own member.
TEST(LoadParameters, EveryNumberRoundTrips) {
  struct Numbers {
    double next = 1.0;
    std::vector<double> seen;
    bool sets = true;
    void take(double& value) {
      value = sets ? next : value;
      next += 0.125;
      seen.push_back(value);
    }
    void operator()(const char*, std::string&, const char*) {}
    void optionalText(const char*, std::string&, const std::vector<std::string>&, const char*) {}
    void operator()(const char*, double& value, config::Range, const char*) { take(value); }
    void optional(const char*, double& value, config::Range, const char*) { take(value); }
    void group(const char*, PaperModel& g, const char*) { PaperModel::describe(g, *this); }
    void group(const char*, Thrusters& g, const char*) { Thrusters::describe(g, *this); }
    void group(const char*, Hull& g, const char*) { Hull::describe(g, *this); }
    void optionalGroup(const char*, ManoeuvringModel& g, const char*) {
      ManoeuvringModel::describe(g, *this);
    }
  };
  Parameters written;
  Numbers set;
  Parameters::describe(written, set);
  ASSERT_EQ(set.seen.size(), 2U + 5U + 17U + 4U + 2U);
  auto read = readParameters({YAML::Load(toYaml(written)), "text"});
  ASSERT_TRUE(read) << read.error().message;
  Numbers again;
  again.sets = false;
  Parameters::describe(*read, again);
  EXPECT_EQ(again.seen, set.seen);
  EXPECT_EQ(read->manoeuvring.yaw_from_sway_kgmps, written.manoeuvring.yaw_from_sway_kgmps);
}

TEST(LoadParameters, WithoutManoeuvringModelThePapersIsUsed) {
  YAML::Node node = YAML::Load(toYaml(Parameters{}));
  node["paper_model"]["d2_kgps"] = 33.0;
  node.remove("manoeuvring_model");
  const auto read = readParameters({node, "text"});
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->manoeuvring.sway_drag_kgps, 33.0);
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
  EXPECT_NE(message("name: \"otter_gazebo\"", "name: \"\"").find("'name' is empty"),
            std::string::npos);
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
