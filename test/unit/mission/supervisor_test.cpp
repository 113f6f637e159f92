#include "otter_nav/mission/supervisor.hpp"

#include <gtest/gtest.h>

#include "../feasibility/moving_disc.hpp"
#include "otter_nav/trajectory/straight_leg.hpp"
#include "scripted_mission.hpp"

namespace otter_nav::mission {
namespace {

using test::beginsUnderWay;
using test::eastward;
using test::ScriptedMission;

// The trajectory that goes on from a request as the sailed one did, bent to port by 3 m.
trajectory::Trajectory aroundIt(const PlanRequest& request) {
  vessel::FlatPoint beside;
  beside.position = request.query.start.flat.position + Eigen::Vector2d(20.0, 3.0);
  beside.velocity = {4.0, 0.0};
  vessel::FlatPoint end;
  end.position = request.query.goal.flat.position;
  return trajectory::Trajectory({trajectory::hermitePiece(request.query.start.flat, beside, 5.2),
                                 trajectory::hermitePiece(beside, end, 10.0)});
}

TEST(Supervisor, SailsAndArrives) {
  ScriptedMission mission;
  mission.setOut(5.0);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
  while (mission.supervisor->phase() == Phase::kSailing && mission.now_s < 200.0) {
    const Orders orders = mission.update(0.1);
    EXPECT_FALSE(orders.plan || orders.sail || orders.stop);
  }
  EXPECT_EQ(mission.supervisor->phase(), Phase::kArrived);
  EXPECT_EQ(mission.supervisor->replans().all, 0);
}

TEST(Supervisor, KeepsALastStopUnderWayAlone) {
  ScriptedMission mission;
  mission.setOut(5.0);
  (void)mission.update(0.1);
  EXPECT_TRUE(mission.supervisor->lastStop());
  while (mission.supervisor->phase() == Phase::kSailing && mission.now_s < 200.0) {
    (void)mission.update(0.1);
  }
  ASSERT_EQ(mission.supervisor->phase(), Phase::kArrived);
  EXPECT_FALSE(mission.supervisor->lastStop());
}

// Towed away from where it arrived it has not wandered, and the next goal is none for a crawl.
TEST(Supervisor, LearnsNothingOfWanderingWithoutAMission) {
  ScriptedMission mission;
  mission.setOut(5.0);
  while (mission.supervisor->phase() == Phase::kSailing && mission.now_s < 200.0) {
    (void)mission.update(0.1);
  }
  ASSERT_EQ(mission.supervisor->phase(), Phase::kArrived);
  Situation towed = mission.situation();
  for (int k = 0; k < 200; ++k) {
    mission.now_s += 0.1;
    towed.odometry_stamp_s = mission.now_s;
    towed.state.y() += 0.05;
    (void)mission.supervisor->update(mission.now_s, towed, mission.field);
  }
  const auto orders =
      mission.supervisor->setGoal(mission.now_s, {{0.0, 0.0}, 0.0}, towed, mission.field);
  ASSERT_TRUE(orders && orders->plan);
  EXPECT_LT(orders->plan->query.limits.hull_margin_m, 0.1);
}

// Set aside by more than a plan from rest bears each time one comes, it gives up in the end.
TEST(Supervisor, LosesARoundToEachPlanFromRestThatItIsNotAtAnyMore) {
  ScriptedMission mission;
  std::optional<PlanRequest> asked = mission.goTo({40.0, 0.0})->plan;
  int plans = 0;
  for (int k = 0; k < 300 && mission.supervisor->phase() != Phase::kFailed; ++k) {
    if (asked) {
      ++plans;
      mission.rest.y() += 1.0;
      (void)mission.answer(*asked, eastward({0.0, 0.0}, 40.0, 2.0));
    }
    asked = mission.update(0.1).plan;
  }
  EXPECT_EQ(mission.supervisor->phase(), Phase::kFailed);
  EXPECT_EQ(plans, mission.options.rounds_from_rest);
  EXPECT_NE(mission.supervisor->reason().find("set aside"), std::string::npos);
}

TEST(Supervisor, KeepsThePlanWhileTheWayIsClear) {
  ScriptedMission mission;
  mission.setOut(6.0);
  mission.put({0.0, 3.0}, {3.0, 6.0});
  EXPECT_FALSE(mission.update(0.1).plan);
  mission.put({-35.0, -1.0}, {-34.0, 1.0});  // astern already
  EXPECT_FALSE(mission.update(0.1).plan);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
}

TEST(Supervisor, ReplansInMotionWhenTheWayIsBlocked) {
  ScriptedMission mission;
  mission.setOut(6.0);
  const trajectory::TimedTrajectory before = mission.supervisor->sailed();
  mission.put({5.0, -1.0}, {6.0, 1.0});
  const Orders orders = mission.update(0.1);
  ASSERT_TRUE(orders.plan);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kReplanning);
  EXPECT_NE(mission.supervisor->reason().find("on the way"), std::string::npos);
  // By which rosrun otter_nav latency knows conflicts in a recording.
  EXPECT_EQ(mission.supervisor->reason().rfind("only ", 0), 0U) << mission.supervisor->reason();
  const PlanRequest request = *orders.plan;
  const double joint = request.start_time_s - before.start_time_s;
  EXPECT_LT((request.query.start.flat.position - before.trajectory.flat(joint).position).norm(),
            1e-12);
  EXPECT_NEAR(request.query.warm_start.duration(), before.trajectory.duration() - joint, 1e-9);

