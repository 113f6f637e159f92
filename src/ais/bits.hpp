// Fields to bits and back; both take the calls that layout.hpp makes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "otter_nav/ais/message.hpp"

namespace otter_nav::ais {

// Six bits a letter: '@' (which ends a text) to '_', then ' ' to '?'.
inline char letterOf(std::uint64_t six) {
  return static_cast<char>(six < 32 ? six + 64 : six);
}

class BitReader {
 public:
  explicit BitReader(std::vector<bool> bits) : bits_(std::move(bits)) {}

  template <typename Number>
  void number(Number& value, std::size_t width) {
    value = static_cast<Number>(take(width));
  }
  void signedNumber(int& value, std::size_t width) { value = static_cast<int>(takeSigned(width)); }
  void scaled(double& value, std::size_t width, double unit, std::int64_t none) {
    set(value, static_cast<std::int64_t>(take(width)), unit, none);
  }
  void scaledSigned(double& value, std::size_t width, double unit, std::int64_t none) {
    set(value, takeSigned(width), unit, none);
  }
  void bearing(double& value, std::size_t width, double unit, std::int64_t none) {
    scaled(value, width, unit, none);
    value = value < 360.0 - 0.5 * unit ? value : kNotAvailable;
  }
  void flag(bool& value) { value = take(1) != 0; }
  void text(std::string& value, std::size_t letters) {
    value.clear();
    bool ended = false;
    for (std::size_t k = 0; k < letters; ++k) {
      const char letter = letterOf(take(6));
      ended = ended || letter == '@';
      if (!ended) {
        value += letter;
      }
    }
    value.erase(value.find_last_not_of(' ') + 1);
  }
  // What is left, up to so many letters, continues a text of `before` letters.
  void rest(std::string& value, std::size_t before, std::size_t letters) {
    std::string more;
    text(more, std::min(letters, (bits_.size() - std::min(at_, bits_.size())) / 6));
    if (!more.empty()) {
      value.resize(before, ' ');
      value += more;
    }
  }
  void spare(std::size_t width) { at_ += width; }

  // Whether more was asked for than there is.
  [[nodiscard]] bool ranOut(std::size_t spare) const { return at_ > bits_.size() + spare; }

 private:
  std::uint64_t take(std::size_t width) {
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < width; ++k, ++at_) {
      value = value << 1U | (at_ < bits_.size() && bits_[at_] ? 1U : 0U);
    }
    return value;
  }
  std::int64_t takeSigned(std::size_t width) {
    const std::uint64_t value = take(width);
    const std::uint64_t sign = std::uint64_t{1} << (width - 1);
    return static_cast<std::int64_t>(value) -
           ((value & sign) != 0 ? static_cast<std::int64_t>(2 * sign) : 0);
  }
  static void set(double& value, std::int64_t raw, double unit, std::int64_t none) {
    value = raw == none ? (none == 0 ? 0.0 : kNotAvailable) : static_cast<double>(raw) * unit;
  }

  std::vector<bool> bits_;
  std::size_t at_ = 0;
};

class BitWriter {
 public:
  template <typename Number>
  void number(const Number& value, std::size_t width) {
    put(static_cast<std::uint64_t>(std::clamp<std::int64_t>(value, 0, largest(width))), width);
  }
  void signedNumber(int value, std::size_t width) {
    put(static_cast<std::uint64_t>(
            std::clamp<std::int64_t>(value, -largest(width - 1) - 1, largest(width - 1))),
        width);
  }
  // What is known never becomes "not available": it stays below that.
  void scaled(double value, std::size_t width, double unit, std::int64_t none) {
    const std::int64_t most = none == 0 ? largest(width) : none - 1;
    put(static_cast<std::uint64_t>(
            std::isfinite(value) ? std::clamp<std::int64_t>(std::llround(value / unit), 0, most)
                                 : none),
        width);
  }
  void scaledSigned(double value, std::size_t width, double unit, std::int64_t none) {
    put(static_cast<std::uint64_t>(
            std::isfinite(value)
                ? std::clamp<std::int64_t>(std::llround(value / unit), 1 - none, none - 1)
                : none),
        width);
  }
  void bearing(double value, std::size_t width, double unit, std::int64_t none) {
    scaled(value < 360.0 - 0.5 * unit ? value : value - 360.0, width, unit, none);
  }
  void flag(bool value) { put(value ? 1U : 0U, 1); }
  void text(const std::string& value, std::size_t letters) {
    for (std::size_t k = 0; k < letters; ++k) {
      put(k < value.size() ? sixOf(value[k]) : 0U, 6);
    }
  }
  void rest(const std::string& value, std::size_t before, std::size_t letters) {
    if (value.size() > before) {
      const std::string more = value.substr(before, letters);
      text(more, more.size());
    }
  }
  void spare(std::size_t width) { put(0, width); }

  [[nodiscard]] const std::vector<bool>& bits() const { return bits_; }

 private:
  static std::int64_t largest(std::size_t width) { return (std::int64_t{1} << width) - 1; }
  static std::uint64_t sixOf(char letter) {
    const bool lower = letter >= 'a' && letter <= 'z';
    const char upper = lower ? static_cast<char>(letter - 'a' + 'A') : letter;
    if (upper > '@' && upper <= '_') {
      return static_cast<std::uint64_t>(upper - 64);
    }
    return upper >= ' ' && upper <= '?' ? static_cast<std::uint64_t>(upper) : '?';
  }
  void put(std::uint64_t value, std::size_t width) {
    for (std::size_t k = width; k-- > 0;) {
      bits_.push_back((value >> k & 1U) != 0);
    }
  }

  std::vector<bool> bits_;
};

}  // namespace otter_nav::ais
