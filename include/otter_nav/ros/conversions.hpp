// Times, poses and odometry between messages and the core's plane.
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <otter_nav/DisturbanceEstimate.h>
#include <otter_nav/Foreseen.h>
#include <ros/time.h>
#include <std_msgs/ColorRGBA.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/pose.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::ros_bridge {

// Whole nanoseconds, so that a time survives the way there and back.
[[nodiscard]] ros::Time toRosTime(double time_s);

[[nodiscard]] geometry_msgs::Point toPoint(const Eigen::Vector2d& p, double z_m = 0.0);
[[nodiscard]] geometry_msgs::Quaternion toQuaternion(double roll_rad, double pitch_rad,
                                                     double yaw_rad);
[[nodiscard]] geometry_msgs::Pose toPose(const vessel::Pose& pose);
[[nodiscard]] geometry_msgs::PoseStamped toPose(const vessel::Pose& pose, const std::string& frame,
                                                const ros::Time& stamp);

// Roll, pitch, yaw (yaw first, then pitch, then roll, in moving axes); `q` of norm 1.
[[nodiscard]] Eigen::Vector3d rollPitchYaw(const Eigen::Quaterniond& q);

// A pose in the plane. An error names the field that is not finite or no rotation.
[[nodiscard]] Result<vessel::Pose> planarPose(const geometry_msgs::Pose& pose);
// The same, and the frame has to be `frame`.
[[nodiscard]] Result<vessel::Pose> planarPose(const geometry_msgs::PoseStamped& pose,
                                              const std::string& frame);

// A vessel's odometry: pose in `frame`, twist in the body frame `child_frame`. Velocities are
// turned from the rolling and pitching hull into the horizontal plane.
struct OdometrySample {
  double stamp_s = 0.0;
  vessel::State state = vessel::State::Zero();
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
};
[[nodiscard]] Result<OdometrySample> odometrySample(const nav_msgs::Odometry& message,
                                                    const std::string& frame,
                                                    const std::string& child_frame);

// Each in [0, 1].
[[nodiscard]] std_msgs::ColorRGBA color(double red, double green, double blue, double alpha = 1.0);

[[nodiscard]] DisturbanceEstimate toMessage(const vessel::DisturbanceEstimate& estimate);
// An error names the field that is not finite.
[[nodiscard]] Result<vessel::DisturbanceEstimate> disturbanceEstimate(
    const DisturbanceEstimate& message);

[[nodiscard]] Foreseen toMessage(const vessel::Foreseen& foreseen);
// An error names the field that is not finite, or as long as the others.
[[nodiscard]] Result<vessel::Foreseen> toForeseen(const Foreseen& message);

}  // namespace otter_nav::ros_bridge
