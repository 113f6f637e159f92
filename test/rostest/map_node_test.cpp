// map_node alone: chart in, map out; a scan adds to it, and so do vessels that lie; save and reset
// work.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseArray.h>
#include <gtest/gtest.h>
#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <otter_nav/SaveMap.h>
#include <sensor_msgs/LaserScan.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "otter_nav/map/chart.hpp"
#include "otter_nav/ros/grids.hpp"
#include "otter_nav/ros/map_mirror.hpp"
#include "support.hpp"

namespace otter_nav::rostest {
namespace {

constexpr double kEast = 20.0;  // m, of the vessel in free water; the echo is 5 m ahead

class MapNode : public testing::Test {
 protected:
  MapNode() {
    geometry_msgs::TransformStamped base;
    base.header.frame_id = ros_bridge::frames().map;
    base.child_frame_id = ros_bridge::frames().base;
    base.transform.translation.x = kEast;
    base.transform.rotation.w = 1.0;
    geometry_msgs::TransformStamped lidar;
    lidar.header.frame_id = ros_bridge::frames().base;
    lidar.child_frame_id = ros_bridge::frames().lidar;
    lidar.transform.translation.z = 0.8;
    lidar.transform.rotation.w = 1.0;
    transforms_.sendTransform(std::vector<geometry_msgs::TransformStamped>{base, lidar});
  }

  // Ten beams ahead with an echo at 5 m.
  sensor_msgs::LaserScan scan() {
    sensor_msgs::LaserScan message;
    message.header.frame_id = ros_bridge::frames().lidar;
    message.header.stamp = ros::Time::now();
    message.angle_min = -0.02F;
    message.angle_increment = 0.004F;
    message.angle_max = 0.016F;
    message.range_min = 0.2F;
    message.range_max = 25.0F;
    message.ranges.assign(10, 5.0F);
    return message;
  }

  map::Cell cellAhead(const map::OccupancyGrid& grid) {
    const Eigen::Vector2i cell = grid.geometry.cellAt({kEast + 5.0, 0.0});
    return grid.at(cell.x(), cell.y());
  }

  // The map after scans until the echo's cell shows as `wanted`.
  bool scanUntil(map::OccupancyGrid& grid, map::Cell wanted) {
    return waitUntil([&] {
      scans_.publish(scan());
      ros::WallDuration(0.05).sleep();
      ros::spinOnce();
      for (const auto& update : updates_.messages) {
        EXPECT_TRUE(ros_bridge::applyUpdate(update, ros_bridge::frames().map, grid).has_value());
      }
      updates_.messages.clear();
      return cellAhead(grid) == wanted;
    });
  }

