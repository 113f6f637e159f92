// Keeps a loop to a period on the monotonic clock.
#pragma once

#include <cstdint>

namespace otter_nav::nodes {

class Pacer {
 public:
  // `period_s` of wall time; 0 does not wait at all.
  explicit Pacer(double period_s);

  // The first turn's time is now.
  void start();
  // Sleeps until the next turn. Returns how late it began, s. After a stall of more than a period
  // the turns missed are skipped.
  double waitForNextTurn();

 private:
  std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;
};

}  // namespace otter_nav::nodes
