// Keeping to the reference by model predictive control: fills the reference, runs the real-time
// iteration a cycle at a time, and lets the last good plan stand in when it fails.
#pragma once

#include <optional>

#include "otter_nav/tracker/tracker.hpp"
#include "tracker/navigator.hpp"
#include "tracker/ocp/rti_solver.hpp"
#include "tracker/reference.hpp"
#include "tracker/wind_corridor.hpp"

namespace otter_nav::tracker {

class PredictiveController {
 public:
  PredictiveController(const Options& options, const vessel::Parameters& vessel);

  // Before the first step on a new trajectory. The plan in force is the best start for the next one
  // unless it leads somewhere else.
  void start(bool keep_plan);
  // Of the method `flatness`; the other keeps its own.
  void setWeights(const Weights& weights);
  // From the next step on; not owned. Null: nothing is known to be near.
  void keepOff(const NearObstacles* near);

  // Linearises and factors for the step at `next_s`, the thrusters being at `last`.
  void prepare(double next_s, const vessel::Thrusts& last, const Navigator& navigator,
               ReferenceSource& source);
  // The thrusts from `now_s` on, nothing when there is no usable plan any more; how the solver
  // ended goes to `command`.
  [[nodiscard]] std::optional<vessel::Thrusts> step(double now_s, const vessel::State& state,
                                                    const vessel::Thrusts& last,
                                                    const Navigator& navigator,
                                                    ReferenceSource& source, Command& command);
  [[nodiscard]] const Prediction& prediction() const { return prediction_; }

 private:
  void prepareFor(double start_s, double psi_rad, const vessel::Thrusts& last,
                  const Navigator& navigator, ReferenceSource& source);
  [[nodiscard]] std::optional<vessel::Thrusts> fromLastPlan(double now_s) const;

  vessel::ManoeuvringModel model_;
  bool flatness_;
  int stages_;
  double period_s_;
  double thrust_rate_nps_;
  double lag_s_;
  WindCorridor corridor_;
  double heading_share_;
  RtiSolver solver_;
  OcpReference reference_;
  Prediction prediction_;  // the last good plan
  std::array<vessel::Thrusts, kMaxStages> plan_thrusts_;
  double solved_for_s_ = 0.0;    // start of the solver's plan
  double prepared_for_s_ = 0.0;  // start the solver is prepared for
  double last_good_s_ = 0.0;
  bool prepared_ = false;
  bool plan_valid_ = false;
};

}  // namespace otter_nav::tracker
