#include "tracker/handover.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace otter_nav::tracker {
namespace {

struct Order {
  Order(int its_number, std::atomic<int>& count) : number(its_number), living(count) { ++living; }
  Order(const Order&) = delete;
  Order& operator=(const Order&) = delete;
  ~Order() { --living; }

  int number;
  std::atomic<int>& living;
};

class HandoverTest : public ::testing::Test {
 protected:
  void give(int number) { handover.give(std::make_unique<Order>(number, living)); }

  std::atomic<int> living{0};
  Handover<Order> handover;
};

TEST_F(HandoverTest, GivesTheLatestOnce) {
  std::unique_ptr<Order> current;
  EXPECT_FALSE(handover.take(current));
  give(1);
  give(2);
  ASSERT_TRUE(handover.take(current));
  EXPECT_EQ(current->number, 2);
  EXPECT_FALSE(handover.take(current));
  EXPECT_EQ(current->number, 2);
  give(3);
  ASSERT_TRUE(handover.take(current));
  EXPECT_EQ(current->number, 3);
  EXPECT_EQ(living, 2) << "what was let go of is the next giver's to free";
  give(4);
  EXPECT_EQ(living, 2);
}

// One order waits, and another comes while the first is being taken: in a moment of nanoseconds, so
// both sides begin at once, a little apart by as much as their rounds say.
TEST_F(HandoverTest, TheLastOrderIsTakenWheneverItComes) {
  constexpr int kRounds = 5000;
  const auto waitFor = [](const std::atomic<int>& clock, int round) {
    for (int spins = 0; clock.load() < round; ++spins) {
      if (spins > 2000) {
        std::this_thread::yield();
      }
    }
  };
  const auto pass = [](int steps) {
    for (volatile int left = steps; left > 0;) {
      left = left - 1;
    }
  };
  std::atomic<int> begun{0};
  std::atomic<int> given{0};
  std::thread giver([&] {
    for (int round = 1; round <= kRounds; ++round) {
      waitFor(begun, round);
      give(2 * round + 1);
      given.store(round);
    }
  });
  std::unique_ptr<Order> current;
  int lost = 0;
  for (int round = 1; round <= kRounds; ++round) {
    give(2 * round);
    begun.store(round);
    pass(round % 400);
    handover.take(current);
    waitFor(given, round);
    for (int step = 0; step < 3; ++step) {
      handover.take(current);
    }
    lost += current->number == 2 * round + 1 ? 0 : 1;
  }
  giver.join();
  EXPECT_EQ(lost, 0) << "of " << kRounds;
}

// Many givers: nothing leaks, nothing is taken twice, each one's orders come in sequence.
TEST_F(HandoverTest, StandsManyGiversAtOnce) {
  constexpr int kGivers = 3;
  constexpr int kEach = 20000;
  std::atomic<int> at_work{kGivers};
  std::vector<std::thread> givers;
  for (int k = 0; k < kGivers; ++k) {
    givers.emplace_back([&, k] {
      for (int i = 1; i <= kEach; ++i) {
        give(kGivers * i + k);
      }
      --at_work;
    });
  }
  std::unique_ptr<Order> current;
  std::array<int, kGivers> last{};
  bool in_sequence = true;
  const auto step = [&] {
    if (handover.take(current)) {
      int& before = last.at(static_cast<std::size_t>(current->number % kGivers));
      in_sequence = in_sequence && current->number > before;
      before = current->number;
    }
  };
  while (at_work.load() > 0) {
    step();
    std::this_thread::yield();
  }
  for (std::thread& giver : givers) {
    giver.join();
  }
  step();
  EXPECT_TRUE(in_sequence);
  ASSERT_NE(current, nullptr);
  EXPECT_EQ(current->number / kGivers, kEach);
  EXPECT_FALSE(handover.take(current));
  EXPECT_LE(living, 2);
}

}  // namespace
}  // namespace otter_nav::tracker
