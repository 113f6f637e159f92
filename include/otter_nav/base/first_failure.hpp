#pragma once

#include "otter_nav/base/result.hpp"

namespace otter_nav {

// What the first of the results that failed says; success if none did.
template <typename... Results>
[[nodiscard]] Status firstFailure(const Results&... results) {
  Status first;
  const auto take = [&first](const auto& result) {
    if (first && !result) {
      first = failure(result.error().message);
    }
  };
  (take(results), ...);
  return first;
}

}  // namespace otter_nav
