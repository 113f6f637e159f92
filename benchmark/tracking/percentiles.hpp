#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace otter_nav::benchmark {

struct Percentiles {
  double median = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

inline Percentiles percentiles(std::vector<double> values) {
  if (values.empty()) {
    return {};
  }
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return {at(0.5), at(0.99), at(1.0)};
}

}  // namespace otter_nav::benchmark
