#include "mission/safety.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace otter_nav::mission {
namespace {

constexpr double kWideWater = 100.0;  // m

TEST(Safety, PlansMayUseLessThrustTheMoreGustsTake) {
  const double calm = SupervisorOptions{}.thrust_share;
  EXPECT_NEAR(planThrustShare(calm, 0.0, 0), calm, 1e-9);
  EXPECT_NEAR(planThrustShare(calm, 0.2, 0), 0.8, 1e-9);
  EXPECT_NEAR(planThrustShare(calm, 0.2, 1), 0.7, 1e-9);
  EXPECT_NEAR(planThrustShare(calm, 0.22, 0), 0.75, 1e-9);  // in steps
  EXPECT_NEAR(planThrustShare(calm, 0.9, 5), 0.4, 1e-9);
}

TEST(Safety, ClearancesAreTheListsInCalmWater) {
  const SupervisorOptions options;
  for (std::size_t k = 0; k < options.side_clearances_m.size(); ++k) {
    EXPECT_DOUBLE_EQ(planClearance(options, k, 0.0, vessel::Hull{}, kWideWater),
                     centreClearance(vessel::Hull{}, options.side_clearances_m[k]));
  }
}

// By what gusts move the hull, less on the narrower levels.
TEST(Safety, ClearancesGrowWithGusts) {
  const SupervisorOptions options;
  const vessel::Hull hull;
  const std::size_t last = options.side_clearances_m.size() - 1;
  EXPECT_NEAR(planClearance(options, 0, 0.7, hull, kWideWater),
              centreClearance(hull, options.side_clearances_m[0]) + 0.7, 1e-12);
  EXPECT_NEAR(planClearance(options, last, 0.7, hull, kWideWater),
              centreClearance(hull, options.side_clearances_m[last]) + 0.5 * 0.7, 1e-12);
}

TEST(Safety, AsksForNoMoreThanStartAndGoalHave) {
  const SupervisorOptions options;
  const vessel::Hull hull;
  EXPECT_DOUBLE_EQ(planClearance(options, 0, 1.0, hull, 2.0), 1.9);
  EXPECT_DOUBLE_EQ(planClearance(options, 3, 1.0, hull, 0.5), 0.64);
}

// Around the hull plans keep what the vessel wanders, half as much where there was none with that;
// stops nearly as much.
TEST(Safety, MarginsGrowWithWhatTheVesselWanders) {
  Safety safety(SupervisorOptions{}, vessel::Parameters{});
  const auto margin = [&] { return safety.limits(0.95, kWideWater).hull_margin_m; };
  for (int k = 0; k < 100; ++k) {
    safety.wander(0.1 * k, 0.01);
  }
  const double steady = margin();
  EXPECT_LT(steady, 0.06);
  EXPECT_NEAR(safety.stop(safety.limits(0.95, kWideWater)).hull_margin_m, 0.02, 0.01);
  for (int k = 100; k < 400; ++k) {
    safety.wander(0.1 * k, k % 2 == 0 ? 0.1 : 0.06);
  }
  const double wide = margin();
  EXPECT_NEAR(wide, 0.16, 0.02);
  EXPECT_NEAR(safety.stop(safety.limits(0.95, kWideWater)).hull_margin_m, wide - 0.03, 1e-9);
  const double fast = safety.limits(0.95, kWideWater).speed_max_mps;
  while (safety.refused()) {
    EXPECT_NEAR(margin(), wide, 1e-9);
    // At a crawl where that is most of the room.
    const double speed = safety.limits(0.95, kWideWater).speed_max_mps;
    EXPECT_NEAR(speed, safety.level() >= 2 ? 0.8 : fast, 1e-9);
  }
  EXPECT_NEAR(margin(), 0.5 * wide, 1e-9);
  EXPECT_EQ(safety.leastStop(safety.limits(0.95, kWideWater)).hull_margin_m, 0.02);
}

// Among what nobody has charted: twice what it wanders where there is room for it, and at a crawl
// where that is most of the room.
// What was refused under way says nothing of plans from rest: they begin with all the room again.
TEST(Safety, BeginsWithAllTheRoomAgainWhereItComesToRest) {
  Safety safety(SupervisorOptions{}, vessel::Parameters{});
  for (double t = 0.0; t < 20.0; t += 0.1) {
    safety.wander(t, 0.08);
  }
  const double at_first_m = safety.limits(1.0, 5.0).hull_margin_m;
  ASSERT_GT(at_first_m, 0.1);
  for (int k = 0; k < 2; ++k) {
    while (safety.refused()) {
    }
    safety.tryWidest();
  }
  ASSERT_LT(safety.limits(1.0, 5.0).hull_margin_m, 0.5 * at_first_m);
  safety.comeToRest();
  EXPECT_DOUBLE_EQ(safety.limits(1.0, 5.0).hull_margin_m, at_first_m);
}

// There one level asks for metres less than the one before: what lies between is tried first.
TEST(Safety, InStrongWindTheNarrowerIsTriedInSteps) {
  vessel::Parameters windy;
  windy.manoeuvring.wind_surge_kgpm = 0.5;
  windy.manoeuvring.wind_sway_kgpm = 0.5;
  windy.manoeuvring.wind_yaw_kg = -0.66;
  for (const double wind_mps : {3.0, 8.0}) {
    Safety safety(SupervisorOptions{}, windy);
    vessel::Disturbance wind;
    for (int k = 0; k < 400; ++k) {
      wind.wind_mps = {wind_mps * (1.0 + 0.2 * std::sin(0.1 * k)), 0.0};
      safety.feel(0.1 * k, wind);
    }
    const bool is_strong = wind_mps > 6.0;
    ASSERT_EQ(safety.weather().isStrong(), is_strong);
    feasibility::SafetyLimits before = safety.limits(0.95, kWideWater);
    int narrower = 0;
    while (safety.refused()) {
      const feasibility::SafetyLimits after = safety.limits(0.95, kWideWater);
      EXPECT_LT(after.clearance_m, before.clearance_m);
      EXPECT_LT(after.drift_m.norm(), before.drift_m.norm());
      EXPECT_EQ(safety.atNarrowest(), ++narrower == (is_strong ? 9 : 3));
      before = after;
    }
    EXPECT_EQ(narrower, is_strong ? 9 : 3);
    EXPECT_EQ(safety.level(), 0U);
    safety.tryLevel(2, 1);
    const double between_m = safety.limits(0.95, kWideWater).clearance_m;
    safety.tryLevel(2);
    EXPECT_GT(between_m, safety.limits(0.95, kWideWater).clearance_m);
  }
}

TEST(Safety, CrawlsInUnknownWaterWhereItWanders) {
  const vessel::Parameters vessel;
  Safety safety(SupervisorOptions{}, vessel);
  const auto limits = [&] { return safety.limits(0.95, kWideWater); };
  for (int k = 0; k < 400; ++k) {
    safety.wander(0.1 * k, 0.1);
  }
  const double fast = limits().speed_max_mps;
  const double crawl = 0.4 * vessel.hull.length_m;
  EXPECT_NEAR(limits().hull_margin_m, 0.2, 0.01);
  safety.inUnknownWater(true);
  EXPECT_NEAR(limits().hull_margin_m, 0.4, 0.02);
  EXPECT_EQ(limits().speed_max_mps, fast);
  ASSERT_TRUE(safety.refused());
  EXPECT_NEAR(limits().hull_margin_m, 0.4, 0.02);
  EXPECT_NEAR(limits().speed_max_mps, crawl, 1e-9);
  while (safety.refused()) {
    EXPECT_NEAR(limits().hull_margin_m, 0.2, 0.01);
    EXPECT_NEAR(limits().speed_max_mps, crawl, 1e-9);
  }
  // As soon as the water is known again.
  safety.planTaken();
  safety.inUnknownWater(false);
  EXPECT_EQ(limits().speed_max_mps, fast);
}

// At the usual pace it wanders more: once it goes slowly that must have become clearly less.
TEST(Safety, GoesFasterAgainOnlyWhereItWandersMuchLess) {
  Safety safety(SupervisorOptions{}, vessel::Parameters{});
  double now_s = 0.0;
  const auto isSlow = [&](double reach_m) {
    for (int k = 0; k < 1000; ++k) {
      safety.wander(now_s += 0.1, 0.5 * reach_m);
    }
    return safety.limits(0.95, kWideWater).speed_max_mps < 1.0;
  };
  safety.inUnknownWater(true);
  ASSERT_TRUE(safety.refused());
  const double room = SupervisorOptions{}.side_clearances_m[1];
  EXPECT_FALSE(isSlow(0.5 * 0.65 * room));  // of which twice is kept
  EXPECT_TRUE(isSlow(0.5 * 0.80 * room));
  EXPECT_TRUE(isSlow(0.5 * 0.65 * room));
  EXPECT_FALSE(isSlow(0.5 * 0.55 * room));
  EXPECT_FALSE(isSlow(0.5 * 0.65 * room));
}

vessel::Parameters feelingWind() {
  vessel::Parameters vessel;
  vessel.manoeuvring.wind_surge_kgpm = 0.5;
  vessel.manoeuvring.wind_sway_kgpm = 0.5;
  return vessel;
}

// Slower than a light wind allows, a hull would sail half across its way; so it crawls no slower.
TEST(Safety, SailsNoSlowerThanALightWindFromAbeamAllows) {
  const vessel::Parameters vessel = feelingWind();
  for (const double wind_mps : {0.0, 3.0}) {
    Safety safety(SupervisorOptions{}, vessel);
    safety.inUnknownWater(true);
    vessel::Disturbance weather;
    weather.wind_mps = {0.0, wind_mps};
    for (int k = 0; k < 50; ++k) {
      safety.feel(0.1 * k, weather);
    }
    while (safety.refused()) {
    }
    while (safety.refused()) {
    }
    safety.tryLevel(2);
    const feasibility::SafetyLimits limits = safety.limits(0.95, kWideWater);
    const double load_n = 0.5 * wind_mps * wind_mps;
    EXPECT_TRUE(limits.felt.wind_mps.isZero(0.0));  // the last round does without
    EXPECT_NEAR(safety.limits(0.95, kWideWater, true).felt.wind_mps.norm(), wind_mps, 0.1);
    if (wind_mps > 0.0) {
      EXPECT_GT(limits.speed_max_mps, load_n / (vessel.paper.d2_kgps * std::tan(0.26)));
    } else {
      EXPECT_LE(limits.speed_max_mps, 0.4 * vessel.hull.length_m);
    }
    safety.planTaken();
    EXPECT_NEAR(safety.limits(0.95, kWideWater).felt.wind_mps.norm(), wind_mps, 0.1);
  }
}

// Strong wind lays the hull across its way.
TEST(Safety, PlansKnowWhatTheHullLeansIntoInStrongWindToo) {
  const vessel::Parameters vessel = feelingWind();
  Safety safety(SupervisorOptions{}, vessel);
  vessel::Disturbance weather;
  weather.wind_mps = {0.0, 8.0};
  for (int k = 0; k < 50; ++k) {
    safety.feel(0.1 * k, weather);
  }
  EXPECT_NEAR(safety.limits(0.95, kWideWater).felt.wind_mps.y(), 8.0, 0.1);
}

// Where there is hardly room for it a vessel that hasn't shown how far it wanders crawls, in water
// that is known as well.
TEST(Safety, CrawlsWhereThereIsNoRoomToWander) {
  Safety safety(SupervisorOptions{}, vessel::Parameters{});
  const double crawl = 0.4 * vessel::Parameters{}.hull.length_m;
  const auto speedAt = [&](std::size_t level) {
    safety.tryLevel(level);
    return safety.limits(0.95, kWideWater).speed_max_mps;
  };
  EXPECT_GT(speedAt(1), 2.0);
  EXPECT_NEAR(speedAt(2), crawl, 1e-9);
  EXPECT_NEAR(speedAt(3), crawl, 1e-9);
  for (int k = 0; k < 80; ++k) {
    safety.wander(0.1 * k, 0.01);
  }
  EXPECT_GT(speedAt(3), 2.0);
}

// The faster it goes the farther off its corners are: where there is no room for that it crawls,
// whatever it wanders by then.
TEST(Safety, CrawlsWhereItsCornersWouldHaveNoRoomAtSpeed) {
  const double crawl = 0.4 * vessel::Parameters{}.hull.length_m;
  for (const bool is_unknown : {false, true}) {
    for (const double reach_m : {0.04, 0.13}) {
      Safety safety(SupervisorOptions{}, vessel::Parameters{});
      for (int k = 0; k < 400; ++k) {
        safety.wander(0.1 * k, 0.5 * reach_m);
      }
      safety.inUnknownWater(is_unknown);
      const auto speedAt = [&](std::size_t level) {
        safety.tryLevel(level);
        return safety.limits(0.95, kWideWater).speed_max_mps;
      };
      EXPECT_GT(speedAt(1), 2.0);
      EXPECT_EQ(speedAt(2) < crawl + 1e-9, reach_m > 0.1);  // 0.2 m beside it
      EXPECT_GT(speedAt(1), 2.0);
    }
  }
}

// Of a gap with room for twice what it wanders and one without the first comes first.
TEST(Safety, KeepsTwiceWhatItWandersInUnknownWaterButOnTheNarrowestLevel) {
  Safety safety(SupervisorOptions{}, vessel::Parameters{});
  for (int k = 0; k < 400; ++k) {
    safety.wander(0.1 * k, 0.04);
  }
  const auto marginAt = [&](std::size_t level) {
    safety.tryLevel(level);
    return safety.limits(0.95, kWideWater).hull_margin_m;
  };
  EXPECT_NEAR(marginAt(2), 0.08, 0.005);
  safety.inUnknownWater(true);
  EXPECT_NEAR(marginAt(2), 0.16, 0.01);
  EXPECT_NEAR(marginAt(3), 0.1, 1e-9);
}

// In the first seconds under way nobody knows how far it wanders.
TEST(Safety, ReckonsWithWanderingInUnknownWater) {
  Safety safety(SupervisorOptions{}, vessel::Parameters{});
  const auto feel = [&](double from_s, double to_s) {
    for (double t = from_s; t < to_s; t += 0.1) {
      safety.wander(t, 0.01);
    }
  };
  feel(0.0, 4.0);
  EXPECT_LT(safety.reach(), 0.06);
  safety.inUnknownWater(true);
  EXPECT_EQ(safety.reach(), 0.2);
  feel(4.0, 8.0);
  EXPECT_LT(safety.reach(), 0.06);
  // Turns and stops come when they must there, so a little more is kept until there is no plan so.
  EXPECT_NEAR(safety.limits(0.95, kWideWater).hull_margin_m, 0.1, 1e-9);
  while (safety.refused()) {
  }
  EXPECT_NEAR(safety.limits(0.95, kWideWater).hull_margin_m, 0.05, 1e-9);
}

vessel::Parameters otter() {
  return *vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/otter.yaml");
}

// Nor in a firm load, whose first plan is made before; until it shows.
TEST(Safety, ReckonsWithWanderingInAFirmLoad) {
  for (const double load_n : {5.0, 40.0}) {
    Safety safety(SupervisorOptions{}, otter());
    vessel::Disturbance load;
    load.force_n = {0.0, load_n};
    for (int k = 0; k < 50; ++k) {
      safety.feel(0.1 * k, load);
    }
    const bool firm = safety.plansWithWeather();
    EXPECT_EQ(firm, load_n > 30.0);
    EXPECT_NEAR(safety.limits(0.8, 20.0).hull_margin_m, firm ? 0.2 : 0.06, 1e-9);
    for (int k = 0; k < 80; ++k) {
      safety.wander(0.1 * k, 0.01);
    }
    EXPECT_LT(safety.limits(0.8, 20.0).hull_margin_m, 0.06);
  }
}

// The tracked hull leans into it all the same.
TEST(Safety, PlansForStillWaterInAFirmLoadKnowTheLean) {
  Safety safety(SupervisorOptions{}, otter());
  vessel::Disturbance load;
  load.force_n = {0.0, 40.0};
  for (int k = 0; k < 50; ++k) {
    safety.feel(0.1 * k, load);
  }
  ASSERT_TRUE(safety.plansWithWeather());
  EXPECT_TRUE(safety.limits(0.8, 20.0).felt.force_n.isZero(0.0));
  while (!safety.plansBlind()) {
    ASSERT_TRUE(safety.refused());
  }
  const feasibility::SafetyLimits blind = safety.limits(0.8, 20.0);
  EXPECT_TRUE(blind.disturbance.force_n.isZero(0.0));
  EXPECT_NEAR(blind.felt.force_n.y(), 40.0, 0.1);
}

// Only where the hull lies on any heading as it is told to.
TEST(Safety, LetsNobodyCreepWhereTheLoadTakesTheHeading) {
  const auto mayCreep = [](const char* name, double force_n, double wind_mps) {
    Safety safety(SupervisorOptions{},
                  *vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/" +
                                          name + ".yaml"));
    vessel::Disturbance load;
    load.force_n = {0.0, force_n};
    load.wind_mps = {0.0, wind_mps};
    for (int k = 0; k < 50; ++k) {
      safety.feel(0.1 * k, load);
    }
    return safety.mayCreep();
  };
  EXPECT_TRUE(mayCreep("otter", 5.0, 0.0));
  EXPECT_FALSE(mayCreep("otter", 40.0, 0.0));
  EXPECT_TRUE(mayCreep("otter_gazebo", 0.0, 3.0));
  EXPECT_FALSE(mayCreep("otter_gazebo", 0.0, 8.0));
}

