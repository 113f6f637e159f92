// Holding a spot with two fixed thrusters, and coming to rest there.
//
// The hull cannot be pushed sideways, so heading and position compete: while the spot is near, the
// wanted heading is held and the surge thrust keeps the distance along the hull. When the vessel
// drifts off, the heading is given up: bow or stern, whichever is nearer, turns into the force that
// position needs (against the disturbance and back to the spot), which also is how a vessel at
// anchor lies. Radii with hysteresis keep it from changing its mind.
#pragma once

#include "otter_nav/tracker/options.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::tracker {

class StationKeeper {
 public:
  StationKeeper(const HoldingOptions& options, const vessel::Parameters& vessel);

  void start(const Eigen::Vector2d& position, double psi_rad);
  [[nodiscard]] vessel::Thrusts step(const vessel::State& state,
                                     const vessel::Disturbance& disturbance);
  // Thrusts that slow the vessel down on the heading it has.
  [[nodiscard]] vessel::Thrusts brake(const vessel::State& state,
                                      const vessel::Disturbance& disturbance) const;
  // Whether the vessel lies at the spot on its heading.
  [[nodiscard]] bool holds(const vessel::State& state) const;
  [[nodiscard]] bool weathervaning() const { return weathervanes_; }

 private:
  [[nodiscard]] vessel::Thrusts thrusts(double surge_n, double yaw_nm) const;
  // Drag through the water and outside force at rest on a heading, earth frame: what the thrust has
  // to balance.
  [[nodiscard]] Eigen::Vector2d load(double psi_rad, const vessel::Disturbance& disturbance) const;

  HoldingOptions options_;
  vessel::Parameters vessel_;
  double surge_gain_npm_;
  double surge_damping_kgps_;
  double yaw_gain_nm_;
  double yaw_damping_nms_;
  double side_load_n_;
  Eigen::Vector2d position_ = Eigen::Vector2d::Zero();
  double psi_rad_ = 0.0;
  bool weathervanes_ = false;
};

}  // namespace otter_nav::tracker
