// What ships is what the code holds.
#include "otter_nav/planner/options.hpp"

#include <gtest/gtest.h>

#include "otter_nav/config/fields.hpp"

namespace otter_nav::planner {
namespace {

TEST(PlannerOptions, ShippedFilesHoldTheDefaults) {
  const auto options = loadOptions(std::string(OTTER_NAV_SOURCE_DIR) + "/config");
  ASSERT_TRUE(options.has_value()) << options.error().message;
  EXPECT_EQ(config::toYaml(*options), config::toYaml(Options()));
  EXPECT_EQ(config::toYaml(options->topology), config::toYaml(topology::Options()));
}

}  // namespace
}  // namespace otter_nav::planner