  ros::NodeHandle node_;
  tf2_ros::StaticTransformBroadcaster transforms_;
  ros::Publisher scans_ = node_.advertise<sensor_msgs::LaserScan>("scan", 10);
  Inbox<nav_msgs::OccupancyGrid> maps_{node_, "map"};
  Inbox<map_msgs::OccupancyGridUpdate> updates_{node_, "map_updates"};
};

TEST_F(MapNode, PublishesItsChartAddsEchoesSavesAndResets) {
  ASSERT_TRUE(maps_.waitFor([](const auto& message) { return message.info.width == 240U; }));
  const auto grid_result = ros_bridge::toGrid(maps_.messages.front(), ros_bridge::frames().map);
  ASSERT_TRUE(grid_result.has_value());
  map::OccupancyGrid grid = *grid_result;
  const auto chart = map::loadChart(OTTER_NAV_SOURCE_DIR "/test/rostest/data/pond_chart.yaml");
  ASSERT_TRUE(chart.has_value());
  EXPECT_EQ(grid.cells, chart->cells);
  EXPECT_EQ(cellAhead(grid), map::Cell::kFree);

  ASSERT_TRUE(updates_.connected());
  ASSERT_TRUE(scanUntil(grid, map::Cell::kOccupied));

  SaveMap save;
  save.request.path = "/tmp/otter_nav_map_node_test.yaml";
  ASSERT_TRUE(ros_bridge::callService("map_node/save", save));
  EXPECT_TRUE(save.response.success) << save.response.message;
  const auto saved = map::loadChart(save.request.path);
  ASSERT_TRUE(saved.has_value());
  EXPECT_EQ(cellAhead(*saved), map::Cell::kOccupied);
  save.request.path = "";
  ASSERT_TRUE(ros_bridge::callService("map_node/save", save));
  EXPECT_FALSE(save.response.success);
  EXPECT_EQ(save.response.message, "the path is empty");
  save.request.path = OTTER_NAV_SOURCE_DIR "/package.xml/map.yaml";
  ASSERT_TRUE(ros_bridge::callService("map_node/save", save));
  EXPECT_FALSE(save.response.success);

  std_srvs::Trigger reset;
  ASSERT_TRUE(ros_bridge::callService("map_node/reset", reset));
  ASSERT_TRUE(updates_.waitFor([&](const auto& update) {
    (void)ros_bridge::applyUpdate(update, ros_bridge::frames().map, grid);
    return cellAhead(grid) == map::Cell::kFree;
  }));
}

// A node that starts later has what was sensed before, though no further scan comes.
TEST_F(MapNode, TellsWhoComesLateWhatItHasSensed) {
  ASSERT_TRUE(maps_.waitFor([](const auto& message) { return message.info.width == 240U; }));
  ASSERT_TRUE(updates_.connected());
  map::OccupancyGrid grid = *ros_bridge::toGrid(maps_.messages.back(), ros_bridge::frames().map);
  ASSERT_TRUE(scanUntil(grid, map::Cell::kOccupied));

  maps_.close();
  updates_.close();
  ros_bridge::MapMirror mirror({});
  const ros::Subscriber map = node_.subscribe<nav_msgs::OccupancyGrid>(
      "map", 1,
      [&](const nav_msgs::OccupancyGridConstPtr& message) { EXPECT_TRUE(mirror.take(*message)); });
  const ros::Subscriber updates = node_.subscribe<map_msgs::OccupancyGridUpdate>(
      "map_updates", 100, [&](const map_msgs::OccupancyGridUpdateConstPtr& message) {
        EXPECT_TRUE(mirror.take(*message).has_value());
      });
  EXPECT_TRUE(waitUntil(
      [&] { return mirror.ready() && cellAhead(mirror.grid()) == map::Cell::kOccupied; }, 5.0));
}

// Which of the two topics is quicker is not known.
TEST_F(MapNode, ItsUpdatesMayComeBeforeTheMap) {
  ASSERT_TRUE(maps_.waitFor([](const auto& message) { return message.info.width == 240U; }));
  const nav_msgs::OccupancyGrid chart = maps_.messages.back();
  map::OccupancyGrid grid = *ros_bridge::toGrid(chart, ros_bridge::frames().map);
  const Eigen::Vector2i cell = grid.geometry.cellAt({kEast + 5.0, 0.0});
  grid.cells[grid.geometry.index(cell.x(), cell.y())] = map::Cell::kOccupied;
  ros_bridge::MapMirror mirror({});
  EXPECT_TRUE(mirror
                  .take(ros_bridge::updateMessage(grid, {cell.x(), cell.y(), 1, 1},
                                                  ros_bridge::frames().map, ros::Time(10.0)))
                  .has_value());
  EXPECT_FALSE(mirror.ready());
  EXPECT_TRUE(mirror.take(chart));
  EXPECT_EQ(cellAhead(mirror.grid()), map::Cell::kOccupied);
  EXPECT_EQ(mirror.stamp(), ros::Time(10.0));
}

// What traffic_node tells of hulls that have come to lie, and of those that have moved on.
TEST_F(MapNode, FillsInWhoLiesAndForgetsWhoHasMovedOn) {
  ros::Publisher lying = node_.advertise<geometry_msgs::PoseArray>("lying", 10);
  ros::Publisher ghosts = node_.advertise<geometry_msgs::PoseArray>("ghosts", 10);
  ASSERT_TRUE(maps_.waitFor([](const auto& message) { return message.info.width == 240U; }));
  ASSERT_TRUE(waitUntil([&] {
    return updates_.connected() && lying.getNumSubscribers() > 0 && ghosts.getNumSubscribers() > 0;
  }));
  map::OccupancyGrid grid = *ros_bridge::toGrid(maps_.messages.back(), ros_bridge::frames().map);
  const Eigen::Vector2d place(kEast - 4.0, 6.0);
  const auto isAt = [&](map::Cell wanted, double patience_s) {
    return updates_.waitFor(
        [&](const auto& update) {
          (void)ros_bridge::applyUpdate(update, ros_bridge::frames().map, grid);
          const Eigen::Vector2i cell = grid.geometry.cellAt(place);
          return grid.at(cell.x(), cell.y()) == wanted;
        },
        patience_s);
  };
  geometry_msgs::PoseArray hulls;
  hulls.header.frame_id = ros_bridge::frames().map;
  hulls.header.stamp = ros::Time::now();
  geometry_msgs::Pose pose;
  pose.position.x = place.x();
  pose.position.y = std::numeric_limits<double>::quiet_NaN();
  pose.position.z = 0.5;
  hulls.poses.assign(1, pose);
  lying.publish(hulls);
  EXPECT_FALSE(isAt(map::Cell::kOccupied, 1.0));
  hulls.poses[0].position.y = place.y();
  lying.publish(hulls);
  EXPECT_TRUE(isAt(map::Cell::kOccupied, kPatienceS));
  updates_.messages.clear();
  ghosts.publish(hulls);
  EXPECT_TRUE(isAt(map::Cell::kFree, kPatienceS));
}

TEST_F(MapNode, RefusesAScanThatGoesBackInTime) {
  ASSERT_TRUE(updates_.connected());
  ASSERT_TRUE(waitUntil([&] { return scans_.getNumSubscribers() > 0; }));
  sensor_msgs::LaserScan late = scan();
  ASSERT_TRUE(waitUntil([&] {
    late.header.stamp = ros::Time::now();
    scans_.publish(late);
    ros::WallDuration(0.05).sleep();
    ros::spinOnce();
    return !updates_.messages.empty();
  }));
  updates_.messages.clear();
  late.header.stamp -= ros::Duration(5.0);
  scans_.publish(late);
  EXPECT_FALSE(updates_.waitFor(
      [&](const auto& update) { return update.header.stamp == late.header.stamp; }, 1.0));
}

// For as long as somebody may want to look, not for ever.
TEST_F(MapNode, WarnsOfWhatItRefusedForAWhile) {
  Inbox<diagnostic_msgs::DiagnosticArray> diagnostics{node_, "/diagnostics"};
  ASSERT_TRUE(diagnostics.connected() && updates_.connected());
  ASSERT_TRUE(waitUntil([&] { return scans_.getNumSubscribers() > 0; }));
  const auto isAt = [&](std::uint8_t level, const std::string& word) {
    diagnostics.messages.clear();
    return waitUntil([&] {
      scans_.publish(scan());
      ros::WallDuration(0.1).sleep();
      ros::spinOnce();
      for (const auto& message : diagnostics.messages) {
        for (const diagnostic_msgs::DiagnosticStatus& status : message.status) {
          if (status.level == level && status.name.find("map_node") != std::string::npos &&
              status.message.find(word) != std::string::npos) {
            return true;
          }
        }
      }
      return false;
    });
  };
  EXPECT_TRUE(isAt(diagnostic_msgs::DiagnosticStatus::OK, "chart"));
  sensor_msgs::LaserScan early = scan();
  early.header.stamp -= ros::Duration(5.0);
  scans_.publish(early);
  EXPECT_TRUE(isAt(diagnostic_msgs::DiagnosticStatus::WARN, "refused"));
  EXPECT_TRUE(isAt(diagnostic_msgs::DiagnosticStatus::OK, "chart"));
}

}  // namespace
}  // namespace otter_nav::rostest

OTTER_NAV_ROSTEST_MAIN("map_node_test")
