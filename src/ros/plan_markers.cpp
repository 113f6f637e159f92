#include "otter_nav/ros/plan_markers.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/marker_tools.hpp"

namespace otter_nav::ros_bridge {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

// Heights over the water that keep flat things from hiding one another.
constexpr double kTreeHeightM = 0.02;
constexpr double kGuideHeightM = 0.03;
constexpr double kTrajectoryHeightM = 0.05;
constexpr double kTrajectoryStepM = 0.5;
constexpr int kCircleCorners = 24;

Marker lineStrip(const std::string& name, int id, double width_m, const std_msgs::ColorRGBA& shade,
                 const std::vector<geometry_msgs::Point>& points, double height_m) {
  Marker line = marker(kMapFrame, name, id, Marker::LINE_STRIP, width_m, shade);
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
      lineStrip("guide path", 0, 0.25, color(0.95, 0.75, 0.1, 0.9), path.points, kGuideHeightM));
  array.markers.push_back(
      lineStrip("dubins", 0, 0.15, color(0.5, 0.5, 0.5, 0.7), path.dubins, kTreeHeightM));
  Marker corridor =
      marker(kMapFrame, "corridor", 0, Marker::LINE_LIST, 0.08, color(0.95, 0.75, 0.1, 0.35));
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
  Marker from_start =
      marker(kMapFrame, "tree from start", 0, Marker::LINE_LIST, 0.1, color(0.2, 0.7, 1.0, 0.6));
  Marker from_goal =
      marker(kMapFrame, "tree from goal", 0, Marker::LINE_LIST, 0.1, color(1.0, 0.4, 0.8, 0.6));
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
  Marker ribbon = marker(kMapFrame, "trajectory", 0, Marker::LINE_STRIP, 0.3, color(1, 1, 1));
  double t_s = 0.0;
  while (!trajectory.empty()) {
    const vessel::FlatPoint flat = trajectory.flat(t_s);
    ribbon.points.push_back(toPoint(flat.position, kTrajectoryHeightM));
    ribbon.colors.push_back(rainbow(flat.velocity.norm() / vessel.top_speed_mps));
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

}  // namespace otter_nav::ros_bridge