// What plans may take of the thrust in a load, with the hull swaying by so much beside a steady
// sway.
double shareInWaves(const vessel::Parameters& vessel, double load_n, double sway_mps,
                    double steady_mps = 0.0, std::size_t level = 0) {
  Safety safety(SupervisorOptions{}, vessel);
  safety.tryLevel(level);
  for (int k = 0; k < 600; ++k) {
    vessel::Disturbance load;
    load.force_n = {-load_n, 0.0};
    safety.feel(0.1 * k, load);
    safety.feelSway(0.1 * k, steady_mps + sway_mps * std::sin(0.25 * k));
  }
  return safety.freeThrustShare();
}

// Munk's moment turns a hull that waves move abeam while she makes way.
TEST(Safety, LeavesThrustToHoldTheHeadingInWaves) {
  constexpr double kFirmN = 40.0;
  const double most = SupervisorOptions{}.thrust_share;
  EXPECT_DOUBLE_EQ(shareInWaves(otter(), kFirmN, 0.0), most);
  EXPECT_DOUBLE_EQ(shareInWaves(otter(), kFirmN, 0.0, 0.5), most);  // a crab angle is no wave
  // 0.1 m/s rms: 74.8 kg * 0.1 m/s * (0.83 of 3.1 m/s) turn by 19 N m, 24 N a side.
  EXPECT_NEAR(shareInWaves(otter(), kFirmN, 0.14), 0.82, 0.051);
  EXPECT_NEAR(shareInWaves(otter(), kFirmN, 0.56), 0.75, 1e-9);  // no less is left to run with
  EXPECT_NEAR(shareInWaves(otter(), kFirmN, 0.56, 0.0, 1), 0.7, 1e-9);  // with less room
  EXPECT_NEAR(shareInWaves(otter(), kFirmN, 0.28, 0.0, 1), 0.68, 0.051);
  EXPECT_NEAR(shareInWaves(otter(), 1.0, 0.14), 0.82, 0.051);  // in a light load as well
  EXPECT_DOUBLE_EQ(shareInWaves(otter(), 1.0, 0.0), most);
  vessel::Parameters without = otter();
  without.manoeuvring.munk_kg = 0.0;
  EXPECT_DOUBLE_EQ(shareInWaves(without, kFirmN, 0.56), most);
}

