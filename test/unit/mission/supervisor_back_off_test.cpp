#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "otter_nav/stopping/back_off.hpp"
#include "scripted_mission.hpp"

namespace otter_nav::mission {
namespace {

// With all plans refused, until the supervisor backs off; what it asked for on the narrowest level.
std::optional<trajectory::TimedTrajectory> backOff(test::ScriptedMission& mission, Orders next,
                                                   std::vector<planner::Query>& narrow) {
  for (int k = 0; k < 40 && !next.sail; ++k) {
    if (next.plan && next.plan->query.may_end_early) {
      narrow.push_back(next.plan->query);
    }
    next = next.plan ? mission.refuse(*next.plan, "the hull touches") : mission.update(0.1);
  }
  return next.sail;
}
// At a wall.
std::optional<trajectory::TimedTrajectory> backOffFromTheWall(test::ScriptedMission& mission) {
  std::vector<planner::Query> narrow;
  mission.put({1.3, -10.0}, {2.0, 10.0});
  return backOff(mission, *mission.goTo({-20.0, 0.0}), narrow);
}

TEST(BackOff, IsTriedByTheSupervisorBeforeARoundIsLost) {
  test::ScriptedMission mission;
  const auto order = backOffFromTheWall(mission);
  ASSERT_TRUE(order);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kBackingOff);
  mission.rest = order->trajectory.sample(order->trajectory.duration(), vessel::Parameters{}).state;
  for (int k = 0; k < 200 && mission.supervisor->phase() == Phase::kBackingOff; ++k) {
    (void)mission.update(0.1);
  }
  EXPECT_EQ(mission.supervisor->phase(), Phase::kStopped);
  const Orders next = mission.update(0.1);
  ASSERT_TRUE(next.plan);
  EXPECT_GE(mission.field.clearance(next.plan->query.start.flat.position),
            stopping::turningRoom(vessel::Parameters{}.hull));
}

// Where it backed off before: what leads on with less around the hull comes first, once.
TEST(BackOff, ComesAfterPlansWithLessAroundTheHullWhereItWasTriedBefore) {
  test::ScriptedMission mission;
  mission.put({1.3, -10.0}, {2.0, 10.0});
  std::vector<planner::Query> narrow;
  const auto first = backOff(mission, *mission.goTo({-20.0, 0.0}), narrow);
  ASSERT_TRUE(first);
  EXPECT_EQ(narrow.size(), 1U);

  mission.rest = first->trajectory.sample(first->trajectory.duration(), vessel::Parameters{}).state;
  for (int k = 0; k < 200 && mission.supervisor->phase() == Phase::kBackingOff; ++k) {
    (void)mission.update(0.1);
  }
  const double wall_m = mission.rest.x() + 1.3;
  ASSERT_LT(1.3 - wall_m, vessel::Hull{}.length_m);
  mission.put({wall_m, -10.0}, {wall_m + 1.0, 10.0});
  narrow.clear();
  ASSERT_TRUE(backOff(mission, mission.update(0.1), narrow));
  ASSERT_EQ(narrow.size(), 2U);
  EXPECT_LT(narrow[1].limits.hull_margin_m, narrow[0].limits.hull_margin_m);
}

// What lay before the bow is remembered for this goal; where other vessels were near, they may have
// been why.
TEST(BackOff, RemembersTheDeadEndForThisGoal) {
  for (const bool has_company : {false, true}) {
    test::ScriptedMission mission;
    if (has_company) {
      traffic::Track other;
      other.position = {60.0, 60.0};
      mission.tracks = {other};
    }
    const auto order = backOffFromTheWall(mission);
    ASSERT_TRUE(order);
    mission.rest =
        order->trajectory.sample(order->trajectory.duration(), vessel::Parameters{}).state;
    Orders next;
    for (int k = 0; k < 300 && !next.plan; ++k) {
      next = mission.update(0.1);
    }
    ASSERT_TRUE(next.plan);
    ASSERT_EQ(next.plan->query.dead_ends.size(), has_company ? 0U : 1U);
    if (!has_company) {
      EXPECT_NEAR(next.plan->query.dead_ends[0].x(), 0.5 * vessel::Hull{}.length_m, 1e-6);
      EXPECT_NEAR(next.plan->query.dead_ends[0].y(), 0.0, 1e-6);
    }
    const auto orders = mission.goTo({-10.0, 3.0});
    ASSERT_TRUE(orders.value().plan);
    EXPECT_TRUE(orders.value().plan->query.dead_ends.empty());
  }
}

// The stop before it counts, and it is a part of that; but not for ever without a plan.
TEST(BackOff, IsNoStopThatCountsThreeTimes) {
  test::ScriptedMission mission;
  std::optional<trajectory::TimedTrajectory> order = backOffFromTheWall(mission);
  for (int k = 1; k <= 4; ++k) {
    ASSERT_TRUE(order) << k;
    mission.rest =
        order->trajectory.sample(order->trajectory.duration(), vessel::Parameters{}).state;
    for (int j = 0; j < 200 && mission.supervisor->phase() == Phase::kBackingOff; ++j) {
      (void)mission.update(0.1);
    }
    ASSERT_EQ(mission.supervisor->phase(), Phase::kStopped);
    EXPECT_EQ(mission.supervisor->stops(), k <= 3 ? 0 : 1) << k;
    const double wall_m = mission.rest.x() + 1.3;
    mission.put({wall_m, -10.0}, {wall_m + 1.0, 10.0});
    Orders next;
    for (int j = 0; j < 30 && !next.sail; ++j) {
      next = mission.update(0.1);
      if (next.plan) {
        next = mission.refuse(*next.plan, "the hull touches");
      }
    }
    order = next.sail;
  }
}

TEST(BackOff, EndsWhereSomethingComesUpAstern) {
  test::ScriptedMission mission;
  ASSERT_TRUE(backOffFromTheWall(mission));
  EXPECT_FALSE(mission.update(0.5).stop);
  mission.put({-1.7, -1.0}, {-1.1, 1.0});
  EXPECT_TRUE(mission.update(0.1).stop);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kStopping);
}

