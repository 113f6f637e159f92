#include "otter_nav/base/progress_line.hpp"

#include <ostream>

namespace otter_nav {

void ProgressLine::show(std::string text, const std::string& state, double t_s) {
  if (terminal_) {
    const std::size_t width = text.size();
    text.append(width_ > width ? width_ - width : 0, ' ');
    width_ = width;
    out_ << '\r' << text << std::flush;
    return;
  }
  if (state == shown_state_ && t_s - shown_s_ < quiet_s_) {
    return;
  }
  shown_state_ = state;
  shown_s_ = t_s;
  out_ << text << '\n' << std::flush;
}

void ProgressLine::show(int done, int all) {
  constexpr int kWidth = 40;
  const auto part = [&](int of) { return all > 0 ? of * done / all : of; };
  const auto filled = static_cast<std::size_t>(part(kWidth));
  const std::string count = std::to_string(done) + '/' + std::to_string(all);
  const std::string bar = '[' + std::string(filled, '=') + std::string(kWidth - filled, ' ') + "] ";
  show((terminal_ ? bar : "") + count, std::to_string(part(10)), 0.0);
  if (done == all) {
    finish();
  }
}

void ProgressLine::finish() {
  if (terminal_ && width_ > 0) {
    out_ << '\n' << std::flush;
    width_ = 0;
  }
}

}  // namespace otter_nav
