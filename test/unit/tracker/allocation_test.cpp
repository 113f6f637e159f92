// The control loop allocates nothing. Apart from the other tests, since operator new is replaced.
#include <gtest/gtest.h>

#include <string>

#include "../counted_allocations.hpp"
#include "otter_nav/tracker/tracker.hpp"

namespace otter_nav::tracker {
namespace {

// Along a straight line of 30 m from rest to rest, from the second cycle on.
class TrackerAllocation : public ::testing::Test {
 protected:
  TrackerAllocation()
      : tracker_(Tracker::create(
            *config::load<Options>(std::string(OTTER_NAV_SOURCE_DIR) + "/config/tracker.yaml"),
            vessel::Parameters{})) {
    vessel::FlatPoint goal;
    goal.position.x() = 30.0;
    const auto status = tracker_->setTrajectory(
        {trajectory::Trajectory({trajectory::hermitePiece({}, goal, 20.0)}), now_s_});
    EXPECT_TRUE(status) << status.error().message;
    EXPECT_EQ(cycle().mode, Mode::kTracking);
    before_ = test::allocations;
  }
  Command cycle() {
    tracker_->addOdometry(now_s_, state_);
    const Command command = tracker_->step(now_s_);
    tracker_->prepare(now_s_ + 0.01);
    now_s_ += 0.01;
    return command;
  }

  double now_s_ = 100.0;
  vessel::State state_ = vessel::State::Zero();
  std::unique_ptr<Tracker> tracker_;
  int before_ = 0;
};

TEST_F(TrackerAllocation, NoneThroughTrackingAndHolding) {
  Mode mode = Mode::kIdle;
  for (int i = 0; i < 2500; ++i) {  // past the end
    mode = cycle().mode;
    state_[vessel::kX] += mode == Mode::kTracking ? 0.015 : 0.0;
  }
  EXPECT_EQ(mode, Mode::kHolding);
  EXPECT_EQ(test::allocations, before_);
}

TEST_F(TrackerAllocation, NoneAmongNearObstacles) {
  NearObstacles near;
  for (int k = 0; k < 300; ++k) {
    near.points.emplace_back(0.1 * k, k % 2 == 0 ? 0.6 : -0.65);
  }
  ASSERT_TRUE(tracker_->setNearObstacles(near, 3));
  before_ = test::allocations;
  for (int i = 0; i < 500; ++i) {
    EXPECT_EQ(cycle().near_taken, 3U);
    state_[vessel::kX] += 0.015;
  }
  EXPECT_EQ(test::allocations, before_);
}

// The vessel stays where it is and the thrusters are at their limits.
TEST_F(TrackerAllocation, NoneWithBoundsMet) {
  int saturated = 0;
  for (int i = 0; i < 1000; ++i) {
    saturated += cycle().thrusts.maxCoeff() > 49.9 ? 1 : 0;
  }
  EXPECT_GT(saturated, 100);
  EXPECT_EQ(test::allocations, before_);
}

}  // namespace
}  // namespace otter_nav::tracker