  mission.now_s += 0.25;
  const Orders answered = mission.answer(request, aroundIt(request));
  ASSERT_TRUE(answered.sail);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
  EXPECT_EQ(mission.supervisor->replans().all, 1);
  EXPECT_EQ(mission.supervisor->replans().for_weather, 0);
  // Up to the joint it is the old way, after it the new one, without a jump.
  const trajectory::TimedTrajectory& sail = *answered.sail;
  for (double t = mission.now_s; t < request.start_time_s; t += 0.01) {
    EXPECT_LT((sail.trajectory.flat(t - sail.start_time_s).position -
               before.trajectory.flat(t - before.start_time_s).position)
                  .norm(),
              1e-9);
  }
  const Eigen::Vector2d later =
      sail.trajectory.flat(request.start_time_s + 5.2 - sail.start_time_s).position;
  EXPECT_NEAR(later.y(), 3.0, 1e-6);
}

// It sets out at 100 s and is at the origin 12 s later.
TEST(Supervisor, MeetsWhatMovesOnTheMissionsClock) {
  const Eigen::Vector2d northward(0.0, 2.0);
  const feasibility::test::MovingDisc then(-112.0 * northward, northward, 1.0);
  const feasibility::test::MovingDisc long_ago(-12.0 * northward, northward, 1.0);
  for (const auto* disc : {&then, &long_ago}) {
    ScriptedMission mission;
    mission.layer = disc;
    mission.setOut(6.0);
    EXPECT_EQ(mission.supervisor->phase() == Phase::kReplanning, disc == &then);
  }
}

TEST(Supervisor, AsksForAPlanThatBeginsWhenTheAnswerComes) {
  ScriptedMission mission;
  const auto orders = mission.goTo({40.0, 0.0});
  ASSERT_TRUE(orders && orders->plan);
  EXPECT_NEAR(orders->plan->start_time_s, mission.now_s + mission.options.planning_latency_s, 1e-9);
}

TEST(Supervisor, StopsInTimeWithoutAPlanAndGoesOnFromRest) {
  ScriptedMission mission;
  mission.setOut(6.0);
  mission.put({5.0, -40.0}, {6.0, 40.0});
  bool stopping = false;
  std::optional<PlanRequest> request;
  for (int k = 0; k < 400 && mission.supervisor->phase() != Phase::kStopped; ++k) {
    const Orders orders = mission.update(0.1);
    stopping = stopping || (orders.sail && mission.supervisor->phase() == Phase::kStopping);
    if (orders.plan) {
      (void)mission.refuse(*orders.plan, "walled in");
    }
    EXPECT_GE(mission.field.clearance(mission.situation().state.head<2>()), 0.8);
  }
  EXPECT_TRUE(stopping);
  ASSERT_EQ(mission.supervisor->phase(), Phase::kStopped);
  EXPECT_EQ(mission.supervisor->stops(), 1);
  const Orders orders = mission.update(0.1);
  ASSERT_TRUE(orders.plan);
  EXPECT_FALSE(beginsUnderWay(*orders.plan));
  const Eigen::Vector2d here = mission.situation().state.head<2>();
  EXPECT_GT(here.x(), -5.0);  // no earlier than needed
  const Orders sailing = mission.answer(*orders.plan, eastward(here, 20.0, 3.0));
  EXPECT_TRUE(sailing.sail);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
  EXPECT_EQ(mission.supervisor->replans().all, 1);
  EXPECT_EQ(mission.supervisor->replans().for_weather, 0);
}

// At rest close to a wall: a way begun with the hull off the place where it is held, and broken off
// at once, would hold it where it was then.
TEST(Supervisor, BeginsNearSomethingWhereItIsHeldWhateverTheSwing) {
  struct Case {
    Eigen::Vector2d off_m;  // of the place, ahead and to port
    double off_rad;
    bool is_near;         // the wall is still there
    bool begins_at_rest;  // where it is held
  };
  const Case cases[] = {{{0.0, 0.0}, 0.0, true, true},     {{0.08, 0.0}, 0.0, true, true},
                        {{-0.05, 0.06}, 0.08, true, true}, {{0.12, 0.0}, 0.0, true, false},
                        {{0.05, 0.0}, 0.12, true, false},  {{0.08, 0.0}, 0.0, false, false}};
  for (const Case& c : cases) {
    ScriptedMission mission;
    mission.setOut(6.0);
    mission.put({5.0, -40.0}, {6.0, 40.0});
    for (int k = 0; k < 400 && mission.supervisor->phase() != Phase::kStopped; ++k) {
      const Orders orders = mission.update(0.1);
      if (orders.plan) {
        (void)mission.refuse(*orders.plan, "walled in");
      }
    }
    ASSERT_EQ(mission.supervisor->phase(), Phase::kStopped);
    Situation swung = mission.situation();
    const Eigen::Vector3d held = swung.state.head<3>();
    ASSERT_LT(mission.field.clearance(held.head<2>()), vessel::Hull{}.length_m);
    if (!c.is_near) {
      mission.grid = test::openWater();
      mission.field = test::fieldOf(mission.grid);
    }
    swung.state += (vessel::State() << c.off_m, c.off_rad, 0.1, 0.0, 0.0).finished();
    mission.now_s += 0.1;
    swung.odometry_stamp_s = mission.now_s;
    const Orders orders = mission.supervisor->update(mission.now_s, swung, mission.obstacles());
    ASSERT_TRUE(orders.plan);
    const Eigen::Vector2d begins = orders.plan->query.start.flat.position;
    const Eigen::Vector2d wanted =
        c.begins_at_rest ? held.head<2>().eval() : swung.state.head<2>().eval();
    EXPECT_LT((begins - wanted).norm(), 1e-9) << c.off_m.transpose() << ", " << c.off_rad;
  }
}

TEST(Supervisor, GivesUpSafelyWhenTheGoalIsWalledOff) {
  ScriptedMission mission;
  mission.setOut(6.0);
  mission.put({5.0, -49.9}, {6.0, 49.9});
  for (int k = 0; k < 1000 && mission.supervisor->phase() != Phase::kFailed; ++k) {
    const Orders orders = mission.update(0.1);
    if (orders.plan) {
      (void)mission.refuse(*orders.plan, "walled off");
    }
  }
  ASSERT_EQ(mission.supervisor->phase(), Phase::kFailed);
  EXPECT_NE(mission.supervisor->reason().find("walled off"), std::string::npos);
  EXPECT_LT(mission.situation().state.tail<3>().norm(), 1e-6);
}

TEST(Supervisor, LatePlansAreAskedForAgainFurtherAhead) {
  ScriptedMission mission;
  mission.setOut(6.0);
  mission.put({25.0, -1.0}, {26.0, 1.0});
  const Orders first = mission.update(0.1);
  ASSERT_TRUE(first.plan);
  mission.now_s += 1.5;
  // Had it come in time, the vessel would be a meter abeam of where it is.
  vessel::FlatPoint aside = first.plan->query.start.flat;
  aside.position += Eigen::Vector2d(4.0, 1.0);
  const Orders second = mission.answer(
      *first.plan,
      trajectory::Trajectory({trajectory::hermitePiece(first.plan->query.start.flat, aside, 1.2)}));
  EXPECT_FALSE(second.sail);
  ASSERT_TRUE(second.plan);
  EXPECT_GT(second.plan->start_time_s - mission.now_s, 0.6);
}

// One from the vessel is late for where that is by then, not for the trajectory it is off.
TEST(Supervisor, TakesLatePlansFromTheVesselThatItIsOnStill) {
  constexpr double kAsideM = 2.0;
  for (const double off_m : {0.0, 1.0}) {
    ScriptedMission mission;
    mission.setOut(6.0);
    const auto astray = [&] {
      Situation s = mission.situation();
      s.state[vessel::kY] += kAsideM;
      s.tracking_error_m = kAsideM;
      return s;
    };
    mission.now_s += 0.5;
    const Orders asked = mission.supervisor->update(mission.now_s, astray(), mission.field);
    ASSERT_TRUE(asked.plan);
    const vessel::FlatPoint& start = asked.plan->query.start.flat;
    ASSERT_NEAR(start.position.y(), kAsideM, 1e-6);
    mission.now_s = asked.plan->start_time_s + 0.1;
    vessel::FlatPoint from = start;
    from.position.y() += off_m;
    vessel::FlatPoint end;
    end.position = from.position + Eigen::Vector2d(40.0, -kAsideM - off_m);
    planner::Plan plan;
    plan.outcome = planner::Outcome::kSolved;
    plan.trajectory = trajectory::Trajectory({trajectory::hermitePiece(from, end, 20.0)});
    const Orders orders = mission.supervisor->planFinished(mission.now_s, asked.plan->id, plan,
                                                           astray(), mission.field);
    EXPECT_EQ(orders.sail.has_value(), off_m == 0.0);
    if (off_m > 0.0) {
      ASSERT_TRUE(orders.plan);
      EXPECT_NEAR(orders.plan->query.start.flat.position.y(), kAsideM, 1e-6);
    }
  }
}

// What was refused for an obstacle that has gone says nothing of the next.
TEST(Supervisor, BeginsAtTheWidestAgainOnceTheWayIsClear) {
  ScriptedMission mission;
  mission.setOut(6.0);
  const map::OccupancyGrid clear = mission.grid;
  mission.put({25.0, -1.0}, {26.0, 1.0});
  Orders orders = mission.update(0.1);
  ASSERT_TRUE(orders.plan);
  const feasibility::SafetyLimits first = orders.plan->query.limits;
  for (int k = 0; k < 6 && orders.plan; ++k) {
    orders = mission.refuse(*orders.plan, "none");
    if (!orders.plan) {
      orders = mission.update(0.01);
    }
  }
  mission.grid = clear;
  mission.field = test::fieldOf(clear);
  (void)mission.update(0.01);
  ASSERT_EQ(mission.supervisor->phase(), Phase::kSailing);
  mission.put({30.0, -1.0}, {31.0, 1.0});
  orders = mission.update(0.5);
  ASSERT_TRUE(orders.plan);
  EXPECT_NEAR(orders.plan->query.limits.clearance_m, first.clearance_m, 1e-6);
  EXPECT_NEAR(orders.plan->query.limits.speed_max_mps, first.speed_max_mps, 1e-6);
}

TEST(Supervisor, GoesBackToSailingWithoutAPlanWhenTheWayClears) {
  ScriptedMission mission;
  mission.setOut(6.0);
  const map::OccupancyGrid clear = mission.grid;
  mission.put({20.0, -1.0}, {21.0, 1.0});
  ASSERT_TRUE(mission.update(0.1).plan);
  mission.grid = clear;
  mission.field = test::fieldOf(clear);
  (void)mission.update(0.1);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
}

TEST(Supervisor, StopsOnLostOdometryAndTrackerFaults) {
  ScriptedMission mission;
  mission.setOut(6.0);
  Situation silent = mission.situation();
  mission.now_s += 1.5;
  Orders orders = mission.supervisor->update(mission.now_s, silent, mission.field);
  EXPECT_TRUE(orders.stop);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kStopping);
  EXPECT_NE(mission.supervisor->reason().find("odometry"), std::string::npos);

  ScriptedMission other;
  other.setOut(6.0);
  Situation fault = other.situation();
  fault.tracker_fault = true;
  fault.tracker_reason = "solver";
  orders = other.supervisor->update(other.now_s, fault, other.field);
  EXPECT_TRUE(orders.stop);
  EXPECT_NE(other.supervisor->reason().find("solver"), std::string::npos);
}