TEST(BackOff, EndsWhenTheTrackerCannotFollowOrOdometryStays) {
  test::ScriptedMission faulty;
  ASSERT_TRUE(backOffFromTheWall(faulty));
  Situation situation = faulty.situation();
  situation.tracker_fault = true;
  situation.tracker_reason = "the solver fails";
  EXPECT_TRUE(faulty.supervisor->update(faulty.now_s, situation, faulty.field).stop);
  EXPECT_NE(faulty.supervisor->reason().find("the solver fails"), std::string::npos);

  test::ScriptedMission blind;
  ASSERT_TRUE(backOffFromTheWall(blind));
  situation = blind.situation();
  situation.odometry_stamp_s = blind.now_s - 2.0 * blind.options.odometry_timeout_s;
  EXPECT_TRUE(blind.supervisor->update(blind.now_s, situation, blind.field).stop);
  EXPECT_EQ(blind.supervisor->reason(), "no odometry");
}

// A square of 4 m that goes north, `at` 100 s where it is said.
traffic::Track northward(const Eigen::Vector2d& at, double now_s, double mps = 1.5) {
  traffic::Track track;
  track.id = 1;
  track.stamp_s = now_s;
  track.velocity = {0.0, mps};
  track.position = at + (now_s - 100.0) * track.velocity;
  track.heading_rad = 1.5707963;
  track.length_m = track.beam_m = 4.0;
  return track;
}

