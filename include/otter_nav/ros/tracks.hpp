// Tracks of other vessels as messages and for rviz.
#pragma once

#include <otter_nav/Tracks.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/traffic/track.hpp"

namespace otter_nav::ros_bridge {

[[nodiscard]] Tracks toMessage(const std::vector<traffic::Track>& tracks, const ros::Time& stamp);

// What can be taken of a message. A track that makes no sense is left out, for the others are no
// less true.
struct SoundTracks {
  std::vector<traffic::Track> tracks;
  std::string refused;  // the last one left out, and why; empty if all are here
};
// An error names the frame that isn't the map's.
[[nodiscard]] Result<SoundTracks> toTracks(const Tracks& message);

// Outlines, names, and the ways they will probably take in the next minute with what is uncertain.
// Markers of tracks that are gone are taken away.
[[nodiscard]] visualization_msgs::MarkerArray trackMarkers(
    const std::vector<traffic::Track>& tracks, const ros::Time& stamp);

}  // namespace otter_nav::ros_bridge
