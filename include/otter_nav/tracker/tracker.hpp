// The tracker: keeps a vessel on a trajectory with nonlinear model predictive control (paper,
// section V-B), holds station at its end, and stops in good order when something fails.
//
// Times are seconds of one clock, given by the caller. All poses are in the map frame (ENU), body
// velocities over ground. step() neither blocks nor allocates.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

#include "otter_nav/base/result.hpp"
#include "otter_nav/tracker/limits.hpp"
#include "otter_nav/tracker/near_obstacles.hpp"
#include "otter_nav/tracker/options.hpp"
#include "otter_nav/tracker/solver_status.hpp"
#include "otter_nav/trajectory/timed_trajectory.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::tracker {

enum class Mode {
  kIdle,      // no trajectory yet: no thrust
  kTracking,  // on a trajectory
  kHolding,   // holding station at the trajectory's end
  kStopping,  // slowing down: on request, odometry lost, or no usable plan
  kStopped,   // at rest after that; holds the spot while the odometry is good
  kFault,     // odometry unusable and the model too old to steer by: no thrust
};
[[nodiscard]] std::string_view name(Mode mode);

// What step() decides, with what one needs to understand it.
struct Command {
  double stamp_s = 0.0;
  vessel::Thrusts thrusts = vessel::Thrusts::Zero();
  Mode mode = Mode::kIdle;
  std::string_view reason;                          // static text; empty when all is well
  vessel::State estimate = vessel::State::Zero();   // at the stamp
  vessel::State reference = vessel::State::Zero();  // at the stamp
  double tracking_error_m = 0.0;                    // of the estimate
  double time_left_s = 0.0;                         // of the trajectory
  bool at_goal = false;                             // holds the spot with its heading
  vessel::DisturbanceEstimate disturbance;
  // What it pushes with on the present heading, wind included: earth frame, and yaw moment.
  Eigen::Vector2d outside_force_n = Eigen::Vector2d::Zero();
  double outside_moment_nm = 0.0;
  SolverStatus solver = SolverStatus::kSolved;
  int solver_iterations = 0;
  // What the step was made with, so that it can be made again (docs/replay.md).
  std::uint64_t cycle = 0;           // steps so far, this one included
  std::uint64_t odometry_taken = 0;  // states taken over so far
  double odometry_stamp_s = 0.0;     // of the last of them
  std::uint32_t order_taken = 0;     // the caller's number of the last order taken over
  std::uint32_t near_taken = 0;      // and of the last near obstacles
  Weights weights;                   // in force
};

// The plan behind the last command: states at equal steps from `start_s`.
struct Prediction {
  double start_s = 0.0;
  double step_s = 0.0;
  int size = 0;  // of `states` in use
  std::array<vessel::State, kMaxStages + 1> states;

  [[nodiscard]] vessel::Foreseen foreseen() const {
    vessel::Foreseen there{start_s, step_s, {}};
    for (int k = 0; k < size; ++k) {
      const vessel::State& x = states[static_cast<std::size_t>(k)];
      there.poses.push_back({x.head<2>(), x[vessel::kPsi]});
    }
    return there;
  }
};

class Tracker {
 public:
  [[nodiscard]] static std::unique_ptr<Tracker> create(const Options& options,
                                                       const vessel::Parameters& vessel);
  virtual ~Tracker() = default;

  // Any thread, at any time. The trajectory takes over at its start, or at the next step when that
  // has passed. Errors: empty or malformed (piece and fault named), not finite, over already.
  // `order` is the caller's number for it. Its speed limit is kept to also when the vessel is
  // behind; the vessel's own counts where that is less.
  [[nodiscard]] virtual Status setTrajectory(trajectory::TimedTrajectory sailed,
                                             std::uint32_t order = 0) = 0;
  // Any one thread. Not finite or out of order: dropped, and the next status says so. The higher
  // the bow comes up, the less the vessel is pushed ahead: thrust below the centre of gravity and a
  // sea from ahead can turn a small hull over.
  virtual void addOdometry(double stamp_s, const vessel::State& state, double bow_up_rad = 0.0) = 0;
  // Any thread: brake and hold the spot from `start_s` on, until the next trajectory. `reason` is
  // static text.
  virtual void requestStop(std::string_view reason, double start_s = 0.0,
                           std::uint32_t order = 0) = 0;

  // Any thread, whenever the map around the vessel has changed or the vessel its place: what not to
  // be set onto, in place of what was told before. A trajectory that leads into something is
  // followed there. Errors: not finite, more than kMostNearObstacles.
  [[nodiscard]] virtual Status setNearObstacles(NearObstacles near, std::uint32_t number = 0) = 0;

  // Any thread: from the next step on, for the method `flatness`.
  virtual void setWeights(const Weights& weights) = 0;

  // The control loop's thread, once a period.
  virtual Command step(double now_s) = 0;
  // The last step's command was not sent, this was (a replay of other commands): what moves the
  // vessel is what the estimate has to know. Before prepare().
  virtual void replaceCommand(const vessel::Thrusts& sent) = 0;
  // After the command is out: linearises and factors for the step at `next_s`, so that it only has
  // to feed back the state. Optional.
  virtual void prepare(double next_s) = 0;

  [[nodiscard]] virtual const Prediction& prediction() const = 0;
  [[nodiscard]] virtual const Options& options() const = 0;
};

}  // namespace otter_nav::tracker
