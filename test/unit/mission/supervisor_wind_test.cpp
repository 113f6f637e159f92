// What the supervisor makes of wind and current.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "../feasibility/moving_disc.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "scripted_mission.hpp"

namespace otter_nav::mission {
namespace {

using Eigen::Vector2d;
using test::beginsUnderWay;
using test::openWater;
using test::ScriptedMission;

SupervisorOptions knowing() {
  SupervisorOptions options;
  options.plan_with_weather = true;
  return options;
}

SupervisorOptions forStillWater() {
  SupervisorOptions options;
  options.plan_with_weather = false;
  return options;
}

// Estimates of a force by time, ten a second; the orders that come of them.
using Force = std::function<Vector2d(double)>;
struct Blown {
  std::vector<PlanRequest> plans;
  bool stop = false;
};
Blown blow(ScriptedMission& mission, double duration_s, const Force& force) {
  Blown blown;
  for (int k = 0; k < static_cast<int>(std::lround(10.0 * duration_s)); ++k) {
    mission.now_s += 0.1;
    mission.disturbance.force_n = force(0.1 * k);
    Orders orders = mission.supervisor->update(mission.now_s, mission.situation(), mission.field);
    if (orders.plan) {
      blown.plans.push_back(*orders.plan);
    }
    blown.stop = blown.stop || orders.stop;
  }
  return blown;
}
Vector2d steady(double /*t*/) {
  return {0.0, 4.0};
}
Vector2d gusty(double t) {
  return {std::fmod(t, 4.0) < 2.0 ? -5.0 : -35.0, 0.0};
}

TEST(SupervisorInWind, KeepsThrustAndDistanceForGustsThatItSaw) {
  ScriptedMission calm;
  const auto still = calm.goTo({20.0, 0.0});
  ASSERT_TRUE(still && still->plan);
  EXPECT_DOUBLE_EQ(still->plan->thrust_share, calm.options.thrust_share);

  ScriptedMission mission(openWater(), knowing());
  blow(mission, 60.0, gusty);
  const auto orders = mission.goTo({20.0, 0.0});
  ASSERT_TRUE(orders && orders->plan);
  EXPECT_LE(orders->plan->thrust_share, calm.options.thrust_share - 0.1);
  EXPECT_GT(orders->plan->query.limits.clearance_m, still->plan->query.limits.clearance_m + 0.3);
  // The plan is made with what blows on the whole.
  EXPECT_NEAR(orders->plan->query.limits.disturbance.force_n.x(), -20.0, 2.0);
}

// A fifth of both thrusters: a plan made with it finds thrust for it itself.
TEST(SupervisorInWind, LeavesThrustAndDistanceToASteadyPush) {
  const Force push = [](double) { return Vector2d(-20.0, 0.0); };
  ScriptedMission mission(openWater(), knowing());
  blow(mission, 60.0, push);
  const auto orders = mission.goTo({20.0, 0.0});
  ASSERT_TRUE(orders && orders->plan);
  EXPECT_NEAR(orders->plan->thrust_share, mission.options.thrust_share, 1e-9);

  ScriptedMission still(openWater(), forStillWater());
  blow(still, 60.0, push);
  const auto others = still.goTo({20.0, 0.0});
  ASSERT_TRUE(others && others->plan);
  EXPECT_NEAR(others->plan->thrust_share, 0.875, 0.026);
}

// A load that swings has set in since the plan in force was made: the next would be slower. That
// somebody else is to be made way for is no reason to be.
TEST(SupervisorInWind, MakesWayAtTheSpeedThatIsSailed) {
  ScriptedMission mission(openWater(400.0), knowing());
  mission.rest << -150.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  const auto orders = mission.goTo({150.0, 0.0});
  ASSERT_TRUE(orders && orders->plan);
  const double sailed_mps = orders->plan->query.limits.speed_max_mps;
  (void)mission.answer(*orders->plan, test::eastward({-150.0, 0.0}, 300.0, 0.9 * sailed_mps));
  std::optional<PlanRequest> onward;
  for (int k = 0; k < 400 && !onward; ++k) {
    mission.disturbance.force_n = {0.0, k % 2 == 0 ? 12.0 : -12.0};
    traffic::Track track;
    track.id = 1;
    track.stamp_s = mission.now_s + 0.1;
    track.velocity = {-2.0, 0.0};
    track.position = {120.0 - 2.0 * (0.1 * k), 0.0};
    track.heading_rad = kPi;
    track.length_m = 6.0;
    track.beam_m = 2.0;
    mission.tracks = {track};
    onward = mission.update(0.1).plan;
  }
  ASSERT_TRUE(onward);
  EXPECT_LT(onward->thrust_share, 1.0);
  EXPECT_NEAR(onward->query.limits.speed_max_mps, sailed_mps, 1e-9);
  ScriptedMission other(openWater(400.0), knowing());
  for (int k = 0; k < 100; ++k) {
    other.disturbance.force_n = {0.0, k % 2 == 0 ? 12.0 : -12.0};
    (void)other.update(0.1);
  }
  const auto slower = other.goTo({150.0, 0.0});
  ASSERT_TRUE(slower && slower->plan);
  EXPECT_LT(slower->plan->query.limits.speed_max_mps, 0.9 * sailed_mps);
}

// Waves move the hull abeam: some thrust is left to hold the heading with.
TEST(SupervisorInWind, LeavesThrustForWhatWavesTurn) {
  const auto otter =
      vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/otter.yaml");
  ASSERT_TRUE(otter);
  const auto thrustShare = [&](double sway_mps) {
    ScriptedMission mission(openWater(), knowing());
    mission.supervisor = Supervisor::create(mission.options, *otter, 1);
    for (int k = 0; k < 300; ++k) {
      mission.rest[vessel::kSway] = sway_mps * std::sin(0.25 * k);
      blow(mission, 0.1, [](double) { return Vector2d(-40.0, 0.0); });
    }
    mission.rest[vessel::kSway] = 0.0;
    const auto orders = mission.goTo({20.0, 0.0});
    EXPECT_TRUE(orders && orders->plan);
    return orders && orders->plan ? orders->plan->thrust_share : 0.0;
  };
  EXPECT_GT(thrustShare(0.0), 0.9);
  EXPECT_LT(thrustShare(0.4), 0.8);
}

// Planned at 2.8 m/s, of 3.1 at full thrust, before waves were felt that sway it by `sway_mps`.
struct Swayed {
  std::optional<PlanRequest> plan;
  double after_s = 0.0;
  double speed_mps = 0.0;  // of what is sailed when it is asked for
};
Swayed sailInWaves(ScriptedMission& mission, double sway_mps) {
  const auto otter =
      vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/otter.yaml");
  mission.supervisor = Supervisor::create(mission.options, *otter, 1);
  mission.knowWeather();
  mission.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  const auto orders = mission.goTo({40.0, 0.0});
  (void)mission.answer(*orders->plan, test::eastward({-40.0, 0.0}, 80.0, 2.8));
  Swayed found;
  for (int k = 0; k < 200 && !found.plan; ++k) {
    mission.now_s += 0.1;
    Situation situation = mission.situation();
    situation.state[vessel::kSway] += sway_mps * std::sin(0.25 * k);
    found.plan = mission.supervisor->update(mission.now_s, situation, mission.obstacles()).plan;
    found.after_s = 0.1 * k;
    found.speed_mps = situation.state[vessel::kSurge];
  }
  return found;
}

// What the waves take is known a while after it set out: the plan is replaced by a slower one, at
// speed; the vessel may go as fast as before to make good what it lost.
TEST(SupervisorInWind, PlansSlowerOnceItKnowsWhatWavesTake) {
  ScriptedMission calm(openWater(), knowing());
  EXPECT_FALSE(sailInWaves(calm, 0.02).plan.has_value());

  ScriptedMission mission(openWater(), knowing());
  const Swayed found = sailInWaves(mission, 0.25);
  ASSERT_TRUE(found.plan.has_value());
  EXPECT_GT(found.after_s, 4.0);
  EXPECT_LT(found.after_s, 12.0);
  EXPECT_TRUE(beginsUnderWay(*found.plan));
  EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);  // on what it has, meanwhile
  EXPECT_GT(found.speed_mps, 2.7);
  EXPECT_LT(found.plan->query.limits.speed_max_mps, 2.6);
  const trajectory::TimedTrajectory& sailed = mission.supervisor->sailed();
  const Vector2d from =
      sailed.trajectory.flat(found.plan->start_time_s - sailed.start_time_s).position;
  const Orders taken = mission.answer(*found.plan, test::eastward(from, 40.0 - from.x(), 2.0));
  ASSERT_TRUE(taken.sail);
  EXPECT_GT(taken.sail->speed_max_mps, 2.7);
}

// Begun above its limit it slows down later; a plan in its place would begin there again.
TEST(SupervisorInWind, KeepsTheSlowerPlanWhileThatIsStillFast) {
  ScriptedMission mission(openWater(), knowing());
  const Swayed found = sailInWaves(mission, 0.25);
  ASSERT_TRUE(found.plan.has_value());
  const trajectory::TimedTrajectory& sailed = mission.supervisor->sailed();
  const Vector2d from =
      sailed.trajectory.flat(found.plan->start_time_s - sailed.start_time_s).position;
  ASSERT_TRUE(
      mission.answer(*found.plan, test::eastward(from, 40.0 - from.x(), found.speed_mps)).sail);
  for (int k = 0; k < 60; ++k) {
    mission.now_s += 0.1;
    Situation situation = mission.situation();
    situation.state[vessel::kSway] += 0.25 * std::sin(0.25 * k);
    EXPECT_FALSE(mission.supervisor->update(mission.now_s, situation, mission.obstacles()).plan)
        << k;
  }
}

// What is asked for within that time by a vessel that is set aside by `off_m`.
std::optional<PlanRequest> sailAside(ScriptedMission& mission, double within_s, double off_m) {
  for (int k = 0; k < static_cast<int>(10.0 * within_s); ++k) {
    mission.now_s += 0.1;
    Situation aside = mission.situation();
    aside.state.y() += off_m;
    aside.tracking_error_m = off_m;
    Orders asked = mission.supervisor->update(mission.now_s, aside, mission.field);
    if (asked.plan) {
      return asked.plan;
    }
  }
  return std::nullopt;
}

// Eastward against a firm load, set back by `off_m` after six seconds: whether the next plan starts
// at the vessel.
bool startsAtTheVessel(const SupervisorOptions& options, double off_m) {
  ScriptedMission mission(openWater(), options);
  const auto load = [](double) { return Vector2d(-20.0, 0.0); };
  blow(mission, 10.0, load);
  mission.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  const auto orders = mission.goTo({40.0, 0.0});
  EXPECT_TRUE(orders && orders->plan);
  (void)mission.answer(*orders->plan, test::eastward({-40.0, 0.0}, 80.0, 1.5));
  blow(mission, 6.0, load);
  Situation behind = mission.situation();
  behind.state[vessel::kX] -= off_m;
  behind.tracking_error_m = off_m;
  mission.now_s += 0.1;
  (void)mission.supervisor->update(mission.now_s, behind, mission.field);
  return mission.supervisor->reason().find("far off") != std::string::npos;
}

// A plan made with the load, from where that has set the vessel, can be followed again: it comes
// sooner than one that knows nothing of it.
TEST(SupervisorInWind, PlansFromTheVesselSoonerWithWhatPushesIt) {
  const double most_m = SupervisorOptions{}.tracking_error_max_m;
  EXPECT_FALSE(startsAtTheVessel(knowing(), 0.65 * most_m));
  EXPECT_TRUE(startsAtTheVessel(knowing(), 0.75 * most_m));
  EXPECT_FALSE(startsAtTheVessel(forStillWater(), 0.95 * most_m));
  EXPECT_TRUE(startsAtTheVessel(forStillWater(), 1.05 * most_m));
}

// Eastward past a wall with 0.7 m beside the hull, against a firm load that sets the vessel aside
// by `off_m`: what it asks for within 15 s.
std::optional<PlanRequest> passAWall(ScriptedMission& mission, double off_m) {
  constexpr double kSpeedMps = 1.5;
  mission.put({0.0, 1.3}, {3.0, 3.0});
  mission.disturbance.force_n = {-20.0, 0.0};
  blow(mission, 10.0, [](double) { return Vector2d(-20.0, 0.0); });
  mission.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  const auto orders = mission.goTo({40.0, 0.0});
  EXPECT_TRUE(orders && orders->plan);
  (void)mission.refuse(*orders->plan, "too narrow");
  const Orders narrower = mission.update(0.1);
  EXPECT_TRUE(narrower.plan);
  (void)mission.answer(*narrower.plan, test::eastward({-40.0, 0.0}, 80.0, kSpeedMps));
  return sailAside(mission, 15.0, off_m);
}

// The plan was made before it showed by how much: a wider way is sailed once it is found, and the
// one at hand until then.
TEST(SupervisorInWind, LooksForMoreRoomOnceItKnowsHowFarItWanders) {
  ScriptedMission steadily(openWater(), knowing());
  EXPECT_FALSE(passAWall(steadily, 0.05).has_value());

  ScriptedMission mission(openWater(), knowing());
  constexpr double kOffM = 0.48;
  const std::optional<PlanRequest> wider = passAWall(mission, kOffM);
  ASSERT_TRUE(wider.has_value());
  EXPECT_TRUE(beginsUnderWay(*wider));
  EXPECT_GT(wider->query.limits.hull_margin_m, 0.6);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
  const auto way = [&](const PlanRequest& request, double to_y_m) {
    const trajectory::TimedTrajectory& sailed = mission.supervisor->sailed();
    const vessel::FlatPoint from =
        sailed.trajectory.flat(request.start_time_s - sailed.start_time_s);
    vessel::FlatPoint beside;
    beside.position = {0.0, to_y_m};
    beside.velocity = from.velocity;
    vessel::FlatPoint end;
    end.position = {40.0, 0.0};
    const double there_s = (beside.position - from.position).norm() / from.velocity.norm();
    return trajectory::Trajectory({trajectory::hermitePiece(from, beside, there_s),
                                   trajectory::hermitePiece(beside, end, 50.0)});
  };
  EXPECT_FALSE(mission.answer(*wider, way(*wider, 0.0)).sail);
  const std::optional<PlanRequest> again = sailAside(mission, 6.0, kOffM);
  ASSERT_TRUE(again.has_value());
  EXPECT_TRUE(mission.answer(*again, way(*again, -3.0)).sail);
  EXPECT_EQ(mission.supervisor->replans().all, 1);
  EXPECT_EQ(mission.supervisor->replans().for_weather, 1);
}

TEST(SupervisorInWind, PlansMoreGentlyAfterTheVesselCouldNotFollow) {
  ScriptedMission mission;
  mission.setOut(6.0);
  Situation behind = mission.situation();
  behind.state.x() -= 2.0;
  behind.tracking_error_m = 2.0;
  const Orders orders = mission.supervisor->update(mission.now_s, behind, mission.field);
  ASSERT_TRUE(orders.plan);
  EXPECT_NEAR(orders.plan->thrust_share, mission.options.thrust_share - 0.1, 1e-9);
  // It begins where the vessel is, with no more force than the plan may use.
  EXPECT_LT((orders.plan->query.start.flat.position - behind.state.head<2>()).norm(), 2.0);
  const vessel::Parameters otter;
  const Vector2d force = otter.paper.m1_kg * orders.plan->query.start.flat.acceleration +
                         otter.paper.d2_kgps * orders.plan->query.start.flat.velocity;
  EXPECT_LE(force.norm(), 2.0 * otter.thrusters.ahead_max_n * orders.plan->thrust_share);
}

// 4 m/s take 80 N of 100 N.
TEST(SupervisorInWind, ReplansWhenTheWindTakesWhatThePlanCountsOn) {
  ScriptedMission mission(openWater(), knowing());
  mission.setOut(6.0);
  EXPECT_TRUE(blow(mission, 2.0, steady).plans.empty());
  const Blown blown = blow(mission, 6.0, [](double) { return Vector2d(-60.0, 0.0); });
  ASSERT_FALSE(blown.plans.empty());
  EXPECT_EQ(mission.supervisor->phase(), Phase::kReplanning);
  EXPECT_TRUE(beginsUnderWay(blown.plans.front()));
  EXPECT_LT(blown.plans.front().query.limits.disturbance.force_n.x(), -10.0);
}

// What is sailed at least began with the weather of then: no plan for still water takes its place.
TEST(SupervisorInWind, KeepsItsPlanWhereNoneThatKnowsTheWeatherIsFound) {
  ScriptedMission mission(openWater(), knowing());
  mission.setOut(6.0);
  blow(mission, 2.0, steady);
  double asked_s = 0.0;
  int rounds = 0;
  int sailing = 0;
  for (int k = 0; k < 100; ++k) {
    mission.disturbance.force_n = {-45.0, 0.0};
    if (const Orders orders = mission.update(0.1); orders.plan) {
      EXPECT_LT(orders.plan->query.limits.disturbance.force_n.x(), -5.0);
      rounds += mission.now_s - asked_s > 3.0 ? 1 : 0;
      asked_s = mission.now_s;
      (void)mission.refuse(*orders.plan, "no");
    }
    sailing += mission.supervisor->phase() == Phase::kSailing ? 1 : 0;
  }
  EXPECT_GE(rounds, 1);
  EXPECT_LE(rounds, 2);  // not again at once
  EXPECT_GT(sailing, 80);
}

// A plan is asked for under way since the thrust lacks.
Orders asksForTheWeathersSake(ScriptedMission& mission) {
  mission.setOut(6.0);
  blow(mission, 2.0, steady);
  mission.disturbance.force_n = {-45.0, 0.0};
  Orders orders;
  for (int k = 0; k < 100 && !orders.plan; ++k) {
    orders = mission.update(0.1);
  }
  return orders;
}

// Two metres off; at first a plan from there, then, for there is none, one from rest.
TEST(SupervisorInWind, CountsThePlansThatTheWeatherAskedFor) {
  for (const bool stops : {false, true}) {
    ScriptedMission mission;
    mission.setOut(6.0);
    std::optional<PlanRequest> request;
    for (int k = 0; k < 100 && !request; ++k) {
      mission.now_s += 0.1;
      Situation aside = mission.situation();
      aside.state.y() += 2.0;
      aside.tracking_error_m = 2.0;
      const Orders orders = mission.supervisor->update(mission.now_s, aside, mission.field);
      mission.rest = aside.state;
      if (stops && orders.stop) {
        mission.rest.tail<3>().setZero();
        break;
      }
      request = stops ? std::nullopt : orders.plan;
    }
    for (int k = 0; k < 100 && !request; ++k) {
      request = mission.update(0.1).plan;
    }
    ASSERT_TRUE(request.has_value());
    EXPECT_EQ(beginsUnderWay(*request), !stops);
    EXPECT_EQ(mission.supervisor->replans().all, 0);
    const trajectory::Trajectory way =
        test::eastward(request->query.start.flat.position, 20.0, stops ? 3.0 : 4.0);
    (void)mission.answer(*request, way);
    EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
    EXPECT_EQ(mission.supervisor->replans().all, 1);
    EXPECT_EQ(mission.supervisor->replans().for_weather, 1);
  }
}

// It stops meanwhile: from rest there is no plan to keep, and one for still water is tried.
TEST(SupervisorInWind, HasNoPlanToKeepOnceItStopped) {
  ScriptedMission mission(openWater(), knowing());
  ASSERT_TRUE(asksForTheWeathersSake(mission).plan);
  mission.rest = mission.situation().state;
  mission.rest.tail<3>().setZero();
  mission.rest[vessel::kPsi] = 0.0;        // bow to it
  for (bool stopped = false; !stopped;) {  // without an answer
    mission.now_s += 0.1;
    Situation aside = mission.situation();
    aside.tracking_error_m = 2.0;
    stopped = mission.supervisor->update(mission.now_s, aside, mission.field).stop;
  }
  bool still_water = false;
  for (int k = 0; k < 100; ++k) {
    if (const Orders orders = mission.update(0.1); orders.plan) {
      still_water = still_water || orders.plan->query.limits.disturbance.force_n.isZero(0.0);
      (void)mission.refuse(*orders.plan, "no");
    }
    EXPECT_NE(mission.supervisor->phase(), Phase::kSailing);
  }
  EXPECT_TRUE(still_water);
}

// And a new goal is no matter of the weather: the plan that is sailed leads elsewhere.
TEST(SupervisorInWind, DoesNotKeepThePlanToAnotherGoal) {
  ScriptedMission mission(openWater(), knowing());
  ASSERT_TRUE(asksForTheWeathersSake(mission).plan);
  Result<Orders> orders = mission.goTo({30.0, 10.0});
  ASSERT_TRUE(orders);
  std::optional<PlanRequest> asked = orders->plan;
  int refused = 0;
  for (int k = 0; k < 40; ++k) {
    if (asked) {
      ++refused;
      asked = mission.refuse(*asked, "no").plan;
    }
    EXPECT_NE(mission.supervisor->phase(), Phase::kSailing);
    if (!asked) {
      asked = mission.update(0.1).plan;
    }
  }
  EXPECT_GT(refused, 4);
}

// Then with thrust left for what blows.
TEST(SupervisorInWind, PlansForStillWaterIfAsked) {
  ScriptedMission mission(openWater(), forStillWater()), asked(openWater(), knowing());
  blow(mission, 60.0, gusty);
  blow(asked, 60.0, gusty);
  const auto orders = mission.goTo({20.0, 0.0});
  const auto others = asked.goTo({20.0, 0.0});
  ASSERT_TRUE(orders && orders->plan && others && others->plan);
  EXPECT_EQ(orders->plan->query.limits.disturbance.force_n.x(), 0.0);
  EXPECT_LT(orders->plan->thrust_share, others->plan->thrust_share);
}

// The estimate begins at nothing and overshoots: the first plan waits for what it comes to.
TEST(SupervisorInWind, PlansOnceTheWeatherIsKnown) {
  ScriptedMission mission;
  mission.supervisor = Supervisor::create(mission.options, vessel::Parameters{}, 1);
  const auto orders = mission.goTo({20.0, 0.0});
  ASSERT_TRUE(orders);
  EXPECT_FALSE(orders->plan);
  EXPECT_TRUE(orders->stop);  // held meanwhile
  EXPECT_EQ(mission.supervisor->phase(), Phase::kPlanning);
  const Force transient = [](double t) { return Vector2d(t < 0.5 ? -60.0 : -4.0, 0.0); };
  EXPECT_TRUE(blow(mission, 0.8, transient).plans.empty());
  const Blown blown = blow(mission, 0.6, steady);
  ASSERT_FALSE(blown.plans.empty());
  EXPECT_LT(blown.plans.front().query.limits.disturbance.force_n.norm(), 5.0);
}

// More than a light load still rises.
TEST(SupervisorInWind, WaitsAMomentMoreInAFreshWind) {
  ScriptedMission mission(openWater(), knowing());
  mission.supervisor = Supervisor::create(mission.options, vessel::Parameters{}, 1);
  mission.rest[vessel::kPsi] = kPi;
  ASSERT_TRUE(mission.goTo({20.0, 0.0}).has_value());
  const Force rising = [](double t) { return Vector2d(std::min(14.0 * t, 42.0), 0.0); };
  EXPECT_TRUE(blow(mission, 2.5, rising).plans.empty());
  const Blown blown = blow(mission, 1.5, rising);
  ASSERT_FALSE(blown.plans.empty());
  EXPECT_GT(blown.plans.front().query.limits.disturbance.force_n.x(), 7.0);
}

// Plans from rest begin bow to a firm load; the tracker turns the hull there first, or does not get
// it there.
TEST(SupervisorInWind, TurnsTheBowToAFirmLoadBeforeItPlans) {
  const Force push = [](double) { return Vector2d(20.0, 0.0); };
  ScriptedMission mission(openWater(), knowing());
  mission.rest[vessel::kPsi] = 0.5;
  blow(mission, 10.0, push);
  const auto orders = mission.goTo({20.0, 0.0});
  ASSERT_TRUE(orders);
  EXPECT_FALSE(orders->plan);
  EXPECT_TRUE(orders->stop);  // held: turned
  EXPECT_TRUE(blow(mission, 15.0, push).plans.empty());
  mission.rest[vessel::kPsi] = 2.9;
  const Blown blown = blow(mission, 0.3, push);
  ASSERT_EQ(blown.plans.size(), 1U);
  EXPECT_NEAR(wrapAngle(blown.plans[0].query.start.psi_rad - kPi), 0.0, 1e-6);
  EXPECT_NEAR(wrapAngle(blown.plans[0].query.goal.psi_rad - kPi), 0.0, 1e-6);

  ScriptedMission stuck(openWater(), knowing());
  stuck.rest[vessel::kPsi] = 0.5;
  blow(stuck, 10.0, push);
  ASSERT_TRUE(stuck.goTo({20.0, 0.0}).has_value());
  const Blown late = blow(stuck, 21.0, push);
  ASSERT_EQ(late.plans.size(), 1U);
  EXPECT_NEAR(late.plans[0].query.start.psi_rad, 0.5, 1e-9);
}

TEST(SupervisorInWind, SteadyWeatherIsNoGroundForAnotherPlan) {
  ScriptedMission mission;
  blow(mission, 5.0, steady);
  mission.setOut(1.0);
  EXPECT_TRUE(blow(mission, 15.0, steady).plans.empty());
}

std::vector<PlanRequest> refusedAll(ScriptedMission& mission, const Force& force,
                                    std::size_t times) {
  blow(mission, 60.0, force);
  mission.setOut(6.0);
  std::vector<PlanRequest> asked;
  while (asked.size() < times) {
    Situation behind = mission.situation();
    behind.tracking_error_m = 2.0;
    const Orders orders = mission.supervisor->update(mission.now_s, behind, mission.field);
    if (!orders.plan) {
      ADD_FAILURE() << "no request after " << asked.size();
      break;
    }
    asked.push_back(*orders.plan);
    (void)mission.refuse(*orders.plan, "too fast");
  }
  return asked;
}

TEST(SupervisorInWind, AllowsMoreThrustWhereThereIsNoPlanWithLess) {
  ScriptedMission mission(openWater(), forStillWater());
  const std::vector<PlanRequest> asked = refusedAll(mission, gusty, 8);
  ASSERT_EQ(asked.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) {  // once for each clearance
    EXPECT_NEAR(asked[k].thrust_share,
                std::min(mission.options.thrust_share, asked[0].thrust_share + (k < 4 ? 0.0 : 0.2)),
                1e-9);
  }
}

// In a firm load, on a narrow level, it is set aside by more than that leaves. Of the thrust left
// over, some is given before.
TEST(SupervisorInWind, TriesWideWaysForStillWaterBeforeNarrowOnesWithTheLoad) {
  ScriptedMission mission(openWater(), knowing());
  const std::vector<PlanRequest> asked = refusedAll(mission, gusty, 8);
  ASSERT_EQ(asked.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) {
    const double east_n = asked[k].query.limits.disturbance.force_n.x();
    if (k < 4) {
      EXPECT_LT(east_n, -10.0);
      EXPECT_NEAR(asked[k].thrust_share, asked[0].thrust_share + (k < 2 ? 0.0 : 0.2), 1e-9);
      EXPECT_NEAR(asked[k].query.limits.clearance_m, asked[k % 2].query.limits.clearance_m, 0.05);
    } else {
      EXPECT_EQ(east_n, 0.0);
      EXPECT_LE(asked[k].thrust_share, asked[0].thrust_share);  // some is left for the load
    }
  }
  EXPECT_GT(asked[0].query.limits.clearance_m, asked[1].query.limits.clearance_m);
  EXPECT_NEAR(asked[4].query.limits.clearance_m, asked[0].query.limits.clearance_m, 0.05);
  EXPECT_GT(asked[6].query.limits.clearance_m, asked[7].query.limits.clearance_m);
}

// Off its trajectory nothing was verified: it waits for a plan no longer than one takes.
TEST(SupervisorInWind, StopsWhereItIsSetAsideAndThereIsNoPlan) {
  ScriptedMission mission;
  mission.setOut(6.0);
  double off_s = 0.0;
  bool stopped = false;
  for (; off_s < 5.0 && !stopped; off_s += 0.1) {
    mission.now_s += 0.1;
    Situation aside = mission.situation();
    aside.state.y() += 2.0;
    aside.tracking_error_m = 2.0;
    const Orders orders = mission.supervisor->update(mission.now_s, aside, mission.field);
    stopped = orders.stop;
    if (orders.plan) {
      (void)mission.refuse(*orders.plan, "no");
    }
  }
  EXPECT_TRUE(stopped);
  EXPECT_GT(off_s, 1.0);
  EXPECT_LT(off_s, 2.0);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kStopping);
}

