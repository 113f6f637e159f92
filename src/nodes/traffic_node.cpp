// traffic_node: tracks of other vessels from lidar, radar and AIS, and the scan without them for
// the map. Parameters: config/traffic_node.yaml, the tracker's own under ~traffic
// (config/traffic.yaml).
#include <geometry_msgs/PoseArray.h>
#include <message_filters/subscriber.h>
#include <nav_msgs/OccupancyGrid.h>
#include <otter_nav/Tracks.h>
#include <ros/node_handle.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/String.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/message_filter.h>
#include <tf2_ros/transform_listener.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "otter_nav/base/first_failure.hpp"
#include "otter_nav/config/fields.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/diagnostics.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/grids.hpp"
#include "otter_nav/ros/run_node.hpp"
#include "otter_nav/ros/scans.hpp"
#include "otter_nav/ros/tracks.hpp"
#include "otter_nav/traffic/tracker.hpp"
#include "stamps.hpp"
#include "traffic_node_options.hpp"

namespace otter_nav::nodes {
namespace {

using ros_bridge::frames;
using Level = ros_bridge::Diagnostics::Level;

constexpr int kQueue = 50;
constexpr std::size_t kMostHeard = 1000;

}  // namespace

// Everything happens with a scan: what other sensors told since the scan before is taken first, so
// that a run in lockstep doesn't depend on which message was quicker.
class TrafficNode {
 public:
  [[nodiscard]] static Result<std::unique_ptr<TrafficNode>> create(config::Section section);
  [[nodiscard]] static int exitCode() { return 0; }

 private:
  TrafficNode(const traffic::Options& options, const vessel::Hull& hull);

  void onChart(const nav_msgs::OccupancyGrid& message);
  void onScan(const sensor_msgs::LaserScanConstPtr& message);
  void onRadar(const geometry_msgs::PoseArray& message);
  void onAis(const std_msgs::String& message);
  static void publishPoints(const ros::Publisher& publisher, const ros::Time& stamp,
                            const std::vector<Eigen::Vector3d>& points);
  void publish(const ros::Time& stamp);

