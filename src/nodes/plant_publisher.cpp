#include "plant_publisher.hpp"

#include <geometry_msgs/PoseArray.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <otter_nav/ContactEvent.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/String.h>

#include "otter_nav/base/attitude.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/tracks.hpp"

namespace otter_nav::nodes {
namespace {

using namespace ros_bridge;  // NOLINT: the node is made of these

constexpr int kKept = 100;
constexpr double kWeatherPeriodS = 0.1;

geometry_msgs::TransformStamped transformOf(const std::string& parent, const std::string& child,
                                            const Eigen::Vector3d& position,
                                            const ros::Time& stamp) {
  geometry_msgs::TransformStamped message;
  message.header.frame_id = parent;
  message.header.stamp = stamp;
  message.child_frame_id = child;
  message.transform.translation.x = position.x();
  message.transform.translation.y = position.y();
  message.transform.translation.z = position.z();
  message.transform.rotation.w = 1.0;
  return message;
}

geometry_msgs::Vector3Stamped vectorMessage(const Eigen::Vector2d& v, const ros::Time& stamp) {
  geometry_msgs::Vector3Stamped message;
  message.header.frame_id = frames().map;
  message.header.stamp = stamp;
  message.vector.x = v.x();
  message.vector.y = v.y();
  return message;
}

void set(const Eigen::Vector3d& v, geometry_msgs::Vector3& message) {
  message.x = v.x();
  message.y = v.y();
  message.z = v.z();
}

}  // namespace

PlantPublisher::PlantPublisher(ros::NodeHandle& node, const plant::LidarOptions& lidar)
    : clock_(node.advertise<rosgraph_msgs::Clock>("/clock", kKept)),
      odometry_(node.advertise<nav_msgs::Odometry>("odom", kKept)),
      ground_truth_(node.advertise<nav_msgs::Odometry>("ground_truth", kKept)),
      state_(node.advertise<PlantState>("plant_state", kKept)),
      scan_(node.advertise<sensor_msgs::LaserScan>("scan", kKept)),
      radar_(node.advertise<geometry_msgs::PoseArray>("radar", kKept)),
      ais_(node.advertise<std_msgs::String>("ais", kKept)),
      vessels_(node.advertise<Tracks>("vessels", kKept)),
      contact_(node.advertise<ContactEvent>("contact", kKept, true)),
      wind_(node.advertise<geometry_msgs::Vector3Stamped>("wind", kKept)),
      current_(node.advertise<geometry_msgs::Vector3Stamped>("current", kKept)),
      trail_(node, "trail"),
      transforms_(node.advertise<tf2_msgs::TFMessage>("/tf", kKept, true)) {
  // A GNSS-aided navigation system is simulated, so odom and map coincide.
  static_transforms_.sendTransform(
      {transformOf(frames().map, frames().odom, Eigen::Vector3d::Zero(), ros::Time()),
       transformOf(frames().base, frames().lidar, lidar.position_m, ros::Time())});
}

void PlantPublisher::publish(const plant::Simulator& simulator, const ros::Time& stamp) {
  rosgraph_msgs::Clock clock;
  clock.clock = stamp;
  clock_.publish(clock);
  publishTruth(simulator, stamp);
  publishContact(simulator, stamp);
  if (stamp >= next_weather_) {
    publishWeather(simulator.truth(), stamp);
    publishVessels(simulator, stamp);
    next_weather_ = stamp + ros::Duration(kWeatherPeriodS);
  }
  // Last, because the tracker's answer lets time go on.
  publishOdometry(simulator, stamp);
}

void PlantPublisher::publishOdometry(const plant::Simulator& simulator, const ros::Time& stamp) {
  const plant::Odometry& odometry = simulator.odometry();
  const vessel::State& state = odometry.state;
  const ros::Duration age(simulator.time() - odometry.stamp_s);
  nav_msgs::Odometry& message = last_odometry_;
  message.header.frame_id = frames().odom;
  message.header.stamp = stamp - age;
  message.child_frame_id = frames().base;
  message.pose.pose.position = toPoint(state.head<2>(), odometry.z_m);
  message.pose.pose.orientation =
      toQuaternion(odometry.roll_rad, odometry.pitch_rad, state[vessel::kPsi]);
  // The twist is in the body's axes, which roll and pitch; the state's velocities are level.
  const Eigen::Matrix3d level_from_body =
      attitude(odometry.roll_rad, odometry.pitch_rad, 0.0).toRotationMatrix();
  set(level_from_body.transpose() *
          Eigen::Vector3d(state[vessel::kSurge], state[vessel::kSway], 0.0),
      message.twist.twist.linear);
  set(level_from_body.transpose() * Eigen::Vector3d(0.0, 0.0, state[vessel::kYawRate]),
      message.twist.twist.angular);

  geometry_msgs::TransformStamped base;
  base.header = message.header;
  base.child_frame_id = frames().base;
  base.transform.translation.x = message.pose.pose.position.x;
  base.transform.translation.y = message.pose.pose.position.y;
  base.transform.translation.z = message.pose.pose.position.z;
  base.transform.rotation = message.pose.pose.orientation;
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(base);
  transforms_.publish(transforms);
  odometry_.publish(message);
}

void PlantPublisher::publishTruth(const plant::Simulator& simulator, const ros::Time& stamp) {
  const plant::Truth& truth = simulator.truth();
  nav_msgs::Odometry pose;
  pose.header.frame_id = frames().map;
  pose.header.stamp = stamp;
  pose.child_frame_id = frames().base;
  pose.pose.pose.position = toPoint(truth.position.head<2>(), truth.position.z());
  pose.pose.pose.orientation = toQuaternion(truth.roll_rad, truth.pitch_rad, truth.yaw_rad);
  set(truth.velocity_in_body, pose.twist.twist.linear);
  set(truth.angular_velocity_in_body, pose.twist.twist.angular);
  ground_truth_.publish(pose);
  trail_.add(pose.pose.pose, frames().map, stamp);

  PlantState& state = last_state_;
  state.header = pose.header;
  state.x = truth.position.x();
  state.y = truth.position.y();
  state.z = truth.position.z();
  state.roll = truth.roll_rad;
  state.pitch = truth.pitch_rad;
  state.yaw = truth.yaw_rad;
  state.u = truth.planar[vessel::kSurge];
  state.v = truth.planar[vessel::kSway];
  state.r = truth.planar[vessel::kYawRate];
  state.thrust_left = truth.thrusts_n[vessel::kLeft];
  state.thrust_right = truth.thrusts_n[vessel::kRight];
  state.clearance = simulator.clearance();
  state.in_contact = static_cast<std::uint8_t>(simulator.inContact());
  state_.publish(state);
}

void PlantPublisher::publishWeather(const plant::Truth& truth, const ros::Time& stamp) {
  wind_.publish(vectorMessage(truth.wind_mps, stamp));
  current_.publish(vectorMessage(truth.current_mps, stamp));
}

// The truth of others, as tracks that are certain.
void PlantPublisher::publishVessels(const plant::Simulator& simulator, const ros::Time& stamp) {
  std::vector<traffic::Track> truth;
  for (const plant::OtherVessel& other : simulator.others()) {
    const double psi = other.motion.pose.psi_rad;
    traffic::Track track;
    track.id = other.id;
    track.stamp_s = stamp.toSec();
    track.position = other.motion.pose.position;
    track.velocity = other.motion.speed_mps * unitVector(psi);
    track.heading_rad = psi;
    track.length_m = other.hull.length_m;
    track.beam_m = other.hull.beam_m;
    truth.push_back(track);
  }
  if (!truth.empty()) {
    vessels_.publish(toMessage(truth, stamp));
  }
}

void PlantPublisher::publishRadar(const std::vector<Eigen::Vector2d>& radar_in_base,
                                  const ros::Time& stamp) {
  geometry_msgs::PoseArray message;
  message.header.frame_id = frames().base;
  message.header.stamp = stamp;
  for (const Eigen::Vector2d& position : radar_in_base) {
    message.poses.push_back(toPose({position, 0.0}));
  }
  radar_.publish(message);
}

void PlantPublisher::publishAis(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) {
    std_msgs::String message;
    message.data = sentence;
    ais_.publish(message);
  }
}