// It brakes on its way, waits at rest, and goes on once scans come again; without any ever it sails
// by the chart.
TEST(Supervisor, StopsWhereNoScanComesIntoTheMapAnyMore) {
  ScriptedMission by_chart;
  by_chart.setOut(6.0);
  EXPECT_EQ(by_chart.supervisor->phase(), Phase::kSailing);

  ScriptedMission m;
  m.scanned_s = m.now_s;
  m.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  const auto orders = m.goTo({40.0, 0.0});
  ASSERT_TRUE(m.answer(*orders->plan, eastward({-40.0, 0.0}, 80.0, 2.0)).sail);
  for (int k = 0; k < 40; ++k) {
    m.scanned_s = m.now_s;
    (void)m.update(0.1);
    ASSERT_EQ(m.supervisor->phase(), Phase::kSailing) << m.supervisor->reason();
  }
  double blind_s = 0.0;
  for (; m.supervisor->phase() == Phase::kSailing && blind_s < 5.0; blind_s += 0.1) {
    EXPECT_FALSE(m.update(0.1).stop);
  }
  EXPECT_NEAR(blind_s, 2.0, 0.25);
  EXPECT_EQ(m.supervisor->phase(), Phase::kStopping);
  EXPECT_NE(m.supervisor->reason().find("no scan"), std::string::npos);
  for (int k = 0; k < 100 && m.supervisor->phase() == Phase::kStopping; ++k) {
    EXPECT_FALSE(m.update(0.1).plan);
  }
  for (int k = 0; k < 20; ++k) {
    EXPECT_FALSE(m.update(0.1).plan);
    ASSERT_EQ(m.supervisor->phase(), Phase::kStopped) << m.supervisor->reason();
  }
  std::optional<PlanRequest> again;
  for (int k = 0; k < 20 && !again; ++k) {
    m.scanned_s = m.now_s;
    again = m.update(0.1).plan;
  }
  EXPECT_TRUE(again);
}

// Not for ever, and nothing begins meanwhile.
TEST(Supervisor, SetsOutOnNothingWhereNoScanComesIntoTheMap) {
  ScriptedMission m;
  m.scanned_s = m.now_s - 10.0;
  const auto orders = m.goTo({40.0, 0.0});
  ASSERT_TRUE(orders && orders->plan);
  EXPECT_FALSE(m.answer(*orders->plan, eastward({0.0, 0.0}, 40.0, 2.0)).sail);
  for (int k = 0; k < 100 && m.supervisor->phase() != Phase::kFailed; ++k) {
    EXPECT_FALSE(m.update(0.1).plan);
  }
  EXPECT_EQ(m.supervisor->phase(), Phase::kFailed);
  EXPECT_NE(m.supervisor->reason().find("no scan"), std::string::npos);
}

TEST(Supervisor, FarOffTheTrajectoryItPlansFromTheVessel) {
  ScriptedMission mission;
  mission.setOut(6.0);
  Situation astray = mission.situation();
  astray.state[vessel::kY] += 4.0;
  astray.tracking_error_m = 4.0;
  mission.now_s += 0.1;
  const Orders orders = mission.supervisor->update(mission.now_s, astray, mission.field);
  ASSERT_TRUE(orders.plan);
  EXPECT_NEAR(orders.plan->query.start.flat.position.y(), 4.0, 1e-6);
  EXPECT_NEAR(orders.plan->query.start.flat.velocity.x(), 4.0, 0.1);
}

// The tracker's error is still that of the way before.
TEST(Supervisor, IsNotFarOffAPlanThatItHasJustTaken) {
  ScriptedMission mission;
  mission.setOut(6.0);
  Situation off = mission.situation();
  off.state[vessel::kY] += 2.0;
  off.tracking_error_m = 2.0;
  const Orders asked = mission.supervisor->update(mission.now_s, off, mission.field);
  ASSERT_TRUE(asked.plan);
  planner::Plan plan;
  plan.outcome = planner::Outcome::kSolved;
  plan.trajectory = eastward(asked.plan->query.start.flat.position, 40.0, 4.0);
  mission.now_s = asked.plan->start_time_s;
  ASSERT_TRUE(mission.supervisor
                  ->planFinished(mission.now_s, asked.plan->id, plan, off, mission.obstacles())
                  .sail);
  for (const double later_s : {0.01, 0.5}) {
    mission.now_s += later_s;
    Situation then = mission.situation();
    then.tracking_error_m = 2.0;
    const bool asks =
        mission.supervisor->update(mission.now_s, then, mission.field).plan.has_value();
    EXPECT_EQ(asks, later_s > 0.1);
  }
}

// What takes a part of the room that it was planned with leaves more than a narrower plan has.
TEST(Supervisor, KeepsAPlanWithTheRoomThatIsAskedForNow) {
  for (const double beside_m : {1.26, 0.76}) {
    ScriptedMission mission;
    mission.setOut(6.0);
    mission.put({0.0, beside_m}, {4.0, beside_m + 2.0});
    Orders orders = mission.update(0.1);
    ASSERT_TRUE(orders.plan);
    EXPECT_DOUBLE_EQ(orders.plan->query.limits.clearance_m, mission.clearance(0));
    orders = mission.refuse(*orders.plan, "");
    const bool keeps = beside_m > mission.clearance(1);
    EXPECT_EQ(orders.plan.has_value(), !keeps);
    EXPECT_EQ(mission.supervisor->phase(), keeps ? Phase::kSailing : Phase::kReplanning);
    orders = mission.update(0.1);
    EXPECT_TRUE(!keeps || !orders.plan);
  }
}

TEST(Supervisor, CancelBrakesAndIsIdleThen) {
  ScriptedMission mission;
  mission.setOut(6.0);
  const Orders orders =
      mission.supervisor->cancel(mission.now_s, mission.situation(), mission.field);
  EXPECT_TRUE(orders.sail);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kStopping);
  for (int k = 0; k < 400 && mission.supervisor->phase() == Phase::kStopping; ++k) {
    (void)mission.update(0.1);
  }
  EXPECT_EQ(mission.supervisor->phase(), Phase::kIdle);
}

TEST(Supervisor, PlansAnewWhenItDoesNotSettle) {
  ScriptedMission mission;
  mission.setOut(5.0);
  mission.now_s += 60.0;
  Situation off = mission.situation();
  off.state[vessel::kPsi] = 1.0;
  (void)mission.supervisor->update(mission.now_s, off, mission.field);
  off.odometry_stamp_s = mission.now_s;
  const Orders orders = mission.supervisor->update(mission.now_s, off, mission.field);
  ASSERT_TRUE(orders.plan);
  EXPECT_FALSE(beginsUnderWay(*orders.plan));
  EXPECT_EQ(orders.plan->query.start.psi_rad, 1.0);
}

TEST(Supervisor, TakesOnlyImprovementsThatSaveTime) {
  SupervisorOptions options;
  options.improve_period_s = 2.0;
  ScriptedMission mission(test::openWater(), options);
  mission.setOut(1.5);
  const Orders orders = mission.update(1.0);
  ASSERT_TRUE(orders.plan);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
  EXPECT_FALSE(mission.answer(*orders.plan, orders.plan->query.warm_start).sail);
  const Orders again = mission.update(2.1);
  ASSERT_TRUE(again.plan);
  vessel::FlatPoint end;
  end.position = again.plan->query.goal.flat.position;
  const double quick = 0.8 * again.plan->query.warm_start.duration();
  EXPECT_TRUE(mission
                  .answer(*again.plan, trajectory::Trajectory({trajectory::hermitePiece(
                                           again.plan->query.start.flat, end, quick)}))
                  .sail);
}

// Near what nobody has seen, a vessel that has just set out is taken to wander, and crawls on the
// levels with little room.
TEST(Supervisor, CrawlsNearUnknownWater) {
  const auto speedAsked = [](double unknown_from_m) {
    ScriptedMission m;
    map::OccupancyGrid seen = m.grid;
    test::block(seen, {unknown_from_m, -10.0}, {unknown_from_m + 10.0, 10.0});
    m.known.emplace(test::fieldOf(seen));
    std::optional<PlanRequest> asked = m.goTo({20.0, 0.0})->plan;
    (void)m.refuse(*asked, "none");
    asked = m.update(0.1).plan;
    return asked ? asked->query.limits.speed_max_mps : 0.0;
  };
  EXPECT_GT(speedAsked(9.0), 3.0);
  EXPECT_NEAR(speedAsked(4.0), 0.8, 1e-9);
}

// Past the narrow place, for which it crawls, a wider way is looked for: the widest, and the next.
TEST(Supervisor, LeavesOffCrawlingWhereAWiderWayLeadsOn) {
  ScriptedMission m;
  std::optional<PlanRequest> asked = m.goTo({20.0, 0.0})->plan;
  for (std::size_t k = 1; k < m.options.side_clearances_m.size() && asked; ++k) {
    (void)m.refuse(*asked, "none");
    asked = m.update(0.1).plan;
  }
  ASSERT_TRUE(asked);
  EXPECT_NEAR(asked->query.limits.speed_max_mps, 0.8, 1e-9);
  ASSERT_TRUE(m.answer(*asked, test::eastward({0.0, 0.0}, 20.0, 0.7)).sail);
  std::vector<double> clearances;
  for (int k = 0; k < 45 && clearances.size() < 2; ++k) {
    if (const std::optional<PlanRequest> wider = m.update(0.1).plan) {
      clearances.push_back(wider->query.limits.clearance_m);
      (void)m.refuse(*wider, "none");
    }
  }
  ASSERT_EQ(clearances.size(), 2U);
  EXPECT_NEAR(clearances[0], m.clearance(0), 1e-9);
  EXPECT_NEAR(clearances[1], m.clearance(m.options.side_clearances_m.size() - 2), 1e-9);
}

