// One refreshed line on a terminal; on anything else a line each tenth of the way.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <string>

namespace otter_nav::benchmark {

class ProgressBar {
 public:
  void show(int done, int all) {
    constexpr int kWidth = 40;
    const int tenth = all > 0 ? 10 * done / all : 10;
    if (isatty(STDERR_FILENO) != 0) {
      const int filled = all > 0 ? kWidth * done / all : kWidth;
      std::fprintf(stderr, "\r[%s%s] %d/%d%s",
                   std::string(static_cast<std::size_t>(filled), '=').c_str(),
                   std::string(static_cast<std::size_t>(kWidth - filled), ' ').c_str(), done, all,
                   done == all ? "\n" : "");
    } else if (tenth != last_tenth_) {
      std::fprintf(stderr, "%d/%d\n", done, all);
    }
    last_tenth_ = tenth;
  }

 private:
  int last_tenth_ = 0;
};

}  // namespace otter_nav::benchmark
