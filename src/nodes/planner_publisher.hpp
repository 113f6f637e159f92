// What the planner tells the world: trajectories for the tracker, paths and trees for people, and
// its status with the paper's figures.
#pragma once

#include <otter_nav/PlannerStatus.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::nodes {

class PlannerPublisher {
 public:
  // Trajectories' and near obstacles' ids rise from `ids_after` on.
  PlannerPublisher(ros::NodeHandle& node, vessel::Parameters vessel, std::uint32_t ids_after);

  // Publishes the order under a new id and returns that.
  std::uint32_t publish(const trajectory::TimedTrajectory& order, const vessel::Pose& goal);
  // Publishes what lies near, in force from `start_s` on; returns its id.
  std::uint32_t publishNear(double start_s, std::vector<Eigen::Vector2d> points);
  // Asks the tracker to stop by itself: an empty trajectory.
  std::uint32_t publishStop(double now_s, const vessel::Pose& goal);
  // The way sailed, its clearance on the map as it is now, and the goal.
  void show(const mission::Supervisor& supervisor, const map::DistanceField& field);
  void publishPlan(const planner::Plan& plan, double wall_ms);
  void publishStatus(const mission::Supervisor& supervisor, double now_s,
                     std::uint32_t trajectory_id);

 private:
  vessel::Parameters vessel_;
  std::uint32_t last_id_;
  std::uint32_t last_near_id_;
  PlannerStatus status_;
  std::vector<double> planning_ms_;  // of the last plans
  ros::Publisher trajectory_;
  ros::Publisher near_obstacles_;
  ros::Publisher path_;
  ros::Publisher status_publisher_;
  ros::Publisher trajectory_markers_;
  ros::Publisher tree_markers_;
};

}  // namespace otter_nav::nodes
