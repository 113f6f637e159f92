#pragma once

#include <cstdio>
#include <string>

namespace otter_nav::mission {

template <typename... Values>
std::string text(const char* format, Values... values) {
  char buffer[160];
  std::snprintf(buffer, sizeof(buffer), format, values...);
  return buffer;
}

}  // namespace otter_nav::mission
