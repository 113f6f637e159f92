#include "pacer.hpp"

#include <cerrno>
#include <cmath>
#include <ctime>

namespace otter_nav::nodes {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

std::int64_t monotonicNs() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kNsPerS + now.tv_nsec;
}

void sleepUntil(std::int64_t time_ns) {
  const timespec time{time_ns / kNsPerS, time_ns % kNsPerS};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) {
  }
}

}  // namespace

Pacer::Pacer(double period_s) : period_ns_(std::llround(period_s * 1e9)) {}

void Pacer::start() {
  next_ns_ = monotonicNs();
}

double Pacer::waitForNextTurn() {
  if (period_ns_ == 0) {
    return 0.0;
  }
  next_ns_ += period_ns_;
  if (monotonicNs() < next_ns_) {
    sleepUntil(next_ns_);
  }
  const std::int64_t late_ns = monotonicNs() - next_ns_;
  if (late_ns > period_ns_) {
    next_ns_ += late_ns;
  }
  return static_cast<double>(late_ns) * 1e-9;
}

}  // namespace otter_nav::nodes
