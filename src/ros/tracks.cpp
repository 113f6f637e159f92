#include "otter_nav/ros/tracks.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/text.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/frames.hpp"

namespace otter_nav::ros_bridge {
namespace {

using visualization_msgs::Marker;

constexpr double kShownS = 60.0;
constexpr double kStepS = 10.0;

// The outline's corners, closed, as a line.
Marker outlineMarker(const traffic::Outline& outline, const std::string& name, int id, double alpha,
                     const ros::Time& stamp) {
  Marker marker;
  marker.header.frame_id = frames().map;
  marker.header.stamp = stamp;
  marker.ns = name;
  marker.id = id;
  marker.type = Marker::LINE_STRIP;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = 0.15;
  marker.color.r = 1.0F;
  marker.color.g = 0.5F;
  marker.color.a = static_cast<float>(alpha);
  const Eigen::Vector2d ahead = unitVector(outline.heading_rad);
  const Eigen::Vector2d port = across(ahead);
  const double half_length = outline.half_length_m + outline.radius_m;
  const double half_beam = outline.half_beam_m + outline.radius_m;
  const double corners[][2] = {{1.0, 0.0},  {0.6, 1.0}, {-1.0, 1.0}, {-1.0, -1.0},
                               {0.6, -1.0}, {1.0, 0.0}};  // a bow, so that one sees where she heads
  for (const auto& corner : corners) {
    marker.points.push_back(
        toPoint(outline.position + corner[0] * half_length * ahead + corner[1] * half_beam * port));
  }
  return marker;
}

Marker nameMarker(const traffic::Track& track, const ros::Time& stamp) {
  Marker marker = outlineMarker({}, "track_names", track.id, 1.0, stamp);
  marker.type = Marker::TEXT_VIEW_FACING;
  marker.points.clear();
  marker.pose.position = toPoint(track.position, 3.0);
  marker.scale.z = 2.0;
  marker.text = text("%d  %.1f m/s", track.id, track.velocity.norm());
  return marker;
}

// An error names the track and what makes no sense of it.
Result<traffic::Track> toTrack(const Track& one) {
  traffic::Track track;
  track.id = static_cast<int>(one.id);
  track.mmsi = one.mmsi;
  track.stamp_s = one.stamp.toSec();
  track.position = {one.position.x, one.position.y};
  track.velocity = {one.velocity.x, one.velocity.y};
  track.heading_rad = one.heading;
  track.turn_rate_radps = one.turn_rate;
  track.turn_time_s = one.turn_time;
  track.length_m = one.length;
  track.beam_m = one.beam;
  track.keeps_place = one.keeps_place != 0;
  track.shape = one.disc != 0 ? traffic::Shape::kDisc : traffic::Shape::kBox;
  std::copy(one.covariance.begin(), one.covariance.end(), track.covariance.data());
  track.existence = one.existence;
  track.met.stamp_s = one.met_stamp.toSec();
  track.met.position = {one.met_position.x, one.met_position.y};
  track.met.deviation_m = one.met_deviation;
  track.sources = one.sources;
  const bool finite = track.position.allFinite() && track.velocity.allFinite() &&
                      std::isfinite(one.heading) && std::isfinite(one.turn_rate) &&
                      std::isfinite(one.turn_time) && std::isfinite(one.length) &&
                      std::isfinite(one.beam) && std::isfinite(one.met_deviation) &&
                      track.covariance.allFinite() && track.met.position.allFinite();
  if (!finite || !(one.met_deviation >= 0.0) || !(one.length >= 0.0) || !(one.beam >= 0.0) ||
      !(one.turn_time > 0.0)) {
    return failure(
        text("track %u holds a figure that is not finite, or a negative size or time", one.id));
  }
  if (track.velocity.norm() > traffic::kFastestMps || one.length > traffic::kLongestM ||
      one.beam > traffic::kLongestM) {
    return failure(text("track %u is faster than %.0f m/s or larger than %.0f m", one.id,
                        traffic::kFastestMps, traffic::kLongestM));
  }
  if (!(one.existence >= 0.0 && one.existence <= 1.0)) {
    return failure(text("track %u has an existence outside [0, 1]", one.id));
  }
  return track;
}

}  // namespace

Tracks toMessage(const std::vector<traffic::Track>& tracks, const ros::Time& stamp) {
  Tracks message;
  message.header.frame_id = frames().map;
  message.header.stamp = stamp;
  for (const traffic::Track& track : tracks) {
    Track one;
    one.id = static_cast<std::uint32_t>(track.id);
    one.mmsi = track.mmsi;
    one.stamp = toRosTime(track.stamp_s);
    one.position = toPoint(track.position);
    one.velocity.x = track.velocity.x();
    one.velocity.y = track.velocity.y();
    one.heading = track.heading_rad;
    one.turn_rate = track.turn_rate_radps;
    one.turn_time = track.turn_time_s;
    one.length = track.length_m;
    one.beam = track.beam_m;
    one.keeps_place = static_cast<std::uint8_t>(track.keeps_place);
    one.disc = static_cast<std::uint8_t>(track.shape == traffic::Shape::kDisc);
    std::copy(track.covariance.data(), track.covariance.data() + 16, one.covariance.begin());
    one.existence = track.existence;
    one.met_stamp = toRosTime(track.met.stamp_s);
    one.met_position = toPoint(track.met.position);
    one.met_deviation = track.met.deviation_m;
    one.sources = static_cast<std::uint8_t>(track.sources);
    message.tracks.push_back(one);
  }
  return message;
}

Result<SoundTracks> toTracks(const Tracks& message) {
  if (const Status status = checkFrame(message.header.frame_id, frames().map); !status) {
    return failure(status.error().message);
  }
  SoundTracks sound;
  for (const Track& one : message.tracks) {
    if (Result<traffic::Track> track = toTrack(one)) {
      sound.tracks.push_back(*track);
    } else {
      sound.refused = track.error().message;
    }
  }
  return sound;
}

visualization_msgs::MarkerArray trackMarkers(const std::vector<traffic::Track>& tracks,
                                             const ros::Time& stamp) {
  visualization_msgs::MarkerArray markers;
  Marker all_gone;
  all_gone.action = Marker::DELETEALL;
  markers.markers.push_back(all_gone);
  int place = 0;
  for (const traffic::Track& track : tracks) {
    const traffic::PredictedPath path(track, {});
    for (double t = 0.0; t <= kShownS; t += kStepS) {
      markers.markers.push_back(outlineMarker(path.at(track.stamp_s + t), "track_ways", place++,
                                              t == 0.0 ? 1.0 : 0.5 - 0.4 * t / kShownS, stamp));
    }
    markers.markers.push_back(nameMarker(track, stamp));
  }
  return markers;
}

}  // namespace otter_nav::ros_bridge
