// Progress to watch: one line refreshed in place on a terminal; elsewhere a line each time the
// state changes or `quiet_s` have passed.
#pragma once

#include <iosfwd>
#include <string>

namespace otter_nav {

class ProgressLine {
 public:
  ProgressLine(std::ostream& out, bool terminal, double quiet_s = 20.0)
      : out_(out), terminal_(terminal), quiet_s_(quiet_s) {}

  // `t_s`: on whatever clock the work goes by.
  void show(std::string text, const std::string& state, double t_s);
  // How much of something is done: a bar, elsewhere a line each tenth.
  void show(int done, int all);
  // Ends the line on a terminal, so that what follows starts on its own.
  void finish();

 private:
  std::ostream& out_;
  bool terminal_;
  double quiet_s_;
  double shown_s_ = 0.0;
  std::string shown_state_;
  std::size_t width_ = 0;
};

}  // namespace otter_nav
