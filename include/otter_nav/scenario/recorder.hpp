// What a mission came to: figures gathered from the true motion while it goes on.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "otter_nav/vessel/types.hpp"

namespace otter_nav::scenario {

enum class Outcome { kArrived, kStopped, kCollided, kCapsized, kTimeout, kError };
[[nodiscard]] const char* name(Outcome outcome);

// Which mission, sailed by whom in what.
struct MissionLabel {
  std::string scenario;
  int mission = 0;
  std::string vessel;
  std::string disturbance;
  std::uint64_t seed = 0;
};

// What an independent check of each step came to.
struct Monitored {
  long steps = 0;
  long violations = 0;    // steps in which something was wrong
  double margin_m = 0.0;  // the least of the hull's outline
  std::string first;      // violation: when, what and where
};

struct MissionResult {
  MissionLabel label;
  Outcome outcome = Outcome::kError;
  std::string reason;  // why it did not arrive; empty if it did
  double duration_s = 0.0;
  double distance_m = 0.0;       // over ground
  double min_clearance_m = 0.0;  // of the hull's outline
  double tracking_error_mean_m = 0.0;
  double tracking_error_max_m = 0.0;
  int replans = 0;
  int replans_for_weather = 0;  // of these
  double planning_ms_median = 0.0;
  double planning_ms_max = 0.0;
  double tracker_ms_p99 = 0.0;
  std::string track;    // the CSV's path; empty if none was written
  std::string vessels;  // the same of other vessels
  std::optional<Monitored> monitored = {};
};

// The true motion at one instant, and where the vessel should have been.
struct MotionSample {
  double t_s = 0.0;
  vessel::State state = vessel::State::Zero();  // true, map frame
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  vessel::Thrusts thrusts_n = vessel::Thrusts::Zero();  // acting
  std::optional<Eigen::Vector3d> reference;             // [x m, y m, psi rad]; none: no trajectory
  double clearance_m = 0.0;                             // of the hull's outline
};

class Recorder {
 public:
  // In the order of time; 10 Hz or more for a distance that means something.
  void addMotion(const MotionSample& sample);
  void addPlanning(double duration_ms) { planning_ms_.push_back(duration_ms); }
  void addTracking(double duration_ms) { tracking_ms_.push_back(duration_ms); }

  [[nodiscard]] double distance() const { return distance_m_; }
  [[nodiscard]] MissionResult result(const MissionLabel& label, Outcome outcome, std::string reason,
                                     int replans) const;

 private:
  std::optional<MotionSample> first_;
  std::optional<MotionSample> last_;
  double distance_m_ = 0.0;
  double min_clearance_m_ = 0.0;
  double error_sum_m_ = 0.0;
  double error_max_m_ = 0.0;
  int error_count_ = 0;
  std::vector<double> planning_ms_;
  std::vector<double> tracking_ms_;
};

}  // namespace otter_nav::scenario
