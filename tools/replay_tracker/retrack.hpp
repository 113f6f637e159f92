// A recorded run through today's tracker: step by step with what each step was made with, or in
// closed loop with a simulated vessel under the disturbance estimated then. Knows no ROS.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/tracker/options.hpp"
#include "otter_nav/tracker/tracker.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "replay_tracker/recorded_run.hpp"

namespace otter_nav::replay {

// One step. In closed loop `command.estimate` is the simulated vessel's and `recorded` what the
// real one did.
struct Step {
  RecordedCycle recorded;
  tracker::Command command;
  vessel::State truth = vessel::State::Zero();  // in closed loop
};

// What the tracker is told. Its weights may have been set anew while the run was recorded; those
// `pinned` stay as in `options` nevertheless.
struct Settings {
  tracker::Options options;
  std::vector<double tracker::Weights::*> pinned;
};

struct Figures {
  double difference_max_n = 0.0;  // of either thruster, to the recorded
  double difference_max_time_s = 0.0;
  double difference_rms_n = 0.0;
  double error_mean_m = 0.0;  // to the reference, while tracking or holding: of the estimate, in
  double error_max_m = 0.0;   // closed loop of the truth
  double thrust_rms_n = 0.0;
  double thrust_rate_rms_nps = 0.0;
  double saturated_share = 0.0;  // of thruster-steps within 0.5 % of a limit
  double yaw_rate_rms_radps = 0.0;
  std::size_t steps = 0;
};
struct Window {
  std::optional<double> from_s;
  std::optional<double> to_s;
  [[nodiscard]] bool has(double time_s) const {
    return time_s >= from_s.value_or(time_s) && time_s <= to_s.value_or(time_s);
  }
};
[[nodiscard]] Figures figures(const std::vector<Step>& steps, const vessel::Thrusters& limits);

// Whose commands the tracker takes for those that moved the vessel.
enum class Sent {
  kOwn,       // its own: as it was, as long as they are the recorded ones
  kRecorded,  // those recorded: other options, or a start in the middle, don't mislead its estimate
};
// Every step of the run up to the window's end is made again, since each rests on those before; the
// result has those in the window. An error names the first hole in the recording; with `partial` it
// is a note, and the steps after it go by what is there.
[[nodiscard]] Result<std::vector<Step>> retrack(const RecordedRun& run, const Settings& settings,
                                                const vessel::Parameters& vessel,
                                                const Window& window, Sent sent, bool partial,
                                                std::vector<std::string>& notes);

// What sails in closed loop.
enum class Hull {
  kModel,  // the vessel file's manoeuvring model, which the tracker predicts with
  kPlant,  // its plant (docs/plant.md)
};
// From the first step of the window on that tracks, with the estimate then as the vessel's state.
[[nodiscard]] Result<std::vector<Step>> sailAgain(const RecordedRun& run, const Settings& settings,
                                                  const vessel::Parameters& vessel, Hull hull,
                                                  const Window& window);

}  // namespace otter_nav::replay
