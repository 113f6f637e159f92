#include "otter_nav/tracker/options.hpp"

#include <gtest/gtest.h>

#include "nodes/tracker_node_options.hpp"

namespace otter_nav::tracker {
namespace {

TEST(TrackerOptions, DefaultsAreWhatShips) {
  const auto shipped =
      config::load<Options>(std::string(OTTER_NAV_SOURCE_DIR) + "/config/tracker.yaml");
  ASSERT_TRUE(shipped) << shipped.error().message;
  EXPECT_EQ(config::toYaml(*shipped), config::toYaml(Options{}));
}

TEST(TrackerOptions, TheNodesDefaultsAreWhatShips) {
  const auto shipped = config::load<nodes::TrackerNodeOptions>(std::string(OTTER_NAV_SOURCE_DIR) +
                                                               "/config/tracker_node.yaml");
  ASSERT_TRUE(shipped) << shipped.error().message;
  EXPECT_EQ(config::toYaml(*shipped), config::toYaml(nodes::TrackerNodeOptions{}));
}

// A key that is unknown, missing or out of range is an error that names it.
TEST(TrackerOptions, AreReadStrictly) {
  YAML::Node node = YAML::Load(config::toYaml(Options{}));
  EXPECT_TRUE(config::read<Options>(config::Section(node, "tracker")));
  node["horizon_s"] = 0.01;
  const auto narrow = config::read<Options>(config::Section(node, "tracker"));
  ASSERT_FALSE(narrow);
  EXPECT_NE(narrow.error().message.find("horizon_s"), std::string::npos);
  node["horizon_s"] = 6.0;
  node["thrust_share"] = 0.9;
  const auto unknown = config::read<Options>(config::Section(node, "tracker"));
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("thrust_share"), std::string::npos);
}

}  // namespace
}  // namespace otter_nav::tracker