void PlantPublisher::publishContact(const plant::Simulator& simulator, const ros::Time& stamp) {
  if (simulator.inContact() == in_contact_) {
    return;
  }
  in_contact_ = simulator.inContact();
  const plant::Truth& truth = simulator.truth();
  ContactEvent event;
  event.header.frame_id = frames().map;
  event.header.stamp = stamp;
  event.in_contact = static_cast<std::uint8_t>(in_contact_);
  event.position = toPoint(truth.position.head<2>());
  event.speed = vessel::speedOf(truth.planar);
  contact_.publish(event);
}

void PlantPublisher::publishScan(const Scan& scan, const ros::Time& stamp) {
  sensor_msgs::LaserScan& message = last_scan_;
  message.header.frame_id = frames().lidar;
  message.header.stamp = stamp;
  message.angle_min = static_cast<float>(scan.angle_min_rad);
  message.angle_increment = static_cast<float>(scan.angle_increment_rad);
  message.angle_max =
      static_cast<float>(scan.angle_min_rad + scan.angle_increment_rad *
                                                  (static_cast<double>(scan.ranges_m.size()) - 1));
  message.range_min = static_cast<float>(scan.range_min_m);
  message.range_max = static_cast<float>(scan.range_max_m);
  message.ranges = scan.ranges_m;
  scan_.publish(message);
}

void PlantPublisher::repeat() {
  rosgraph_msgs::Clock clock;
  clock.clock = last_odometry_.header.stamp;
  clock_.publish(clock);
  state_.publish(last_state_);
  odometry_.publish(last_odometry_);
  if (!last_scan_.header.frame_id.empty()) {
    scan_.publish(last_scan_);
  }
}

}  // namespace otter_nav::nodes