// A gust takes the moment of a hull that it turns, which sails slower. Where the load doesn't turn
// with the heading a slower hull would only be carried.
TEST(Safety, SailsAsFastAsUsualInALoadThatDoesNotTurnWithTheHeading) {
  constexpr double kUsualMps = 2.9;
  const auto speed = [](const vessel::Parameters& vessel, vessel::Disturbance load) {
    Safety safety(SupervisorOptions{}, vessel);
    const vessel::Disturbance mean = load;
    for (int k = 0; k < 600; ++k) {
      const double gust = 1.0 + 0.3 * std::sin(0.1 * k);
      load.wind_mps = gust * mean.wind_mps;
      load.force_n = gust * mean.force_n;
      safety.feel(0.1 * k, load);
    }
    return safety.sailingSpeed(kUsualMps);
  };
  vessel::Disturbance load;
  for (const double current_mps : {0.05, 0.4}) {
    load.current_mps = {0.0, current_mps};
    load.force_n = {0.0, 10.0};
    load.moment_nm = 30.0;
    EXPECT_EQ(speed(otter(), load), kUsualMps);
  }
  const auto feels_wind = vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) +
                                                 "/config/vessels/otter_gazebo.yaml");
  ASSERT_TRUE(feels_wind);
  vessel::Disturbance wind;
  wind.wind_mps = {0.0, 8.0};
  EXPECT_LT(speed(*feels_wind, wind), 1.2);
}

