// Times of the last control cycles: written by the control loop without blocking, read by anybody.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <vector>

#include "otter_nav/base/statistics.hpp"

namespace otter_nav::nodes {

class CycleStatistics {
 public:
  struct Summary {
    double solver_ms_median = 0.0;
    double solver_ms_p99 = 0.0;
    double lateness_ms_max = 0.0;
    double on_time_share = 1.0;  // of cycles that began within kOnTimeMs of their time
  };
  static constexpr double kOnTimeMs = 2.0;

  void add(double solver_ms, double lateness_ms) {
    const std::size_t i = next_++ % kSize;
    solver_ms_[i].store(static_cast<float>(solver_ms), std::memory_order_relaxed);
    lateness_ms_[i].store(static_cast<float>(lateness_ms), std::memory_order_relaxed);
    count_.store(next_, std::memory_order_release);
  }

  [[nodiscard]] Summary summary() const {
    const std::size_t size = std::min(count_.load(std::memory_order_acquire), kSize);
    Summary summary;
    if (size == 0) {
      return summary;
    }
    const std::vector<float> times = copy(solver_ms_, size);
    summary.solver_ms_median = quantile(times, 0.5);
    summary.solver_ms_p99 = quantile(times, 0.99);
    const std::vector<float> lateness = copy(lateness_ms_, size);
    summary.lateness_ms_max =
        static_cast<double>(*std::max_element(lateness.begin(), lateness.end()));
    const auto on_time = std::count_if(lateness.begin(), lateness.end(), [](float late_ms) {
      return static_cast<double>(late_ms) <= kOnTimeMs;
    });
    summary.on_time_share = static_cast<double>(on_time) / static_cast<double>(size);
    return summary;
  }

 private:
  static constexpr std::size_t kSize = 8192;
  using Ring = std::array<std::atomic<float>, kSize>;

  static std::vector<float> copy(const Ring& ring, std::size_t size) {
    std::vector<float> values(size);
    std::transform(
        ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(size), values.begin(),
        [](const std::atomic<float>& value) { return value.load(std::memory_order_relaxed); });
    return values;
  }

  Ring solver_ms_{};
  Ring lateness_ms_{};
  std::size_t next_ = 0;
  std::atomic<std::size_t> count_{0};
};

}  // namespace otter_nav::nodes
