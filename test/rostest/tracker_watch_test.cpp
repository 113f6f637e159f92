// What the planner takes from the tracker's statuses. Needs no master.
#include "nodes/tracker_watch.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace {

using otter_nav::TrackerStatus;
using otter_nav::nodes::TrackerWatch;

constexpr std::uint32_t kSailed = 7;

class TrackerWatchTest : public ::testing::Test {
 protected:
  TrackerWatchTest() { watch_.expect(kSailed, false); }

  void tell(double stamp_s, const std::string& state, std::uint32_t trajectory_id, double off_m) {
    TrackerStatus status;
    status.header.stamp = ros::Time(stamp_s);
    status.state = state;
    status.trajectory_id = trajectory_id;
    status.position_error = off_m;
    watch_.take(status);
    watch_.countUntil(stamp_s);
  }

  TrackerWatch watch_;
};

TEST_F(TrackerWatchTest, TellsHowFarOffTheTrackerIsOnItsWay) {
  EXPECT_FALSE(watch_.trackingError(0.0));
  tell(1.0, TrackerStatus::TRACKING, kSailed, 0.4);
  EXPECT_EQ(watch_.trackingError(1.1), 0.4);
  tell(1.1, TrackerStatus::HOLDING, kSailed, 0.3);
  EXPECT_EQ(watch_.trackingError(1.1), 0.3);
}

TEST_F(TrackerWatchTest, CountsStatusesByTheirStamps) {
  tell(1.0, TrackerStatus::TRACKING, kSailed, 0.4);
  TrackerStatus later;
  later.header.stamp = ros::Time(1.2);
  later.state = TrackerStatus::TRACKING;
  later.trajectory_id = kSailed;
  later.position_error = 2.0;
  watch_.take(later);
  EXPECT_EQ(watch_.trackingError(1.1), 0.4);
  watch_.countUntil(1.2);
  EXPECT_EQ(watch_.trackingError(1.2), 2.0);
}

TEST_F(TrackerWatchTest, NothingIsToldOfAnotherWayOrByOldStatuses) {
  tell(1.0, TrackerStatus::TRACKING, kSailed - 1, 0.4);
  EXPECT_FALSE(watch_.trackingError(1.0)) << "the way before";
  tell(2.0, TrackerStatus::TRACKING, kSailed, 0.4);
  EXPECT_FALSE(watch_.trackingError(2.6)) << "the tracker has fallen silent";
  EXPECT_FALSE(watch_.trackingError(1.4)) << "the clock was set back";
  double now_s = 2.8;
  using Limits = std::numeric_limits<double>;
  for (const double senseless : {Limits::quiet_NaN(), Limits::infinity(), -0.1}) {
    tell(now_s += 0.1, TrackerStatus::TRACKING, kSailed, senseless);
    EXPECT_FALSE(watch_.trackingError(now_s)) << senseless;
  }
  tell(3.5, TrackerStatus::TRACKING, kSailed, 0.0);
  EXPECT_FALSE(watch_.trackingError(3.5)) << "a tracker that leaves it at zero";
  tell(4.0, TrackerStatus::STOPPING, kSailed, 0.4);
  EXPECT_FALSE(watch_.trackingError(4.0)) << "who brakes follows no way";
  tell(5.0, TrackerStatus::TRACKING, kSailed, 0.4);
  watch_.expect(kSailed + 1, false);
  EXPECT_FALSE(watch_.trackingError(5.0)) << "another way is to be sailed";
}

}  // namespace
