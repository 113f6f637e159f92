// A check of numbers on command lines that, unlike CLI::Range, refuses NaN.
#pragma once

#include <CLI/CLI.hpp>
#include <sstream>
#include <string>

namespace otter_nav::tools {

// A number within [min, max].
inline CLI::Validator numberIn(double min, double max) {
  std::ostringstream range;
  range << min << " to " << max;
  const auto check = [min, max, allowed = range.str()](const std::string& text) {
    double value = 0.0;
    const bool within =
        CLI::detail::lexical_cast(text, value) && value >= min && value <= max;  // false for NaN
    return within ? std::string() : text + " is not a number from " + allowed;
  };
  return {check, "in " + range.str()};
}

}  // namespace otter_nav::tools
