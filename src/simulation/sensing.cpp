#include "simulation/sensing.hpp"

#include <Eigen/Geometry>
#include <utility>

namespace otter_nav::simulation {
namespace {

map::SensorPose sensorPose(const plant::Odometry& odometry, const Eigen::Vector3d& lidar_in_base) {
  map::SensorPose pose;
  pose.roll_rad = odometry.roll_rad;
  pose.pitch_rad = odometry.pitch_rad;
  pose.yaw_rad = odometry.state[vessel::kPsi];
  const Eigen::Quaterniond map_from_base =
      Eigen::AngleAxisd(pose.yaw_rad, Eigen::Vector3d::UnitZ()) *
      Eigen::AngleAxisd(pose.pitch_rad, Eigen::Vector3d::UnitY()) *
      Eigen::AngleAxisd(pose.roll_rad, Eigen::Vector3d::UnitX());
  const Eigen::Vector3d base(odometry.state[vessel::kX], odometry.state[vessel::kY], odometry.z_m);
  pose.position = base + map_from_base * lidar_in_base;
  return pose;
}

}  // namespace

Sensing::Sensing(map::OccupancyGrid chart, const LoopOptions& options)
    : map_(std::move(chart), options.vessel.hull, options.map),
      field_(map_.projection(), {options.field_distance_m, false}),
      lidar_in_base_(options.plant.lidar.position_m) {}

Status Sensing::insert(const plant::Scan& scan, const plant::Odometry& odometry) {
  scan_.angle_min_rad = scan.angle_min_rad;
  scan_.angle_increment_rad = scan.angle_increment_rad;
  scan_.range_min_m = scan.range_min_m;
  scan_.range_max_m = scan.range_max_m;
  scan_.ranges_m.assign(scan.ranges.begin(), scan.ranges.end());
  const map::SensorPose pose = sensorPose(odometry, lidar_in_base_);
  if (!field_.geometry().contains(pose.position.head<2>())) {
    return {};
  }
  const Result<map::CellRectangle> changed =
      map_.insertScan(pose, {odometry.state.head<2>(), odometry.state[vessel::kPsi]}, scan_);
  if (!changed) {
    return failure(changed.error().message);
  }
  if (!changed->empty()) {
    field_.update(map_.projection(), changed->column, changed->row, changed->width,
                  changed->height);
  }
  return {};
}

}  // namespace otter_nav::simulation
