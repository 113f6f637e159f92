// Multiple shooting: one RK4 step over each stage of the horizon with its exact sensitivities
// (paper, equation 7), four stages at a time.
#pragma once

#include <array>

#include "otter_nav/tracker/options.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"
#include "tracker/orbital_motion.hpp"
#include "tracker/qp/riccati.hpp"

namespace otter_nav::tracker {

// The manoeuvring model with thrust levers and disturbance.
class StageModel {
 public:
  // Bow to the wind, what its load abeam changes by with the heading counts as over a turn of
  // `finite_turn_rad`; 0: exact.
  StageModel(const vessel::ManoeuvringModel& model, const vessel::Thrusters& thrusters,
             double finite_turn_rad)
      : model_(model),
        mobility_(model),
        lever_m_(thrusters.lever_arm_m),
        finite_turn_rad_(finite_turn_rad) {}
  void setDisturbance(const vessel::Disturbance& disturbance) { disturbance_ = disturbance; }
  // How waves move the water over each stage.
  void setWater(const std::array<WaterMotion, kMaxStages>& water) { water_ = water; }

  // Stages 0 to `count` - 1 from `states` (count + 1) and `thrusts` (count); step in s. `stages`
  // has room for `count` rounded up to a multiple of kLanes.
  void linearize(const vessel::State* states, const vessel::Thrusts* thrusts, int count,
                 double step_s, qp::Stage* stages) const;

 private:
  struct Derivative;
  struct Sensitivity;
  struct Water;
  [[nodiscard]] Water waterOf(const int (&index)[kLanes]) const;
  void differentiate(const Pack (&q)[4], Pack surge_n, Pack yaw_nm, const Water& water,
                     Derivative& d) const;
  [[nodiscard]] Pack bowInWind(const Pack& cosine, const Pack& sine) const;
  void propagate(const Derivative& d, const Sensitivity& s, Sensitivity& rate) const;

  vessel::ManoeuvringModel model_;
  vessel::Mobility<double> mobility_;
  double lever_m_;
  double finite_turn_rad_;
  vessel::Disturbance disturbance_;
  std::array<WaterMotion, kMaxStages> water_;
};

}  // namespace otter_nav::tracker
