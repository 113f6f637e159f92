// The tracker's inside: what happens in one control step.
#pragma once

#include <atomic>

#include "otter_nav/tracker/tracker.hpp"
#include "tracker/handover.hpp"
#include "tracker/navigator.hpp"
#include "tracker/ocp/rti_solver.hpp"
#include "tracker/reference.hpp"
#include "tracker/station_keeper.hpp"

namespace otter_nav::tracker {

class Tracker::Core {
 public:
  Core(const Options& options, const vessel::Parameters& vessel);

  Status setTrajectory(trajectory::Trajectory trajectory, double start_s);
  void addOdometry(double stamp_s, const vessel::State& state);
  void requestStop(std::string_view reason);
  Command step(double now_s);
  void prepare(double next_s);

  [[nodiscard]] const Prediction& prediction() const { return prediction_; }
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  struct Assignment {
    trajectory::Trajectory trajectory;  // empty: stop
    double start_s = 0.0;
    std::string_view reason;
  };
  struct Measurement {
    double stamp_s = 0.0;
    vessel::State state = vessel::State::Zero();
  };

  void takeOdometry();
  void takeAssignment(double now_s, const vessel::State& state);
  void beginTracking(double now_s, const vessel::State& state);
  void beginStop(std::string_view reason);
  void beginHolding();
  void watchFix(Fix fix, double now_s, const vessel::State& state);

  // Each gives the thrusts of its mode.
  vessel::Thrusts track(double now_s, const vessel::State& state, Command& command);
  vessel::Thrusts hold(const vessel::State& state, Command& command);
  vessel::Thrusts stop(const vessel::State& state, Fix fix, Command& command);
  vessel::Thrusts afterFailure(double now_s, const vessel::State& state, Command& command);

  [[nodiscard]] static OcpOptions ocpOptions(const Options& options,
                                             const vessel::Parameters& vessel);
  [[nodiscard]] static RtiOptions rtiOptions(const Options& options);
  void prepareSolver(double ahead_s, double psi_rad);
  void keepPlan(double start_s);
  void finish(double now_s, const vessel::State& state, Command& command);
  [[nodiscard]] vessel::Thrusts slew(const vessel::Thrusts& wanted) const;

  Options options_;
  vessel::Parameters vessel_;
  Handover<Assignment> incoming_;
  Ring<Measurement, 256> odometry_;
  std::atomic<double> last_now_s_{0.0};

  std::unique_ptr<Assignment> waiting_;  // not yet due, or already over: see fresh_
  std::unique_ptr<Assignment> sailing_;
  bool fresh_ = false;  // waiting_ is still to come
  Navigator navigator_;
  ReferenceSource reference_source_;
  StationKeeper keeper_;
  RtiSolver solver_;
  OcpReference reference_;
  Prediction prediction_;

  Mode mode_ = Mode::kIdle;
  std::string_view stop_reason_;
  double solved_for_s_ = 0.0;    // start of the solver's plan
  double prepared_for_s_ = 0.0;  // start the solver is prepared for
  bool prepared_ = false;
  bool plan_valid_ = false;
  double last_good_s_ = 0.0;
  double lost_since_s_ = 0.0;
  std::array<vessel::Thrusts, kMaxStages> plan_thrusts_;
  vessel::Thrusts last_thrusts_ = vessel::Thrusts::Zero();
};

}  // namespace otter_nav::tracker
