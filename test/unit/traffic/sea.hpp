// A plant with other vessels whose sensors a traffic tracker listens to.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "otter_nav/base/attitude.hpp"
#include "otter_nav/plant/simulator.hpp"
#include "otter_nav/traffic/tracker.hpp"

namespace otter_nav::traffic::test {

inline plant::Options plantOptions(const std::string& disturbance = "none") {
  const std::string config = std::string(OTTER_NAV_SOURCE_DIR) + "/config/";
  return plant::loadOptions(vessel::loadParameters(config + "vessels/otter_gazebo.yaml").value(),
                            config + "plant.yaml", config + "disturbances/" + disturbance + ".yaml")
      .value();
}

class Sea {
 public:
  Sea(const plant::Options& options, const map::OccupancyGrid& world,
      std::vector<vessel::ScriptedVessel> vessels, std::uint64_t seed)
      : simulator(options, world, seed),
        tracker(Options{}, map::OccupancyGrid{}, options.vessel.hull) {
    scripts = vessels;
    simulator.setVessels(std::move(vessels));
    simulator.placeAt({0.0, 0.0}, 0.0);
  }

  // To `time_s` under constant thrusts; `each` after every scan.
  void run(double time_s, const vessel::Thrusts& thrusts,
           const std::function<void(const ScanVerdict&)>& each = {}) {
    while (simulator.time() < time_s) {
      simulator.step(thrusts, 0.01);
      if (simulator.scanDue()) {
        const ScanVerdict& verdict = look();
        if (each) {
          each(verdict);
        }
      }
      if (simulator.radarDue()) {
        const vessel::State& own = simulator.odometry().state;
        tracker.addRadar(simulator.time(),
                         vessel::toMap({own.head<2>(), own[vessel::kPsi]}, simulator.radar()),
                         own.head<2>());
      }
      for (const std::string& sentence : simulator.takeAis()) {
        ASSERT_TRUE(tracker.addAis(simulator.time(), sentence));
      }
    }
  }

  // Changes a scan before it is looked at.
  std::function<void(Scan&)> disturb;

  // The track of a vessel: the nearest one within 5 m of where she truly was at its stamp.
  [[nodiscard]] std::optional<Track> trackOf(std::size_t index) const {
    std::optional<Track> best;
    double nearest = 5.0;
    for (const Track& track : tracker.tracks()) {
      const double off = (track.position - trueMotion(index, track.stamp_s).pose.position).norm();
      if (off < nearest) {
        nearest = off;
        best = track;
      }
    }
    return best;
  }
  [[nodiscard]] vessel::ScriptedMotion trueMotion(std::size_t index, double time_s) const {
    return vessel::motionAt(scripts[index], time_s);
  }

  plant::Simulator simulator;
  Tracker tracker;
  std::vector<vessel::ScriptedVessel> scripts;

 private:
  const ScanVerdict& look() {
    Scan seen = simulator.scan();
    const plant::Odometry& odometry = simulator.odometry();
    if (disturb) {
      disturb(seen);
    }
    const double psi = odometry.state[vessel::kPsi];
    const Eigen::Matrix3d rotation =
        attitude(odometry.roll_rad, odometry.pitch_rad, psi).toRotationMatrix();
    map::SensorPose pose;
    pose.position =
        Eigen::Vector3d(odometry.state[vessel::kX], odometry.state[vessel::kY], odometry.z_m) +
        rotation * simulator.options().lidar.position_m;
    pose.roll_rad = odometry.roll_rad;
    pose.pitch_rad = odometry.pitch_rad;
    pose.yaw_rad = psi;
    return tracker.addScan(odometry.stamp_s, pose, {odometry.state.head<2>(), psi}, seen);
  }
};

// Normalised estimation error squared of position and velocity: 4 on average if the covariance is
// what it claims to be.
inline double nees(const Track& track, const vessel::ScriptedMotion& truth) {
  Eigen::Vector4d off;
  off << track.position - truth.pose.position,
      track.velocity - truth.speed_mps * Eigen::Vector2d(std::cos(truth.pose.psi_rad),
                                                         std::sin(truth.pose.psi_rad));
  return off.dot(track.covariance.inverse() * off);
}

}  // namespace otter_nav::traffic::test
