// Wind, current and waves together, as they act at one instant; and the one place where the outside
// frames (ENU, FLU) and the plant's (NED; forward, starboard, down) meet.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "current.hpp"
#include "otter_nav/plant/options.hpp"
#include "otter_nav/plant/plant_model.hpp"
#include "otter_nav/plant/signals.hpp"
#include "waves.hpp"
#include "wind.hpp"

namespace otter_nav::plant {

// What acts during one step, in the map frame (waves in the heading frame).
struct Conditions {
  Eigen::Vector2d wind_mps = Eigen::Vector2d::Zero();
  Eigen::Vector2d current_mps = Eigen::Vector2d::Zero();
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();
  HullWaves waves;
};

class Environment {
 public:
  // Each source draws from its own stream, so switching one off leaves the others as they were.
  Environment(const EnvironmentOptions& options, std::uint64_t seed);

  void advance(double dt_s);
  // Wind and current as advanced to; waves at `time_s` under a hull at this pose.
  [[nodiscard]] Conditions at(double time_s, const vessel::State& planar,
                              const PlantModel& model) const;

 private:
  EnvironmentOptions options_;
  Wind wind_;
  Current current_;
  WaveField waves_;
};

// Conditions seen from the hull.
[[nodiscard]] Surroundings surroundings(const Conditions& conditions, const PlantState& x,
                                        const PlantModel& model);

// The truth that a plant state means; `pose_rate` is eta'.
[[nodiscard]] Truth toTruth(const PlantState& x, const Vector6& pose_rate);
[[nodiscard]] vessel::State planarPose(const PlantState& x);
// `x` moved to a position and heading of the map.
[[nodiscard]] PlantState placed(PlantState x, const Eigen::Vector2d& position, double psi_rad);

}  // namespace otter_nav::plant
