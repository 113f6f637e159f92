// Whether what a program writes would take the place of what it reads.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "otter_nav/base/result.hpp"

namespace otter_nav::tools {

// An error if --output names the file that is read, by whatever path or link.
inline Status notOver(const std::string& input, const std::string& output) {
  std::error_code error;  // there is no such file yet, or it can't be told
  if (std::filesystem::is_regular_file(input, error) &&
      std::filesystem::equivalent(input, output, error)) {
    return failure("--output " + output + ": would be written over " + input + ", which is read");
  }
  return {};
}

}  // namespace otter_nav::tools
