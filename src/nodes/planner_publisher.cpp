#include "planner_publisher.hpp"

#include <nav_msgs/Path.h>
#include <otter_nav/NearObstacles.h>
#include <otter_nav/Trajectory.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <utility>

#include "otter_nav/base/statistics.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/near_obstacles.hpp"
#include "otter_nav/ros/plan_markers.hpp"
#include "otter_nav/ros/trajectories.hpp"

namespace otter_nav::nodes {
namespace {

using ros_bridge::frames;

constexpr int kKept = 100;
constexpr std::size_t kPlansTold = 1000;  // by the median of their times
constexpr double kPathStepS = 0.25;

}  // namespace

PlannerPublisher::PlannerPublisher(ros::NodeHandle& node, vessel::Parameters vessel,
                                   std::uint32_t ids_after)
    : vessel_(std::move(vessel)),
      last_id_(ids_after),
      last_near_id_(ids_after),
      trajectory_(node.advertise<Trajectory>("trajectory", kKept, true)),
      near_obstacles_(node.advertise<NearObstacles>("near_obstacles", kKept, true)),
      path_(node.advertise<nav_msgs::Path>("path", kKept, true)),
      status_publisher_(node.advertise<PlannerStatus>("planner_status", kKept)),
      trajectory_markers_(
          node.advertise<visualization_msgs::MarkerArray>("trajectory_markers", kKept, true)),
      tree_markers_(node.advertise<visualization_msgs::MarkerArray>("tree_markers", kKept, true)) {
  status_.header.frame_id = frames().map;
}

std::uint32_t PlannerPublisher::publish(const trajectory::TimedTrajectory& order,
                                        const vessel::Pose& goal) {
  trajectory_.publish(ros_bridge::toMessage(order, ++last_id_, goal, frames().map, vessel_));
  path_.publish(
      ros_bridge::toPath(order.trajectory, order.start_time_s, kPathStepS, frames().map, vessel_));
  return last_id_;
}

std::uint32_t PlannerPublisher::publishNear(double start_s, std::vector<Eigen::Vector2d> points) {
  near_obstacles_.publish(
      ros_bridge::toMessage({start_s, std::move(points)}, ++last_near_id_, frames().map));
  return last_near_id_;
}

std::uint32_t PlannerPublisher::publishStop(double now_s, const vessel::Pose& goal) {
  return publish({trajectory::Trajectory(), now_s}, goal);
}

void PlannerPublisher::show(const mission::Supervisor& supervisor,
                            const map::DistanceField& field) {
  const trajectory::Trajectory& sailed = supervisor.sailed().trajectory;
  visualization_msgs::MarkerArray all = ros_bridge::trajectoryMarkers(sailed, vessel_);
  for (const auto& more :
       {ros_bridge::clearanceMarkers(sailed, supervisor.plannedClearance(), field),
        ros_bridge::goalMarkers(supervisor.goal())}) {
    all.markers.insert(all.markers.end(), more.markers.begin(), more.markers.end());
  }
  trajectory_markers_.publish(all);
}

void PlannerPublisher::publishPlan(const planner::Plan& plan, double wall_ms) {
  const planner::Figures& figures = plan.figures;
  planning_ms_.push_back(wall_ms);
  if (planning_ms_.size() > kPlansTold) {
    planning_ms_.erase(planning_ms_.begin());
  }
  status_.outcome = planner::toString(plan.outcome);
  status_.plans += 1;
  status_.length = figures.length_m;
  status_.duration = figures.duration_s;
  status_.cost = figures.cost;
  status_.node_utilization = figures.node_utilization;
  status_.samples = static_cast<std::uint32_t>(figures.samples);
  status_.nodes = static_cast<std::uint32_t>(figures.nodes);
  status_.first_solution_ms = figures.first_solution_ms;
  status_.planning_ms = wall_ms;
  status_.planning_ms_median = quantile(planning_ms_, 0.5);
  status_.planning_ms_max = std::max(status_.planning_ms_max, wall_ms);
  tree_markers_.publish(ros_bridge::treeMarkers(plan));
}

void PlannerPublisher::publishStatus(const mission::Supervisor& supervisor, double now_s,
                                     std::uint32_t trajectory_id) {
  status_.header.stamp = ros_bridge::toRosTime(now_s);
  status_.state = mission::name(supervisor.phase());
  status_.reason = supervisor.reason();
  status_.clearance = supervisor.plannedClearance();
  status_.encounters.clear();
  for (const encounter::Encounter& encounter : supervisor.encounters()) {
    status_.encounters.push_back(encounter::describe(encounter));
  }
  const mission::Replans replans = supervisor.replans();
  status_.replans = static_cast<std::uint32_t>(replans.all);
  status_.replans_for_weather = static_cast<std::uint32_t>(replans.for_weather);
  status_.trajectory_id = trajectory_id;
  status_publisher_.publish(status_);
}

}  // namespace otter_nav::nodes