// One narrow place, where it begins, makes a plan narrow all along: past it a wider one is asked
// for, and taken where it keeps more room beside what lies ahead.
TEST(Supervisor, KeepsOffWhatLiesInWideWaterOnceTheNarrowPlaceIsBehind) {
  ScriptedMission m;
  m.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  m.put({-41.0, 1.25}, {-35.0, 3.0});
  m.put({20.0, 1.25}, {21.0, 3.0});
  std::optional<PlanRequest> asked = m.goTo({40.0, 0.0})->plan;
  ASSERT_NEAR(asked->query.limits.clearance_m, m.clearance(1), 1e-9);
  ASSERT_TRUE(m.answer(*asked, test::eastward({-40.0, 0.0}, 80.0, 4.0)).sail);
  const auto asksAgain = [&]() -> std::optional<PlanRequest> {
    for (int k = 0; k < 60; ++k) {
      if (std::optional<PlanRequest> wider = m.update(0.1).plan) {
        return wider;
      }
    }
    return std::nullopt;
  };
  asked = asksAgain();
  ASSERT_TRUE(asked);
  EXPECT_GT(m.situation().state.x(), -35.0);
  EXPECT_NEAR(asked->query.limits.clearance_m, m.clearance(0), 1e-9);
  EXPECT_FALSE(m.answer(*asked, asked->query.warm_start).sail);
  vessel::FlatPoint beside;
  beside.position = {20.5, -1.0};
  beside.velocity = {4.0, 0.0};
  vessel::FlatPoint end;
  end.position = {40.0, 0.0};
  const auto leadsAside = [&](const vessel::FlatPoint& start, double longer_s) {
    const double way_s = 0.25 * (beside.position.x() - start.position.x());
    return trajectory::Trajectory({trajectory::hermitePiece(start, beside, way_s),
                                   trajectory::hermitePiece(beside, end, 7.0 + longer_s)});
  };
  for (const double longer_s : {3.0, 1.0}) {
    asked = asksAgain();
    ASSERT_TRUE(asked);
    EXPECT_EQ(m.answer(*asked, leadsAside(asked->query.start.flat, longer_s)).sail.has_value(),
              longer_s < 2.0)
        << longer_s;
  }
  EXPECT_EQ(m.supervisor->replans().for_weather, 0);
  EXPECT_FALSE(asksAgain());
}

// What comes into sight close beside a narrow plan is kept off where there is room to, at little
// cost.
TEST(Supervisor, KeepsOffWhatComesIntoSightBesideANarrowPlan) {
  for (const bool comes_close : {false, true}) {
    ScriptedMission m;
    const double y_m = comes_close ? 0.15 : 0.0;
    m.rest.y() = y_m;
    map::OccupancyGrid seen = m.grid;
    test::block(seen, {7.0, -10.0}, {17.0, 10.0});
    m.known.emplace(test::fieldOf(seen));
    std::optional<PlanRequest> asked = m.goTo({20.0, y_m})->plan;
    for (std::size_t k = 1; k < m.options.side_clearances_m.size() && asked; ++k) {
      (void)m.refuse(*asked, "none");
      asked = m.update(0.1).plan;
    }
    ASSERT_TRUE(asked);
    const double clearance_m = asked->query.limits.clearance_m;
    ASSERT_TRUE(m.answer(*asked, test::eastward({0.0, y_m}, 20.0, 0.7)).sail);
    (void)m.update(1.0);
    m.put({4.0, 0.75}, {4.5, 2.0});
    const auto asksAgain = [&]() -> std::optional<PlanRequest> {
      for (int k = 0; k < 15; ++k) {
        if (std::optional<PlanRequest> another = m.update(0.1).plan) {
          return another;
        }
      }
      return std::nullopt;
    };
    asked = asksAgain();
    ASSERT_EQ(asked.has_value(), comes_close);
    if (!comes_close) {
      continue;
    }
    EXPECT_NEAR(asked->query.limits.clearance_m, clearance_m, 1e-9);
    EXPECT_FALSE(m.answer(*asked, asked->query.warm_start).sail);
    vessel::FlatPoint aside;
    aside.position = {4.25, -0.3};
    aside.velocity = {0.7, 0.0};
    vessel::FlatPoint end;
    end.position = {20.0, y_m};
    for (const double longer_s : {6.0, 0.0}) {
      asked = asksAgain();
      ASSERT_TRUE(asked);
      const vessel::FlatPoint start = asked->query.start.flat;
      const double way_s = (aside.position.x() - start.position.x()) / 0.7;
      const double then_s = (end.position.x() - aside.position.x()) / 0.7 + 2.0;
      EXPECT_EQ(m.answer(*asked, trajectory::Trajectory(
                                     {trajectory::hermitePiece(start, aside, way_s),
                                      trajectory::hermitePiece(aside, end, then_s + longer_s)}))
                    .sail.has_value(),
                longer_s == 0.0);
    }
    EXPECT_EQ(m.supervisor->phase(), Phase::kSailing);
    EXPECT_EQ(m.supervisor->replans().for_weather, 0);
    EXPECT_FALSE(asksAgain());
  }
}

// A plan that was made slow because nobody had seen the water is not sailed slowly for all the way:
// once it is known, a faster one is asked for, and taken, once.
TEST(Supervisor, WhatWasPlannedSlowInUnknownWaterIsPlannedAnewOnceItIsKnown) {
  for (const bool is_seen : {false, true}) {
    ScriptedMission m;
    map::OccupancyGrid seen = m.grid;
    test::block(seen, {4.0, -10.0}, {14.0, 10.0});
    m.known.emplace(test::fieldOf(seen));
    std::optional<PlanRequest> asked = m.goTo({20.0, 0.0})->plan;
    (void)m.refuse(*asked, "none");
    asked = m.update(0.1).plan;
    ASSERT_TRUE(asked);
    ASSERT_TRUE(m.answer(*asked, test::eastward({0.0, 0.0}, 20.0, 0.7)).sail);
    if (is_seen) {
      m.known.reset();
    }
    asked.reset();
    for (int k = 0; k < 40 && !asked; ++k) {
      asked = m.update(0.1).plan;
    }
    EXPECT_EQ(asked.has_value(), is_seen);
    if (asked) {
      EXPECT_GT(asked->query.limits.speed_max_mps, 2.0);
      vessel::FlatPoint end;
      end.position = {20.0, 0.0};
      ASSERT_TRUE(m.answer(*asked, trajectory::Trajectory({trajectory::hermitePiece(
                                       asked->query.start.flat, end, 15.0)}))
                      .sail);
      for (int k = 0; k < 60; ++k) {
        EXPECT_FALSE(m.update(0.1).plan);
      }
    }
  }
}

// Under way towards something, the next clearance is tried at once and not a decision later.
TEST(Supervisor, UnderWayTheNextClearanceIsTriedAtOnce) {
  ScriptedMission m;
  m.setOut(6.0);
  m.put({10.0, -3.0}, {12.0, 3.0});
  std::optional<PlanRequest> asked = m.update(0.1).plan;
  ASSERT_TRUE(asked);
  for (std::size_t k = 1; k < m.options.side_clearances_m.size(); ++k) {
    const double before = asked->query.limits.clearance_m;
    asked = m.refuse(*asked, "none").plan;
    ASSERT_TRUE(asked) << k;
    EXPECT_LT(asked->query.limits.clearance_m, before);
  }
  EXPECT_FALSE(m.refuse(*asked, "none").plan);
}

// Wind and waves may turn the hull far from the attitude it was planned in: what counts is how it
// lies.
TEST(Supervisor, StopsBeforeItTouchesAsItLies) {
  for (const bool is_turned : {false, true}) {
    for (const bool is_narrow : {false, true}) {
      ScriptedMission m;
      m.setOut(6.0);
      Situation s = m.situation();
      const double ahead = s.state.x() + 1.0;
      if (is_narrow) {
        m.put({ahead + 1.0, 0.8}, {ahead + 20.0, 3.0});
      }
      s.state[vessel::kPsi] += is_turned ? 0.4 : 0.0;
      s.odometry_stamp_s = m.now_s;
      (void)m.supervisor->update(m.now_s, s, m.obstacles());
      EXPECT_EQ(m.supervisor->phase() == Phase::kStopping, is_turned && is_narrow);
    }
  }
}

