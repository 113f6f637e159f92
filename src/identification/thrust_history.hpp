// The thrusts that acted, from the commands that were given.
#pragma once

#include <vector>

#include "otter_nav/identification/data_set.hpp"

namespace otter_nav::identification {

// Commands hold until the next one, or until `timeout_s` has passed; acting thrust follows them
// with a first-order lag: T' = (command - T) / lag.
class ThrustHistory {
 public:
  // `commands` in order of time. The lagged thrust starts at zero with the first command.
  ThrustHistory(const std::vector<CommandRecord>& commands, double lag_s, double timeout_s);

  // The mean acting thrust over [from_s, to_s], from_s < to_s. Intervals come in order of time.
  [[nodiscard]] vessel::Thrusts mean(double from_s, double to_s);

 private:
  // Integral of the acting thrust from now_s_ to `until_s`, which becomes now_s_.
  vessel::Thrusts advance(double until_s);
  [[nodiscard]] double nextSwitch() const;
  void takeSwitch();

  struct Switch {
    double stamp_s;
    vessel::Thrusts thrusts;
  };
  std::vector<Switch> switches_;
  std::size_t next_ = 0;
  double lag_s_;
  double now_s_;
  vessel::Thrusts command_ = vessel::Thrusts::Zero();
  vessel::Thrusts acting_ = vessel::Thrusts::Zero();
};

}  // namespace otter_nav::identification
