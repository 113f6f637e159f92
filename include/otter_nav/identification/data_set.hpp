// What identification works on: recorded motion with the thrusts that drove it.
#pragma once

#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::identification {

// One odometry message or CSV row: pose in the earth frame, velocities in the body frame.
struct OdometryRecord {
  double stamp_s = 0.0;
  vessel::State state = vessel::State::Zero();
};

// Thrusts commanded from `stamp_s` until the next record.
struct CommandRecord {
  double stamp_s = 0.0;
  vessel::Thrusts thrusts = vessel::Thrusts::Zero();
};

// As read from a bag or a CSV file, unchecked. `odometry_name` and `command_name` are what messages
// call the two streams: topics, or the file.
struct Recording {
  std::string odometry_name;
  std::string command_name;
  int first_row = 0;  // of a text file, for messages; 0 for a bag's messages
  std::vector<OdometryRecord> odometry;
  std::vector<CommandRecord> commands;
};

// `thrusts` is the mean over the interval to the next sample of what the thrusters gave.
struct Sample {
  double time_s = 0.0;
  vessel::State state = vessel::State::Zero();  // heading unwrapped
  vessel::Thrusts thrusts = vessel::Thrusts::Zero();
};

// Samples [begin, end) without a gap between them.
struct Stretch {
  std::size_t begin = 0;
  std::size_t end = 0;
};

// Where a stream has holes: stamps more than three usual intervals apart.
struct Holes {
  std::string stream;
  int count = 0;
  double missing_s = 0.0;  // all together, beside a usual interval each
  double longest_from_s = 0.0;
  double longest_to_s = 0.0;
};
// A line each, beginning with a line break; empty without holes.
[[nodiscard]] std::string describe(const std::vector<Holes>& holes);

struct DataSet {
  std::vector<Sample> samples;
  std::vector<Stretch> stretches;
  std::vector<Holes> holes;  // of the streams that have any
};

struct DataOptions {
  double min_duration_s = 30.0;
  double sample_interval_s = 0.05;
  double max_gap_s = 0.5;
  double command_timeout_s = 0.5;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("min_duration_s", o.min_duration_s, {10.0, 1e5}, "shorter recordings are refused");
    fields("sample_interval_s", o.sample_interval_s, {0.001, 1.0},
           "faster odometry is thinned to this, its thrusts averaged");
    fields("max_gap_s", o.max_gap_s, {0.001, 60.0},
           "a longer pause of the odometry or the commands splits the recording");
    fields("command_timeout_s", o.command_timeout_s, {0.01, 1e5},
           "thrust is zero this long after the last command");
  }
};

// Checks a recording (finite values, time going forward, both streams there and overlapping, long
// enough) and puts both streams on stamps of the odometry. Errors name the stream and the row or
// stamp. A message sent again is skipped. Acting thrust follows the commands with the thrusters'
// lag.
[[nodiscard]] Result<DataSet> assemble(const Recording& recording, const DataOptions& options,
                                       double thrust_lag_s);

}  // namespace otter_nav::identification
