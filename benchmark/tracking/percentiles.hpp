#pragma once

#include <vector>

#include "otter_nav/base/statistics.hpp"

namespace otter_nav::benchmark {

struct Percentiles {
  double median = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

inline Percentiles percentiles(const std::vector<double>& values) {
  return {quantile(values, 0.5), quantile(values, 0.99), quantile(values, 1.0)};
}

}  // namespace otter_nav::benchmark
