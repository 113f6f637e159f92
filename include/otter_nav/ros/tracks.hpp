// Tracks of other vessels as messages and for rviz.
#pragma once

#include <otter_nav/Tracks.h>
#include <visualization_msgs/MarkerArray.h>

#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/traffic/track.hpp"

namespace otter_nav::ros_bridge {

[[nodiscard]] Tracks toMessage(const std::vector<traffic::Track>& tracks, const ros::Time& stamp);
// An error names the track and the field that is not finite, or the frame that isn't the map's.
[[nodiscard]] Result<std::vector<traffic::Track>> toTracks(const Tracks& message);

// Outlines, names, and the ways they will probably take in the next minute with what is uncertain.
// Markers of tracks that are gone are taken away.
[[nodiscard]] visualization_msgs::MarkerArray trackMarkers(
    const std::vector<traffic::Track>& tracks, const ros::Time& stamp);

}  // namespace otter_nav::ros_bridge
