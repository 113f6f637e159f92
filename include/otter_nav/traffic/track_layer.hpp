// Other vessels as obstacles in space and time.
#pragma once

#include <vector>

#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/traffic/track.hpp"

namespace otter_nav::traffic {

// The outlines of a set of tracks along their predicted ways, grown by their uncertainty. Holds
// copies: it may be handed to another thread. Of no tracks it is infinitely far away.
class TrackLayer : public feasibility::ObstacleLayer {
 public:
  TrackLayer() = default;
  TrackLayer(const std::vector<Track>& tracks, const PredictionOptions& options);

  [[nodiscard]] const std::vector<PredictedPath>& paths() const { return paths_; }

  [[nodiscard]] double clearance(const Eigen::Vector2d& position, double time_s) const override;
  [[nodiscard]] double clearanceWithin(const Eigen::Vector2d& position, double time_s,
                                       double enough_m) const override;
  [[nodiscard]] double rateBound() const override { return rate_bound_mps_; }
  // Of the nearest outline: its signed distance, with the direction away from it.
  [[nodiscard]] map::DistanceField::Smooth smooth(const Eigen::Vector2d& position,
                                                  double time_s) const override;

 private:
  std::vector<PredictedPath> paths_;
  double rate_bound_mps_ = 0.0;
};

}  // namespace otter_nav::traffic
