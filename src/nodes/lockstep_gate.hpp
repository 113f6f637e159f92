// Where the plant waits in lockstep: for the command of a control step, and for the nodes that have
// to have dealt with what it published before time may go on. Thread-safe, knows no ROS.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "otter_nav/vessel/types.hpp"

namespace otter_nav::nodes {

// Times are stamps in ns.
class LockstepGate {
 public:
  // `nodes` have to acknowledge; there may be none.
  explicit LockstepGate(const std::vector<std::string>& nodes);

  void command(std::uint64_t stamp_ns, const vessel::Thrusts& thrusts_n);
  // `node` has dealt with everything up to the stamp. False for a node nobody waits for.
  bool acknowledge(const std::string& node, std::uint64_t stamp_ns);

  // The command for exactly this stamp, or nothing within `patience`.
  [[nodiscard]] std::optional<vessel::Thrusts> waitForCommand(std::uint64_t stamp_ns,
                                                              std::chrono::milliseconds patience);
  // The last command, if it has not been taken before.
  [[nodiscard]] std::optional<vessel::Thrusts> takeLatest();
  // Whether everybody acknowledged up to the stamp within `patience`.
  [[nodiscard]] bool waitForAcknowledgement(std::uint64_t stamp_ns,
                                            std::chrono::milliseconds patience);
  // Who has not acknowledged the stamp, separated by commas.
  [[nodiscard]] std::string missing(std::uint64_t stamp_ns) const;

 private:
  [[nodiscard]] bool complete(std::uint64_t stamp_ns) const;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t command_stamp_ns_ = 0;
  bool taken_ = true;
  vessel::Thrusts command_ = vessel::Thrusts::Zero();
  std::map<std::string, std::uint64_t> acknowledged_ns_;
};

}  // namespace otter_nav::nodes
