// Holding a spot with two fixed thrusters: on which heading. The tracker's plan does the holding.
//
// The hull cannot be pushed sideways, so heading and position compete. The wanted heading is held
// where wind and current set the resting hull aside but slowly; else bow or stern turns into what
// they push with, which also is how a vessel at anchor lies: the bow, unless the stern is nearer
// and little thrust is asked for. Into a firm load (vessel/rest.hpp) it is always the bow, from
// where a plan leads on.
#pragma once

#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::tracker {

class StationKeeper {
 public:
  explicit StationKeeper(const vessel::Parameters& vessel);

  // `heading_rad` is the vessel's own now, from where it turns to `psi_rad`.
  void start(const Eigen::Vector2d& position, double psi_rad, double heading_rad, double now_s);
  // The heading to hold from now on; turns slowly when it changes.
  [[nodiscard]] double heading(double now_s, const vessel::Disturbance& disturbance);
  [[nodiscard]] const Eigen::Vector2d& position() const { return position_; }
  // Thrusts that slow the vessel down on the heading it has.
  [[nodiscard]] vessel::Thrusts brake(const vessel::State& state,
                                      const vessel::Disturbance& disturbance) const;
  // Whether the vessel lies at the spot on its heading.
  [[nodiscard]] bool holds(const vessel::State& state) const;
  // Whether it lies there but for a swing: what holds the place against a load abeam swings the
  // hull to and fro, by a thruster's full force for a light one.
  [[nodiscard]] bool swingsAbout(const vessel::State& state) const;
  [[nodiscard]] bool weathervaning() const { return weathervanes_; }

 private:
  [[nodiscard]] vessel::Thrusts thrusts(double surge_n, double yaw_nm) const;
  [[nodiscard]] double intoLoad(const vessel::Disturbance& disturbance) const;

  vessel::Parameters vessel_;
  double surge_damping_kgps_;
  double yaw_damping_nms_;
  Eigen::Vector2d position_ = Eigen::Vector2d::Zero();
  double psi_rad_ = 0.0;   // wanted
  double held_rad_ = 0.0;  // what the vessel is told
  double time_s_ = 0.0;
  bool weathervanes_ = false;
};

}  // namespace otter_nav::tracker