// At once where it is set towards something.
TEST(SupervisorInWind, StopsWhereItIsSetTowardsSomething) {
  for (const double set_mps : {1.5, -1.5}) {
    ScriptedMission mission;
    mission.setOut(6.0);
    Situation aside = mission.situation();
    aside.state.y() += 1.0;
    aside.tracking_error_m = 1.0;
    aside.state[vessel::kSurge] = 0.0;
    aside.state[vessel::kSway] = set_mps;
    const Vector2d here = aside.state.head<2>();
    mission.put(here + Vector2d(-2.0, 2.5), here + Vector2d(2.0, 4.0));
    const Orders orders = mission.supervisor->update(mission.now_s, aside, mission.field);
    EXPECT_EQ(orders.stop, set_mps > 0.0);
  }
}

// At rest, bow to 30 N from the east, with a shore 2 m to leeward: first it goes ahead.
TEST(SupervisorInWind, MakesRoomOffALeeShoreBeforeItPlans) {
  for (const bool shore : {true, false}) {
    ScriptedMission mission;
    blow(mission, 5.0, [](double) { return Vector2d(-30.0, 0.0); });
    if (shore) {
      mission.put({-4.0, -5.0}, {-2.5, 5.0});
    }
    const auto orders = mission.goTo({20.0, 0.0});
    ASSERT_TRUE(orders && orders->plan);
    (void)mission.refuse(*orders->plan, "no");
    const Orders next = mission.update(0.1);
    EXPECT_EQ(mission.supervisor->phase(), shore ? Phase::kBackingOff : Phase::kPlanning);
    ASSERT_EQ(next.sail.has_value(), shore);
    if (shore) {
      const trajectory::Trajectory& path = next.sail->trajectory;
      const trajectory::Sample end = path.sample(path.duration(), vessel::Parameters{});
      EXPECT_GT(end.state.x(), 0.9);
      EXPECT_NEAR(end.state.y(), 0.0, 1e-6);
      EXPECT_NEAR(end.state[vessel::kPsi], 0.0, 1e-6);
      mission.rest = end.state;
      (void)mission.update(path.duration() + 0.1);
      (void)mission.update(0.1);
      EXPECT_NE(mission.supervisor->phase(), Phase::kBackingOff);
      EXPECT_EQ(mission.supervisor->stops(), 0);  // it was nothing that went wrong
    }
  }
}