// A wider hull is kept as far from everything, beside it.
TEST(Safety, ClearancesGrowWithTheBeam) {
  vessel::Parameters wam_v;
  wam_v.hull = {4.9, 2.44};
  const SupervisorOptions options;
  Safety safety(options, wam_v);
  EXPECT_NEAR(safety.narrowest(), 1.22 + 0.1, 1e-12);
  EXPECT_NEAR(safety.critical(), 0.03, 1e-12);
  const feasibility::SafetyLimits limits = safety.limits(0.95, kWideWater);
  EXPECT_NEAR(limits.clearance_m, 1.22 + 1.06, 1e-12);
  EXPECT_EQ(limits.hull.length_m, 4.9);
  EXPECT_LT(limits.speed_max_mps, 0.95 * wam_v.top_speed_mps);
}

// What a gust took it may have again after a while without.
TEST(Safety, GivesBackTheThrustTakenForBeingLeftBehind) {
  Safety safety(SupervisorOptions{}, vessel::Parameters{});
  const auto shareAfter = [&](double now_s) {
    safety.feel(now_s, {});
    return safety.nextThrustShare();
  };
  const double all = shareAfter(0.0);
  safety.leftBehind(1.0);
  safety.leftBehind(2.0);
  const double least = shareAfter(100.0);
  EXPECT_LT(least, all - 0.15);
  const double again = shareAfter(130.0);
  EXPECT_GT(again, least + 0.05);
  EXPECT_LT(again, all - 0.05);
  EXPECT_EQ(shareAfter(300.0), all);
}

