// Which samples are fitted and which are kept back to judge the fit.
#pragma once

#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/identification/data_set.hpp"

namespace otter_nav::identification {

struct SplitOptions {
  double window_s = 8.0;     // length of one rollout of the fit
  double block_s = 24.0;     // stretches are cut into blocks of this length
  int validation_every = 3;  // every n-th block is kept back for validation
};

struct Split {
  std::vector<Stretch> fit_windows;  // windows share their border samples
  std::vector<Stretch> validation_blocks;
};

// Cuts every stretch into blocks; an error says which of the two sides stays empty.
[[nodiscard]] Result<Split> split(const DataSet& data, const SplitOptions& options);

}  // namespace otter_nav::identification
