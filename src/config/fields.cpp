#include "otter_nav/config/fields.hpp"

#include <array>
#include <charconv>

namespace otter_nav::config {

std::string FieldWriter::text(double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), end.ptr};
}

}  // namespace otter_nav::config