// Set back each time, it would make room for ever: after three times it counts.
TEST(SupervisorInWind, MakesRoomThreeTimesBeforeItCounts) {
  ScriptedMission mission;
  mission.put({-4.0, -5.0}, {-2.5, 5.0});
  const Force push = [](double) { return Vector2d(-30.0, 0.0); };
  blow(mission, 5.0, push);
  const auto orders = mission.goTo({20.0, 0.0});
  ASSERT_TRUE(orders && orders->plan);
  (void)mission.refuse(*orders->plan, "no");
  int rooms = 0;
  for (int k = 0; k < 3000 && mission.supervisor->phase() != Phase::kFailed; ++k) {
    const bool makes_room = mission.supervisor->phase() == Phase::kBackingOff;
    mission.now_s += 0.1;
    Situation back = mission.situation();
    if (!makes_room) {
      back.state = mission.rest;
    }
    rooms += mission.supervisor->update(mission.now_s, back, mission.field).sail ? 1 : 0;
    if (mission.supervisor->phase() == Phase::kStopped) {
      EXPECT_EQ(mission.supervisor->stops(), std::max(0, rooms - 3));
    }
  }
  EXPECT_EQ(mission.supervisor->phase(), Phase::kFailed);
  EXPECT_GT(rooms, 3);
}

