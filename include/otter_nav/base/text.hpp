// Text with numbers in it, as printf has them.
#pragma once

#include <cstdio>
#include <string>

namespace otter_nav {

template <typename... Values>
[[nodiscard]] std::string text(const char* format, Values... values) {
  std::string all(static_cast<std::size_t>(std::snprintf(nullptr, 0, format, values...)), '\0');
  std::snprintf(all.data(), all.size() + 1, format, values...);
  return all;
}

}  // namespace otter_nav
