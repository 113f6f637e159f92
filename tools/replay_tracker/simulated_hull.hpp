// A vessel that is simulated under a disturbance given from outside.
#pragma once

#include <memory>

#include "otter_nav/base/result.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::replay {

class SimulatedHull {
 public:
  // The manoeuvring model, thrusters with their lag.
  [[nodiscard]] static Result<std::unique_ptr<SimulatedHull>> model(
      const vessel::Parameters& vessel);
  // The plant that the vessel's file names, in still water of its own, with its shipped options.
  [[nodiscard]] static Result<std::unique_ptr<SimulatedHull>> plant(
      const vessel::Parameters& vessel);
  virtual ~SimulatedHull() = default;

  // Moving as `state` says, the thrusters at `thrusts`.
  virtual void place(const vessel::State& state, const vessel::Thrusts& thrusts) = 0;
  virtual void advance(const vessel::Thrusts& command, const vessel::Disturbance& disturbance,
                       double dt_s) = 0;
  [[nodiscard]] virtual vessel::State state() const = 0;
};

}  // namespace otter_nav::replay