// Nor does it wait for that: the tracker knows sooner where wind and current take the hull. What it
// foresaw on the plan before says nothing.
TEST(Supervisor, StopsBeforeItTouchesWhereTheTrackerForeseesIt) {
  struct Case {
    double sets_mps;
    bool is_narrow, of_this_plan;
    bool stops;
  };
  for (const auto& c : {Case{1.0, true, true, true}, Case{1.0, false, true, false},
                        Case{1.0, true, false, false}, Case{0.3, true, true, false}}) {
    ScriptedMission m;
    const double before_s = m.now_s - 0.5;
    m.setOut(3.0);
    Situation s = m.situation();
    if (c.is_narrow) {
      m.put({s.state.x() + 2.0, 3.0}, {s.state.x() + 40.0, 5.0});
    }
    const Eigen::Vector2d goes(s.state[vessel::kSurge], c.sets_mps);
    s.foreseen = test::foreseenFrom(c.of_this_plan ? m.now_s : before_s, s.state, goes);
    s.odometry_stamp_s = m.now_s;
    (void)m.supervisor->update(m.now_s, s, m.obstacles());
    EXPECT_EQ(m.supervisor->phase() == Phase::kStopping, c.stops)
        << c.sets_mps << " " << c.is_narrow << " " << c.of_this_plan;
  }
}

// Set aside towards something, every stop would touch before the vessel is back on its way: the
// last one is taken.
TEST(Supervisor, StopsWhereNoLaterStopIsClearAsTheHullLies) {
  for (const double aside_m : {-0.4, 0.0, 0.4}) {
    ScriptedMission m;
    m.setOut(6.0);
    (void)m.update(0.1);
    Situation s = m.situation();
    m.put({s.state.x() + 2.5, 0.8}, {s.state.x() + 40.0, 3.0});
    s.state.y() += aside_m;
    (void)m.supervisor->update(m.now_s, s, m.obstacles());
    EXPECT_EQ(m.supervisor->phase(), aside_m > 0.0 ? Phase::kStopping : Phase::kReplanning)
        << aside_m;
  }
}

// Eastward along y = `y_m` at 2 m/s until something comes up and it stops; then that is gone.
Orders stopForWhatGoesAway(ScriptedMission& m, double y_m) {
  m.rest << -40.0, y_m, 0.0, 0.0, 0.0, 0.0;
  const auto orders = m.goTo({40.0, y_m});
  (void)m.answer(*orders->plan, eastward({-40.0, y_m}, 80.0, 2.0));
  (void)m.update(8.0);
  m.put({m.situation().state.x() + 3.0, -5.0}, {m.situation().state.x() + 4.0, 5.0});
  Orders stops = m.update(0.1);
  for (int k = 0; k < 20 && m.supervisor->phase() != Phase::kStopping; ++k) {
    stops = m.update(0.1);
  }
  EXPECT_EQ(m.supervisor->phase(), Phase::kStopping);
  m.grid = test::openWater();
  m.field = test::fieldOf(m.grid);
  return stops;
}

// What it asks for then, or has asked for, is answered with 60 m straight on, the hull `aside_m`
// off the stop: whether that is sailed.
bool goesOnFromTheStop(ScriptedMission& m, const Orders& stops, double aside_m) {
  std::optional<PlanRequest> asked = stops.plan;
  for (int k = 0; k < 10 && !asked; ++k) {
    asked = m.update(0.1).plan;
  }
  EXPECT_TRUE(asked);
  if (!asked) {
    return false;
  }
  const vessel::FlatPoint& start = asked->query.start.flat;
  vessel::FlatPoint end;
  end.position = start.position + Eigen::Vector2d(60.0, 0.0);
  planner::Plan plan;
  plan.outcome = planner::Outcome::kSolved;
  plan.trajectory = trajectory::Trajectory({trajectory::hermitePiece(start, end, 30.0)});
  Situation s = m.situation();
  s.state.y() += aside_m;
  return m.supervisor->planFinished(m.now_s, asked->id, plan, s, m.obstacles()).sail.has_value();
}

// A stop is given up for a plan on which the next stops exist too.
TEST(Supervisor, GoesOnFromAStopOnlyWhereItCanStopForAWhile) {
  for (const double wall_m : {5.0, 40.0}) {
    ScriptedMission m;
    const Orders stops = stopForWhatGoesAway(m, 0.0);
    m.put({m.situation().state.x() + wall_m, -5.0}, {m.situation().state.x() + wall_m + 1.0, 5.0});
    EXPECT_EQ(goesOnFromTheStop(m, stops, 0.0), wall_m > 20.0) << wall_m;
  }
  // Or one beside the way, which leaves the hull some room and stops too little.
  for (const double from_m : {3.0, 10.0}) {
    ScriptedMission m;
    const Orders stops = stopForWhatGoesAway(m, 0.42);
    m.put({m.situation().state.x() + from_m, 1.0}, {m.situation().state.x() + 40.0, 5.0});
    EXPECT_EQ(goesOnFromTheStop(m, stops, 0.0), from_m > 5.0) << from_m;
  }
}

// What the hull is off the stop it is off the plan too: with less than that beside it the plan is
// not taken.
TEST(Supervisor, GoesOnFromAStopOnlyWhereThereIsRoomForWhatItIsOff) {
  const auto goesOn = [](double aside_m, bool has_wall) {
    ScriptedMission m;
    const Orders stops = stopForWhatGoesAway(m, 0.21);
    if (has_wall) {
      m.put({-40.0, 1.0}, {40.0, 2.0});  // 0.25 m beside the hull
    }
    return goesOnFromTheStop(m, stops, aside_m);
  };
  EXPECT_TRUE(goesOn(-0.35, false));
  EXPECT_FALSE(goesOn(-0.35, true));
  EXPECT_TRUE(goesOn(-0.1, true));
}

// While it stops, too: another way to rest is taken where the hull would touch on its way back.
TEST(Supervisor, ChangesAStopThatTouchesAsTheHullLies) {
  for (const double aside_m : {-0.3, 0.0, 0.3}) {
    ScriptedMission m;
    m.setOut(6.0);
    ASSERT_TRUE(m.supervisor->cancel(m.now_s, m.situation(), m.obstacles()).sail);
    const trajectory::Trajectory stop = m.supervisor->sailed().trajectory;
    const Eigen::Vector2d rest = stop.flat(stop.duration()).position;
    m.put({rest.x() - 4.0, 0.75}, {rest.x() + 20.0, 3.0});
    (void)m.update(0.5);
    Situation s = m.situation();
    ASSERT_EQ(m.supervisor->sailed().trajectory.duration(), stop.duration());
    s.state.y() += aside_m;
    s.tracking_error_m = std::abs(aside_m);
    for (int k = 0; k < 30; ++k) {
      m.now_s += 0.1;
      s = m.situation();
      s.state.y() += aside_m;
      s.odometry_stamp_s = m.now_s;
      (void)m.supervisor->update(m.now_s, s, m.obstacles());
    }
    const bool changed = m.supervisor->sailed().trajectory.duration() != stop.duration();
    EXPECT_EQ(changed, aside_m > 0.0) << aside_m;
  }
}

// What was asked for on the way to rest would begin on the one that was given up.
TEST(Supervisor, DropsThePlanThatBeginsOnAStopThatItChanges) {
  ScriptedMission m;
  Orders asked = stopForWhatGoesAway(m, 0.0);
  for (int k = 0; k < 10 && !asked.plan; ++k) {
    asked = m.update(0.05);
  }
  ASSERT_TRUE(asked.plan);
  const trajectory::TimedTrajectory stop = m.supervisor->sailed();
  const double rest_m = stop.trajectory.flat(stop.trajectory.duration()).position.x();
  m.put({rest_m - 0.3, -20.0}, {rest_m + 0.5, 20.0});
  for (int k = 0; k < 10 && m.supervisor->sailed().left(m.now_s) == stop.left(m.now_s); ++k) {
    (void)m.update(0.05);
  }
  ASSERT_NE(m.supervisor->sailed().left(m.now_s), stop.left(m.now_s));
  m.put({rest_m - 0.3, -20.0}, {rest_m + 0.5, 20.0});
  m.grid = test::openWater();
  m.field = test::fieldOf(m.grid);
  const vessel::FlatPoint& start = asked.plan->query.start.flat;
  vessel::FlatPoint end;
  end.position = start.position + Eigen::Vector2d(60.0, 0.0);
  EXPECT_FALSE(
      m.answer(*asked.plan, trajectory::Trajectory({trajectory::hermitePiece(start, end, 30.0)}))
          .sail);
}

// One is kept that goes through where what is sailed is now, to within `off_m`, and comes to rest
// in less than `within_s`.
void expectAStopThatCanBeTaken(const ScriptedMission& m, double off_m, double within_s) {
  SCOPED_TRACE(m.now_s);
  const trajectory::TimedTrajectory& sailed = m.supervisor->sailed();
  const std::optional<trajectory::TimedTrajectory>& stop = m.supervisor->lastStop();
  ASSERT_TRUE(stop);
  const trajectory::Trajectory& path = stop->trajectory;
  EXPECT_LT((path.flat(stop->elapsed(m.now_s)).position -
             sailed.trajectory.flat(sailed.elapsed(m.now_s)).position)
                .norm(),
            off_m);
  EXPECT_LT(path.flat(path.duration()).velocity.norm(), 1e-3);
  EXPECT_LT(stop->left(m.now_s), within_s);
}

