#include "simulation/sensing.hpp"

#include <limits>
#include <utility>

namespace otter_nav::simulation {
namespace {

map::SensorPose sensorPose(const plant::Odometry& odometry, const Eigen::Vector3d& lidar_in_base) {
  map::SensorPose pose;
  pose.roll_rad = odometry.roll_rad;
  pose.pitch_rad = odometry.pitch_rad;
  pose.yaw_rad = odometry.state[vessel::kPsi];
  const Eigen::Vector3d base(odometry.state[vessel::kX], odometry.state[vessel::kY], odometry.z_m);
  pose.position = base + attitude(pose.roll_rad, pose.pitch_rad, pose.yaw_rad) * lidar_in_base;
  return pose;
}

}  // namespace

Sensing::Sensing(map::OccupancyGrid chart, const LoopOptions& options)
    : map_(std::move(chart), options.vessel.hull, options.map),
      field_(map_.projection(), {options.field_distance_m, false}),
      known_(map_.projection(), {map::kKnownWaterDistanceM, true}),
      traffic_(options.traffic, map_.chart(), options.vessel.hull),
      lidar_in_base_(options.plant.lidar.position_m) {}

Status Sensing::insert(Scan scan, const plant::Odometry& odometry) {
  const map::SensorPose pose = sensorPose(odometry, lidar_in_base_);
  const vessel::Pose own{odometry.state.head<2>(), odometry.state[vessel::kPsi]};
  // What moves stays out of the map, and what it has left there.
  const traffic::ScanVerdict& verdict = traffic_.addScan(odometry.stamp_s, pose, own, scan);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (verdict.on_vessel[i]) {
      scan.ranges_m[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  update(map_.forget(verdict.ghosts));
  update(map_.fill(verdict.lying));
  if (!field_.geometry().contains(pose.position.head<2>())) {
    return {};
  }
  const Result<map::CellRectangle> changed = map_.insertScan(pose, own, scan);
  if (!changed) {
    return failure(changed.error().message);
  }
  update(*changed);
  return {};
}

void Sensing::update(const map::CellRectangle& changed) {
  field_.update(map_.projection(), changed);
  known_.update(map_.projection(), changed);
}

void Sensing::hear(const std::vector<Eigen::Vector2d>& radar_in_base,
                   const plant::Odometry& odometry) {
  const vessel::Pose own{odometry.state.head<2>(), odometry.state[vessel::kPsi]};
  traffic_.addRadar(odometry.stamp_s, vessel::toMap(own, radar_in_base), own.position);
}

Status Sensing::hear(double stamp_s, const std::vector<std::string>& ais) {
  for (const std::string& sentence : ais) {
    if (Status status = traffic_.addAis(stamp_s, sentence); !status) {
      return status;
    }
  }
  return {};
}

}  // namespace otter_nav::simulation
