#include "otter_nav/traffic/track_layer.hpp"

#include <algorithm>
#include <limits>

namespace otter_nav::traffic {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TrackLayer::TrackLayer(const std::vector<Track>& tracks, const PredictionOptions& options) {
  paths_.reserve(tracks.size());
  for (const Track& track : tracks) {
    paths_.emplace_back(track, options);
    rate_bound_mps_ = std::max(rate_bound_mps_, paths_.back().rateBound());
  }
}

double TrackLayer::clearance(const Eigen::Vector2d& position, double time_s) const {
  return clearanceWithin(position, time_s, kInfinity);
}

double TrackLayer::clearanceWithin(const Eigen::Vector2d& position, double time_s,
                                   double enough_m) const {
  double least = enough_m;
  for (const PredictedPath& path : paths_) {
    // What lies farther off than what was found needs no closer look.
    if (path.distanceBound(position, time_s) < least) {
      least = std::min(least, path.at(time_s).distanceTo(position).distance_m);
    }
  }
  return std::max(0.0, least);
}

map::DistanceField::Smooth TrackLayer::smooth(const Eigen::Vector2d& position,
                                              double time_s) const {
  map::DistanceField::Smooth nearest{kInfinity, Eigen::Vector2d::Zero()};
  for (const PredictedPath& path : paths_) {
    if (path.distanceBound(position, time_s) >= nearest.distance_m) {
      continue;
    }
    const Outline::Distance distance = path.at(time_s).distanceTo(position);
    if (distance.distance_m < nearest.distance_m) {
      nearest = {distance.distance_m, distance.gradient};
    }
  }
  return nearest;
}

}  // namespace otter_nav::traffic