// The least of what thrust, the vessel's file and the mission allow.
TEST(Safety, LeavesTheRestOfTheThrust) {
  const vessel::Parameters vessel;
  Safety safety(SupervisorOptions{}, vessel);
  const double all = feasibility::SafetyLimits::of(vessel).thrust_share;
  EXPECT_LT(all, 1.0);
  EXPECT_NEAR(safety.limits(0.95, kWideWater).thrust_share, 0.95 * all, 1e-12);
  EXPECT_NEAR(safety.limits(0.4, kWideWater).thrust_share, 0.4 * all, 1e-12);
}

TEST(Safety, LimitsTheSpeed) {
  vessel::Parameters vessel;
  const SupervisorOptions options;
  EXPECT_NEAR(Safety(options, vessel).limits(0.95, kWideWater).speed_max_mps, 0.98 * 0.95 * 5.0,
              1e-12);
  vessel.speed_max_mps = 3.0;
  Safety safety(options, vessel);
  EXPECT_NEAR(safety.limits(0.95, kWideWater).speed_max_mps, 0.98 * 3.0, 1e-12);
  safety.setSpeedMax(4.0);
  EXPECT_NEAR(safety.limits(0.95, kWideWater).speed_max_mps, 0.98 * 3.0, 1e-12);
  safety.setSpeedMax(1.0);
  EXPECT_NEAR(safety.limits(0.95, kWideWater).speed_max_mps, 0.98, 1e-12);
}

TEST(Safety, TakesTheFirstLevelThatStartAndGoalHaveRoomFor) {
  const SupervisorOptions options;
  Safety safety(options, vessel::Parameters{});
  for (int k = 0; k < 80; ++k) {
    safety.wander(0.1 * k, 0.01);
  }
  EXPECT_NEAR(safety.limits(0.95, 0.9).clearance_m, 0.74, 1e-12);
  EXPECT_TRUE(safety.refused());
  EXPECT_NEAR(safety.limits(0.95, kWideWater).clearance_m, 0.64, 1e-12);
  const double usual_mps = safety.limits(0.95, kWideWater).speed_max_mps;
  EXPECT_FALSE(safety.refused());  // all were tried
  EXPECT_NEAR(safety.limits(0.95, kWideWater).clearance_m, 1.6, 1e-12);
  // And once more, slower, until there is a plan.
  EXPECT_NEAR(safety.limits(0.95, kWideWater).speed_max_mps, 0.5 * usual_mps, 1e-9);
  safety.planTaken();
  EXPECT_NEAR(safety.limits(0.95, kWideWater).speed_max_mps, usual_mps, 1e-9);
}

}  // namespace
}  // namespace otter_nav::mission
