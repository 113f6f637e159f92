// Small helpers to make markers.
#pragma once

#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/Marker.h>

#include <string>

namespace otter_nav::ros_bridge {

[[nodiscard]] std_msgs::ColorRGBA color(double red, double green, double blue, double alpha = 1.0);
// From blue (0) over green to red (1).
[[nodiscard]] std_msgs::ColorRGBA rainbow(double share);

// A marker in `frame` at its origin, for ever; `width_m` is the lines' or points'.
[[nodiscard]] visualization_msgs::Marker marker(const std::string& frame, const std::string& name,
                                                int id, int type, double width_m,
                                                const std_msgs::ColorRGBA& color);

}  // namespace otter_nav::ros_bridge