// Not into the way of what crosses ahead: it would be broken off at once, again and again.
TEST(SupervisorInWind, MakesNoRoomWhereSomethingWillPass) {
  ScriptedMission mission;
  blow(mission, 5.0, [](double) { return Vector2d(-30.0, 0.0); });
  const Vector2d northward(0.0, 1.5);
  const Vector2d ahead(2.0, 0.0);
  const feasibility::test::MovingDisc crossing(ahead - (mission.now_s + 3.0) * northward, northward,
                                               0.5);
  mission.put({-4.0, -5.0}, {-2.5, 5.0});
  mission.layer = &crossing;
  const auto orders = mission.goTo({20.0, 0.0});
  ASSERT_TRUE(orders && orders->plan);
  (void)mission.refuse(*orders->plan, "no");
  (void)mission.update(0.1);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kPlanning) << mission.supervisor->reason();
}

TEST(SupervisorInWind, WaitsAMinuteForLessWind) {
  ScriptedMission mission;
  const Force storm = [](double) { return Vector2d(-150.0, 0.0); };
  blow(mission, 40.0, storm);
  (void)mission.goTo({20.0, 0.0});
  blow(mission, 40.0, storm);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kPlanning) << mission.supervisor->reason();
  blow(mission, 30.0, storm);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kFailed);
}

// Each time: it may have abated.
TEST(SupervisorInWind, WaitsAMinuteForLessWindForEachGoal) {
  ScriptedMission mission;
  const Force storm = [](double) { return Vector2d(-150.0, 0.0); };
  blow(mission, 40.0, storm);
  (void)mission.goTo({20.0, 0.0});
  blow(mission, 70.0, storm);
  ASSERT_EQ(mission.supervisor->phase(), Phase::kFailed);
  (void)mission.goTo({10.0, 0.0});
  blow(mission, 40.0, storm);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kPlanning) << mission.supervisor->reason();
  ASSERT_TRUE(mission.supervisor->pause(mission.now_s, mission.situation(), mission.field));
  blow(mission, 70.0, storm);
  (void)mission.supervisor->resume(mission.now_s, mission.situation(), mission.field);
  blow(mission, 40.0, storm);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kPlanning) << mission.supervisor->reason();
}

TEST(SupervisorInWind, LaunchesAVesselAgainThatHasHardlyGotUnderWay) {
  for (const double surge : {0.1, 1.5}) {
    ScriptedMission mission;
    mission.setOut(6.0);
    Situation behind = mission.situation();
    behind.state[vessel::kSurge] = surge;
    behind.tracking_error_m = 2.0;
    const Orders orders = mission.supervisor->update(mission.now_s, behind, mission.field);
    ASSERT_TRUE(orders.plan);
    EXPECT_EQ(trajectory::atRest(orders.plan->query.start), surge < 1.0);
  }
}

// 30 N on the beam set a hull with 20 kg/s of drag aside by 1.5 m/s.
TEST(SupervisorInWind, ArrivesBowToTheLoadWhereTheGoalsHeadingCannotBeHeld) {
  ScriptedMission mission;
  mission.rest[vessel::kPsi] = -0.5 * kPi;
  const Force abeam = [](double) { return Vector2d(0.0, 30.0); };
  blow(mission, 5.0, abeam);
  const auto orders = mission.goTo({20.0, 0.0}, 0.0);
  ASSERT_TRUE(orders && orders->plan);
  EXPECT_NEAR(orders->plan->query.goal.psi_rad, -0.5 * kPi, 1e-3);
  ASSERT_TRUE(mission.answer(*orders->plan, test::eastward({0.0, 0.0}, 20.0, 2.0)).sail);
  mission.now_s += 20.0;
  Situation there = mission.situation();
  there.state << 20.3, 0.0, -1.5, 0.0, 0.0, 0.0;
  (void)mission.supervisor->update(mission.now_s, there, mission.field);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kArrived);
  EXPECT_NE(
      mission.supervisor->reason().find("0.30 m from the goal (0.90 m allowed), but 1.50 rad"),
      std::string::npos)
      << mission.supervisor->reason();
}

TEST(SupervisorInWind, InCalmWaterTheGoalsHeadingCounts) {
  ScriptedMission mission;
  const auto orders = mission.goTo({20.0, 0.0}, 0.0);
  ASSERT_TRUE(mission.answer(*orders->plan, test::eastward({0.0, 0.0}, 20.0, 2.0)).sail);
  mission.now_s += 20.0;
  Situation there = mission.situation();
  there.state << 20.3, 0.0, -1.5, 0.0, 0.0, 0.0;
  (void)mission.supervisor->update(mission.now_s, there, mission.field);
  EXPECT_NE(mission.supervisor->phase(), Phase::kArrived);
}

// The plan on the way ends on the goal's heading; then it begins to blow.
TEST(SupervisorInWind, PlansForAnotherHeadingAtTheGoalOnce) {
  ScriptedMission mission;
  mission.setOut(6.0);
  const Force abeam = [](double) { return Vector2d(0.0, 12.0); };
  const Blown blown = blow(mission, 8.0, abeam);
  ASSERT_EQ(blown.plans.size(), 1u);
  EXPECT_NEAR(blown.plans.front().query.goal.psi_rad, -0.5 * kPi, 0.1);
  EXPECT_NE(mission.supervisor->reason().find("heading at the goal"), std::string::npos);
}

// A minute and more before it is there, the weather may still turn.
TEST(SupervisorInWind, PlansForAnotherHeadingAtTheGoalNoSoonerThanItMatters) {
  ScriptedMission mission;
  mission.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  const auto orders = mission.goTo({40.0, 0.0});
  ASSERT_TRUE(mission.answer(*orders->plan, test::eastward({-40.0, 0.0}, 80.0, 0.8)).sail);
  const Force abeam = [](double) { return Vector2d(0.0, 12.0); };
  EXPECT_TRUE(blow(mission, 60.0, abeam).plans.empty());
  EXPECT_FALSE(blow(mission, 20.0, abeam).plans.empty());
}

TEST(SupervisorInWind, AHeadingLostInAGustEndsBowToTheWind) {
  for (const double off_rad : {0.2, 1.4}) {
    ScriptedMission mission;
    mission.setOut(6.0);
    Situation lost = mission.situation();
    lost.state[vessel::kPsi] += off_rad;
    lost.tracking_error_m = 2.0;
    const Orders orders = mission.supervisor->update(mission.now_s, lost, mission.field);
    EXPECT_EQ(orders.stop, off_rad > 1.0);
    EXPECT_EQ(mission.supervisor->phase(), off_rad > 1.0 ? Phase::kStopping : Phase::kReplanning);
  }
}

// Once the wind freshens to where a gust takes most of the moment at the speed of the plan.
TEST(SupervisorInWind, SlowsDownForGustsThatTakeTheMoment) {
  vessel::Parameters windy;
  windy.manoeuvring.wind_surge_kgpm = 0.5;
  windy.manoeuvring.wind_sway_kgpm = 0.5;
  windy.manoeuvring.wind_yaw_kg = -0.66;
  for (const double mean_mps : {4.0, 8.0}) {
    ScriptedMission mission;
    mission.supervisor = Supervisor::create(mission.options, windy, 1);
    mission.knowWeather();
    mission.setOut(4.0);
    std::optional<PlanRequest> asked;
    for (int k = 0; k < 80 && !asked; ++k) {
      mission.disturbance.wind_mps = {0.0, mean_mps * (1.0 + 0.2 * std::sin(0.5 * k))};
      asked = mission.update(0.1).plan;
    }
    ASSERT_EQ(asked.has_value(), mean_mps > 6.0);
    if (asked) {
      EXPECT_TRUE(beginsUnderWay(*asked));
      EXPECT_LT(asked->query.limits.speed_max_mps, 2.5);
      EXPECT_NE(mission.supervisor->reason().find("gusts take"), std::string::npos)
          << mission.supervisor->reason();
    }
  }
}

// Of otter_gazebo's kind: the wind's moment goes with the sine of twice the angle to the bow.
ScriptedMission inWind(double towards_east_mps) {
  vessel::Parameters windy;
  windy.manoeuvring.wind_surge_kgpm = 0.5;
  windy.manoeuvring.wind_sway_kgpm = 0.5;
  windy.manoeuvring.wind_yaw_kg = -0.66;
  ScriptedMission mission;
  mission.supervisor = Supervisor::create(mission.options, windy, 1);
  mission.disturbance.wind_mps = {towards_east_mps, 0.0};
  mission.knowWeather();
  return mission;
}

