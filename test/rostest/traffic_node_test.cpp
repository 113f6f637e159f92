// traffic_node alone: tracks from radar and AIS, the scan passed on, nonsense refused; who comes to
// lie is given to the map.
#include <geometry_msgs/PoseArray.h>
#include <gtest/gtest.h>
#include <otter_nav/Tracks.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/ros/tracks.hpp"
#include "support.hpp"

namespace otter_nav::rostest {
namespace {

// What the planner remembers ways by comes back as it was sent.
TEST(TracksMessage, CarriesWhereTheyWereMet) {
  traffic::Track track;
  track.met = {12.25, {3.0, -4.0}, 0.75};
  Tracks message = ros_bridge::toMessage({track}, ros::Time(13.0));
  const auto told = ros_bridge::toTracks(message);
  ASSERT_TRUE(told);
  ASSERT_EQ(told->tracks.size(), 1u);
  EXPECT_TRUE(told->refused.empty()) << told->refused;
  const auto& met = told->tracks[0].met;
  EXPECT_EQ(met.stamp_s, track.met.stamp_s);
  EXPECT_EQ(met.position, track.met.position);
  EXPECT_EQ(met.deviation_m, track.met.deviation_m);
}

// The others that it tells of are taken.
TEST(TracksMessage, LosesATrackForAnyFigureThatMakesNoSense) {
  const auto refuses = [](const auto& spoil) {
    std::vector<traffic::Track> three(3);
    for (int i = 0; i < 3; ++i) {
      three[i].id = 7 + i;
    }
    Tracks message = ros_bridge::toMessage(three, ros::Time(13.0));
    spoil(message.tracks[1]);
    const auto told = ros_bridge::toTracks(message);
    if (told && told->refused.empty()) {
      EXPECT_EQ(told->tracks.size(), 3u);
      return false;
    }
    EXPECT_TRUE(told);
    EXPECT_EQ(told->refused.rfind("track 8 ", 0), 0u) << told->refused;
    EXPECT_EQ(told->tracks.size(), 2u);
    EXPECT_EQ(told->tracks.front().id, 7);
    EXPECT_EQ(told->tracks.back().id, 9);
    return true;
  };
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(refuses([](Track&) {}));
  EXPECT_TRUE(refuses([&](Track& one) { one.turn_time = infinite; }));
  EXPECT_TRUE(refuses([&](Track& one) { one.length = infinite; }));
  EXPECT_TRUE(refuses([&](Track& one) { one.beam = infinite; }));
  EXPECT_TRUE(refuses([&](Track& one) { one.met_deviation = infinite; }));
  EXPECT_TRUE(refuses([](Track& one) { one.met_deviation = -1.0; }));
  EXPECT_TRUE(refuses([](Track& one) { one.met_position.y = std::nan(""); }));
  EXPECT_TRUE(refuses([&](Track& one) { one.existence = std::nan(""); }));
  EXPECT_TRUE(refuses([&](Track& one) { one.existence = 1.5; }));
  EXPECT_TRUE(refuses([&](Track& one) { one.velocity.x = 1e300; }));
  EXPECT_TRUE(refuses([&](Track& one) { one.length = 1e6; }));
}

TEST(TracksMessage, IsRefusedInAnotherFrame) {
  Tracks message = ros_bridge::toMessage({traffic::Track()}, ros::Time(13.0));
  message.header.frame_id = "base_link";
  EXPECT_FALSE(ros_bridge::toTracks(message));
}

// A hull along x, 5 m by 2 m.
struct Hull {
  Eigen::Vector2d middle;

  // Along a beam from the origin; infinite where that passes her.
  [[nodiscard]] double range(double bearing_rad) const {
    const Eigen::Vector2d along = unitVector(bearing_rad);
    double first = 0.0;
    double last = std::numeric_limits<double>::infinity();
    const Eigen::Vector2d half(2.5, 1.0);
    for (int axis = 0; axis < 2; ++axis) {
      const double a = (middle[axis] - half[axis]) / along[axis];
      const double b = (middle[axis] + half[axis]) / along[axis];
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
    }
    return first < last ? first : std::numeric_limits<double>::infinity();
  }
};

class TrafficNode : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(waitUntil([&] {
      return scans_.getNumSubscribers() > 0 && radar_.getNumSubscribers() > 0 &&
             ais_.getNumSubscribers() > 0 && transforms_.getNumSubscribers() > 0;
    }));
    ASSERT_TRUE(tracks_.connected() && still_.connected());
  }

