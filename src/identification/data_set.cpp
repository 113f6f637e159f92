#include "otter_nav/identification/data_set.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/text.hpp"
#include "thrust_history.hpp"

namespace otter_nav::identification {
namespace {

constexpr std::array<const char*, vessel::kStateSize> kStateNames = {"x", "y", "psi",
                                                                     "u", "v", "r"};
constexpr std::array<const char*, vessel::kInputSize> kThrustNames = {"f_left", "f_right"};

// "/odom, message 12 (stamp 1.1 s)" or "run.csv, row 12 (stamp 1.1 s)".
std::string place(const std::string& stream, const char* unit, std::size_t number, double stamp_s) {
  return text("%s, %s %zu (stamp %.15g s)", stream.c_str(), unit, number, stamp_s);
}

// A record that is sent again, stamp and values alike, does no harm.
template <typename Record, typename Values>
Status checkStream(const std::vector<Record>& records, const Recording& recording,
                   const std::string& stream, Values values, const char* const* names,
                   bool equal_stamps) {
  const char* unit = recording.first_row > 0 ? "row" : "message";
  const std::size_t first = recording.first_row > 0 ? recording.first_row : 1;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const double stamp_s = records[i].stamp_s;
    const std::string at = place(stream, unit, i + first, stamp_s);
    if (!std::isfinite(stamp_s)) {
      return failure(at + ": the stamp is not a finite number");
    }
    const auto& row = values(records[i]);
    for (int k = 0; k < row.size(); ++k) {
      if (!std::isfinite(row[k])) {
        return failure(at + ": " + names[k] + " is not a finite number");
      }
    }
    const bool again = i > 0 && stamp_s == records[i - 1].stamp_s;
    const bool stands_still = again && !equal_stamps && row != values(records[i - 1]);
    if (i > 0 && (stamp_s < records[i - 1].stamp_s || stands_still)) {
      return failure(at + ": time goes backwards or stands still, the stamp before was " +
                     std::to_string(records[i - 1].stamp_s) + " s");
    }
  }
  return {};
}

Status check(const Recording& recording) {
  if (recording.odometry.empty()) {
    return failure(recording.odometry_name + ": no odometry in the recording");
  }
  if (recording.commands.empty()) {
    return failure(recording.command_name + ": no thruster commands in the recording");
  }
  Status status = checkStream(
      recording.odometry, recording, recording.odometry_name,
      [](const OdometryRecord& r) -> const vessel::State& { return r.state; }, kStateNames.data(),
      false);
  if (!status) {
    return status;
  }
  return checkStream(
      recording.commands, recording, recording.command_name,
      [](const CommandRecord& r) -> const vessel::Thrusts& { return r.thrusts; },
      kThrustNames.data(), true);
}

// The median; 0 without two stamps that differ.
template <typename Record>
double usualInterval(const std::vector<Record>& records) {
  std::vector<double> spacings;
  for (std::size_t i = 1; i < records.size(); ++i) {
    if (records[i].stamp_s > records[i - 1].stamp_s) {
      spacings.push_back(records[i].stamp_s - records[i - 1].stamp_s);
    }
  }
  if (spacings.empty()) {
    return 0.0;
  }
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  return *middle;
}

// Of how many records one is kept, so that they stand about `interval_s` apart.
std::size_t strideOf(const std::vector<OdometryRecord>& records, double interval_s) {
  const double usual_s = usualInterval(records);
  return usual_s > 0.0 ? static_cast<std::size_t>(std::max(1.0, std::round(interval_s / usual_s)))
                       : 1;
}

template <typename Record>
void addHoles(const std::vector<Record>& records, const std::string& stream,
              std::vector<Holes>& all) {
  constexpr double kUsualIntervals = 3.0;
  const double usual_s = usualInterval(records);
  Holes holes;
  holes.stream = stream;
  for (std::size_t i = 1; i < records.size(); ++i) {
    const double pause_s = records[i].stamp_s - records[i - 1].stamp_s;
    if (pause_s <= kUsualIntervals * usual_s) {
      continue;
    }
    ++holes.count;
    holes.missing_s += pause_s - usual_s;
    if (pause_s > holes.longest_to_s - holes.longest_from_s) {
      holes.longest_from_s = records[i - 1].stamp_s;
      holes.longest_to_s = records[i].stamp_s;
    }
  }
  if (holes.count > 0) {
    all.push_back(std::move(holes));
  }
}

Sample sampleOf(const OdometryRecord& record, const std::vector<Sample>& before) {
  Sample sample;
  sample.time_s = record.stamp_s;
  sample.state = record.state;
  if (!before.empty()) {
    sample.state[vessel::kPsi] =
        unwrapNear(sample.state[vessel::kPsi], before.back().state[vessel::kPsi]);
  }
  return sample;
}

// Samples from `from_s` to `to_s`, cut where the odometry or the commands pause: what was asked of
// the thrusters meanwhile is not known.
DataSet samplesOf(const std::vector<OdometryRecord>& records,
                  const std::vector<CommandRecord>& commands, double from_s, double to_s,
                  const DataOptions& options) {
  const std::size_t stride = strideOf(records, options.sample_interval_s);
  DataSet data;
  std::size_t begin = 0;
  std::size_t count = 0;
  double last_s = from_s;
  std::size_t next = 1;  // of the commands
  const auto close = [&] {
    if (data.samples.size() - begin > 1) {
      data.stretches.push_back({begin, data.samples.size()});
    }
    begin = data.samples.size();
    count = 0;
  };
  for (const OdometryRecord& record : records) {
    const bool again = !data.samples.empty() && record.stamp_s == last_s;
    if (record.stamp_s < from_s || record.stamp_s > to_s || again) {
      continue;
    }
    while (next < commands.size() && commands[next].stamp_s < record.stamp_s) {
      ++next;
    }
    const bool unknown = next < commands.size() &&
                         commands[next].stamp_s - commands[next - 1].stamp_s > options.max_gap_s &&
                         record.stamp_s > commands[next - 1].stamp_s &&
                         record.stamp_s < commands[next].stamp_s;
    if (unknown || record.stamp_s - last_s > options.max_gap_s) {
      close();
    }
    if (unknown) {
      continue;
    }
    last_s = record.stamp_s;
    if (count++ % stride == 0) {
      data.samples.push_back(sampleOf(record, data.samples));
    }
  }
  close();
  return data;
}

double usableDuration(const DataSet& data) {
  double duration_s = 0.0;
  for (const Stretch& s : data.stretches) {
    duration_s += data.samples[s.end - 1].time_s - data.samples[s.begin].time_s;
  }
  return duration_s;
}

}  // namespace