// It goes on looking, but sees to everything else meanwhile.
TEST(SupervisorInWind, SailsOnWhereNoPlanSlowsDownForGusts) {
  ScriptedMission mission = inWind(0.0);
  mission.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  const auto first = mission.goTo({40.0, 0.0}, -0.5 * kPi);  // bow to the wind
  ASSERT_TRUE(first && first->plan);
  (void)mission.answer(*first->plan, test::eastward({-40.0, 0.0}, 80.0, 4.0));
  (void)mission.update(4.0);
  int rounds = 0;
  int sailing = 0;
  double asked_s = 0.0;
  for (int k = 0; k < 120; ++k) {
    mission.disturbance.wind_mps = {0.0, 8.0 * (1.0 + 0.2 * std::sin(0.5 * k))};
    for (Orders orders = mission.update(0.1); orders.plan;) {
      if (mission.supervisor->reason().find("gusts take") != std::string::npos) {
        rounds += mission.now_s - asked_s > 3.0 ? 1 : 0;
        asked_s = mission.now_s;
      }
      orders = mission.refuse(*orders.plan, "no");
    }
    sailing += mission.supervisor->phase() == Phase::kSailing ? 1 : 0;
  }
  EXPECT_EQ(rounds, 1);  // not again at once
  EXPECT_GT(sailing, 100);
}

// The next gust would have it.
TEST(SupervisorInWind, BeginsNoPlanFromAHeadingLostInStrongWind) {
  for (const double wind_mps : {5.0, 8.0}) {
    ScriptedMission mission = inWind(wind_mps);
    const bool strong = wind_mps > 6.0;
    mission.rest[vessel::kPsi] = 0.5 * kPi;
    const auto lost = mission.goTo({20.0, 0.0});
    ASSERT_TRUE(lost);
    EXPECT_EQ(lost->plan.has_value(), !strong);
    if (strong) {
      EXPECT_FALSE(mission.update(1.0).plan);
      mission.rest[vessel::kPsi] = kPi - 0.3;
      EXPECT_TRUE(mission.update(1.0).plan);
    }
  }
}

// Against the wind the faster plan counts on thrust that there isn't.
TEST(SupervisorInWind, TakesNoFasterPlanThatTheWindLeavesNoThrustFor) {
  for (const double against_mps : {2.0, 7.0}) {
    ScriptedMission mission = inWind(-against_mps);
    mission.options.improve_period_s = 2.0;
    mission.supervisor->setOptions(mission.options);
    mission.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
    const auto orders = mission.goTo({40.0, 0.0});
    ASSERT_TRUE(orders && orders->plan);
    (void)mission.answer(*orders->plan, test::eastward({-40.0, 0.0}, 80.0, 2.0));
    const Orders improve = mission.update(4.5);
    ASSERT_TRUE(improve.plan);
    const vessel::FlatPoint& start = improve.plan->query.start.flat;
    vessel::FlatPoint fast = start;
    fast.position.x() += 9.0;
    fast.velocity = {4.0, 0.0};
    vessel::FlatPoint slow = fast;
    slow.position.x() += 40.0;
    vessel::FlatPoint end;
    end.position = {40.0, 0.0};
    const trajectory::Trajectory quick(
        {trajectory::hermitePiece(start, fast, 3.0), trajectory::hermitePiece(fast, slow, 10.0),
         trajectory::hermitePiece(slow, end, 0.5 * (end.position - slow.position).x())});
    EXPECT_EQ(mission.answer(*improve.plan, quick).sail.has_value(), against_mps < 5.0);
  }
}

// A vessel that makes good less than its plan has, for a minute.
struct PutOff {
  int times = 0;
  double most_off_m = 0.0;
  std::optional<double> far_off_after_s;
};
PutOff fallBehind(ScriptedMission& mission, double makes_good_mps) {
  PutOff put_off;
  const double began_s = mission.now_s;
  Vector2d here = mission.situation().state.head<2>();
  while (mission.now_s < began_s + 60.0 && !put_off.far_off_after_s) {
    mission.now_s += 0.1;
    here.x() += 0.1 * makes_good_mps;
    Situation behind = mission.situation();
    behind.tracking_error_m = behind.state.x() - here.x();
    behind.state.head<2>() = here;
    behind.state[vessel::kSurge] = makes_good_mps;
    const Orders orders = mission.supervisor->update(mission.now_s, behind, mission.obstacles());
    put_off.times += orders.sail ? 1 : 0;
    put_off.most_off_m = std::max(put_off.most_off_m, behind.tracking_error_m);
    if (mission.supervisor->reason() == "far off the trajectory") {
      put_off.far_off_after_s = mission.now_s - began_s;
    }
  }
  return put_off;
}

// Another plan would be too fast too: in a gust as long as it makes any way.
TEST(SupervisorInWind, SailsTheSameWayLaterInStrongWind) {
  for (const double makes_good_mps : {0.3, 0.0}) {
    ScriptedMission mission = inWind(-8.0);
    mission.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
    const auto orders = mission.goTo({40.0, 0.0});
    ASSERT_TRUE(orders && orders->plan);
    (void)mission.answer(*orders->plan, test::eastward({-40.0, 0.0}, 80.0, 0.6));
    (void)mission.update(30.0);
    const PutOff put_off = fallBehind(mission, makes_good_mps);
    EXPECT_GT(put_off.times, 10);
    EXPECT_LT(put_off.most_off_m, 0.5);
    EXPECT_EQ(put_off.far_off_after_s.has_value(), makes_good_mps == 0.0);
  }
}

// A second of wind tells nothing of its gusts: by the first guess of them narrow water can be
// passed.
TEST(SupervisorInWind, LearnsWhatGustsDoBeforeItGoesThroughNarrowWater) {
  struct Case {
    double wind_mps;
    bool is_narrow;
    double waits_s;
  };
  for (const Case& c : {Case{8.0, false, 0.0}, Case{3.0, true, 0.0}, Case{8.0, true, 28.0}}) {
    ScriptedMission mission = inWind(-c.wind_mps);
    mission.rest.x() = 0.0;
    std::optional<PlanRequest> asked = mission.goTo({20.0, 0.0})->plan;
    ASSERT_TRUE(asked);
    if (c.is_narrow) {
      asked = mission.refuse(*asked, "too narrow").plan;
      asked = asked ? asked : mission.update(0.1).plan;
      ASSERT_TRUE(asked);
    }
    const double began_s = mission.now_s;
    while (asked && mission.now_s < began_s + 60.0 &&
           !mission.answer(*asked, test::eastward({0.0, 0.0}, 20.0, 0.6)).sail) {
      EXPECT_EQ(mission.supervisor->phase(), Phase::kPlanning);
      EXPECT_NE(mission.supervisor->reason().find("gusts"), std::string::npos);
      asked.reset();
      while (!asked && mission.now_s < began_s + 60.0) {
        asked = mission.update(0.1).plan;
      }
    }
    EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
    EXPECT_NEAR(mission.now_s - began_s, c.waits_s, 1.5) << c.wind_mps;
  }
}

// Plans are slow there: a way that leads far round takes minutes, and is taken where there is none
// else.
TEST(SupervisorInWind, InStrongWindTakesANarrowerWayBeforeOneFarRound) {
  vessel::FlatPoint start, far, end;
  far.position = {0.0, 60.0};
  end.position = {20.0, 0.0};
  const trajectory::Trajectory far_round(
      {trajectory::hermitePiece(start, far, 90.0), trajectory::hermitePiece(far, end, 90.0)});
  for (const auto& [wind_mps, finds_narrower] :
       {std::pair(3.0, true), std::pair(8.0, true), std::pair(8.0, false)}) {
    ScriptedMission mission = inWind(-wind_mps);
    mission.rest.x() = 0.0;
    mission.knowWeather(30.0);
    Orders orders = *mission.goTo({20.0, 0.0});
    ASSERT_TRUE(orders.plan);
    const double widest_m = orders.plan->query.limits.clearance_m;
    const double first_mps = orders.plan->query.limits.speed_max_mps;
    const bool is_strong = wind_mps > 6.0;
    int not_taken = 0;
    double next_m = widest_m;
    feasibility::SafetyLimits asked;
    const auto taken = [&, finds = finds_narrower] {
      asked = orders.plan->query.limits;
      orders = finds || orders.plan->query.limits.clearance_m == widest_m
                   ? mission.answer(*orders.plan, far_round)
                   : mission.refuse(*orders.plan, "no");
      return orders.sail.has_value();
    };
    while (!taken() && not_taken < 20) {
      ++not_taken;
      while (!orders.plan) {
        orders = mission.update(0.1);
      }
      next_m = not_taken == 1 ? orders.plan->query.limits.clearance_m : next_m;
    }
    EXPECT_EQ(not_taken, is_strong ? 10 : 0);
    EXPECT_EQ(asked.clearance_m, widest_m);
    EXPECT_EQ(asked.speed_max_mps, first_mps);
    EXPECT_EQ(next_m < widest_m, is_strong);
    EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
  }
}

// The plan ended bow to the wind, for on the goal's heading the hull would have been set aside.
// Then the wind veers, and astern it would be held there for a moment: that is no reason to turn
// round.
TEST(SupervisorInWind, DoesNotTurnRoundAtTheGoalWhereStrongWindVeers) {
  for (const double wind_mps : {3.0, 8.0}) {
    ScriptedMission mission = inWind(-wind_mps);
    mission.rest.x() = 0.0;
    const auto orders = mission.goTo({20.0, 0.0}, kPi - 0.5);
    ASSERT_TRUE(orders && orders->plan);
    if (wind_mps > 5.0) {
      EXPECT_NEAR(orders->plan->query.goal.psi_rad, 0.0, 0.1);
    }
    ASSERT_TRUE(mission.answer(*orders->plan, test::eastward({0.0, 0.0}, 20.0, 0.8)).sail);
    mission.disturbance.wind_mps = -wind_mps * Eigen::Vector2d(std::cos(0.4), -std::sin(0.4));
    for (int k = 0; k < 450; ++k) {
      (void)mission.update(0.1);
    }
    const bool arrived = mission.supervisor->phase() == Phase::kArrived;
    EXPECT_EQ(arrived, wind_mps > 5.0) << mission.supervisor->reason();
    EXPECT_EQ(mission.supervisor->reason().find("in gusts") != std::string::npos, arrived);
  }
}

// A new goal at the same place, the other way round: what the old plan gave up is nothing to it.
TEST(SupervisorInWind, TurnsRoundForANewGoalWhereTheOldOneWas) {
  ScriptedMission mission = inWind(-8.0);
  mission.rest.x() = 0.0;
  const auto orders = mission.goTo({20.0, 0.0});
  ASSERT_TRUE(orders && orders->plan);
  ASSERT_TRUE(mission.answer(*orders->plan, test::eastward({0.0, 0.0}, 20.0, 0.8)).sail);
  while (mission.supervisor->sailed().left(mission.now_s) > 1.0) {
    (void)mission.update(0.1);
  }
  ASSERT_TRUE(mission.goTo({20.0, 0.0}, kPi));
  for (int k = 0; k < 30; ++k) {
    (void)mission.update(0.1);
    EXPECT_NE(mission.supervisor->phase(), Phase::kArrived) << mission.supervisor->reason();
  }
}

