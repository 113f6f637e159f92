#include "map_node.hpp"

#include <filesystem>

#include "map_node_options.hpp"
#include "otter_nav/base/first_failure.hpp"
#include "otter_nav/config/fields.hpp"
#include "otter_nav/config/share.hpp"
#include "otter_nav/map/chart.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/grids.hpp"
#include "otter_nav/ros/scans.hpp"
#include "otter_nav/scenario/scenario.hpp"

namespace otter_nav::nodes {
namespace {

using ros_bridge::frames;
using Level = ros_bridge::Diagnostics::Level;

constexpr int kQueue = 50;

}  // namespace

Result<std::unique_ptr<MapNode>> MapNode::create(config::Section section) {
  MapNodeOptions node;
  const Status fields = config::readFields(section, node);
  const Result<map::OccupancyMapOptions> options =
      map::readOccupancyMapOptions(section.child("map"));
  if (const Status status = firstFailure(section.finish(), fields, options); !status) {
    return failure(status.error().message);
  }
  if (node.chart.empty() == node.scenario.empty()) {
    return failure(section.where() + ": give one of the parameters 'chart' and 'scenario'");
  }
  const Result<vessel::Parameters> own =
      config::vesselFile(node.vessel).and_then(vessel::loadParameters);
  if (!own) {
    return failure(section.where() + ": parameter 'vessel': " + own.error().message);
  }
  if (!node.scenario.empty()) {
    const Result<scenario::Scenario> scenario = scenario::loadScenario(node.scenario);
    if (!scenario) {
      return failure(scenario.error().message);
    }
    node.chart = scenario->chart_path;
  }
  return map::loadMap(node.chart, options->band).map([&](map::OccupancyGrid grid) {
    return std::unique_ptr<MapNode>(
        new MapNode(map::OccupancyMap(std::move(grid), own->hull, *options)));
  });
}

MapNode::MapNode(map::OccupancyMap map)
    : diagnostics_(node_, private_node_, "map"),
      map_(std::move(map)),
      load_time_(ros::WallTime::now().sec, ros::WallTime::now().nsec),
      scan_subscriber_(node_, "scan", kQueue, ros::TransportHints().tcpNoDelay()),
      scan_filter_(scan_subscriber_, transforms_, frames().map, kQueue, node_),
      map_publisher_(node_.advertise<nav_msgs::OccupancyGrid>(
          "map", 1,
          [this](const ros::SingleSubscriberPublisher& subscriber) { publishMapTo(subscriber); },
          ros::SubscriberStatusCallback(), ros::VoidConstPtr(), true)),
      chart_publisher_(node_.advertise<nav_msgs::OccupancyGrid>("chart", 1, true)),
      update_publisher_(node_.advertise<map_msgs::OccupancyGridUpdate>("map_updates", kQueue)),
      save_service_(private_node_.advertiseService("save", &MapNode::onSave, this)),
      reset_service_(private_node_.advertiseService("reset", &MapNode::onReset, this)) {
  map_publisher_.publish(
      ros_bridge::toMessage(map_.projection(), frames().map, ros::Time::now(), load_time_));
  chart_publisher_.publish(
      ros_bridge::toMessage(map_.chart(), frames().map, ros::Time::now(), load_time_));
  scan_filter_.registerCallback(
      [this](const sensor_msgs::LaserScanConstPtr& message) { onScan(message); });
  ghost_subscriber_ = node_.subscribe("ghosts", kQueue, &MapNode::onGhosts, this,
                                      ros::TransportHints().tcpNoDelay());
  diagnostics_.setState(Level::kOk, "chart loaded");
}

// A late subscriber gets the map as it is now, not as it was when it was latched.
void MapNode::publishMapTo(const ros::SingleSubscriberPublisher& subscriber) const {
  if (!last_scan_.isZero()) {
    subscriber.publish(
        ros_bridge::toMessage(map_.projection(), frames().map, last_scan_, load_time_));
  }
}

// Sensor and hull are where tf says they are, so the sensor may sit anywhere on the vessel.
Result<map::CellRectangle> MapNode::insert(const sensor_msgs::LaserScan& message) {
  const ros::Time& stamp = message.header.stamp;
  const Result<map::SensorPose> sensor =
      ros_bridge::poseInMap(transforms_, message.header.frame_id, stamp);
  const Result<map::SensorPose> base =
      ros_bridge::poseInMap(transforms_, ros_bridge::frames().base, stamp);
  if (!sensor || !base) {
    return failure((sensor ? base : sensor).error().message);
  }
  return map_.insertScan(*sensor, {base->position.head<2>(), base->yaw_rad},
                         ros_bridge::toScan(message));
}

void MapNode::onScan(const sensor_msgs::LaserScanConstPtr& message) {
  diagnostics_.received("scan");
  if (message->header.stamp <= last_scan_) {
    if (message->header.stamp == last_scan_) {
      publishUpdate({}, last_scan_);
    } else {
      diagnostics_.refuse("scan", "its stamp goes backwards");
    }
    return;
  }
  const Result<map::CellRectangle> changed = insert(*message);
  if (!changed) {
    diagnostics_.refuse("scan", changed.error().message);
  }
  last_scan_ = message->header.stamp;
  publishUpdate(changed.value_or(map::CellRectangle{}), last_scan_);
}

// A vessel was met there before it was known to be one.
void MapNode::onGhosts(const sensor_msgs::PointCloud& message) {
  if (message.header.frame_id != frames().map) {
    diagnostics_.refuse("ghosts", "frame_id is '" + message.header.frame_id + "'");
    return;
  }
  std::vector<Eigen::Vector2d> points;
  for (const geometry_msgs::Point32& point : message.points) {
    points.emplace_back(static_cast<double>(point.x), static_cast<double>(point.y));
  }
  const map::CellRectangle changed = map_.forget(points);
  if (!changed.empty()) {
    publishUpdate(changed, last_scan_.isZero() ? message.header.stamp : last_scan_);
  }
}

void MapNode::publishUpdate(map::CellRectangle changed, const ros::Time& stamp) {
  if (changed.empty()) {
    changed = {0, 0, 1, 1};
  }
  update_publisher_.publish(
      ros_bridge::updateMessage(map_.projection(), changed, frames().map, stamp));
}

bool MapNode::onSave(SaveMap::Request& request, SaveMap::Response& response) {
  // A relative path is one in this node's folder, which under roslaunch is ~/.ros.
  const std::string path = std::filesystem::absolute(request.path).string();
  const Status status = map_.save(path);
  response.success = static_cast<std::uint8_t>(status.has_value());
  response.message = status ? "saved " + path : status.error().message;
  return true;
}

bool MapNode::onReset(std_srvs::Trigger::Request& /*request*/,
                      std_srvs::Trigger::Response& response) {
  publishUpdate(map_.reset(), last_scan_.isZero() ? ros::Time::now() : last_scan_);
  response.success = 1;
  response.message = "what was sensed is forgotten; the chart stays";
  return true;
}

}  // namespace otter_nav::nodes
