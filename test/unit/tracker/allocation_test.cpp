// The control loop allocates nothing. Apart from the other tests, since it replaces operator new.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <new>
#include <string>

#include "otter_nav/tracker/tracker.hpp"

// Counts what the control loop allocates.
namespace {
std::size_t allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) {
    return memory;
  }
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}

namespace otter_nav::tracker {
namespace {

TEST(TrackerAllocation, AllocatesNothingInTheLoop) {
  const auto options = loadOptions(std::string(OTTER_NAV_SOURCE_DIR) + "/config/tracker.yaml");
  ASSERT_TRUE(options) << options.error().message;
  Tracker tracker(*options, vessel::Parameters{});
  vessel::FlatPoint goal;
  goal.position.x() = 30.0;
  double now_s = 100.0;
  ASSERT_TRUE(tracker.setTrajectory(
      trajectory::Trajectory({trajectory::hermitePiece({}, goal, 20.0)}), now_s));
  vessel::State state = vessel::State::Zero();
  const auto cycle = [&] {
    tracker.addOdometry(now_s, state);
    const Command command = tracker.step(now_s);
    tracker.prepare(now_s + 0.01);
    state[vessel::kX] += command.mode == Mode::kTracking ? 0.015 : 0.0;
    now_s += 0.01;
    return command.mode;
  };
  EXPECT_EQ(cycle(), Mode::kTracking);
  const std::size_t before = allocations;
  Mode mode = Mode::kIdle;
  for (int i = 0; i < 2500; ++i) {  // past the end, through holding
    mode = cycle();
  }
  EXPECT_EQ(mode, Mode::kHolding);
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace otter_nav::tracker