// The goal's heading can be held, stern to the wind, but the hull lies bow to it when its way is
// over: strong wind won't let it turn past abeam the next time either.
TEST(SupervisorInWind, DoesNotTryAgainToTurnRoundAtTheGoalInStrongWind) {
  struct Case {
    double wind_mps, lies_rad, off_m, speed_mps;
    bool arrives;
  };
  for (const Case& at : {
           Case{8.0, 0.0, 0.0, 0.0, true},
           Case{8.0, 0.4, 0.0, 0.0, true},
           Case{8.0, 0.9, 0.0, 0.0, false},        // not held there
           Case{8.0, kPi - 0.5, 0.0, 0.0, false},  // comes round
           Case{8.0, 0.0, 1.2, 0.0, false},        // elsewhere
           Case{8.0, 0.0, 0.0, 0.4, false},        // not at rest
           Case{3.0, 0.0, 0.0, 0.0, false},
       }) {
    ScriptedMission mission = inWind(-at.wind_mps);
    mission.rest.x() = 0.0;
    const auto orders = mission.goTo({20.0, 0.0}, kPi);
    ASSERT_TRUE(orders && orders->plan);
    EXPECT_NEAR(std::abs(orders->plan->query.goal.psi_rad), kPi, 1e-6);
    ASSERT_TRUE(mission.answer(*orders->plan, test::eastward({0.0, 0.0}, 20.0, 0.8)).sail);
    const double end_s = mission.supervisor->sailed().start_time_s +
                         mission.supervisor->sailed().trajectory.duration();
    while (mission.now_s < end_s) {
      (void)mission.update(0.1);
    }
    const auto lie = [&](double until_s) {
      while (mission.now_s < until_s) {
        mission.now_s += 0.1;
        Situation there = mission.situation();
        there.state.y() += at.off_m;
        there.state[vessel::kPsi] = at.lies_rad;
        there.state[vessel::kSurge] = at.speed_mps;
        (void)mission.supervisor->update(mission.now_s, there, mission.obstacles());
      }
    };
    lie(end_s + 9.5);
    EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing) << mission.supervisor->reason();
    lie(end_s + 10.5);
    EXPECT_EQ(mission.supervisor->phase() == Phase::kArrived, at.arrives)
        << mission.supervisor->reason();
    EXPECT_EQ(mission.supervisor->reason().find("turn the hull round") != std::string::npos,
              at.arrives);
  }
}

// With 2 m beside it, though all is free to leeward.
TEST(SupervisorInWind, MakesMoreRoomInStrongWind) {
  for (const double wind_mps : {5.0, 8.0}) {
    ScriptedMission mission = inWind(wind_mps);
    mission.put({-2.0, 2.5}, {0.0, 5.0});
    mission.rest[vessel::kPsi] = kPi;
    mission.rest.x() = 0.0;
    const auto orders = mission.goTo({-20.0, 0.0});
    ASSERT_TRUE(orders && orders->plan);
    (void)mission.refuse(*orders->plan, "no");
    (void)mission.update(0.1);
    EXPECT_EQ(mission.supervisor->phase() == Phase::kBackingOff, wind_mps > 6.0);
  }
}

// Set aside until it stops, or told to end its mission; where it lies then, bow to a wind from the
// west.
Situation stopped(ScriptedMission& mission, bool set_aside) {
  if (!set_aside) {
    (void)mission.supervisor->cancel(mission.now_s, mission.situation(), mission.field);
  }
  for (int k = 0; k < 200 && mission.supervisor->phase() != Phase::kStopping &&
                  mission.supervisor->phase() != Phase::kIdle;
       ++k) {
    mission.now_s += 0.1;
    Situation aside = mission.situation();
    aside.tracking_error_m = set_aside ? 3.0 : 0.0;
    const Orders orders = mission.supervisor->update(mission.now_s, aside, mission.field);
    if (orders.plan) {
      (void)mission.refuse(*orders.plan, "no");
    }
  }
  Situation lies = mission.situation();
  lies.state[vessel::kPsi] = kPi;
  lies.state.tail<3>().setZero();
  return lies;
}

// It sails each leg that makes room, and is set back to where it lay. Whether one begins.
bool makesRoom(ScriptedMission& mission, Situation& lies, std::optional<PlanRequest>& plan) {
  mission.now_s += 0.1;
  lies.odometry_stamp_s = mission.now_s;
  const bool on_leg = mission.supervisor->phase() == Phase::kBackingOff;
  const Orders orders =
      mission.supervisor->update(mission.now_s, on_leg ? mission.situation() : lies, mission.field);
  plan = orders.plan;
  return orders.sail && mission.supervisor->phase() == Phase::kBackingOff;
}

// With 4.6 m beside it there is room to set out from, and too little to wait in for what gusts
// are yet to come. Set back each time it leaves it at that: it must not use up its stops.
TEST(SupervisorInWind, MakesRoomToWaitInOnceItHadToStop) {
  for (const bool had_to_stop : {false, true}) {
    ScriptedMission mission = inWind(8.0);
    mission.setOut(6.0);
    Situation lies = stopped(mission, had_to_stop);
    const Vector2d here = lies.state.head<2>();
    mission.put(here + Vector2d(0.0, 4.6), here + Vector2d(5.0, 8.0));
    std::optional<PlanRequest> plan;
    int rooms = 0;
    for (int k = 0; k < 2000 && !plan; ++k) {
      rooms += makesRoom(mission, lies, plan) ? 1 : 0;
      if (mission.supervisor->phase() == Phase::kIdle) {
        plan = mission.supervisor->setGoal(mission.now_s, {{40.0, 0.0}, 0.0}, lies, mission.field)
                   ->plan;
      }
    }
    EXPECT_TRUE(plan) << mission.supervisor->reason();
    EXPECT_EQ(rooms, had_to_stop ? 3 : 0);
    EXPECT_EQ(mission.supervisor->stops(), had_to_stop ? 1 : 0);
  }
}

// To windward, whether that is ahead or astern.
TEST(SupervisorInWind, MakesRoomSternToTheWindToo) {
  for (const double psi : {kPi, 0.0, 0.2}) {
    ScriptedMission mission = inWind(8.0);
    mission.put({2.0, -5.0}, {5.0, 5.0});
    mission.rest[vessel::kPsi] = psi;
    const auto orders = mission.goTo({-20.0, 0.0});
    ASSERT_TRUE(orders && orders->plan);
    (void)mission.refuse(*orders->plan, "no");
    const Orders next = mission.update(0.1);
    EXPECT_EQ(mission.supervisor->phase(), Phase::kBackingOff);
    ASSERT_TRUE(next.sail);
    const trajectory::Trajectory& path = next.sail->trajectory;
    const trajectory::Sample end = path.sample(path.duration(), vessel::Parameters{});
    EXPECT_LT(end.state.x(), -2.4);
    EXPECT_NEAR(end.state.y(), 0.0, 1e-6);
    EXPECT_NEAR(path.duration(), std::max(4.0, -end.state.x()), 1e-6);
  }
}

// Off the line of what drives it, for as far as it turns on the leg.
TEST(SupervisorInWind, MakesRoomOffTheWindsLine) {
  for (const double psi : {0.9, 1.4}) {
    ScriptedMission mission = inWind(8.0);
    mission.put({2.0, -5.0}, {5.0, 5.0});
    mission.rest[vessel::kPsi] = psi;
    (void)mission.goTo({-20.0, 0.0});
    (void)mission.update(0.1);
    EXPECT_EQ(mission.supervisor->phase() == Phase::kBackingOff, psi < 1.0);
  }
}

// A gust drives it on while it stops, bow to the wind: it counts as a stop, but isn't waited for,
// unless the mission has ended.
TEST(SupervisorInWind, MakesRoomBeforeItRestsInStrongWind) {
  struct Case {
    bool shore, cancelled;
  };
  for (const auto [shore, cancelled] : {Case{false, false}, Case{true, false}, Case{true, true}}) {
    ScriptedMission mission = inWind(8.0);
    mission.setOut(6.0);
    Situation driven = mission.situation();
    driven.tracking_error_m = 2.0;
    driven.state[vessel::kPsi] = kPi + 0.7;  // lost
    driven.state.tail<3>() << -0.6, 0.0, 0.0;
    if (shore) {
      const Vector2d here = driven.state.head<2>();
      mission.put(here + Vector2d(2.5, -5.0), here + Vector2d(4.0, 5.0));
    }
    double stopping_s = 0.0;
    for (int k = 0; k < 60 && mission.supervisor->phase() != Phase::kBackingOff; ++k) {
      mission.now_s += 0.1;
      driven.odometry_stamp_s = mission.now_s;
      const Orders orders = mission.supervisor->update(mission.now_s, driven, mission.field);
      driven.state[vessel::kPsi] = kPi;
      if (orders.plan) {
        (void)mission.refuse(*orders.plan, "no");
      }
      stopping_s += mission.supervisor->phase() == Phase::kStopping ? 0.1 : 0.0;
      if (cancelled && mission.supervisor->phase() == Phase::kStopping) {
        (void)mission.supervisor->cancel(mission.now_s, driven, mission.field);
      }
    }
    const bool makes_room = shore && !cancelled;
    EXPECT_EQ(mission.supervisor->phase(), makes_room ? Phase::kBackingOff : Phase::kStopping);
    EXPECT_EQ(mission.supervisor->stops(), makes_room ? 1 : 0);
    EXPECT_GT(stopping_s, 0.8);
  }
}