// Where none can begin at the moment, as in a bend taken at the limit, one that begins later is
// kept.
TEST(Supervisor, KeepsAStopInAHardBend) {
  ScriptedMission m;
  const auto orders = m.goTo({20.0, 0.0});
  std::vector<trajectory::Piece> pieces = test::circle(2.0, 4.0, 3.0).pieces();
  const vessel::FlatPoint out = pieces.back().flat(pieces.back().duration_s);
  vessel::FlatPoint end;
  end.position = out.position + 5.0 * out.velocity;
  pieces.push_back(trajectory::hermitePiece(out, end, 10.0));
  ASSERT_TRUE(m.answer(*orders->plan, trajectory::Trajectory(pieces)).sail);
  for (int k = 0; k < 25; ++k) {
    (void)m.update(0.1);
    ASSERT_EQ(m.supervisor->phase(), Phase::kSailing);
    expectAStopThatCanBeTaken(m, 0.01, m.supervisor->sailed().left(m.now_s));
  }
}

// Beside something that came up, with less room than the plan's stops keep and more than stops
// must: such a stop is kept, and not the last one that had the plan's margin.
TEST(Supervisor, KeepsAStopWithLessBesideItThanThePlanHas) {
  ScriptedMission m;
  m.rest << -40.0, 0.06, 0.0, 0.0, 0.0, 0.0;
  map::OccupancyGrid seen = m.grid;
  test::block(seen, {-42.0, -8.0}, {-38.0, -4.0});  // by nobody: plans keep 0.4 m
  m.known.emplace(test::fieldOf(seen));
  const auto orders = m.goTo({40.0, 0.06});
  ASSERT_NEAR(orders->plan->query.limits.hull_margin_m, 0.4, 1e-9);
  ASSERT_TRUE(m.answer(*orders->plan, eastward({-40.0, 0.06}, 80.0, 1.5)).sail);
  (void)m.update(5.0);
  m.put({-38.0, 1.0}, {30.0, 3.0});  // as much beside the outline, and less beside the discs
  test::block(seen, {-38.0, 1.0}, {30.0, 3.0});
  m.known.emplace(test::fieldOf(seen));
  for (int k = 0; k < 12; ++k) {
    (void)m.update(0.1);
    ASSERT_EQ(m.supervisor->phase(), Phase::kReplanning);
    expectAStopThatCanBeTaken(m, 1e-3, 15.0);
  }
}

// A slot before the narrowest place: where no other plan is found she stops before the slot, and
// not in it. While there may be one she sails on.
TEST(Supervisor, StopsWhereThereIsMostRoomBeforeWhatItDoesNotPass) {
  for (const bool refused : {false, true}) {
    ScriptedMission m;
    m.rest << -40.0, 0.05, 0.0, 0.0, 0.0, 0.0;
    const auto orders = m.goTo({40.0, 0.05});
    ASSERT_TRUE(m.answer(*orders->plan, eastward({-40.0, 0.05}, 80.0, 1.0)).sail);
    (void)m.update(6.0);
    m.put({-26.0, 1.0}, {-12.0, 4.0});
    m.put({-26.0, -4.0}, {-12.0, -0.76});  // 0.26 m beside the hull
    m.put({-12.0, 0.3}, {-10.0, 4.0});     // and nothing
    for (int k = 0; k < 400 && m.supervisor->phase() != Phase::kStopped; ++k) {
      Orders next = m.update(0.1);
      while (next.plan && refused) {
        next = m.refuse(*next.plan, "walled in");
      }
    }
    ASSERT_EQ(m.supervisor->phase(), Phase::kStopped);
    const double bow_m = m.situation().state.x() + 0.5 * vessel::Hull{}.length_m;
    EXPECT_EQ(bow_m < -26.0, refused) << bow_m;
  }
}

// A plan that leads a part of the way is sailed; one that leads on is taken though it takes longer,
// and where none came the way is planned on from its end, which is no stop that counts.
TEST(Supervisor, SailsAPartOfTheWayAndPlansOn) {
  ScriptedMission m;
  m.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  const auto part = [&](const PlanRequest& request, double length_m, double left_m) {
    planner::Plan plan;
    plan.outcome = planner::Outcome::kSolved;
    plan.trajectory = eastward({-40.0, 0.0}, length_m, 4.0);
    plan.left_m = left_m;
    return m.supervisor->planFinished(m.now_s, request.id, plan, m.situation(), m.obstacles());
  };
  std::optional<PlanRequest> asked = m.goTo({40.0, 0.0})->plan;
  for (int k = 0; k < 10 && asked && !asked->query.may_end_early; ++k) {
    (void)m.refuse(*asked, "none");
    asked = m.update(0.1).plan;
  }
  ASSERT_TRUE(asked);
  ASSERT_TRUE(asked->query.may_end_early);
  EXPECT_EQ(asked->query.limits.clearance_m, m.clearance(3));
  ASSERT_TRUE(part(*asked, 40.0, 40.0).sail);
  EXPECT_EQ(m.supervisor->phase(), Phase::kSailing);
  // Improvements are asked for; what leads no further is left.
  std::optional<PlanRequest> better;
  for (int k = 0; k < 40 && !better; ++k) {
    better = m.update(0.1).plan;
  }
  ASSERT_TRUE(better);
  EXPECT_TRUE(better->query.warm_start.empty());
  EXPECT_FALSE(part(*better, 40.0, 39.0).sail);
  for (int k = 0; k < 400 && m.supervisor->phase() != Phase::kStopped; ++k) {
    if (const Orders later = m.update(0.1); later.plan) {
      (void)m.refuse(*later.plan, "none");
    }
  }
  ASSERT_EQ(m.supervisor->phase(), Phase::kStopped);
  EXPECT_EQ(m.supervisor->stops(), 0);
  EXPECT_NE(m.supervisor->reason().find("40 m of the way"), std::string::npos);
  EXPECT_TRUE(m.update(0.1).plan);
}

// With much of it left, 3 m are hardly any further.
TEST(Supervisor, ReplacesAPartOfTheWayByOneThatLeadsATenthFurther) {
  for (const double left_m : {37.0, 35.0}) {
    ScriptedMission m;
    m.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
    planner::Plan plan;
    plan.outcome = planner::Outcome::kSolved;
    plan.trajectory = eastward({-40.0, 0.0}, 40.0, 2.0);
    plan.left_m = 40.0;
    std::optional<PlanRequest> asked = m.goTo({40.0, 0.0})->plan;
    while (asked && !asked->query.may_end_early) {
      (void)m.refuse(*asked, "none");
      asked = m.update(0.1).plan;
    }
    ASSERT_TRUE(asked);
    (void)m.supervisor->planFinished(m.now_s, asked->id, plan, m.situation(), m.obstacles());
    asked.reset();
    for (int k = 0; k < 60 && !asked; ++k) {
      asked = m.update(0.1).plan;
    }
    ASSERT_TRUE(asked);
    const vessel::FlatPoint& start = asked->query.start.flat;
    vessel::FlatPoint end;
    end.position = {40.0 - left_m, 0.0};
    plan.trajectory = trajectory::Trajectory({trajectory::hermitePiece(start, end, 30.0)});
    plan.left_m = left_m;
    EXPECT_EQ(m.supervisor->planFinished(m.now_s, asked->id, plan, m.situation(), m.obstacles())
                  .sail.has_value(),
              left_m < 36.0);
  }
}

// The last request before the mission would give up is answered with a part of the way.
TEST(Supervisor, HasAllRoundsAgainAfterAPartOfTheWay) {
  ScriptedMission m;
  m.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  const std::size_t levels = m.options.side_clearances_m.size();
  const std::size_t most = levels * static_cast<std::size_t>(m.options.rounds_from_rest);
  std::optional<PlanRequest> asked = m.goTo({40.0, 0.0})->plan;
  const auto next = [&] {
    asked.reset();
    for (int k = 0; k < 100 && !asked && m.supervisor->phase() != Phase::kFailed; ++k) {
      asked = m.update(0.1).plan;
    }
  };
  for (std::size_t k = 1; k < most; ++k) {
    ASSERT_TRUE(asked);
    (void)m.refuse(*asked, "none");
    next();
  }
  ASSERT_TRUE(asked);
  planner::Plan plan;
  plan.outcome = planner::Outcome::kSolved;
  plan.trajectory = eastward({-40.0, 0.0}, 40.0, 4.0);
  plan.left_m = 40.0;
  ASSERT_TRUE(
      m.supervisor->planFinished(m.now_s, asked->id, plan, m.situation(), m.obstacles()).sail);
  for (int k = 0; k < 400 && m.supervisor->phase() != Phase::kStopped; ++k) {
    if (const Orders later = m.update(0.1); later.plan) {
      (void)m.refuse(*later.plan, "none");
    }
  }
  ASSERT_EQ(m.supervisor->phase(), Phase::kStopped);
  for (std::size_t k = 0; k < levels; ++k) {
    next();
    ASSERT_TRUE(asked);
    (void)m.refuse(*asked, "none");
  }
  EXPECT_NE(m.supervisor->phase(), Phase::kFailed);
}