  // What came between two scans.
  struct Heard {
    ros::Time stamp;
    bool is_radar = false;
    bool before_scans = false;
    std::vector<Eigen::Vector2d> radar_in_base;
    std::string ais;
  };
  void keep(Heard heard);
  void takeOthers(const ros::Time& scan);

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  ros_bridge::Diagnostics diagnostics_;
  traffic::Options options_;
  vessel::Hull hull_;
  traffic::Tracker tracker_;
  std::deque<Heard> heard_;
  ros::Time last_scan_;
  sensor_msgs::LaserScan last_still_;

  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener transform_listener_{transforms_};
  message_filters::Subscriber<sensor_msgs::LaserScan> scan_subscriber_;
  tf2_ros::MessageFilter<sensor_msgs::LaserScan> scan_filter_;
  ros::Subscriber chart_subscriber_;
  ros::Subscriber radar_subscriber_;
  ros::Subscriber ais_subscriber_;
  ros::Publisher tracks_publisher_;
  ros::Publisher markers_publisher_;
  ros::Publisher still_publisher_;
  ros::Publisher ghosts_publisher_;
  ros::Publisher lying_publisher_;
};

Result<std::unique_ptr<TrafficNode>> TrafficNode::create(config::Section section) {
  TrafficNodeOptions node;
  const Status fields = config::readFields(section, node);
  const Result<traffic::Options> options = config::read<traffic::Options>(section.child("traffic"));
  const auto own = vessel::loadParameters(node.vessel);
  if (const Status status = firstFailure(section.finish(), fields, options, own); !status) {
    return failure(status.error().message);
  }
  return std::unique_ptr<TrafficNode>(new TrafficNode(*options, own->hull));
}

TrafficNode::TrafficNode(const traffic::Options& options, const vessel::Hull& hull)
    : diagnostics_(node_, private_node_, "traffic"),
      options_(options),
      hull_(hull),
      tracker_(options, {}, hull),
      scan_subscriber_(node_, "scan", kQueue, ros::TransportHints().tcpNoDelay()),
      scan_filter_(scan_subscriber_, transforms_, frames().map, kQueue, node_),
      tracks_publisher_(node_.advertise<Tracks>("tracks", kQueue)),
      markers_publisher_(node_.advertise<visualization_msgs::MarkerArray>("track_markers", kQueue)),
      still_publisher_(node_.advertise<sensor_msgs::LaserScan>("scan_still", kQueue)),
      ghosts_publisher_(node_.advertise<geometry_msgs::PoseArray>("ghosts", kQueue)),
      lying_publisher_(node_.advertise<geometry_msgs::PoseArray>("lying", kQueue)) {
  diagnostics_.setState(Level::kOk, "without a chart");
  chart_subscriber_ = node_.subscribe("chart", 1, &TrafficNode::onChart, this);
  radar_subscriber_ = node_.subscribe("radar", kQueue, &TrafficNode::onRadar, this,
                                      ros::TransportHints().tcpNoDelay());
  ais_subscriber_ =
      node_.subscribe("ais", kQueue, &TrafficNode::onAis, this, ros::TransportHints().tcpNoDelay());
  scan_filter_.registerCallback(
      [this](const sensor_msgs::LaserScanConstPtr& message) { onScan(message); });
}

// What the chart shows is no vessel; the tracks begin anew.
void TrafficNode::onChart(const nav_msgs::OccupancyGrid& message) {
  const Result<map::OccupancyGrid> chart = ros_bridge::toGrid(message, frames().map);
  if (!chart) {
    diagnostics_.refuse("chart", chart.error().message);
    return;
  }
  tracker_ = traffic::Tracker(options_, *chart, hull_);
  diagnostics_.setState(Level::kOk, "with the chart");
}

void TrafficNode::onRadar(const geometry_msgs::PoseArray& message) {
  if (const Status status = ros_bridge::checkFrame(message.header.frame_id, frames().base);
      !status) {
    diagnostics_.refuse("radar", status.error().message);
    return;
  }
  Heard heard;
  heard.stamp = message.header.stamp;
  heard.is_radar = true;
  if (isAhead(heard.stamp, ros::Time::now())) {
    diagnostics_.refuse("radar", kStampedAhead);
    return;
  }
  for (const geometry_msgs::Pose& pose : message.poses) {
    if (!std::isfinite(pose.position.x) || !std::isfinite(pose.position.y)) {
      diagnostics_.refuse("radar", "a position is not finite");
      return;
    }
    heard.radar_in_base.emplace_back(pose.position.x, pose.position.y);
  }
  keep(std::move(heard));
}

void TrafficNode::onAis(const std_msgs::String& message) {
  Heard heard;
  heard.stamp = last_scan_.isZero() ? ros::Time::now() : last_scan_;
  heard.before_scans = last_scan_.isZero();
  heard.ais = message.data;
  keep(std::move(heard));
}

void TrafficNode::keep(Heard heard) {
  heard_.push_back(std::move(heard));
  if (heard_.size() > kMostHeard) {  // no scans
    heard_.pop_front();
  }
}

// Up to the scan before the one stamped `scan`.
void TrafficNode::takeOthers(const ros::Time& scan) {
  const ros::Time now = ros::Time::now();
  while (!heard_.empty() && isAhead(heard_.front().stamp, now)) {  // the clock was set back
    heard_.pop_front();
  }
  while (!heard_.empty() && (heard_.front().before_scans || heard_.front().stamp <= last_scan_)) {
    const Heard heard = std::move(heard_.front());
    heard_.pop_front();
    const double stamp_s = std::min(heard.stamp, scan).toSec();
    if (!heard.is_radar) {
      if (const Status status = tracker_.addAis(stamp_s, heard.ais); !status) {
        diagnostics_.refuse("ais", status.error().message);
      }
      continue;
    }
    const Result<vessel::Pose> own = ros_bridge::hullInMap(transforms_, heard.stamp);
    if (!own) {
      diagnostics_.refuse("radar", own.error().message);
      continue;
    }
    tracker_.addRadar(stamp_s, vessel::toMap(*own, heard.radar_in_base), own->position);
  }
}

void TrafficNode::onScan(const sensor_msgs::LaserScanConstPtr& message) {
  const ros::Time& stamp = message->header.stamp;
  if (stamp < last_scan_ && isAhead(last_scan_, ros::Time::now())) {  // the clock was set back
    last_scan_ = ros::Time();
    tracker_.beginAnew();
  }
  if (stamp <= last_scan_) {
    if (stamp == last_scan_) {
      still_publisher_.publish(last_still_);  // sent again: whoever asked missed the answer
    } else {
      diagnostics_.refuse("scan", kStampedBack);
    }
    return;
  }
  takeOthers(stamp);
  sensor_msgs::LaserScan still = *message;
  const auto sensor = ros_bridge::poseInMap(transforms_, message->header.frame_id, stamp);
  const auto own = ros_bridge::hullInMap(transforms_, stamp);
  const Scan scan = ros_bridge::toScan(*message);
  // What the map would refuse has to be refused here too: it tells nothing of others either.
  const std::string unusable = whyUnusable(scan);
  if (const Status status = firstFailure(sensor, own); !status) {
    diagnostics_.refuse("scan", status.error().message);
  } else if (!unusable.empty()) {
    diagnostics_.refuse("scan", unusable);
  } else {
    const traffic::ScanVerdict& verdict = tracker_.addScan(stamp.toSec(), *sensor, *own, scan);
    for (std::size_t i = 0; i < still.ranges.size(); ++i) {
      if (verdict.on_vessel[i]) {
        still.ranges[i] = std::numeric_limits<float>::quiet_NaN();
      }
    }
    std::vector<Eigen::Vector3d> ghosts;
    for (const Eigen::Vector2d& ghost : verdict.ghosts) {
      ghosts.emplace_back(ghost.x(), ghost.y(), 0.0);
    }
    publishPoints(ghosts_publisher_, stamp, ghosts);
    publishPoints(lying_publisher_, stamp, verdict.lying);
  }
  last_scan_ = stamp;
  last_still_ = std::move(still);
  publish(stamp);
}

void TrafficNode::publishPoints(const ros::Publisher& publisher, const ros::Time& stamp,
                                const std::vector<Eigen::Vector3d>& points) {
  if (points.empty()) {
    return;
  }
  geometry_msgs::PoseArray message;  // a point cloud's floats lose cells of a map in UTM
  message.header.frame_id = frames().map;
  message.header.stamp = stamp;
  for (const Eigen::Vector3d& point : points) {
    geometry_msgs::Pose pose;
    pose.position = ros_bridge::toPoint(point.head<2>(), point.z());
    pose.orientation.w = 1.0;
    message.poses.push_back(pose);
  }
  publisher.publish(message);
}

// The map's answer to the scan lets time go on: it comes last.
void TrafficNode::publish(const ros::Time& stamp) {
  tracks_publisher_.publish(ros_bridge::toMessage(tracker_.tracks(), stamp));
  if (markers_publisher_.getNumSubscribers() > 0) {
    markers_publisher_.publish(ros_bridge::trackMarkers(tracker_.tracks(), stamp));
  }
  still_publisher_.publish(last_still_);
}

}  // namespace otter_nav::nodes

int main(int argc, char** argv) {
  return otter_nav::ros_bridge::runNode<otter_nav::nodes::TrafficNode>(argc, argv, "traffic_node");
}