TEST(StandAside, LeavesTheWayOfWhoDriftsOverHer) {
  constexpr double kDriftMps = 0.4;
  test::ScriptedMission mission;
  const auto orders = mission.goTo({-20.0, 0.0});
  mission.tracks = {northward({0.0, -5.5}, mission.now_s, kDriftMps)};
  (void)mission.refuse(orders->plan.value(), "the hull touches");
  const Orders aside = mission.update(0.1);
  ASSERT_TRUE(aside.sail);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kBackingOff);
  const Eigen::Vector2d end = aside.sail->trajectory.flat(100.0).position;
  EXPECT_GT(end.norm(), 2.0);
  // Something ahead doesn't hold her up; by and by she plans again, and it was no stop that counts.
  Orders next;
  for (int k = 0; k < 300 && !next.plan; ++k) {
    mission.tracks = {northward({0.0, -5.5}, mission.now_s + 0.1, kDriftMps)};
    next = mission.update(0.1);
    EXPECT_FALSE(next.stop) << mission.now_s;
  }
  ASSERT_TRUE(next.plan);
  EXPECT_LT((next.plan->query.start.flat.position - end).norm(), 0.1);
  EXPECT_EQ(mission.supervisor->stops(), 0);
}

// Whoever makes way is evaded, and the mission goes on from there.
TEST(Evading, LeavesTheWayOfWhoComesOverHerAndGoesOn) {
  test::ScriptedMission mission;
  const auto orders = mission.goTo({-20.0, 0.0});
  mission.tracks = {northward({0.0, -12.0}, mission.now_s)};
  (void)mission.refuse(orders->plan.value(), "the hull touches");
  const Orders away = mission.update(0.1);
  ASSERT_TRUE(away.sail);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kEvading);
  constexpr double kHalfM = 2.0 + 1.1;  // hers and ours
  bool plans = false;
  for (int k = 0; k < 600; ++k) {
    mission.tracks = {northward({0.0, -12.0}, mission.now_s + 0.1)};
    const Orders next = mission.update(0.1);
    if (mission.supervisor->phase() == Phase::kArrived) {
      EXPECT_TRUE(next.stop);
      break;
    }
    EXPECT_FALSE(next.stop) << mission.now_s;
    plans = plans || next.plan.has_value();
    const Eigen::Vector2d off =
        mission.situation().state.head<2>() - mission.tracks.front().position;
    EXPECT_GT(off.cwiseAbs().maxCoeff(), kHalfM) << mission.now_s;
  }
  EXPECT_TRUE(plans || mission.supervisor->phase() == Phase::kArrived);
  EXPECT_EQ(mission.supervisor->stops(), 0);
}

// Four beside each other come over her, still some way off.
void putManyNear(test::ScriptedMission& mission) {
  mission.tracks.clear();
  for (int k = 0; k < 4; ++k) {
    mission.tracks.push_back(northward({-12.0 + 8.0 * k, -25.0}, mission.now_s));
    mission.tracks.back().id = k;
  }
}

TEST(Evading, WaitsForNoPlan) {
  test::ScriptedMission mission;
  (void)mission.goTo({-20.0, 0.0});
  putManyNear(mission);
  EXPECT_TRUE(mission.update(0.1).sail);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kEvading);
}

// One decision follows another after a quarter of a second, but at once where somebody near turns.
TEST(Evading, DecidesAtOnceWhenSomebodyNearTurns) {
  test::ScriptedMission mission;
  (void)mission.goTo({-20.0, 0.0});
  const auto come = [&](double towards_mps) {
    putManyNear(mission);
    mission.tracks.push_back(northward({-9.0, -6.0}, mission.now_s + 0.08));
    mission.tracks.back().id = 9;
    mission.tracks.back().velocity.x() = towards_mps;
  };
  come(0.0);
  ASSERT_TRUE(mission.update(0.08).sail);
  ASSERT_EQ(mission.supervisor->phase(), Phase::kEvading);
  come(2.5);
  EXPECT_TRUE(mission.update(0.08).sail);
}

