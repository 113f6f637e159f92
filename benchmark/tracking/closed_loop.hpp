// One run of the tracker against the plant, 100 Hz, no ROS.
#pragma once

#include <cstdint>
#include <functional>
#include <ostream>

#include "otter_nav/base/result.hpp"
#include "otter_nav/plant/options.hpp"
#include "otter_nav/tracker/options.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "percentiles.hpp"

namespace otter_nav::benchmark {

struct RunSetup {
  trajectory::Trajectory trajectory;
  tracker::Options tracker;
  vessel::Parameters vessel;
  plant::Options plant;
  std::uint64_t seed = 0;
  double duration_s = 0.0;      // of the run; the trajectory may go on beyond
  double errors_from_s = 10.0;  // the vessel starts at rest and catches up before
};

// Errors are distances of the true position from the trajectory's at the same time.
struct RunFigures {
  double mean_error_m = 0.0;
  double max_error_m = 0.0;
  double mean_speed = 0.0;  // over ground, m/s
  double max_speed = 0.0;
  double planned_mean_speed = 0.0;  // of the trajectory, same window
  double yaw_rate_integral = 0.0;   // of r^2, rad^2/s
  double thrust_rms_n = 0.0;        // of each thruster's command
  double thrust_rate_rms_nps = 0.0;
  double saturation_share = 0.0;  // of cycles with a thruster at its limit
  double unsolved_share = 0.0;    // of cycles whose solver gave no optimum
  double capsized_at_s = -1.0;    // where the run ended then; not negative only if it did
  Percentiles step_us;            // wall clock of the whole control step
};

// `dump` gets the CSV of the motion if it isn't null; `progress` the share done.
[[nodiscard]] Result<RunFigures> run(const RunSetup& setup, std::ostream* dump,
                                     const std::function<void(double)>& progress);

}  // namespace otter_nav::benchmark
