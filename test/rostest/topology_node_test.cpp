// topology_node alone: guide paths by service, refusals with a reason.
#include <gtest/gtest.h>
#include <otter_nav/FindGuidePath.h>

#include <cmath>
#include <limits>

#include "support.hpp"

namespace otter_nav::rostest {
namespace {

geometry_msgs::PoseStamped pose(double x, double y) {
  geometry_msgs::PoseStamped message;
  message.header.frame_id = ros_bridge::frames().map;
  message.pose = ros_bridge::toPose({{x, y}, 0.0});
  return message;
}

GuidePath find(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal) {
  FindGuidePath call;
  call.request.start = start;
  call.request.goal = goal;
  EXPECT_TRUE(ros::service::waitForService("find_guide_path", ros::Duration(kPatienceS)));
  EXPECT_TRUE(ros_bridge::callService("find_guide_path", call));
  return call.response.guide_path;
}

// Start and goal have the larger rock, a disc of 4 m about (0, 2), between them.
TEST(TopologyNode, LeadsAroundARock) {
  const GuidePath path = find(pose(-20.0, 2.0), pose(20.0, 2.0));
  ASSERT_TRUE(path.found) << path.reason;
  ASSERT_GE(path.points.size(), 3U);
  EXPECT_NEAR(path.points.front().x, -20.0, 1e-6);
  EXPECT_NEAR(path.points.back().x, 20.0, 1e-6);
  EXPECT_EQ(path.corridor_radii.size(), path.points.size());
  EXPECT_GT(path.length, 40.0);
  EXPECT_LT(path.length, 48.0);
  for (const auto& point : path.points) {
    EXPECT_GT(std::hypot(point.x, point.y - 2.0), 4.5);
  }
}

TEST(TopologyNode, SaysWhyThereIsNone) {
  const GuidePath inside = find(pose(-20.0, 2.0), pose(0.0, 2.0));
  EXPECT_FALSE(inside.found);
  EXPECT_NE(inside.reason.find("goal"), std::string::npos) << inside.reason;

  const GuidePath not_finite =
      find(pose(std::numeric_limits<double>::quiet_NaN(), 2.0), pose(20.0, 2.0));
  EXPECT_FALSE(not_finite.found);
  EXPECT_NE(not_finite.reason.find("start: position is not finite"), std::string::npos)
      << not_finite.reason;

  geometry_msgs::PoseStamped elsewhere = pose(20.0, 2.0);
  elsewhere.header.frame_id = "base_link";
  EXPECT_NE(find(pose(-20.0, 2.0), elsewhere).reason.find("base_link"), std::string::npos);
}

}  // namespace
}  // namespace otter_nav::rostest

OTTER_NAV_ROSTEST_MAIN("topology_node_test")