  // The vessel lies at the origin and looks into open water, or at somebody there.
  void scanAt(const ros::Time& stamp, const std::optional<Hull>& other = std::nullopt) {
    tf2_msgs::TFMessage transforms;
    for (const std::string& child : {ros_bridge::frames().base, ros_bridge::frames().lidar}) {
      geometry_msgs::TransformStamped transform;
      transform.header.frame_id = ros_bridge::frames().map;
      transform.header.stamp = stamp;
      transform.child_frame_id = child;
      transform.transform.translation.z = 0.8;
      transform.transform.rotation.w = 1.0;
      transforms.transforms.push_back(transform);
    }
    transforms_.publish(transforms);
    sensor_msgs::LaserScan scan;
    scan.header.frame_id = ros_bridge::frames().lidar;
    scan.header.stamp = stamp;
    scan.angle_min = -3.14F;
    scan.angle_max = 3.13F;
    scan.angle_increment = 0.01F;
    scan.range_min = 0.2F;
    scan.range_max = 25.0F;
    scan.ranges.assign(628, std::numeric_limits<float>::infinity());
    for (std::size_t k = 0; other && k < scan.ranges.size(); ++k) {
      const auto range = static_cast<float>(
          other->range(static_cast<double>(scan.angle_min + scan.angle_increment * k)));
      if (range < scan.range_max) {
        scan.ranges[k] = range;
      }
    }
    if (no_range_) {
      scan.ranges.clear();
    }
    scans_.publish(scan);
  }
  // Sent again like the plant does it: the first may go out before all are listening.
  bool isAnswered(const ros::Time& stamp, const std::optional<Hull>& other = std::nullopt) {
    return waitUntil([&] {
      scanAt(stamp, other);
      return still_.waitFor([&](const auto& scan) { return scan.header.stamp == stamp; }, 1.0);
    });
  }
  void radarAt(const ros::Time& stamp, double x, double y) {
    geometry_msgs::PoseArray plot;
    plot.header.frame_id = ros_bridge::frames().base;
    plot.header.stamp = stamp;
    plot.poses.push_back(ros_bridge::toPose({{x, y}, 0.0}));
    radar_.publish(plot);
  }

  bool no_range_ = false;
  ros::NodeHandle node_;
  ros::Publisher scans_ = node_.advertise<sensor_msgs::LaserScan>("scan", 10);
  ros::Publisher radar_ = node_.advertise<geometry_msgs::PoseArray>("radar", 10);
  ros::Publisher ais_ = node_.advertise<std_msgs::String>("ais", 10);
  ros::Publisher transforms_ = node_.advertise<tf2_msgs::TFMessage>("/tf", 10);
  Inbox<Tracks> tracks_{node_, "tracks"};
  Inbox<sensor_msgs::LaserScan> still_{node_, "scan_still"};
};

TEST_F(TrafficNode, TracksWhatTheRadarAndAisTell) {
  ros::Time stamp(100.0);
  for (int k = 0; k < 12; ++k) {
    stamp += ros::Duration(0.5);
    if (k % 2 == 0) {
      radarAt(stamp, 80.0 - stamp.toSec() + 100.0, 20.0);
    }
    std_msgs::String nonsense;
    nonsense.data = "!AIVDM,1,1,,A,nonsense,0*00";
    ais_.publish(nonsense);
    ros::WallDuration(0.05).sleep();
    ASSERT_TRUE(isAnswered(stamp)) << k;
    EXPECT_EQ(still_.messages.back().ranges.size(), 628U);
  }
  ASSERT_TRUE(tracks_.waitFor([](const Tracks& message) { return message.tracks.size() == 1; }));
  const Track& track = tracks_.messages.back().tracks.at(0);
  EXPECT_NEAR(track.velocity.x, -1.0, 0.4);
  EXPECT_NEAR(track.position.y, 20.0, 1.5);
  EXPECT_EQ(track.sources, Track::RADAR);
  EXPECT_GT(track.covariance[0], 0.0);
  EXPECT_EQ(track.met_stamp, track.stamp);
  EXPECT_NEAR(track.met_position.y, 20.0, 1.5);
  EXPECT_GT(track.met_deviation, 0.0);
  EXPECT_EQ(tracks_.messages.back().header.frame_id, ros_bridge::frames().map);
}

