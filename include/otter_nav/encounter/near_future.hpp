// Other vessels as obstacles, as far ahead in time as their tracks tell more than that they are
// there: what the vessel brakes for and plans around at once. Beyond it, the pilot weighs courses.
#pragma once

#include <vector>

#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/traffic/track_layer.hpp"

namespace otter_nav::encounter {

class NearFuture final : public feasibility::ObstacleLayer {
 public:
  NearFuture() = default;
  // Of tracks known at `now_s`.
  NearFuture(double now_s, const std::vector<traffic::Track>& tracks)
      : tracks_(tracks, prediction()), until_s_(now_s + kHorizonS) {}

  [[nodiscard]] bool empty() const { return tracks_.paths().empty(); }
  [[nodiscard]] double clearance(const Eigen::Vector2d& position, double time_s) const override {
    return time_s <= until_s_ ? tracks_.clearance(position, time_s) : kFarM;
  }
  [[nodiscard]] double clearanceWithin(const Eigen::Vector2d& position, double time_s,
                                       double enough_m) const override {
    return time_s <= until_s_ ? tracks_.clearanceWithin(position, time_s, enough_m) : kFarM;
  }
  [[nodiscard]] double rateBound() const override { return tracks_.rateBound(); }
  [[nodiscard]] map::DistanceField::Smooth smooth(const Eigen::Vector2d& position,
                                                  double time_s) const override {
    return time_s <= until_s_ ? tracks_.smooth(position, time_s)
                              : map::DistanceField::Smooth{kFarM, Eigen::Vector2d::Zero()};
  }

 private:
  static constexpr double kHorizonS = 12.0;
  static constexpr double kFarM = 1e6;
  [[nodiscard]] static traffic::PredictionOptions prediction() {
    traffic::PredictionOptions options;
    options.horizon_s = kHorizonS;
    return options;
  }

  traffic::TrackLayer tracks_;
  double until_s_ = 0.0;
};

}  // namespace otter_nav::encounter
