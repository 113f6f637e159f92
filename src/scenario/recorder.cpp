#include "otter_nav/scenario/recorder.hpp"

#include <algorithm>
#include <utility>

#include "otter_nav/base/statistics.hpp"

namespace otter_nav::scenario {

const char* name(Outcome outcome) {
  switch (outcome) {
    case Outcome::kArrived:
      return "arrived";
    case Outcome::kStopped:
      return "stopped";
    case Outcome::kCollided:
      return "collided";
    case Outcome::kCapsized:
      return "capsized";
    case Outcome::kTimeout:
      return "timeout";
    case Outcome::kError:
      break;
  }
  return "error";
}

void Recorder::addMotion(const MotionSample& sample) {
  if (last_) {
    distance_m_ += (sample.state.head<2>() - last_->state.head<2>()).norm();
    min_clearance_m_ = std::min(min_clearance_m_, sample.clearance_m);
  } else {
    first_ = sample;
    min_clearance_m_ = sample.clearance_m;
  }
  if (sample.reference) {
    const double error = (sample.state.head<2>() - sample.reference->head<2>()).norm();
    error_sum_m_ += error;
    error_max_m_ = std::max(error_max_m_, error);
    ++error_count_;
  }
  last_ = sample;
}

MissionResult Recorder::result(const MissionLabel& label, Outcome outcome, std::string reason,
                               int replans) const {
  MissionResult result;
  result.label = label;
  result.outcome = outcome;
  result.reason = std::move(reason);
  result.duration_s = last_ ? last_->t_s - first_->t_s : 0.0;
  result.distance_m = distance_m_;
  result.min_clearance_m = min_clearance_m_;
  result.tracking_error_mean_m = error_count_ > 0 ? error_sum_m_ / error_count_ : 0.0;
  result.tracking_error_max_m = error_max_m_;
  result.replans = replans;
  result.planning_ms_median = quantile(planning_ms_, 0.5);
  result.planning_ms_max = quantile(planning_ms_, 1.0);
  result.tracker_ms_p99 = quantile(tracking_ms_, 0.99);
  return result;
}

}  // namespace otter_nav::scenario
