#include "otter_nav/ros/plan_markers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/speed_colour.hpp"

namespace otter_nav::ros_bridge {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

// Heights over the water that keep flat things from hiding one another.
constexpr double kRibbonHeightM = 0.01;
constexpr double kTreeHeightM = 0.02;
constexpr double kGuideHeightM = 0.03;
constexpr double kTrajectoryHeightM = 0.05;
constexpr double kTrajectoryStepM = 0.5;
constexpr int kCircleCorners = 24;

// In the map at its origin, for ever; `width_m` is the lines'.
Marker marker(const std::string& name, int type, double width_m, const std_msgs::ColorRGBA& shade) {
  Marker value;
  value.header.frame_id = frames().map;
  value.ns = name;
  value.type = type;
  value.action = Marker::ADD;
  value.pose.orientation.w = 1.0;
  value.scale.x = width_m;
  value.scale.y = width_m;
  value.scale.z = width_m;
  value.color = shade;
  return value;
}

Marker lineStrip(const std::string& name, double width_m, const std_msgs::ColorRGBA& shade,
                 const std::vector<geometry_msgs::Point>& points, double height_m) {
  Marker line = marker(name, Marker::LINE_STRIP, width_m, shade);
  line.points = points;
  for (geometry_msgs::Point& point : line.points) {
    point.z = height_m;
  }
  return line;
}

void addCircle(const geometry_msgs::Point& centre, double radius_m, Marker& lines) {
  const auto corner = [&](int i) {
    const double angle = 2.0 * kPi * i / kCircleCorners;
    return toPoint({centre.x + radius_m * std::cos(angle), centre.y + radius_m * std::sin(angle)},
                   kGuideHeightM);
  };
  for (int i = 0; i < kCircleCorners; ++i) {
    lines.points.push_back(corner(i));
    lines.points.push_back(corner(i + 1));
  }
}

}  // namespace

MarkerArray guidePathMarkers(const GuidePath& path) {
  MarkerArray array;
  array.markers.push_back(
      lineStrip("guide path", 0.25, color(0.95, 0.75, 0.1, 0.9), path.points, kGuideHeightM));
  array.markers.push_back(
      lineStrip("dubins", 0.15, color(0.5, 0.5, 0.5, 0.7), path.dubins, kTreeHeightM));
  Marker corridor = marker("corridor", Marker::LINE_LIST, 0.08, color(0.95, 0.75, 0.1, 0.35));
  for (std::size_t i = 0; i < std::min(path.points.size(), path.corridor_radii.size()); ++i) {
    addCircle(path.points[i], path.corridor_radii[i], corridor);
  }
  array.markers.push_back(corridor);
  for (Marker& each : array.markers) {
    if (each.points.size() < 2) {
      each.action = Marker::DELETE;
    }
  }
  return array;
}

MarkerArray treeMarkers(const planner::Plan& plan) {
  MarkerArray array;
  Marker from_start = marker("tree from start", Marker::LINE_LIST, 0.1, color(0.2, 0.7, 1.0, 0.6));
  Marker from_goal = marker("tree from goal", Marker::LINE_LIST, 0.1, color(1.0, 0.4, 0.8, 0.6));
  for (const planner::Plan::Branch& branch : plan.trees) {
    Marker& tree = branch.from_goal ? from_goal : from_start;
    for (std::size_t i = 1; i < branch.points.size(); ++i) {
      tree.points.push_back(toPoint(branch.points[i - 1], kTreeHeightM));
      tree.points.push_back(toPoint(branch.points[i], kTreeHeightM));
    }
  }
  for (Marker* tree : {&from_start, &from_goal}) {
    if (tree->points.empty()) {
      tree->action = Marker::DELETE;
    }
    array.markers.push_back(*tree);
  }
  return array;
}

MarkerArray trajectoryMarkers(const trajectory::Trajectory& trajectory,
                              const vessel::Parameters& vessel) {
  MarkerArray array;
  Marker ribbon = marker("trajectory", Marker::LINE_STRIP, 0.3, color(1, 1, 1));
  double t_s = 0.0;
  while (!trajectory.empty()) {
    const vessel::FlatPoint flat = trajectory.flat(t_s);
    ribbon.points.push_back(toPoint(flat.position, kTrajectoryHeightM));
    const auto [red, green, blue] = speedColour(flat.velocity.norm() / vessel.top_speed_mps);
    ribbon.colors.push_back(color(red, green, blue));
    if (t_s >= trajectory.duration()) {
      break;
    }
    t_s = std::min(trajectory.duration(),
                   t_s + kTrajectoryStepM / std::max(1.0, flat.velocity.norm()));
  }
  if (ribbon.points.size() < 2) {
    ribbon.action = Marker::DELETE;
  }
  array.markers.push_back(ribbon);
  return array;
}

MarkerArray clearanceMarkers(const trajectory::Trajectory& trajectory, double clearance_m,
                             const map::DistanceField& field) {
  constexpr double kNarrowerM = 0.1;  // less than that is the grid's
  Marker ribbon = marker("clearance", Marker::TRIANGLE_LIST, 1.0, color(1, 1, 1));
  std::optional<std::array<Eigen::Vector2d, 2>> before;
  double t_s = 0.0;
  while (!trajectory.empty() && clearance_m > 0.0) {
    const vessel::FlatPoint flat = trajectory.flat(t_s);
    const double speed = flat.velocity.norm();
    // Turning on the spot it has no direction.
    if (speed > 0.3) {
      const Eigen::Vector2d ahead = flat.velocity / speed;
      const Eigen::Vector2d port = clearance_m * across(ahead);
      const std::array<Eigen::Vector2d, 2> sides = {flat.position + port, flat.position - port};
      if (before) {
        const bool narrower = field.clearance(flat.position) < clearance_m - kNarrowerM;
        const std_msgs::ColorRGBA shade =
            narrower ? color(0.92, 0.5, 0.08, 0.55) : color(0.12, 0.55, 0.45, 0.22);
        for (const Eigen::Vector2d& corner :
             {(*before)[0], (*before)[1], sides[1], (*before)[0], sides[1], sides[0]}) {
          ribbon.points.push_back(toPoint(corner, kRibbonHeightM));
          ribbon.colors.push_back(shade);
        }
      }
      before = sides;
    }
    if (t_s >= trajectory.duration()) {
      break;
    }
    t_s = std::min(trajectory.duration(), t_s + kTrajectoryStepM / std::max(1.0, speed));
  }
  if (ribbon.points.empty()) {
    ribbon.action = Marker::DELETE;
  }
  MarkerArray array;
  array.markers.push_back(ribbon);
  return array;
}

MarkerArray goalMarkers(const vessel::Pose& goal) {
  MarkerArray array;
  Marker arrow = marker("goal", Marker::ARROW, 0.5, color(0.8, 0.05, 0.5, 0.9));
  arrow.pose = toPose(goal);
  arrow.pose.position.z = kTrajectoryHeightM;
  arrow.scale.x = 2.5;
  array.markers.push_back(arrow);
  return array;
}

}  // namespace otter_nav::ros_bridge
