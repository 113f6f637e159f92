#include "lockstep_gate.hpp"

#include <algorithm>

namespace otter_nav::nodes {

LockstepGate::LockstepGate(const std::vector<std::string>& nodes) {
  for (const std::string& node : nodes) {
    acknowledged_ns_[node] = 0;
  }
}

void LockstepGate::command(std::uint64_t stamp_ns, const vessel::Thrusts& thrusts_n) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    command_stamp_ns_ = stamp_ns;
    command_ = thrusts_n;
    taken_ = false;
  }
  changed_.notify_all();
}

bool LockstepGate::acknowledge(const std::string& node, std::uint64_t stamp_ns) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = acknowledged_ns_.find(node);
    if (found == acknowledged_ns_.end()) {
      return false;
    }
    found->second = std::max(found->second, stamp_ns);
  }
  changed_.notify_all();
  return true;
}

std::optional<vessel::Thrusts> LockstepGate::waitForCommand(std::uint64_t stamp_ns,
                                                            std::chrono::milliseconds patience) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (!changed_.wait_for(lock, patience, [&] { return command_stamp_ns_ == stamp_ns; })) {
    return std::nullopt;
  }
  return command_;
}

std::optional<vessel::Thrusts> LockstepGate::takeLatest() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (taken_) {
    return std::nullopt;
  }
  taken_ = true;
  return command_;
}

bool LockstepGate::waitForAcknowledgement(std::uint64_t stamp_ns,
                                          std::chrono::milliseconds patience) {
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_for(lock, patience, [&] { return complete(stamp_ns); });
}

std::string LockstepGate::missing(std::uint64_t stamp_ns) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string list;
  for (const auto& [node, acknowledged_ns] : acknowledged_ns_) {
    if (acknowledged_ns < stamp_ns) {
      list += (list.empty() ? "" : ", ") + node;
    }
  }
  return list;
}

bool LockstepGate::complete(std::uint64_t stamp_ns) const {
  return std::all_of(acknowledged_ns_.begin(), acknowledged_ns_.end(),
                     [&](const auto& entry) { return entry.second >= stamp_ns; });
}

}  // namespace otter_nav::nodes