// The wide way was refused for something far off; on the narrow one a shore lies 3 m to leeward.
TEST(SupervisorInWind, LooksForMoreRoomToLeewardInStrongWind) {
  for (const double wind_mps : {5.0, 8.0}) {
    ScriptedMission mission = inWind(wind_mps);
    mission.disturbance.wind_mps = {0.0, wind_mps};
    mission.knowWeather(30.0);
    mission.put({-20.0, 4.0}, {20.0, 6.0});
    mission.rest << -40.0, 0.0, -0.5 * kPi, 0.0, 0.0, 0.0;
    auto orders = mission.goTo({40.0, 0.0});
    ASSERT_TRUE(orders && orders->plan);
    Orders narrower = *orders;
    const int steps = wind_mps > 6.0 ? ClearanceLevels::kSteps : 1;
    for (int step = 0; step < steps; ++step) {
      for (narrower = mission.refuse(*narrower.plan, "no"); !narrower.plan;) {
        narrower = mission.update(0.1);
      }
    }
    (void)mission.answer(*narrower.plan, test::eastward({-40.0, 0.0}, 80.0, 0.8));
    ASSERT_EQ(mission.supervisor->phase(), Phase::kSailing);
    std::optional<PlanRequest> wider;
    for (int k = 0; k < 250 && !wider; ++k) {
      wider = mission.update(0.1).plan;
    }
    ASSERT_EQ(wider.has_value(), wind_mps > 6.0);
    if (!wider) {
      continue;
    }
    EXPECT_TRUE(beginsUnderWay(*wider));
    EXPECT_GT(wider->query.limits.drift_m.norm(), 1.5 * narrower.plan->query.limits.drift_m.norm());
    const auto way = [&](const PlanRequest& request, double to_y_m) {
      const trajectory::TimedTrajectory& sailed = mission.supervisor->sailed();
      const vessel::FlatPoint from =
          sailed.trajectory.flat(request.start_time_s - sailed.start_time_s);
      vessel::FlatPoint beside;
      beside.position = from.position + Vector2d(8.0, to_y_m);
      beside.velocity = from.velocity;
      vessel::FlatPoint end;
      end.position = {40.0, 0.0};
      return trajectory::Trajectory({trajectory::hermitePiece(from, beside, 12.0),
                                     trajectory::hermitePiece(beside, end, 95.0)});
    };
    EXPECT_FALSE(mission.answer(*wider, way(*wider, 0.2)).sail);
    wider.reset();
    for (int k = 0; k < 80 && !wider; ++k) {
      wider = mission.update(0.1).plan;
    }
    ASSERT_TRUE(wider);
    EXPECT_TRUE(mission.answer(*wider, way(*wider, -6.0)).sail);
  }
}

// 60 N from astern leave the path 20 N to point the bow with: it may lie as it likes.
TEST(SupervisorInWind, NoHeadingIsLostWhereThePathWantsNone) {
  for (const double push_n : {0.0, 60.0}) {
    ScriptedMission mission;
    blow(mission, 60.0, [&](double) { return Vector2d(push_n, 0.0); });
    mission.setOut(6.0);
    Situation turned = mission.situation();
    turned.state[vessel::kPsi] += 1.4;
    turned.tracking_error_m = 1.0;
    const Orders orders = mission.supervisor->update(mission.now_s, turned, mission.field);
    EXPECT_EQ(orders.stop, push_n == 0.0);
  }
}

// Half of the thrusters' moment is taken, and 30 N set a lost hull aside by 4.5 m in three seconds.
TEST(SupervisorInWind, IsImpatientOffItsTrajectoryWithSomethingNear) {
  struct Case {
    bool near;
    double away_mps;
  };
  for (const auto [near, away_mps] : {Case{true, 0.3}, Case{true, -0.3}, Case{false, 0.3}}) {
    ScriptedMission mission;
    mission.disturbance.moment_nm = 20.0;
    blow(mission, 5.0, [](double) { return Vector2d(-30.0, 0.0); });
    mission.setOut(6.0);
    Situation aside = mission.situation();
    aside.state.y() -= 2.0;
    aside.state[vessel::kSway] = -away_mps;
    aside.tracking_error_m = 2.0;
    if (near) {
      const Vector2d here = aside.state.head<2>();
      mission.put(here + Vector2d(-2.0, -3.0), here + Vector2d(2.0, -1.8));
    }
    const Orders orders = mission.supervisor->update(mission.now_s, aside, mission.field);
    EXPECT_EQ(orders.stop, near && away_mps > 0.0);
  }
}

// Whatever heading it is turned to, and wherever gusts set it aside, wide water leaves room for it.
TEST(SupervisorInWind, PrefersWideWaterWhereTheWindTurnsTheHull) {
  for (const double moment_nm : {0.0, 5.0, 12.0, 20.0}) {
    ScriptedMission mission(openWater(), forStillWater());
    mission.disturbance.moment_nm = moment_nm;
    blow(mission, 40.0, [](double) { return Vector2d(-30.0, 0.0); });
    const auto orders = mission.goTo({20.0, 0.0});
    ASSERT_TRUE(orders && orders->plan);
    const feasibility::SafetyLimits& limits = orders->plan->query.limits;
    if (moment_nm > 10.0) {
      EXPECT_GT(limits.preferred_clearance_m, limits.clearance_m + 0.5) << moment_nm;
    } else {
      EXPECT_EQ(limits.preferred_clearance_m, 0.0) << moment_nm;
    }
  }
}

// 2 m off, where strong wind may take the heading and wide water leaves room for that, it is not
// planned anew: another plan would meet the same gusts. Nearer to something it is, or with
// something beside its way, and in less wind.
TEST(SupervisorInWind, KeepsItsPlanFartherOffWhereStrongWindHasRoom) {
  enum class Something { kNowhere, kBesideIt, kBesideItsWay };
  struct Case {
    double moment_nm;
    Something lies;
    bool keeps;
  };
  for (const auto& [moment_nm, lies, keeps] :
       {Case{20.0, Something::kNowhere, true}, Case{20.0, Something::kBesideIt, false},
        Case{20.0, Something::kBesideItsWay, false}, Case{0.0, Something::kNowhere, false}}) {
    ScriptedMission mission(openWater(), forStillWater());
    mission.disturbance.moment_nm = moment_nm;
    blow(mission, 5.0, [](double) { return Vector2d(-30.0, 0.0); });
    mission.setOut(6.0);
    const Vector2d there = mission.situation().state.head<2>();
    if (lies == Something::kBesideIt) {
      mission.put(there + Vector2d(-3.0, -6.5), there + Vector2d(9.0, -4.5));
    } else if (lies == Something::kBesideItsWay) {
      mission.put(there + Vector2d(15.0, 2.5), there + Vector2d(17.0, 4.5));
    }
    bool kept = true;
    for (int k = 0; k < 30 && kept; ++k) {
      mission.now_s += 0.1;
      Situation aside = mission.situation();
      aside.state.y() -= 2.0;
      aside.tracking_error_m = 2.0;
      const Orders orders = mission.supervisor->update(mission.now_s, aside, mission.field);
      kept = !orders.stop && !orders.plan;
    }
    EXPECT_EQ(kept, keeps) << moment_nm << " " << static_cast<int>(lies);
  }
}

// In such a wind what drives a hull off doesn't let go of it until it lies in the wind: it is not
// waited for how far that takes it.
TEST(SupervisorInWind, StopsBeforeItIsFarOffWithSomethingNear) {
  struct Case {
    double moment_nm;
    bool near;
    double away_mps;
    bool stops;
  };
  for (const auto& [moment_nm, near, away_mps, stops] :
       {Case{20.0, true, 0.9, true}, Case{20.0, true, 0.3, false}, Case{20.0, true, -0.9, false},
        Case{20.0, false, 0.9, false}, Case{0.0, true, 0.9, false}}) {
    ScriptedMission mission;
    mission.disturbance.moment_nm = moment_nm;
    blow(mission, 5.0, [](double) { return Vector2d(-30.0, 0.0); });
    mission.setOut(6.0);
    Situation aside = mission.situation();
    aside.state.y() -= 0.4;
    aside.state[vessel::kSway] = -away_mps;
    aside.tracking_error_m = 0.4;
    if (near) {
      const Vector2d here = aside.state.head<2>();
      mission.put(here + Vector2d(-2.0, -4.0), here + Vector2d(2.0, -2.0));
    }
    const Orders orders = mission.supervisor->update(mission.now_s, aside, mission.field);
    EXPECT_EQ(orders.stop, stops) << moment_nm << " " << near << " " << away_mps;
  }
}

// With the bow to a strong wind, or the stern, it is sailed wherever the path leads.
TEST(SupervisorInWind, AHeadingInTheWindsLineIsNotLostInStrongWind) {
  for (const double off_rad : {0.0, 0.3, 1.2}) {
    ScriptedMission mission = inWind(8.0);
    mission.setOut(6.0);
    Situation held = mission.situation();
    held.tracking_error_m = 1.5;
    held.state.y() -= 1.5;
    held.state[vessel::kPsi] = kPi + off_rad;
    held.state.tail<3>().setZero();
    const Orders orders = mission.supervisor->update(mission.now_s, held, mission.field);
    EXPECT_EQ(orders.stop, off_rad > 1.0) << off_rad;
  }
}

// Its heading is lost, and it stops; what it drifts onto then there are thrusts to pass. So in wind
// that turns the hull, if the tracker foresees it since it was told to stop; also where it drifts
// slowly and there is most of ten seconds left.
TEST(SupervisorInWind, EscapesFromWhatTheTrackerForeseesItDriftsOnto) {
  struct Case {
    double wind_mps;
    bool shore, since_the_stop;
    double drifts_mps;
    bool escapes;
  };
  for (const auto& c : {Case{8.0, true, true, 1.0, true}, Case{8.0, false, true, 1.0, false},
                        Case{8.0, true, false, 1.0, false}, Case{8.0, true, true, 0.1, false},
                        Case{8.0, true, true, 0.25, false}, Case{8.0, true, true, 0.4, true},
                        Case{3.0, true, true, 1.0, false}, Case{3.0, true, true, 0.4, false}}) {
    ScriptedMission mission = inWind(c.wind_mps);
    mission.setOut(6.0);
    Situation driven = mission.situation();
    driven.tracking_error_m = 3.0;
    driven.state[vessel::kPsi] = kPi + 1.2;
    driven.state.tail<3>().setZero();
    const Vector2d here = driven.state.head<2>();
    if (c.shore) {
      mission.put(here + Vector2d(4.5, -1.0), here + Vector2d(6.5, 1.0));
    }
    const double before_s = mission.now_s;
    Orders orders;
    for (int k = 0; k < 40 && !orders.stop; ++k) {
      mission.now_s += 0.1;
      driven.odometry_stamp_s = mission.now_s;
      orders = mission.supervisor->update(mission.now_s, driven, mission.field);
      if (orders.plan) {
        (void)mission.refuse(*orders.plan, "no");
      }
    }
    ASSERT_TRUE(orders.stop);
    mission.now_s += 0.1;
    driven.odometry_stamp_s = mission.now_s;
    driven.foreseen = test::foreseenFrom(c.since_the_stop ? mission.now_s : before_s, driven.state,
                                         {c.drifts_mps, 0.0});
    orders = mission.supervisor->update(mission.now_s, driven, mission.field);
    EXPECT_EQ(orders.sail && orders.sail->rolled_out, c.escapes)
        << c.wind_mps << " " << c.shore << " " << c.since_the_stop << " " << c.drifts_mps;
    if (c.escapes && orders.sail) {
      EXPECT_EQ(mission.supervisor->phase(), Phase::kBackingOff);
      EXPECT_LT((orders.sail->trajectory.flat(0.0).position - here).norm(), 1e-6);
      const map::DistanceField& field = mission.field;
      for (double t = 0.0; t < orders.sail->trajectory.duration(); t += 0.1) {
        EXPECT_GT(field.clearance(orders.sail->trajectory.flat(t).position), 0.54) << t;
      }
    }
  }
}

