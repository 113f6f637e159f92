// How a hull that a load carries comes to rest: by the manoeuvring model's own motion under its
// thrusts, and no heading has to be held on the way.
#pragma once

#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::stopping {

// Of the thrust: the rest is the tracker's, to keep to such a motion.
constexpr double kCarriedShare = 0.9;
constexpr double kCarriedStepS = 0.1;

// Turns bow or stern to what pushes, whichever is nearer, and brakes with the thrust left.
class ComingToRest {
 public:
  ComingToRest(const vessel::Parameters& vessel, const vessel::Disturbance& load)
      : vessel_(vessel), load_(load) {}

  // The turn, rad, that is left.
  [[nodiscard]] double off(const vessel::State& x) const;
  // Bow or stern to the load, and hardly moving.
  [[nodiscard]] bool hasCome(const vessel::State& x) const;
  [[nodiscard]] vessel::Thrusts thrusts(const vessel::State& x) const;
  // After one step under these thrusts.
  [[nodiscard]] vessel::State after(const vessel::State& x, const vessel::Thrusts& thrusts) const;

 private:
  const vessel::Parameters& vessel_;
  const vessel::Disturbance& load_;
};

// One step's piece. Cubic: the thrusts, and with them the accelerations, jump.
[[nodiscard]] trajectory::Piece carriedPiece(const vessel::State& from, const vessel::State& to);

// The last of the way of who has come, within a second.
[[nodiscard]] trajectory::Piece stillPiece(const vessel::State& state);

// From a state to where it has come, and rest there. Empty where it doesn't within 12 s.
[[nodiscard]] trajectory::Trajectory carriedToRest(const vessel::State& state,
                                                   const vessel::Parameters& vessel,
                                                   const vessel::Disturbance& load);

}  // namespace otter_nav::stopping
