// Multiple shooting: one RK4 step over each stage of the horizon with its exact sensitivities
// (paper, equation 7), four stages at a time.
#pragma once

#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"
#include "tracker/qp/pack.hpp"

namespace otter_nav::tracker {

// x+ = A dx + B du + c about a stage's state and thrusts. The columns of A for x and y are the
// identity's, so only those for psi, u, v, r are kept, row by row.
struct alignas(32) Stage {
  Pack a[6];   // columns psi, u, v, r
  Pack bc[6];  // columns F_left, F_right, gap to the next stage's state, 0
};

// The manoeuvring model with thrust levers and disturbance.
class StageModel {
 public:
  StageModel(const vessel::ManoeuvringModel& model, const vessel::Thrusters& thrusters)
      : model_(model), mobility_(model), lever_m_(thrusters.lever_arm_m) {}
  void setDisturbance(const vessel::Disturbance& disturbance) { disturbance_ = disturbance; }

  // Stages 0 to `count` - 1 from `states` (count + 1) and `thrusts` (count); step in s. `stages`
  // has room for `count` rounded up to a multiple of kLanes.
  void linearize(const vessel::State* states, const vessel::Thrusts* thrusts, int count,
                 double step_s, Stage* stages) const;

 private:
  struct Derivative;
  struct Sensitivity;
  void differentiate(const Pack (&q)[4], Pack surge_n, Pack yaw_nm, Derivative& d) const;
  void propagate(const Derivative& d, const Sensitivity& s, Sensitivity& rate) const;

  vessel::ManoeuvringModel model_;
  vessel::Mobility<double> mobility_;
  double lever_m_;
  vessel::Disturbance disturbance_;
};

}  // namespace otter_nav::tracker