// Nobody's way is known yet: it lies off and looks on, but not for ever.
TEST(Evading, LiesOffBeforeItGoesInAmongMany) {
  test::ScriptedMission mission;
  (void)mission.goTo({-40.0, 0.0});
  const double began_s = mission.now_s;
  const auto goOnUntil = [&](double until_s) {
    while (mission.now_s < began_s + until_s) {
      mission.tracks.clear();
      for (int k = 0; k < 8; ++k) {
        mission.tracks.push_back(northward({-28.0 + 8.0 * k, -30.0}, mission.now_s + 0.1, 1.0));
        mission.tracks.back().id = k;
      }
      (void)mission.update(0.1);
    }
    return -mission.situation().state.x();
  };
  EXPECT_LT(goOnUntil(55.0), 8.0);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kEvading);
  EXPECT_GT(goOnUntil(67.0), 5.0);
}

// Nor does the tracker catch up faster than the mission may sail.
TEST(Evading, KeepsToTheSpeedLimit) {
  constexpr double kLimitMps = 1.2;
  test::ScriptedMission mission;
  ASSERT_TRUE(mission.supervisor->setSpeedMax(kLimitMps));
  (void)mission.goTo({-20.0, 0.0});
  putManyNear(mission);
  const Orders orders = mission.update(0.1);
  ASSERT_EQ(mission.supervisor->phase(), Phase::kEvading);
  ASSERT_TRUE(orders.sail);
  EXPECT_LE(orders.sail->speed_max_mps, kLimitMps);
  const trajectory::Trajectory& way = orders.sail->trajectory;
  for (double t = 0.0; t < way.duration(); t += 0.1) {
    EXPECT_LT(way.flat(t).velocity.norm(), 1.02 * kLimitMps) << t;
  }
}

// Also where she has hardly begun to move: the way would lead on.
TEST(Evading, EndsAtRestWithTheMissionOrAtAPause) {
  for (const bool is_cancelled : {false, true}) {
    test::ScriptedMission mission;
    (void)mission.goTo({-20.0, 0.0});
    putManyNear(mission);
    ASSERT_TRUE(mission.update(0.1).sail);
    Supervisor& supervisor = *mission.supervisor;
    const Orders orders =
        is_cancelled ? supervisor.cancel(mission.now_s, mission.situation(), mission.obstacles())
                     : *supervisor.pause(mission.now_s, mission.situation(), mission.obstacles());
    EXPECT_TRUE(orders.stop) << is_cancelled;
    for (int k = 0; k < 20; ++k) {
      EXPECT_FALSE(mission.update(0.1).sail) << is_cancelled;
    }
    EXPECT_EQ(supervisor.phase(), is_cancelled ? Phase::kIdle : Phase::kPaused);
  }
}

// The way that she is on leads past it.
TEST(Evading, StaysAtTheGoal) {
  test::ScriptedMission mission;
  (void)mission.goTo({-20.0, 0.0});
  putManyNear(mission);
  ASSERT_TRUE(mission.update(0.1).sail);
  Situation there = mission.situation();
  there.state << -20.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  const Orders orders = mission.supervisor->update(mission.now_s, there, mission.obstacles());
  EXPECT_EQ(mission.supervisor->phase(), Phase::kArrived);
  EXPECT_TRUE(orders.stop);
}

// And makes for it though it could not stay there: what comes after the arrival is another matter.
TEST(Evading, ArrivesBeforeTheyComeOverTheGoal) {
  test::ScriptedMission mission;
  (void)mission.goTo({1.5, 0.0});
  const double began_s = mission.now_s;
  while (mission.supervisor->phase() != Phase::kArrived && mission.now_s < began_s + 6.0) {
    mission.tracks.clear();
    for (int k = 0; k < 4; ++k) {
      mission.tracks.push_back(northward({1.5 - 8.0 * k, -21.0}, mission.now_s + 0.1, 3.0));
      mission.tracks.back().id = k;
    }
    (void)mission.update(0.1);
  }
  EXPECT_EQ(mission.supervisor->phase(), Phase::kArrived);
}