// From rest to rest: two legs with a turn on the spot between them.
trajectory::Trajectory creeping(double last_leg_s = 8.0) {
  return trajectory::Trajectory({trajectory::straightLeg({-40.0, 0.0}, 0.0, 4.0, 8.0),
                                 trajectory::spinPiece({-36.0, 0.0}, 0.0, 1.0, 4.0),
                                 trajectory::straightLeg({-36.0, 0.0}, 1.0, -3.0, last_leg_s)});
}

// A way from stop to stop is left where it next rests, if there is a better one from there: one
// that takes 19 s from there saves time only where more than that is left of the way itself.
TEST(Supervisor, PlansFromTheNextRestOfACreepingWay) {
  for (const double last_leg_s : {8.0, 40.0}) {
    test::ScriptedMission mission;
    mission.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
    const auto orders = mission.goTo({40.0, 0.0});
    (void)mission.answer(*orders->plan, creeping(last_leg_s));
    Orders next;
    for (int k = 0; k < 30 && !next.plan; ++k) {
      next = mission.update(0.1);
    }
    ASSERT_TRUE(next.plan);
    EXPECT_NEAR(next.plan->start_time_s, mission.supervisor->sailed().start_time_s + 8.0, 1e-6);
    EXPECT_TRUE(trajectory::atRest(next.plan->query.start));
    EXPECT_LT((next.plan->query.start.flat.position - Eigen::Vector2d(-36.0, 0.0)).norm(), 1e-6);
    EXPECT_NEAR(next.plan->query.start.psi_rad, 0.0, 1e-6);
    EXPECT_FALSE(next.plan->query.may_creep);
    const Orders better = mission.answer(*next.plan, test::eastward({-36.0, 0.0}, 76.0, 4.0));
    ASSERT_EQ(better.sail.has_value(), last_leg_s > 19.0);
    if (better.sail) {
      const trajectory::Trajectory& sailed = better.sail->trajectory;
      EXPECT_LT((sailed.flat(sailed.duration()).position - Eigen::Vector2d(40.0, 0.0)).norm(),
                1e-6);
    }
  }
}

// Not where something lies on the way before that rest.
TEST(Supervisor, DoesNotPlanFromARestBeyondWhatIsInTheWay) {
  test::ScriptedMission mission;
  mission.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  const auto orders = mission.goTo({40.0, 0.0});
  (void)mission.answer(*orders->plan, creeping());
  mission.put({-36.3, -0.5}, {-35.9, 0.5});
  for (int k = 0; k < 10; ++k) {
    const Orders next = mission.update(0.1);
    EXPECT_FALSE(next.plan && trajectory::atRest(next.plan->query.start) &&
                 mission.supervisor->phase() == Phase::kReplanning);
  }
}

// Behind a slow vessel in a channel: whatever was decided about her, something else can begin soon.
// 6 m of a vessel that goes east at 1 m/s, from x = -84 m on.
traffic::Track slowerAhead(double stamp_s, double began_s) {
  traffic::Track track;
  track.id = 1;
  track.stamp_s = stamp_s;
  track.velocity = {1.0, 0.0};
  track.position = {-84.0 + stamp_s - began_s, 0.0};
  track.length_m = 6.0;
  track.beam_m = 2.0;
  return track;
}

// What is kept when she is heard of is known from before, not from how waves swing the hull then.
TEST(Supervisor, KnowsItsOwnCourseBeforeItHearsOfAnybody) {
  ScriptedMission mission;
  mission.setOut(0.1);
  while (mission.now_s < 106.0) {
    (void)mission.update(0.1);
  }
  ASSERT_TRUE(mission.supervisor->encounters().empty());
  traffic::Track crossing;
  crossing.id = 1;
  crossing.stamp_s = mission.now_s;
  crossing.velocity = {0.0, 1.0};
  crossing.position = {30.0, -13.0};
  crossing.heading_rad = 0.5 * kPi;
  crossing.length_m = 6.0;
  crossing.beam_m = 2.0;
  mission.tracks = {crossing};
  (void)mission.update(0.1);
  const std::vector<encounter::Encounter> met = mission.supervisor->encounters();
  ASSERT_EQ(met.size(), 1U);
  EXPECT_EQ(met[0].role, encounter::Role::kGiveWay);
  EXPECT_LT(met[0].since_s, 102.0);
}

// Who may not have been heard of yet is waited for from when reports come in, not from the first
// goal.
TEST(Supervisor, HearsOfOthersBeforeItsFirstGoal) {
  constexpr double kBeforeS = 40.0;
  for (const bool hears_others : {false, true}) {
    ScriptedMission m(test::openWater(400.0));
    m.hears_others = hears_others;
    m.knowWeather(kBeforeS);
    m.rest << -190.0, 0.0, 0.0, 0.0, 0.0, 0.0;
    const auto orders = m.goTo({190.0, 0.0});
    ASSERT_TRUE(orders && orders->plan);
    (void)m.answer(*orders->plan, eastward({-190.0, 0.0}, 380.0, 1.8));
    const double began_s = m.now_s;
    std::optional<PlanRequest> asked;
    while (!asked && m.now_s < began_s + 25.0) {
      traffic::Track oncoming = slowerAhead(m.now_s + 0.1, began_s);
      oncoming.velocity = {-1.8, 0.0};
      oncoming.position = {170.0 - 1.8 * (m.now_s + 0.1 - began_s), 0.0};
      oncoming.heading_rad = kPi;
      m.tracks = {oncoming};
      asked = m.update(0.1).plan;
    }
    EXPECT_EQ(asked.has_value(), hears_others);
  }
}

TEST(Supervisor, MakesWayWithoutBindingItselfForLong) {
  constexpr double kBeginsMps = 0.4;
  map::OccupancyGrid water = test::openWater(300.0);
  test::block(water, {-149.0, 4.0}, {149.0, 149.0});
  test::block(water, {-149.0, -149.0}, {149.0, -4.0});
  test::ScriptedMission mission(water);
  mission.rest << -140.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  const auto orders = mission.goTo({140.0, 0.0});
  ASSERT_TRUE(orders && orders->plan);
  (void)mission.answer(*orders->plan, test::eastward({-140.0, 0.0}, 280.0, 1.8));
  (void)mission.update(10.0);
  int made = 0;
  double bound_s = 0.0;
  const double began_s = mission.now_s;
  for (int k = 0; k < 300; ++k) {
    mission.tracks = {slowerAhead(mission.now_s + 0.1, began_s)};
    const int before = mission.supervisor->replans().all;
    (void)mission.update(0.1);
    made += mission.supervisor->replans().all - before;
    bound_s = vessel::speedOf(mission.situation().state) < kBeginsMps ? bound_s + 0.1 : 0.0;
    EXPECT_LT(bound_s, 3.0) << 0.1 * k;
  }
  EXPECT_GT(made, 0);
}

// A plan that leads on from making way may lead far round: then the way is sailed on as it is, for
// less than it would cost to break the rules once.
TEST(Supervisor, MakesNoWayThatCostsMoreThanItIsWorth) {
  ScriptedMission m(test::openWater(400.0));
  m.rest << -140.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  const auto orders = m.goTo({140.0, 0.0});
  ASSERT_TRUE(orders && orders->plan);
  (void)m.answer(*orders->plan, eastward({-140.0, 0.0}, 280.0, 1.8));
  (void)m.update(10.0);
  const double began_s = m.now_s;
  const auto leadsOn = [](const PlanRequest& request, double duration_s) {
    vessel::FlatPoint goal;
    goal.position = request.query.goal.flat.position;
    return trajectory::Trajectory(
        {trajectory::hermitePiece(request.query.start.flat, goal, duration_s)});
  };
  for (const auto& [duration_s, taken] : {std::pair{2000.0, false}, std::pair{180.0, true}}) {
    std::optional<PlanRequest> asked;
    for (int k = 0; k < 300 && !asked; ++k) {
      traffic::Track oncoming = slowerAhead(m.now_s + 0.1, began_s);
      oncoming.velocity = {-1.0, 0.0};
      oncoming.position = {60.0 - (m.now_s + 0.1 - began_s), 9.0};
      oncoming.heading_rad = kPi;
      m.tracks = {oncoming};
      asked = m.update(0.1).plan;
    }
    ASSERT_TRUE(asked);
    const int before = m.supervisor->replans().all;
    (void)m.answer(*asked, leadsOn(*asked, duration_s));
    EXPECT_EQ(m.supervisor->phase(), Phase::kSailing);
    EXPECT_EQ(m.supervisor->replans().all, before + (taken ? 1 : 0)) << duration_s;
  }
}

