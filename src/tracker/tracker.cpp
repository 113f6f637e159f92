#include "otter_nav/tracker/tracker.hpp"

#include <utility>

#include "tracker/core.hpp"

namespace otter_nav::tracker {

std::string_view name(Mode mode) {
  switch (mode) {
    case Mode::kIdle:
      return "idle";
    case Mode::kTracking:
      return "tracking";
    case Mode::kHolding:
      return "holding";
    case Mode::kStopping:
      return "stopping";
    case Mode::kStopped:
      return "stopped";
    case Mode::kFault:
      return "fault";
  }
  return "unknown";
}

Tracker::Tracker(const Options& options, const vessel::Parameters& vessel)
    : core_(std::make_unique<Core>(options, vessel)) {}
Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

Status Tracker::setTrajectory(trajectory::Trajectory trajectory, double start_s) {
  return core_->setTrajectory(std::move(trajectory), start_s);
}

void Tracker::addOdometry(double stamp_s, const vessel::State& state) {
  core_->addOdometry(stamp_s, state);
}

void Tracker::requestStop(std::string_view reason) {
  core_->requestStop(reason);
}

Command Tracker::step(double now_s) {
  return core_->step(now_s);
}

void Tracker::prepare(double next_s) {
  core_->prepare(next_s);
}

const Prediction& Tracker::prediction() const {
  return core_->prediction();
}

const Options& Tracker::options() const {
  return core_->options();
}

}  // namespace otter_nav::tracker
