// Recorded propeller speeds run through a plant model, and how far the motion is from the recorded
// one. Files are CSV in MSS's conventions: t s, u v w m/s, p q r rad/s, x y z m (NED), phi theta
// psi rad, n_left n_right (rad/s of the propellers for `otter`, N for `otter_gazebo`).
#pragma once

#include <Eigen/Core>
#include <iosfwd>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/plant/plant_model.hpp"

namespace otter_nav::plant {

struct RecordedRow {
  double time_s = 0.0;
  PlantState state = PlantState::Zero();  // the propellers' rows are the speeds from here on
};

struct Recording {
  std::vector<RecordedRow> rows;  // two at least, time growing
  bool has_motion = false;        // whether the twelve motion columns are there
};

// Columns t, n_left and n_right are required, the motion's come all or none, in any order; columns
// of other names are skipped. Errors name the file, line and column.
[[nodiscard]] Result<Recording> readRecording(const std::string& path);
[[nodiscard]] Result<Recording> readRecording(std::istream& in, const std::string& name);
void writeRecording(std::ostream& out, const Recording& recording);

// A steady current as MSS means it: towards `direction_rad`, clockwise from north.
struct SteadyCurrent {
  double speed_mps = 0.0;
  double direction_rad = 0.0;
};

// Starts from the first row's motion, or from the settled trim heading north if there is none, with
// propellers at the first row's speed (at rest if they lag). A row's speeds hold from its time to
// the next row's; its motion is the one before they act. `step_s` is the longest step.
[[nodiscard]] Recording replay(const PlantModel& model, const Recording& recording,
                               const SteadyCurrent& current, double step_s = 0.01);

struct ReplayDifference {
  double position_m = 0.0;  // worst distance
  double position_time_s = 0.0;
  double heading_rad = 0.0;  // worst, absolute
  double heading_time_s = 0.0;
};
// Between two recordings of the same times.
[[nodiscard]] ReplayDifference worstDifference(const Recording& a, const Recording& b);

}  // namespace otter_nav::plant