// So in a firm load that plans are made with, but from what it touches alone, also where it waits:
// the load takes no heading.
TEST(SupervisorInWind, EscapesInAFirmLoadThatPlansKnow) {
  struct Case {
    double load_n;
    bool known, waits;
    double drifts_mps;  // for five seconds, with something 4 m off
    bool escapes;
  };
  for (const auto& c : {Case{60.0, true, false, 1.0, true}, Case{6.0, true, false, 1.0, false},
                        Case{60.0, false, false, 1.0, false}, Case{60.0, true, true, 1.0, true},
                        Case{60.0, true, true, 0.7, false}}) {
    ScriptedMission mission(openWater(), c.known ? knowing() : forStillWater());
    mission.supervisor = Supervisor::create(
        mission.options,
        *vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/otter.yaml"),
        1);
    blow(mission, 10.0, [&](double) { return Vector2d(-c.load_n, 0.0); });
    mission.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
    const auto asked = mission.goTo({40.0, 0.0});
    ASSERT_TRUE(asked && asked->plan);
    if (!c.waits) {
      (void)mission.answer(*asked->plan, test::eastward({-40.0, 0.0}, 80.0, 1.0));
      blow(mission, 6.0, [&](double) { return Vector2d(-c.load_n, 0.0); });
    }
    mission.now_s += 0.1;
    Situation driven = mission.situation();
    driven.state[vessel::kPsi] = 0.5 * kPi;
    driven.state.tail<3>().setZero();
    const Vector2d here = driven.state.head<2>();
    mission.put(here + Vector2d(-6.5, -1.0), here + Vector2d(-4.5, 1.0));
    driven.foreseen = test::foreseenFrom(mission.now_s, driven.state, {-c.drifts_mps, 0.0});
    const Orders orders = mission.supervisor->update(mission.now_s, driven, mission.field);
    EXPECT_EQ(orders.sail && orders.sail->rolled_out, c.escapes)
        << c.load_n << " " << c.known << " " << c.waits << " " << c.drifts_mps;
    if (!c.escapes) {
      continue;
    }
    // What is foreseen soon after is the same again.
    for (const auto& [after_s, again] : {std::pair(20.0, false), std::pair(50.0, true)}) {
      blow(mission, after_s, [&](double) { return Vector2d(-c.load_n, 0.0); });
      driven.odometry_stamp_s = mission.now_s += 0.1;
      driven.foreseen = test::foreseenFrom(mission.now_s, driven.state, {-1.0, 0.0});
      const Orders then = mission.supervisor->update(mission.now_s, driven, mission.field);
      EXPECT_EQ(then.sail && then.sail->rolled_out, again) << c.waits << " " << after_s;
    }
  }
}

// Late on its way it lies where nothing is, and a shore to windward or abeam is none that a lost
// heading is driven on.
TEST(SupervisorInWind, NeitherBeingLateNorAWindwardShoreIsAHurry) {
  struct Case {
    Vector2d going;       // over ground, on a plan that leads east
    Vector2d near_low_m;  // of something, from the vessel; the wind pushes west
    bool stops;
  };
  const Vector2d lee(-5.5, -1.5);
  const Vector2d windward(3.6, -1.5);
  const Vector2d abeam(-2.0, -6.6);
  for (const auto& [going, near_low_m, stops] :
       {Case{{-0.5, -0.7}, lee, true}, Case{{0.1, 0.0}, lee, false}, Case{{-1.0, 0.0}, lee, true},
        Case{{-0.5, -0.7}, windward, false}, Case{{-0.5, -0.7}, abeam, false}}) {
    ScriptedMission mission;
    mission.disturbance.moment_nm = 20.0;
    blow(mission, 5.0, [](double) { return Vector2d(-30.0, 0.0); });
    mission.setOut(6.0);
    Situation aside = mission.situation();
    aside.state.head<2>() -= Vector2d(0.2, 0.3);
    aside.tracking_error_m = 0.36;
    const double psi = aside.state[vessel::kPsi];
    aside.state.segment<2>(vessel::kSurge) = Eigen::Rotation2D<double>(-psi) * going;
    const Vector2d here = aside.state.head<2>();
    mission.put(here + near_low_m, here + near_low_m + Vector2d(3.0, 3.0));
    const Orders orders = mission.supervisor->update(mission.now_s, aside, mission.field);
    EXPECT_EQ(orders.stop, stops) << going.transpose() << ", " << near_low_m.transpose();
  }
}

// Set aside until it stops; s from there to the request for another plan, which is granted.
double plansAgainAfter(ScriptedMission& mission) {
  mission.rest = mission.situation().state;
  mission.rest.tail<3>().setZero();
  for (bool stopped = false; !stopped;) {
    mission.now_s += 0.1;
    Situation aside = mission.situation();
    aside.tracking_error_m = 3.0;
    const Orders orders = mission.supervisor->update(mission.now_s, aside, mission.field);
    stopped = orders.stop;
    if (orders.plan) {
      (void)mission.refuse(*orders.plan, "no");
    }
  }
  const double since_s = mission.now_s;
  while (mission.now_s < since_s + 100.0) {
    if (const Orders orders = mission.update(0.1); orders.plan) {
      const double after_s = mission.now_s - since_s;
      const Vector2d here = mission.rest.head<2>();
      (void)mission.answer(*orders.plan, test::eastward(here, 40.0 - here.x(), 4.0));
      return after_s;
    }
  }
  return 100.0;
}

// Where the wind takes most of the moment, the next gust would do what the last one did.
TEST(SupervisorInWind, WaitsLongerEachTimeItHadToStopInAStrongWind) {
  for (const double moment_nm : {0.0, 20.0}) {
    ScriptedMission mission;
    mission.disturbance.moment_nm = moment_nm;
    mission.knowWeather();
    mission.setOut(1.0);
    EXPECT_LT(plansAgainAfter(mission), 2.0);
    EXPECT_NEAR(plansAgainAfter(mission), moment_nm > 0.0 ? 10.0 : 0.5, 1.5);
    EXPECT_NEAR(plansAgainAfter(mission), moment_nm > 0.0 ? 20.0 : 0.5, 1.5);
  }
}

// As patient after a stop as at the beginning.
TEST(SupervisorInWind, WaitsEachTimeForABowInTheStrongWind) {
  ScriptedMission mission = inWind(8.0);
  mission.rest << -40.0, 0.0, 0.5 * kPi, 0.0, 0.0, 0.0;
  Situation lies = mission.situation();
  const auto plansAfter = [&](std::optional<PlanRequest> plan) {
    const double since_s = mission.now_s;
    while (!plan && mission.now_s < since_s + 60.0) {
      mission.now_s += 0.1;
      lies.odometry_stamp_s = mission.now_s;
      plan = mission.supervisor->update(mission.now_s, lies, mission.field).plan;
    }
    const Vector2d here = lies.state.head<2>();
    (void)mission.answer(*plan, test::eastward(here, 40.0 - here.x(), 4.0));
    EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
    return mission.now_s - since_s;
  };
  EXPECT_NEAR(plansAfter(mission.goTo({40.0, 0.0})->plan), 20.0, 1.0);
  (void)mission.update(3.0);
  lies = stopped(mission, true);
  lies.state[vessel::kPsi] = 0.5 * kPi;
  EXPECT_NEAR(plansAfter(std::nullopt), 20.0, 2.0);
}

// 40 s after the fifth stop: with 2 m beside it it makes room again and again meanwhile.
TEST(SupervisorInWind, CountsNoStopWhileItWaitsForLessWind) {
  ScriptedMission mission = inWind(8.0);
  mission.setOut(1.0);
  constexpr int kStops = 5;
  for (int k = 1; k < kStops; ++k) {
    (void)plansAgainAfter(mission);
  }
  Situation lies = stopped(mission, true);
  const Vector2d here = lies.state.head<2>();
  mission.put(here + Vector2d(-2.0, 2.0), here + Vector2d(0.0, 5.0));
  const double since_s = mission.now_s;
  std::optional<PlanRequest> plan;
  int rooms = 0;
  while (mission.now_s < since_s + 39.0 && !plan) {
    rooms += makesRoom(mission, lies, plan) ? 1 : 0;
    EXPECT_LE(mission.supervisor->stops(), kStops);
  }
  EXPECT_FALSE(plan);
  EXPECT_GT(rooms, 3);
  while (mission.now_s < since_s + 100.0 && mission.supervisor->stops() == kStops) {
    (void)makesRoom(mission, lies, plan);
  }
  EXPECT_EQ(mission.supervisor->stops(), kStops + 1);  // once that is over
}

TEST(SupervisorInWind, HoldsAndRefusesWhereTheThrustDoesNotSuffice) {
  ScriptedMission mission;
  const Force gale = [](double) { return Vector2d(0.0, 120.0); };
  blow(mission, 5.0, gale);
  const auto orders = mission.goTo({20.0, 0.0}, 0.0);
  ASSERT_TRUE(orders);
  const Blown first = blow(mission, 10.0, gale);
  EXPECT_TRUE(first.stop || orders->stop);  // the tracker keeps the place
  EXPECT_TRUE(first.plans.empty());
  EXPECT_NE(mission.supervisor->reason().find("N in gusts"), std::string::npos)
      << mission.supervisor->reason();
  blow(mission, 60.0, gale);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kFailed);
}

}  // namespace
}  // namespace otter_nav::mission