// Where she lies against something the search has no way; what else there is goes on.
TEST(Evading, HoldsNothingUpWhereThereIsNoWay) {
  test::ScriptedMission mission;
  mission.put({0.9, -3.0}, {1.5, 3.0});
  auto orders = mission.goTo({-20.0, 0.0});
  ASSERT_TRUE(orders);
  std::optional<PlanRequest> plan = orders->plan;
  int refused = 0;
  for (int k = 0; k < 30; ++k) {
    putManyNear(mission);
    if (plan) {
      (void)mission.refuse(*plan, "the hull touches");
      ++refused;
    }
    const Orders next = mission.update(0.1);
    EXPECT_FALSE(next.stop) << mission.now_s;
    plan = next.plan;
  }
  EXPECT_GT(refused, 5);
}

// Under way between walls, too near for the search: she takes the stop that was verified last.
TEST(Evading, TakesTheLastStopWhereThereIsNoWay) {
  test::ScriptedMission mission;
  mission.setOut(6.0);
  (void)mission.update(0.1);
  const double x = mission.situation().state.x();
  mission.put({x - 3.0, 0.65}, {x + 12.0, 1.5});
  mission.put({x - 3.0, -1.5}, {x + 12.0, -0.65});
  for (int k = 0; k < 4; ++k) {
    mission.tracks.push_back(northward({x - 12.0 + 8.0 * k, -25.0}, mission.now_s + 0.1));
    mission.tracks.back().id = k;
  }
  const Orders orders = mission.update(0.1);
  EXPECT_EQ(mission.supervisor->reason(), "no way among other vessels");
  EXPECT_EQ(mission.supervisor->phase(), Phase::kStopping);
  EXPECT_FALSE(orders.stop);
  ASSERT_TRUE(orders.sail);
  EXPECT_LT(orders.sail->left(mission.now_s), 8.0);
}

// Where nobody is left but no plan leads on she stops, and plans from rest.
TEST(Evading, StopsWhereNobodyIsLeftAndNoPlanLeadsOn) {
  test::ScriptedMission mission;
  (void)mission.goTo({-20.0, 0.0});
  putManyNear(mission);
  ASSERT_TRUE(mission.update(0.1).sail);
  mission.tracks.clear();
  const double began_s = mission.now_s;
  const auto refuseWhile = [&](Phase phase) {
    while (mission.supervisor->phase() == phase && mission.now_s < began_s + 60.0) {
      const std::optional<PlanRequest> plan = mission.update(0.1).plan;
      if (plan) {
        (void)mission.refuse(*plan, "the hull touches");
      }
    }
  };
  refuseWhile(Phase::kEvading);
  EXPECT_GT(mission.now_s, began_s + 4.0);
  EXPECT_LT(mission.now_s, began_s + 8.0);
  refuseWhile(Phase::kStopping);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kStopped);
  EXPECT_TRUE(mission.update(0.1).plan);
  EXPECT_EQ(mission.supervisor->stops(), 0);
}

TEST(StandAside, LosesNoRoundToOthersForAMinute) {
  for (const bool near : {false, true}) {
    test::ScriptedMission mission;
    auto orders = mission.goTo({-20.0, 0.0});
    std::optional<PlanRequest> plan = orders->plan;
    const double began_s = mission.now_s;
    while (mission.supervisor->phase() != Phase::kFailed && mission.now_s < began_s + 100.0) {
      if (near) {  // beside her, and stays there
        mission.tracks = {northward({6.0, 0.0}, 100.0)};
        mission.tracks[0].velocity.setZero();
        mission.tracks[0].stamp_s = mission.now_s;
      }
      if (plan) {
        (void)mission.refuse(*plan, "the hull touches");
      }
      plan = mission.update(0.1).plan;
    }
    EXPECT_EQ(mission.supervisor->phase(), Phase::kFailed);
    EXPECT_EQ(mission.now_s - began_s > 60.0, near);
  }
}

}  // namespace
}  // namespace otter_nav::mission
