// map_node: the chart, and on top of it what the lidar sees, as an OctoMap and its projection.
// Parameters: config/map_node.yaml, the map's own under ~map (config/map.yaml).
#include <geometry_msgs/PoseArray.h>
#include <message_filters/subscriber.h>
#include <otter_nav/SaveMap.h>
#include <ros/node_handle.h>
#include <sensor_msgs/LaserScan.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/message_filter.h>
#include <tf2_ros/transform_listener.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "map_node_options.hpp"
#include "otter_nav/base/first_failure.hpp"
#include "otter_nav/config/fields.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/map/chart.hpp"
#include "otter_nav/map/occupancy_map.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/diagnostics.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/grids.hpp"
#include "otter_nav/ros/run_node.hpp"
#include "otter_nav/ros/scans.hpp"
#include "otter_nav/scenario/scenario.hpp"
#include "stamps.hpp"

namespace otter_nav::nodes {
namespace {

using ros_bridge::frames;
using Level = ros_bridge::Diagnostics::Level;

constexpr int kQueue = 50;
constexpr double kScanLateS = 10.0;

}  // namespace

class MapNode {
 public:
  [[nodiscard]] static Result<std::unique_ptr<MapNode>> create(config::Section section);
  [[nodiscard]] static int exitCode() { return 0; }

 private:
  explicit MapNode(map::OccupancyMap map);