// What can't be true of a message keeps none behind it waiting.
TEST_F(TrafficNode, GoesOnBehindARadarStampedAhead) {
  ros::Time stamp(150.0);
  radarAt(ros::Time::now() + ros::Duration(1000.0), 80.0, 20.0);
  for (int k = 0; k < 12; ++k) {
    stamp += ros::Duration(0.5);
    if (k % 2 == 0) {
      radarAt(stamp, 80.0 - stamp.toSec() + 150.0, 20.0);
    }
    ros::WallDuration(0.05).sleep();
    ASSERT_TRUE(isAnswered(stamp)) << k;
  }
  EXPECT_TRUE(tracks_.waitFor([&](const Tracks& message) {
    return message.header.stamp > ros::Time(150.0) && !message.tracks.empty() &&
           message.tracks.back().stamp > ros::Time(150.0);
  }));
}

// A scan that the map refuses is none for the tracks either; it is handed on for the map to say so.
TEST_F(TrafficNode, HandsOnAScanThatMakesNoSense) {
  ros::Time stamp(180.0);
  ASSERT_TRUE(isAnswered(stamp));
  const auto told = [&] {
    return std::count_if(tracks_.messages.begin(), tracks_.messages.end(),
                         [&](const Tracks& message) { return message.header.stamp == stamp; });
  };
  stamp += ros::Duration(0.5);
  no_range_ = true;
  ASSERT_TRUE(isAnswered(stamp));
  EXPECT_TRUE(waitUntil([&] { return told() > 0; }));
  EXPECT_TRUE(still_.messages.back().ranges.empty());
  no_range_ = false;
  stamp += ros::Duration(0.5);
  EXPECT_TRUE(isAnswered(stamp));
}

// She passes by abeam at 2 m/s, and stops there.
TEST_F(TrafficNode, GivesToTheMapWhoHasComeToLie) {
  constexpr int kScansPerS = 15;
  constexpr double kMps = 2.0;
  Inbox<geometry_msgs::PoseArray> lying{node_, "lying"};
  ASSERT_TRUE(lying.connected());
  const auto points = [](const geometry_msgs::PoseArray& message) { return message.poses.size(); };
  const auto isSomebody = [&](const auto& message) { return points(message) > 0; };
  const ros::Time begin(200.0);
  for (int k = 0; k < 20 * kScansPerS; ++k) {
    const double t = static_cast<double>(k) / kScansPerS;
    const ros::Time stamp = begin + ros::Duration(t);
    const Hull other{{std::min(0.0, -20.0 + kMps * t), 8.0}};
    if (k % kScansPerS == 0) {
      radarAt(stamp, other.middle.x(), other.middle.y());
    }
    still_.messages.clear();
    ASSERT_TRUE(isAnswered(stamp, other)) << t;
    ASSERT_TRUE(other.middle.x() == 0.0 ||
                std::none_of(lying.messages.begin(), lying.messages.end(), isSomebody));
  }
  ASSERT_TRUE(lying.waitFor(isSomebody));
  std::size_t far_side = 0;
  for (const auto& message : lying.messages) {
    EXPECT_EQ(message.header.frame_id, ros_bridge::frames().map);
    for (const geometry_msgs::Pose& pose : message.poses) {
      EXPECT_LT(std::abs(pose.position.x), 3.1);
      EXPECT_LT(std::abs(pose.position.y - 8.0), 1.6);
      far_side += pose.position.y > 8.3 ? 1 : 0;
    }
  }
  EXPECT_GT(far_side, 5U);  // no beam meets that
}

}  // namespace
}  // namespace otter_nav::rostest

OTTER_NAV_ROSTEST_MAIN("traffic_node_test")
