// Which samples are fitted and which are kept back to judge the fit.
#pragma once

#include "otter_nav/base/result.hpp"
#include "otter_nav/identification/identify.hpp"

namespace otter_nav::identification {

// Cuts every stretch into blocks; an error says which of the two sides stays empty.
[[nodiscard]] Result<Split> split(const DataSet& data, const SplitOptions& options);

}  // namespace otter_nav::identification
