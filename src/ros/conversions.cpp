#include "otter_nav/ros/conversions.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/attitude.hpp"
#include "otter_nav/base/text.hpp"
#include "otter_nav/ros/frames.hpp"

namespace otter_nav::ros_bridge {
namespace {

constexpr double kNormTolerance = 0.05;

Result<Eigen::Quaterniond> rotation(const geometry_msgs::Quaternion& message) {
  const Eigen::Quaterniond q(message.w, message.x, message.y, message.z);
  if (!q.coeffs().allFinite() || std::abs(q.norm() - 1.0) > kNormTolerance) {
    return failure("orientation is not a unit quaternion");
  }
  return q.normalized();
}

bool allFinite(const geometry_msgs::Vector3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Eigen::Vector3d toEigen(const geometry_msgs::Vector3& v) {
  return {v.x, v.y, v.z};
}

Status checkHeader(const nav_msgs::Odometry& message, const std::string& frame,
                   const std::string& child_frame) {
  if (Status status = checkFrame(message.header.frame_id, frame); !status) {
    return status;
  }
  if (const Status status = checkFrame(message.child_frame_id, child_frame); !status) {
    return failure("child " + status.error().message);
  }
  if (message.header.stamp.isZero()) {
    return failure("header.stamp is zero");
  }
  return {};
}

}  // namespace

ros::Time toRosTime(double time_s) {
  ros::Time time;
  return time.fromNSec(static_cast<std::uint64_t>(std::llround(time_s * 1e9)));
}

geometry_msgs::Point toPoint(const Eigen::Vector2d& p, double z_m) {
  geometry_msgs::Point point;
  point.x = p.x();
  point.y = p.y();
  point.z = z_m;
  return point;
}

geometry_msgs::Quaternion toQuaternion(double roll_rad, double pitch_rad, double yaw_rad) {
  const Eigen::Quaterniond q = attitude(roll_rad, pitch_rad, yaw_rad);
  geometry_msgs::Quaternion message;
  message.w = q.w();
  message.x = q.x();
  message.y = q.y();
  message.z = q.z();
  return message;
}

geometry_msgs::Pose toPose(const vessel::Pose& pose) {
  geometry_msgs::Pose message;
  message.position = toPoint(pose.position);
  message.orientation = toQuaternion(0.0, 0.0, pose.psi_rad);
  return message;
}

geometry_msgs::PoseStamped toPose(const vessel::Pose& pose, const std::string& frame,
                                  const ros::Time& stamp) {
  geometry_msgs::PoseStamped message;
  message.header.frame_id = frame;
  message.header.stamp = stamp;
  message.pose = toPose(pose);
  return message;
}

Eigen::Vector3d rollPitchYaw(const Eigen::Quaterniond& q) {
  const double roll = std::atan2(2.0 * (q.w() * q.x() + q.y() * q.z()),
                                 1.0 - 2.0 * (q.x() * q.x() + q.y() * q.y()));
  const double sine = std::clamp(2.0 * (q.w() * q.y() - q.z() * q.x()), -1.0, 1.0);
  const double yaw = std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()),
                                1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
  return {roll, std::asin(sine), yaw};
}

Result<vessel::Pose> planarPose(const geometry_msgs::Pose& pose) {
  if (!std::isfinite(pose.position.x) || !std::isfinite(pose.position.y)) {
    return failure("position is not finite");
  }
  const Result<Eigen::Quaterniond> q = rotation(pose.orientation);
  if (!q) {
    return failure(q.error().message);
  }
  return vessel::Pose{{pose.position.x, pose.position.y}, rollPitchYaw(*q).z()};
}

Result<vessel::Pose> planarPose(const geometry_msgs::PoseStamped& pose, const std::string& frame) {
  return checkFrame(pose.header.frame_id, frame).and_then([&] { return planarPose(pose.pose); });
}

Result<OdometrySample> odometrySample(const nav_msgs::Odometry& message, const std::string& frame,
                                      const std::string& child_frame) {
  if (const Status header = checkHeader(message, frame, child_frame); !header) {
    return failure(header.error().message);
  }
  const Result<vessel::Pose> pose = planarPose(message.pose.pose);
  if (!pose) {
    return failure("pose: " + pose.error().message);
  }
  if (!allFinite(message.twist.twist.linear) || !allFinite(message.twist.twist.angular)) {
    return failure("twist is not finite");
  }
  const Eigen::Quaterniond q = *rotation(message.pose.pose.orientation);
  const Eigen::Vector3d angles = rollPitchYaw(q);
  const Eigen::Quaterniond level_from_body =
      Eigen::AngleAxisd(-angles.z(), Eigen::Vector3d::UnitZ()) * q;
  const Eigen::Vector3d velocity = level_from_body * toEigen(message.twist.twist.linear);
  const Eigen::Vector3d rates = level_from_body * toEigen(message.twist.twist.angular);
  OdometrySample sample;
  sample.stamp_s = message.header.stamp.toSec();
  sample.roll_rad = angles.x();
  sample.pitch_rad = angles.y();
  sample.state << pose->position, angles.z(), velocity.x(), velocity.y(), rates.z();
  return sample;
}

std_msgs::ColorRGBA color(double red, double green, double blue, double alpha) {
  std_msgs::ColorRGBA value;
  value.r = static_cast<float>(red);
  value.g = static_cast<float>(green);
  value.b = static_cast<float>(blue);
  value.a = static_cast<float>(alpha);
  return value;
}

DisturbanceEstimate toMessage(const vessel::DisturbanceEstimate& estimate) {
  const vessel::Disturbance& mean = estimate.mean;
  DisturbanceEstimate message;
  message.force = {mean.force_n.x(), mean.force_n.y()};
  message.moment = mean.moment_nm;
  message.current = {mean.current_mps.x(), mean.current_mps.y()};
  message.wind = {mean.wind_mps.x(), mean.wind_mps.y()};
  for (int i = 0; i < estimate.covariance.size(); ++i) {  // symmetric: rows or columns first
    message.covariance[static_cast<std::size_t>(i)] = estimate.covariance.data()[i];
  }
  message.knows_waves = static_cast<std::uint8_t>(estimate.knows_waves);
  return message;
}

Result<vessel::DisturbanceEstimate> disturbanceEstimate(const DisturbanceEstimate& message) {
  vessel::DisturbanceEstimate estimate;
  vessel::Disturbance& mean = estimate.mean;
  mean.force_n = {message.force[0], message.force[1]};
  mean.moment_nm = message.moment;
  mean.current_mps = {message.current[0], message.current[1]};
  mean.wind_mps = {message.wind[0], message.wind[1]};
  for (int i = 0; i < estimate.covariance.size(); ++i) {
    estimate.covariance.data()[i] = message.covariance[static_cast<std::size_t>(i)];
  }
  estimate.knows_waves = message.knows_waves != 0;
  const struct {
    const char* name;
    bool finite;
  } fields[] = {{"force", mean.force_n.allFinite()},
                {"moment", std::isfinite(mean.moment_nm)},
                {"current", mean.current_mps.allFinite()},
                {"wind", mean.wind_mps.allFinite()},
                {"covariance", estimate.covariance.allFinite()}};
  for (const auto& field : fields) {
    if (!field.finite) {
      return failure(std::string("disturbance estimate: ") + field.name + " is not finite");
    }
  }
  return estimate;
}

Foreseen toMessage(const vessel::Foreseen& foreseen) {
  Foreseen message;
  message.start = toRosTime(foreseen.start_s);
  message.step = foreseen.step_s;
  for (const vessel::Pose& pose : foreseen.poses) {
    message.x.push_back(pose.position.x());
    message.y.push_back(pose.position.y());
    message.heading.push_back(pose.psi_rad);
  }
  return message;
}

Result<vessel::Foreseen> toForeseen(const Foreseen& message) {
  if (message.x.size() != message.y.size() || message.x.size() != message.heading.size()) {
    return failure(text("foreseen: x, y and heading hold %zu, %zu and %zu", message.x.size(),
                        message.y.size(), message.heading.size()));
  }
  vessel::Foreseen foreseen{message.start.toSec(), message.step, {}};
  if (!std::isfinite(foreseen.step_s) || foreseen.step_s < 0.0) {
    return failure(text("foreseen: step is %g s", foreseen.step_s));
  }
  for (std::size_t k = 0; k < message.x.size(); ++k) {
    const vessel::Pose pose{{message.x[k], message.y[k]}, message.heading[k]};
    if (!pose.position.allFinite() || !std::isfinite(pose.psi_rad)) {
      return failure(text("foreseen: place %zu is not finite", k));
    }
    foreseen.poses.push_back(pose);
  }
  return foreseen;
}

}  // namespace otter_nav::ros_bridge
