#include "otter_nav/ros/marker_tools.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::ros_bridge {

std_msgs::ColorRGBA color(double red, double green, double blue, double alpha) {
  std_msgs::ColorRGBA value;
  value.r = static_cast<float>(red);
  value.g = static_cast<float>(green);
  value.b = static_cast<float>(blue);
  value.a = static_cast<float>(alpha);
  return value;
}

std_msgs::ColorRGBA rainbow(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  const auto bump = [s](double centre) {
    return std::clamp(1.5 - 4.0 * std::abs(s - centre), 0.0, 1.0);
  };
  return color(bump(0.8), bump(0.5), bump(0.2));
}

visualization_msgs::Marker marker(const std::string& frame, const std::string& name, int id,
                                  int type, double width_m, const std_msgs::ColorRGBA& color) {
  visualization_msgs::Marker value;
  value.header.frame_id = frame;
  value.ns = name;
  value.id = id;
  value.type = type;
  value.action = visualization_msgs::Marker::ADD;
  value.pose.orientation.w = 1.0;
  value.scale.x = width_m;
  value.scale.y = width_m;
  value.scale.z = width_m;
  value.color = color;
  return value;
}

}  // namespace otter_nav::ros_bridge
