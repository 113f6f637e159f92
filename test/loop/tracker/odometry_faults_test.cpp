// The tracker against the plant when odometry comes late, not at all, or wrong.
#include <limits>

#include "vessel_at_sea.hpp"

namespace otter_nav::tracker {
namespace {

using test::Stretch;
using test::VesselAtSea;

TEST(OdometryFaults, LateOdometryIsPredictedToNow) {
  VesselAtSea sea("paper", 0.15);
  ASSERT_TRUE(sea.tracker().setTrajectory({VesselAtSea::eastward(0.0, 2.0, 60.0), sea.now()}));
  sea.sail(15.0);
  EXPECT_LT(sea.sail(10.0).max_error_m, 0.05);
}

TEST(OdometryFaults, EveryTenthMessageIsEnough) {
  VesselAtSea sea("paper");
  ASSERT_TRUE(sea.tracker().setTrajectory({VesselAtSea::eastward(0.0, 2.0, 60.0), sea.now()}));
  sea.sail(15.0);
  int count = 0;
  const Stretch sparse = sea.sail(10.0, [&](double&, vessel::State&) { return ++count % 10 == 0; });
  EXPECT_EQ(sparse.last.mode, Mode::kTracking);
  EXPECT_LT(sparse.max_error_m, 0.05);
}

TEST(OdometryFaults, ShortGapIsBridgedALongOneBrakes) {
  VesselAtSea sea("paper");
  ASSERT_TRUE(sea.tracker().setTrajectory({VesselAtSea::eastward(0.0, 2.0, 120.0), sea.now()}));
  sea.sail(15.0);
  const auto silence = [](double&, vessel::State&) { return false; };
  const Stretch bridged = sea.sail(0.45, silence);
  EXPECT_EQ(bridged.last.mode, Mode::kTracking);
  EXPECT_LT(sea.sail(5.0).max_error_m, 0.1);
  const Stretch lost = sea.sail(4.0, silence);
  EXPECT_EQ(lost.last.mode, Mode::kStopping);
  EXPECT_EQ(lost.last.reason, "odometry lost");
  EXPECT_LT(sea.truth().segment<2>(vessel::kSurge).norm(), 0.6);  // slowed down blind
  const Stretch blind = sea.sail(5.0, silence);
  EXPECT_EQ(blind.last.mode, Mode::kFault);
  EXPECT_EQ(blind.last.thrusts, vessel::Thrusts::Zero());
  EXPECT_EQ(sea.sail(1.0).last.mode, Mode::kStopped);  // it is back
}

TEST(OdometryFaults, AnOutlierIsNotFollowed) {
  VesselAtSea sea("paper");
  ASSERT_TRUE(sea.tracker().setTrajectory({VesselAtSea::eastward(0.0, 2.0, 60.0), sea.now()}));
  sea.sail(15.0);
  int count = 0;
  const Stretch hit = sea.sail(2.0, [&](double&, vessel::State& x) {
    ++count;
    x[1] += count > 50 && count <= 60 ? 15.0 : 0.0;
    x[2] = count % 7 == 0 ? std::numeric_limits<double>::quiet_NaN() : x[2];
    return true;
  });
  EXPECT_EQ(hit.last.mode, Mode::kTracking);
  EXPECT_LT(hit.max_error_m, 0.1);
}

// A navigation system that corrects itself by three metres: the new position is the truth, and the
// vessel goes back to the path with no more than the usual thrust rates.
TEST(OdometryFaults, AJumpThatStaysIsBelieved) {
  VesselAtSea sea("paper");
  ASSERT_TRUE(sea.tracker().setTrajectory({VesselAtSea::eastward(0.0, 2.0, 120.0), sea.now()}));
  sea.sail(15.0);
  const auto shifted = [](double&, vessel::State& x) {
    x[1] += 3.0;
    return true;
  };
  sea.sail(15.0, shifted);
  const Stretch after = sea.sail(5.0, shifted);
  EXPECT_EQ(after.last.mode, Mode::kTracking);
  EXPECT_TRUE(after.last.reason.empty()) << after.last.reason;
  EXPECT_NEAR(sea.truth()[1], -3.0, 0.1);
}

TEST(OdometryFaults, OutOfOrderMessagesAreDropped) {
  VesselAtSea sea("none");
  ASSERT_TRUE(sea.tracker().setTrajectory({VesselAtSea::eastward(0.0, 2.0, 60.0), sea.now()}));
  sea.sail(15.0);
  int count = 0;
  const Stretch mixed = sea.sail(2.0, [&](double& stamp, vessel::State& x) {
    if (++count % 2 == 0) {  // an old one again
      stamp -= 0.5;
      x[0] -= 1.0;
    }
    return true;
  });
  EXPECT_EQ(mixed.last.mode, Mode::kTracking);
  EXPECT_LT(mixed.max_error_m, 0.05);
}

}  // namespace
}  // namespace otter_nav::tracker