// Moved by waves, or by what holds it in the wind, it waits for a moment of little way, but not for
// long, and not near anything.
TEST(Supervisor, SetsOutWhereItHardlyMoves) {
  // From rest at x; `situation` is at `surge_mps` from then on.
  const auto setsOut = [](ScriptedMission& m, std::optional<PlanRequest> asked, double surge_mps) {
    Situation moves = m.situation();
    moves.state[vessel::kSurge] = surge_mps;
    const double began_s = m.now_s;
    for (int k = 0; k < 100 && m.supervisor->phase() != Phase::kSailing; ++k) {
      planner::Plan plan;
      plan.outcome = planner::Outcome::kSolved;
      plan.trajectory = eastward(moves.state.head<2>(), 30.0 - moves.state.x(), 2.0);
      if (asked) {
        (void)m.supervisor->planFinished(m.now_s, asked->id, plan, moves, m.field);
      }
      m.now_s += 0.1;
      moves.odometry_stamp_s = m.now_s;
      asked = m.supervisor->update(m.now_s, moves, m.field).plan;
    }
    EXPECT_EQ(m.supervisor->phase(), Phase::kSailing);
    return m.now_s - began_s;
  };
  const auto setsOutAfter = [&](double surge_mps, bool near_something, bool plans_with_weather) {
    SupervisorOptions options;
    options.plan_with_weather = plans_with_weather;
    ScriptedMission m(test::openWater(), options);
    if (near_something) {
      m.put({-20.0, 1.5}, {20.0, 3.0});
    }
    m.rest.x() = -10.0;
    return setsOut(m, m.goTo({30.0, 0.0})->plan, surge_mps);
  };
  for (const bool plans_with_weather : {true, false}) {
    EXPECT_LT(setsOutAfter(0.2, false, plans_with_weather), 0.2);
    EXPECT_NEAR(setsOutAfter(0.4, false, plans_with_weather), 3.0, 0.4);
    EXPECT_LT(setsOutAfter(0.4, true, plans_with_weather), 0.2);
  }
  // Having waited once it waits the next time, too.
  ScriptedMission m(test::openWater());
  m.rest.x() = -10.0;
  EXPECT_NEAR(setsOut(m, m.goTo({30.0, 0.0})->plan, 0.4), 3.0, 0.4);
  (void)m.update(3.0);
  (void)m.supervisor->pause(m.now_s, m.situation(), m.field);
  for (int k = 0; k < 200 && m.supervisor->phase() != Phase::kPaused; ++k) {
    (void)m.update(0.1);
  }
  Result<Orders> resumed = m.supervisor->resume(m.now_s, m.situation(), m.field);
  ASSERT_TRUE(resumed);
  EXPECT_NEAR(setsOut(m, resumed->plan, 0.4), 3.0, 0.4);
}

// What was asked for on the way to the goal isn't sailed from there.
TEST(Supervisor, TakesNoPlanOnceItHasArrived) {
  ScriptedMission m;
  m.setOut(2.0);
  std::optional<PlanRequest> asked = m.goTo({40.0, 0.0})->plan;
  for (int k = 0; k < 400 && m.supervisor->phase() != Phase::kArrived; ++k) {
    const Orders orders = m.update(0.1);
    asked = orders.plan ? orders.plan : asked;
  }
  ASSERT_EQ(m.supervisor->phase(), Phase::kArrived);
  ASSERT_TRUE(asked);
  vessel::FlatPoint here;
  here.position = {40.0, 0.0};
  vessel::FlatPoint beyond;
  beyond.position = {45.0, 0.0};
  const trajectory::Trajectory back_and_on(
      {trajectory::hermitePiece(asked->query.start.flat, here, m.now_s - asked->start_time_s),
       trajectory::hermitePiece(here, beyond, 20.0)});
  const Orders late = m.answer(*asked, back_and_on);
  EXPECT_FALSE(late.sail);
  EXPECT_EQ(m.supervisor->phase(), Phase::kArrived);
}

// A way of 220 m to what lies 30 m beside: after a stop there may be a shorter one.
TEST(Supervisor, StopsWhereAWayFarRoundIsLongerThanOneFromRest) {
  constexpr double kSpeedMps = 2.0;
  ScriptedMission m(test::openWater(400.0));
  const auto at = [](double x, double y, double speed_mps) {
    vessel::FlatPoint z;
    z.position = {x, y};
    z.velocity = {speed_mps, 0.0};
    return z;
  };
  const vessel::FlatPoint goal = at(0.0, 30.0, 0.0);
  const auto orders = m.goTo(goal.position, kPi);
  ASSERT_TRUE(orders && orders->plan);
  (void)m.answer(
      *orders->plan,
      trajectory::Trajectory(
          {trajectory::hermitePiece(at(0.0, 0.0, 0.0), at(4.0, 0.0, kSpeedMps), 4.0),
           trajectory::hermitePiece(at(4.0, 0.0, kSpeedMps), at(90.0, 0.0, kSpeedMps), 43.0),
           trajectory::hermitePiece(at(90.0, 0.0, kSpeedMps), at(90.0, 30.0, -kSpeedMps), 30.0),
           trajectory::hermitePiece(at(90.0, 30.0, -kSpeedMps), at(4.0, 30.0, -kSpeedMps), 43.0),
           trajectory::hermitePiece(at(4.0, 30.0, -kSpeedMps), goal, 4.0)}));
  ASSERT_EQ(m.supervisor->phase(), Phase::kSailing);
  (void)m.update(8.0);
  for (const auto& [duration_s, taken] : {std::pair{150.0, false}, std::pair{40.0, true}}) {
    std::optional<PlanRequest> asked;
    for (int k = 0; k < 150 && !asked; ++k) {
      asked = m.update(0.1).plan;
    }
    ASSERT_TRUE(asked);
    const vessel::FlatPoint& rest = asked->query.start.flat;
    EXPECT_LT(rest.velocity.norm(), 1e-6);
    EXPECT_LT((rest.position - m.situation().state.head<2>()).norm(), 15.0);
    EXPECT_GT(asked->start_time_s, m.now_s + 1.0);
    (void)m.answer(*asked,
                   trajectory::Trajectory({trajectory::hermitePiece(rest, goal, duration_s)}));
    EXPECT_EQ(m.supervisor->phase(), Phase::kSailing);
    const trajectory::TimedTrajectory& sailed = m.supervisor->sailed();
    const double left_s = sailed.start_time_s + sailed.trajectory.duration() - m.now_s;
    EXPECT_EQ(left_s < 60.0, taken) << left_s;
    EXPECT_EQ(m.supervisor->replans().all, taken ? 1 : 0);
    EXPECT_LT(
        (sailed.trajectory.flat(sailed.trajectory.duration()).position - goal.position).norm(),
        1e-6);
  }
}

// What is sailed slower behind another vessel leads as far as before: the rest of the way is
// planned from there.
TEST(Supervisor, MakesWayOnAPartOfTheWay) {
  map::OccupancyGrid water = test::openWater(400.0);
  test::block(water, {-199.0, 4.0}, {199.0, 149.0});
  test::block(water, {-199.0, -149.0}, {199.0, -4.0});
  ScriptedMission m(water);
  m.rest << -140.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  const auto orders = m.goTo({190.0, 0.0});
  ASSERT_TRUE(orders && orders->plan);
  planner::Plan plan;
  plan.outcome = planner::Outcome::kSolved;
  plan.trajectory = eastward({-140.0, 0.0}, 280.0, 1.8);
  plan.left_m = 50.0;
  (void)m.supervisor->planFinished(m.now_s, orders->plan->id, plan, m.situation(), m.obstacles());
  (void)m.update(10.0);
  const double began_s = m.now_s;
  const int before = m.supervisor->replans().all;
  for (int k = 0; k < 4000 && m.supervisor->phase() != Phase::kStopped; ++k) {
    m.tracks.clear();
    if (k < 300) {
      m.tracks = {slowerAhead(m.now_s + 0.1, began_s)};
    }
    for (Orders asked = m.update(0.1); asked.plan;) {
      asked = m.refuse(*asked.plan, "none");
    }
  }
  EXPECT_GT(m.supervisor->replans().all, before);
  EXPECT_EQ(m.supervisor->phase(), Phase::kStopped);
  EXPECT_EQ(m.supervisor->stops(), 0) << m.supervisor->reason();
}

}  // namespace
}  // namespace otter_nav::mission
