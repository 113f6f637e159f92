// Trajectories between messages and the core.
#pragma once

#include <nav_msgs/Path.h>
#include <otter_nav/Trajectory.h>

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/trajectory/timed_trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::ros_bridge {

[[nodiscard]] Trajectory toMessage(const trajectory::TimedTrajectory& timed, std::uint32_t id,
                                   const vessel::Pose& goal, const std::string& frame,
                                   const vessel::Parameters& vessel);

// An empty trajectory is valid: it asks for a controlled stop. An error names the field and piece:
// frame, stamp, speed limit, number of pieces, kind, duration, coefficients that are not finite or
// pieces that do not join.
[[nodiscard]] Result<trajectory::TimedTrajectory> toTrajectory(const Trajectory& message,
                                                               const std::string& frame);

// Poses each `step_s`, stamped with the time the vessel is to pass them.
[[nodiscard]] nav_msgs::Path toPath(const trajectory::Trajectory& trajectory, double start_s,
                                    double step_s, const std::string& frame,
                                    const vessel::Parameters& vessel);

}  // namespace otter_nav::ros_bridge