  void watchScans();
  void onScan(const sensor_msgs::LaserScanConstPtr& message);
  void onGhosts(const geometry_msgs::PoseArray& message);
  void onLying(const geometry_msgs::PoseArray& message);
  // None, and said on /diagnostics, if it makes no sense.
  std::optional<std::vector<Eigen::Vector3d>> pointsOf(const char* topic,
                                                       const geometry_msgs::PoseArray& message);
  void publishChange(const map::CellRectangle& changed);
  [[nodiscard]] Result<map::CellRectangle> insert(const sensor_msgs::LaserScan& message);
  bool onSave(SaveMap::Request& request, SaveMap::Response& response);
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  // An update is sent for every scan: it says that the scan has been dealt with. One that came into
  // the map has a cell at least, if need be an unchanged one; one that was refused has none.
  void publishUpdate(map::CellRectangle changed);
  void publishWindow(const map::CellRectangle& window, const ros::Time& stamp);
  void publishMapTo(const ros::SingleSubscriberPublisher& subscriber) const;
  void publishAllTo(const ros::SingleSubscriberPublisher& subscriber) const;

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  ros_bridge::Diagnostics diagnostics_;
  map::OccupancyMap map_;
  ros::Time load_time_;    // wall time, whatever the clock
  ros::Time last_scan_;    // refused or not
  ros::Time taken_;        // of the last scan that came into the map; zero before
  bool has_told_ = false;  // an update

  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener transform_listener_{transforms_};
  message_filters::Subscriber<sensor_msgs::LaserScan> scan_subscriber_;
  tf2_ros::MessageFilter<sensor_msgs::LaserScan> scan_filter_;
  ros::Subscriber ghost_subscriber_;
  ros::Subscriber lying_subscriber_;
  ros::Publisher map_publisher_;
  ros::Publisher chart_publisher_;
  ros::Publisher update_publisher_;
  ros::ServiceServer save_service_;
  ros::ServiceServer reset_service_;
  ros::WallTimer scan_timer_;
};

Result<std::unique_ptr<MapNode>> MapNode::create(config::Section section) {
  MapNodeOptions node;
  const Status fields = config::readFields(section, node);
  const Result<map::OccupancyMapOptions> options =
      map::readOccupancyMapOptions(section.child("map"));
  const auto own = vessel::loadParameters(node.vessel);
  if (const Status status = firstFailure(section.finish(), fields, options, own); !status) {
    return failure(status.error().message);
  }
  if (node.chart.empty() == node.scenario.empty()) {
    return failure(section.where() + ": give one of the parameters 'chart' and 'scenario'");
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
      update_publisher_(node_.advertise<map_msgs::OccupancyGridUpdate>(
          "map_updates", kQueue,
          [this](const ros::SingleSubscriberPublisher& subscriber) { publishAllTo(subscriber); })),
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
  lying_subscriber_ =
      node_.subscribe("lying", kQueue, &MapNode::onLying, this, ros::TransportHints().tcpNoDelay());
  diagnostics_.setState(Level::kOk, "chart loaded");
  scan_timer_ = node_.createWallTimer(ros::WallDuration(1.0),
                                      [this](const ros::WallTimerEvent&) { watchScans(); });
}

// Of ROS time, which in lockstep stands still without scans.
void MapNode::watchScans() {
  const bool none = last_scan_.isZero() && diagnostics_.silence("scan") > kScanLateS;
  const bool late = !last_scan_.isZero() && age(last_scan_, ros::Time::now()) > kScanLateS;
  diagnostics_.setState(none || late ? Level::kWarning : Level::kOk,
                        none   ? "chart loaded, but no scan has come"
                        : late ? "no scan for a while"
                               : "chart loaded");
}

// A late subscriber gets the map as it is now, not as it was when it was latched.
void MapNode::publishMapTo(const ros::SingleSubscriberPublisher& subscriber) const {
  if (!taken_.isZero()) {
    subscriber.publish(ros_bridge::toMessage(map_.projection(), frames().map, taken_, load_time_));
  }
}

// What changed before is its first update: a node that keeps a copy of the map has the latched
// chart first, and whatever comes between map and updates would be lost to it.
void MapNode::publishAllTo(const ros::SingleSubscriberPublisher& subscriber) const {
  if (has_told_) {
    const map::GridGeometry& all = map_.projection().geometry;
    subscriber.publish(ros_bridge::updateMessage(map_.projection(), {0, 0, all.width, all.height},
                                                 frames().map, taken_));
  }
}

// Sensor and hull are where tf says they are, so the sensor may sit anywhere on the vessel.
Result<map::CellRectangle> MapNode::insert(const sensor_msgs::LaserScan& message) {
  const auto sensor =
      ros_bridge::poseInMap(transforms_, message.header.frame_id, message.header.stamp);
  const auto own = ros_bridge::hullInMap(transforms_, message.header.stamp);
  if (const Status status = firstFailure(sensor, own); !status) {
    return failure(status.error().message);
  }
  const Scan scan = ros_bridge::toScan(message);
  std::string why = whyUnusable(scan);
  if (why.empty()) {
    why = whyBlind(scan);
  }
  if (!why.empty()) {
    return failure("scan refused: " + why);
  }
  // What is seen from there lies outside, too.
  if (!map_.chart().geometry.contains(sensor->position.head<2>())) {
    return map::CellRectangle{};
  }
  return map_.insertScan(*sensor, *own, scan);
}

void MapNode::onScan(const sensor_msgs::LaserScanConstPtr& message) {
  diagnostics_.received("scan");
  if (message->header.stamp < last_scan_ && isAhead(last_scan_, ros::Time::now())) {
    last_scan_ = taken_ = ros::Time();  // the clock was set back
  }
  if (message->header.stamp <= last_scan_) {
    if (message->header.stamp == last_scan_) {
      publishWindow({}, last_scan_);
    } else {
      diagnostics_.refuse("scan", kStampedBack);
    }
    return;
  }
  const Result<map::CellRectangle> changed = insert(*message);
  last_scan_ = message->header.stamp;
  if (!changed) {
    diagnostics_.refuse("scan", changed.error().message);
    publishWindow({}, last_scan_);
    return;
  }
  taken_ = last_scan_;
  publishUpdate(*changed);
}

std::optional<std::vector<Eigen::Vector3d>> MapNode::pointsOf(
    const char* topic, const geometry_msgs::PoseArray& message) {
  Status status = ros_bridge::checkFrame(message.header.frame_id, frames().map);
  std::vector<Eigen::Vector3d> points;
  for (const geometry_msgs::Pose& pose : message.poses) {
    points.emplace_back(pose.position.x, pose.position.y, pose.position.z);
    if (status && !points.back().allFinite()) {
      status = failure("a point is not finite");
    }
  }
  if (!status) {
    diagnostics_.refuse(topic, status.error().message);
    return std::nullopt;
  }
  return points;
}

// A vessel was met there before it was known to be one.
void MapNode::onGhosts(const geometry_msgs::PoseArray& message) {
  if (const auto points = pointsOf("ghosts", message)) {
    std::vector<Eigen::Vector2d> places;
    for (const Eigen::Vector3d& point : *points) {
      places.emplace_back(point.head<2>());
    }
    publishChange(map_.forget(places));
  }
}

// A vessel has come to lie still there.
void MapNode::onLying(const geometry_msgs::PoseArray& message) {
  if (const auto points = pointsOf("lying", message)) {
    publishChange(map_.fill(*points));
  }
}

void MapNode::publishChange(const map::CellRectangle& changed) {
  if (!changed.empty()) {
    publishUpdate(changed);
  }
}

void MapNode::publishUpdate(map::CellRectangle changed) {
  publishWindow(changed.empty() ? map::CellRectangle{0, 0, 1, 1} : changed, taken_);
}

void MapNode::publishWindow(const map::CellRectangle& window, const ros::Time& stamp) {
  has_told_ = true;
  update_publisher_.publish(
      ros_bridge::updateMessage(map_.projection(), window, frames().map, stamp));
}

bool MapNode::onSave(SaveMap::Request& request, SaveMap::Response& response) {
  if (request.path.empty()) {
    response.success = 0;
    response.message = "the path is empty";
    return true;
  }
  // A relative path is one in this node's folder, which under roslaunch is ~/.ros.
  const std::string path = std::filesystem::absolute(request.path).string();
  const Status status = map_.save(path);
  response.success = static_cast<std::uint8_t>(status.has_value());
  response.message = status ? "saved " + path : status.error().message;
  return true;
}

bool MapNode::onReset(std_srvs::Trigger::Request& /*request*/,
                      std_srvs::Trigger::Response& response) {
  publishUpdate(map_.reset());
  response.success = 1;
  response.message = "what was sensed is forgotten; the chart stays";
  return true;
}

}  // namespace otter_nav::nodes

int main(int argc, char** argv) {
  return otter_nav::ros_bridge::runNode<otter_nav::nodes::MapNode>(argc, argv, "map_node");
}