std::string describe(const std::vector<Holes>& holes) {
  std::string all;
  for (const Holes& h : holes) {
    all += text("\nholes in %s: %d, %.2f s are missing; the longest from %.3f s to %.3f s",
                h.stream.c_str(), h.count, h.missing_s, h.longest_from_s, h.longest_to_s);
  }
  return all;
}

Result<DataSet> assemble(const Recording& recording, const DataOptions& options,
                         double thrust_lag_s) {
  const Status status = check(recording);
  if (!status) {
    return failure(status.error().message);
  }
  // Only where both streams speak is the thrust known.
  const double from_s = recording.commands.front().stamp_s;
  const double to_s = recording.commands.back().stamp_s + options.command_timeout_s;
  DataSet data = samplesOf(recording.odometry, recording.commands, from_s, to_s, options);
  addHoles(recording.odometry, recording.odometry_name, data.holes);
  addHoles(recording.commands, recording.command_name, data.holes);
  ThrustHistory history(recording.commands, thrust_lag_s, options.command_timeout_s);
  for (std::size_t i = 0; i + 1 < data.samples.size(); ++i) {
    data.samples[i].thrusts = history.mean(data.samples[i].time_s, data.samples[i + 1].time_s);
  }
  if (data.samples.size() > 1) {  // no interval follows the last
    data.samples.back().thrusts = data.samples[data.samples.size() - 2].thrusts;
  }
  const double duration_s = usableDuration(data);
  if (duration_s < options.min_duration_s) {
    return failure(
        "the recording is too short: " + recording.odometry_name + " and " +
        recording.command_name +
        text(" overlap for %g s, at least %g s are needed", duration_s, options.min_duration_s) +
        describe(data.holes));
  }
  return data;
}

}  // namespace otter_nav::identification
