#include "otter_nav/ros/scans.hpp"

#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/frames.hpp"

namespace otter_nav::ros_bridge {

Scan toScan(const sensor_msgs::LaserScan& message) {
  Scan scan;
  scan.angle_min_rad = static_cast<double>(message.angle_min);
  scan.angle_increment_rad = static_cast<double>(message.angle_increment);
  scan.range_min_m = static_cast<double>(message.range_min);
  scan.range_max_m = static_cast<double>(message.range_max);
  scan.ranges_m = message.ranges;
  return scan;
}

Result<map::SensorPose> poseInMap(const tf2_ros::Buffer& transforms, const std::string& frame,
                                  const ros::Time& stamp) {
  try {
    const geometry_msgs::Transform transform =
        transforms.lookupTransform(frames().map, frame, stamp).transform;
    const Eigen::Vector3d angles = rollPitchYaw(
        {transform.rotation.w, transform.rotation.x, transform.rotation.y, transform.rotation.z});
    map::SensorPose pose;
    pose.position = {transform.translation.x, transform.translation.y, transform.translation.z};
    pose.roll_rad = angles.x();
    pose.pitch_rad = angles.y();
    pose.yaw_rad = angles.z();
    return pose;
  } catch (const tf2::TransformException& exception) {
    return failure(exception.what());
  }
}

Result<vessel::Pose> hullInMap(const tf2_ros::Buffer& transforms, const ros::Time& stamp) {
  return poseInMap(transforms, frames().base, stamp).map([](const map::SensorPose& base) {
    return vessel::Pose{base.position.head<2>(), base.yaw_rad};
  });
}

}  // namespace otter_nav::ros_bridge
