#include "thrust_history.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace otter_nav::identification {

ThrustHistory::ThrustHistory(const std::vector<CommandRecord>& commands, double lag_s,
                             double timeout_s)
    : lag_s_(lag_s), now_s_(commands.empty() ? 0.0 : commands.front().stamp_s) {
  for (std::size_t i = 0; i < commands.size(); ++i) {
    switches_.push_back({commands[i].stamp_s, commands[i].thrusts});
    const double silent_s = commands[i].stamp_s + timeout_s;
    const bool last = i + 1 == commands.size();
    if (last || commands[i + 1].stamp_s > silent_s) {
      switches_.push_back({silent_s, vessel::Thrusts::Zero()});
    }
  }
}

double ThrustHistory::nextSwitch() const {
  return next_ < switches_.size() ? switches_[next_].stamp_s
                                  : std::numeric_limits<double>::infinity();
}

void ThrustHistory::takeSwitch() {
  command_ = switches_[next_].thrusts;
  if (lag_s_ <= 0.0) {
    acting_ = command_;
  }
  ++next_;
}

vessel::Thrusts ThrustHistory::advance(double until_s) {
  vessel::Thrusts integral = vessel::Thrusts::Zero();
  while (now_s_ < until_s) {
    while (nextSwitch() <= now_s_) {
      takeSwitch();
    }
    const double end_s = std::min(until_s, nextSwitch());
    const double dt = end_s - now_s_;
    integral += command_ * dt;
    if (lag_s_ > 0.0) {
      const double decay = std::exp(-dt / lag_s_);
      const vessel::Thrusts lagging = acting_ - command_;
      integral += lagging * (lag_s_ * (1.0 - decay));
      acting_ = command_ + lagging * decay;
    }
    now_s_ = end_s;
  }
  return integral;
}

vessel::Thrusts ThrustHistory::mean(double from_s, double to_s) {
  advance(from_s);
  return advance(to_s) / (to_s - from_s);
}

}  // namespace otter_nav::identification
