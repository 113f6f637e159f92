// What a bag holds of one run of a tracker. Knows no ROS.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/tracker/near_obstacles.hpp"
#include "otter_nav/tracker/options.hpp"
#include "otter_nav/trajectory/timed_trajectory.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::replay {

struct RecordedOdometry {
  double stamp_s = 0.0;
  vessel::State state = vessel::State::Zero();
  double bow_up_rad = 0.0;
};

// A trajectory, or an order to stop if it is empty. `position` is its place among all messages.
struct RecordedOrder {
  std::uint32_t id = 0;
  std::size_t position = 0;
  trajectory::TimedTrajectory timed;
};

struct RecordedNearObstacles {
  std::uint32_t id = 0;
  std::size_t position = 0;
  tracker::NearObstacles near;
};

// One control step (TrackerCycle.msg).
struct RecordedCycle {
  double time_s = 0.0;
  std::uint64_t number = 0;  // 0: put together from a command, without what the tracker says of it
  std::uint64_t odometry_taken = 0;
  double odometry_stamp_s = 0.0;
  std::uint32_t order_taken = 0;
  std::uint32_t near_taken = 0;
  tracker::Weights weights;  // in force
  std::size_t position = 0;
  vessel::Thrusts thrusts_n = vessel::Thrusts::Zero();
  vessel::State reference = vessel::State::Zero();
  vessel::State estimate = vessel::State::Zero();
  vessel::Disturbance disturbance;
  bool tracking = false;
};

struct RecordedRun {
  std::vector<RecordedOdometry> odometry;  // as the node takes it: stamps never go backwards
  std::vector<RecordedOrder> orders;
  std::vector<RecordedNearObstacles> near;
  std::vector<RecordedCycle> cycles;
  std::string parameters;  // of tracker_node, YAML; empty if not recorded
  std::string vessel;      // its file, YAML; empty if not recorded
  bool lockstep = true;    // by `parameters`
  bool from_commands = false;
  std::vector<std::string> notes;  // what is missing
};

struct ReadOptions {
  int run = 1;                    // of several, from 1
  std::string name_space;         // of the vessel; empty: the only one there is
  std::string odometry = "odom";  // its topic
  bool partial = false;           // use what is there
};
// Errors name the file and what is missing; with `partial` that becomes a note where anything can
// be done without.
[[nodiscard]] Result<RecordedRun> readRun(const std::string& path, const ReadOptions& options);

}  // namespace otter_nav::replay
