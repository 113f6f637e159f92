#include "mission/plan_requests.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "otter_nav/feasibility/obstacles.hpp"
#include "waters.hpp"

namespace otter_nav::mission {
namespace {

constexpr double kAnyTimeS = 1000.0;

// Two metres per second for 20 s, then to rest within 4 s.
class PlansFromUnderWay : public ::testing::Test {
 protected:
  PlansFromUnderWay() {
    for (int k = 0; k < 400; ++k) {
      requests_.safety.wander(0.1 * k, 0.1);  // too much for speed on the narrow levels
    }
    requests_.safety.inUnknownWater(false);
  }

  // When the plan begins that is asked for at `now_s`, and how fast.
  std::optional<std::pair<double, double>> beginning(double now_s, std::size_t level,
                                                     double conflict_s = kAnyTimeS) {
    requests_.safety.tryLevel(level);
    const std::optional<PlanRequest> request =
        requests_.fromSailed(now_s, sailed_, 1.0, {{20.0, 0.0}, 0.0}, field_, conflict_s);
    if (!request) {
      return std::nullopt;
    }
    return std::pair{request->start_time_s, request->query.start.flat.velocity.norm()};
  }

  map::DistanceField field_ = test::fieldOf(test::openWater());
  PlanRequests requests_{SupervisorOptions{}, vessel::Parameters{}, 1};
  trajectory::TimedTrajectory sailed_{test::eastward({-30.0, 0.0}, 48.0, 2.0), 0.0};
};

// The wide levels leave room for what it wanders at speed.
TEST_F(PlansFromUnderWay, BeginAtOnceWhereItMayBeFast) {
  const auto begins = beginning(10.0, 0);
  ASSERT_TRUE(begins);
  EXPECT_NEAR(begins->first, 10.0 + requests_.latency.seconds(), 1e-9);
  EXPECT_NEAR(begins->second, 2.0, 1e-6);
}

// On a level for a crawl of 0.8 m/s a plan that began at speed would sail the narrow water with it
// for seconds.
TEST_F(PlansFromUnderWay, WaitForTheCrawlThatTheirLevelAsksFor) {
  const double ends_s = sailed_.trajectory.duration();
  const auto begins = beginning(ends_s - 6.0, 3);
  ASSERT_TRUE(begins);
  EXPECT_GT(begins->first, ends_s - 4.0);
  EXPECT_LE(begins->second, 1.0 + 1e-9);
  EXPECT_GT(begins->second, 0.8);
}

// Asked for on the widest, which has no room where it would begin.
TEST_F(PlansFromUnderWay, WaitForTheCrawlOfTheLevelThatHasRoom) {
  map::OccupancyGrid canal = test::openWater();
  test::block(canal, {-40.0, 1.0}, {40.0, 2.0});
  field_ = test::fieldOf(canal);
  const double ends_s = sailed_.trajectory.duration();
  const auto begins = beginning(ends_s - 6.0, 0);
  ASSERT_TRUE(begins);
  EXPECT_GT(begins->first, ends_s - 4.0);
  EXPECT_LE(begins->second, 1.0 + 1e-9);
}

TEST_F(PlansFromUnderWay, DontWaitUntilWhatIsInTheWayIsReachedOrForLong) {
  const double ends_s = sailed_.trajectory.duration();
  EXPECT_FALSE(beginning(ends_s - 6.0, 3, ends_s - 4.0));
  EXPECT_FALSE(beginning(ends_s - 12.0, 3));
}

TEST_F(PlansFromUnderWay, OnALevelForACrawlDontBeginWhereItStaysFast) {
  sailed_.trajectory = test::circle(20.0, 2.0, 60.0);
  EXPECT_TRUE(beginning(10.0, 0));
  EXPECT_FALSE(beginning(10.0, 3));
}

// However often there was none, for it can stop first; from rest the last round does without.
TEST(PlanRequests, KnowUnderWayWhatTheHullLeansInto) {
  vessel::Parameters vessel;
  vessel.manoeuvring.wind_surge_kgpm = 0.5;
  vessel.manoeuvring.wind_sway_kgpm = 0.5;
  PlanRequests requests(SupervisorOptions{}, vessel, 1);
  vessel::Disturbance weather;
  weather.wind_mps = {0.0, 3.0};
  for (int k = 0; k < 50; ++k) {
    requests.safety.feel(0.1 * k, weather);
  }
  for (int round = 0; round < 2; ++round) {
    while (requests.safety.refused()) {
    }
  }
  const map::DistanceField water = test::fieldOf(test::openWater());
  const vessel::Pose goal{{20.0, 0.0}, 0.0};
  const trajectory::TimedTrajectory sailed{test::eastward({-30.0, 0.0}, 48.0, 0.8), 0.0};
  const auto moving = requests.fromSailed(10.0, sailed, 1.0, goal, water, kAnyTimeS);
  ASSERT_TRUE(moving);
  EXPECT_NEAR(moving->query.limits.felt.wind_mps.y(), 3.0, 0.1);
  vessel::State rests = vessel::State::Zero();
  rests[vessel::kX] = -30.0;
  const PlanRequest resting = requests.fromRest(10.0, rests, goal, water);
  EXPECT_TRUE(resting.query.limits.felt.wind_mps.isZero(0.0));
}

}  // namespace
}  // namespace otter_nav::mission
