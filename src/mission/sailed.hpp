// What is sailed: the way, what its plan was made for and with, and since when the tracker has it.
#pragma once

#include <cstddef>
#include <limits>

#include "moment.hpp"
#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/stopping/watch.hpp"
#include "otter_nav/trajectory/timed_trajectory.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::mission {

// What a plan was made for, and with.
struct Planned {
  double left_m = 0.0;  // of the way, from its end to the goal
  bool is_last_resort = false;
  std::size_t level = 0;  // of the clearances
  int steps_wider = 0;    // than that (ClearanceLevels)
  double clearance_m = 0.0;
  double thrust_share = 1.0;
  double pace_share = 1.0;           // of the usual speed
  double speed_limit_mps = 0.0;      // the mission's
  feasibility::SafetyLimits limits;  // all of it
  double goal_psi_rad = 0.0;
  vessel::Disturbance disturbance;
  double overtaxed_s = 0.0;  // for so long that takes more than the thrusters have
  bool in_known_weather = false;
  bool in_unknown_water = false;
  bool among_others = false;
};

struct Sailed {
  // Empty before the first plan, and where the tracker stops by itself.
  trajectory::TimedTrajectory path;
  Planned plan;
  // When the tracker was given it, or to stop.
  double given_s = -std::numeric_limits<double>::infinity();

  [[nodiscard]] bool isEmpty() const { return path.trajectory.empty(); }
  [[nodiscard]] bool isAtTheEnd(double now_s) const { return path.left(now_s) <= 0.0; }
  // Where it has the hull, and how fast.
  [[nodiscard]] vessel::FlatPoint at(double now_s) const {
    return path.trajectory.flat(path.elapsed(now_s));
  }
  // On its clock.
  [[nodiscard]] feasibility::Obstacles obstacles(const Moment& m) const {
    return m.obstacles.startingAt(path.start_time_s);
  }
  // How the hull lies beside it; as planned where nothing is sailed, or nobody knows.
  [[nodiscard]] stopping::Off off(const Moment& m, const vessel::Parameters& vessel) const;
  // Still to go, m.
  [[nodiscard]] double wayLeft(double now_s) const;
};

// For how long, s, what is left of a path asks for more than the thrusters have.
[[nodiscard]] double overtaxed(double now_s, const trajectory::TimedTrajectory& path,
                               const vessel::Parameters& vessel,
                               const vessel::Disturbance& disturbance);
// What the thrusters lack for so much longer on one way than on another makes a difference.
constexpr double kOvertaxedLongerS = 1.5;

}  // namespace otter_nav::mission
