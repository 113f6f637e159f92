#include <gtest/gtest.h>

#include <limits>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/config/fields.hpp"
#include "scripted_mission.hpp"

namespace otter_nav::mission {
namespace {

using test::beginsUnderWay;
using test::eastward;
using test::ScriptedMission;

void expectRefused(ScriptedMission& mission, const Eigen::Vector2d& goal, double psi_rad,
                   const std::string& why) {
  const auto orders = mission.goTo(goal, psi_rad);
  ASSERT_FALSE(orders.has_value());
  EXPECT_NE(orders.error().message.find(why), std::string::npos) << orders.error().message;
  EXPECT_EQ(mission.supervisor->phase(), Phase::kIdle);
}

TEST(Goal, IsRefusedWithTheReason) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ScriptedMission mission;
  mission.put({10.0, 10.0}, {14.0, 14.0});
  expectRefused(mission, {nan, 0.0}, 0.0, "not finite");
  expectRefused(mission, {0.0, 0.0}, nan, "not finite");
  expectRefused(mission, {70.0, 0.0}, 0.0, "outside the map, x in [-50.00, 50.00]");
  expectRefused(mission, {12.0, 12.0}, 0.0, "inside an obstacle");
  expectRefused(mission, {9.5, 12.0}, 0.0, "m from an obstacle");
}

TEST(Goal, AsksForAPlanFromRestAtTheWidestClearance) {
  ScriptedMission mission;
  mission.rest << -40.0, 3.0, 0.5, 0.0, 0.0, 0.0;
  const auto orders = mission.goTo({40.0, 0.0}, 1.0);
  ASSERT_TRUE(orders.has_value() && orders->plan);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kPlanning);
  const PlanRequest& request = *orders->plan;
  EXPECT_FALSE(beginsUnderWay(request));
  EXPECT_EQ(request.query.start.flat.position, Eigen::Vector2d(-40.0, 3.0));
  EXPECT_EQ(request.query.start.flat.velocity, Eigen::Vector2d::Zero());
  EXPECT_EQ(request.query.start.psi_rad, 0.5);
  EXPECT_EQ(request.query.goal.psi_rad, 1.0);
  EXPECT_DOUBLE_EQ(request.query.limits.clearance_m, mission.clearance(0));
}

TEST(Goal, NarrowPlacesLowerTheClearance) {
  ScriptedMission mission;
  mission.put({41.5, -1.0}, {43.0, 1.0});
  const auto orders = mission.goTo({40.0, 0.0});
  ASSERT_TRUE(orders.has_value() && orders->plan);
  EXPECT_DOUBLE_EQ(orders->plan->query.limits.clearance_m, mission.clearance(1));
}

TEST(Goal, NewOneIsAskedForAtTheWidestAgain) {
  for (const bool pauses : {false, true}) {
    ScriptedMission mission;
    std::optional<PlanRequest> asked = mission.goTo({20.0, 0.0})->plan;
    for (int k = 0; k < 2; ++k) {
      ASSERT_TRUE(asked);
      (void)mission.refuse(*asked, "none");
      asked = mission.update(0.1).plan;
    }
    ASSERT_TRUE(asked);
    ASSERT_LT(asked->query.limits.clearance_m, mission.clearance(0) - 0.1);
    Result<Orders> again = Orders{};
    if (pauses) {
      ASSERT_TRUE(mission.supervisor->pause(mission.now_s, mission.situation(), mission.field));
      again = mission.supervisor->resume(mission.now_s, mission.situation(), mission.field);
    } else {
      again = mission.goTo({10.0, 5.0});
    }
    ASSERT_TRUE(again && again->plan);
    EXPECT_NEAR(again->plan->query.limits.clearance_m, mission.clearance(0), 0.05) << pauses;
  }
}

TEST(Goal, RefusalLeavesTheMissionUntouched) {
  ScriptedMission mission;
  mission.setOut(5.0);
  EXPECT_FALSE(mission.goTo({99.0, 0.0}).has_value());
  EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
  EXPECT_EQ(mission.supervisor->goal().position, Eigen::Vector2d(40.0, 0.0));
}

TEST(Goal, NewOneUnderWayIsPlannedInMotion) {
  ScriptedMission mission;
  mission.setOut(6.0);
  const auto orders = mission.goTo({0.0, 30.0});
  ASSERT_TRUE(orders.has_value() && orders->plan);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kReplanning);
  EXPECT_TRUE(beginsUnderWay(*orders->plan));
  EXPECT_NEAR(orders->plan->query.start.flat.velocity.norm(), 4.0, 1e-6);
  EXPECT_NEAR(orders->plan->start_time_s, mission.now_s + mission.options.planning_latency_s, 1e-9);
}

TEST(Goal, PlansThatFailAreTriedNarrowerThenGivenUpWithTheReason) {
  ScriptedMission mission;
  auto orders = mission.goTo({40.0, 0.0});
  std::optional<PlanRequest> request = orders->plan;
  std::vector<double> tried;
  for (int k = 0; k < 100 && mission.supervisor->phase() != Phase::kFailed; ++k) {
    if (request) {
      tried.push_back(request->query.limits.clearance_m);
      (void)mission.refuse(*request, "no way at all");
    }
    request = mission.update(0.1).plan;
  }
  ASSERT_EQ(mission.supervisor->phase(), Phase::kFailed);
  EXPECT_NE(mission.supervisor->reason().find("no way at all"), std::string::npos);
  const std::size_t levels = mission.options.side_clearances_m.size();
  ASSERT_EQ(tried.size(), static_cast<std::size_t>(mission.options.rounds_from_rest) * levels);
  for (std::size_t k = 0; k < tried.size(); ++k) {
    EXPECT_DOUBLE_EQ(tried[k], mission.clearance(k % levels));
  }
}

TEST(Goal, RepliesToReplacedRequestsAreIgnored) {
  ScriptedMission mission;
  const auto first = mission.goTo({40.0, 0.0});
  const auto second = mission.goTo({30.0, 0.0});
  const Orders orders = mission.answer(*first->plan, test::eastward({0.0, 0.0}, 40.0, 4.0));
  EXPECT_FALSE(orders.sail);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kPlanning);
  EXPECT_TRUE(mission.answer(*second->plan, test::eastward({0.0, 0.0}, 30.0, 3.0)).sail);
}

TEST(Goal, PlannerThatStaysSilentCountsAsFailed) {
  ScriptedMission mission;
  const auto orders = mission.goTo({40.0, 0.0});
  EXPECT_FALSE(mission.update(4.0).plan);
  (void)mission.update(2.0);
  const Orders again = mission.update(0.1);
  ASSERT_TRUE(again.plan);
  EXPECT_LT(again.plan->query.limits.clearance_m, orders->plan->query.limits.clearance_m);
}

TEST(Options, ShippedFileLoads) {
  const std::string path = std::string(OTTER_NAV_SOURCE_DIR) + "/config/mission.yaml";
  const auto options = loadSupervisorOptions(path);
  ASSERT_TRUE(options.has_value()) << options.error().message;
  EXPECT_EQ(config::toYaml(*options), config::toYaml(SupervisorOptions{}));
  const auto root = config::loadFile(path);
  YAML::Node broken = YAML::Clone((*root)["supervisor"]);
  broken["side_clearances_m"] = std::vector<double>{0.3, 0.4, 0.7, 1.1};
  EXPECT_FALSE(readSupervisorOptions(config::Section(broken, "broken")).has_value());
  broken = YAML::Clone((*root)["supervisor"]);
  broken["encounter"]["outline_least_m"] = 11.0;
  const auto contradicting = readSupervisorOptions(config::Section(broken, "broken"));
  ASSERT_FALSE(contradicting.has_value());
  EXPECT_EQ(contradicting.error().message,
            "broken/encounter: parameter 'outline_least_m' is above 'outline_wanted_m'");
}

// With `beside_m` of water on either side of the hull, 80 m before the goal; the waves are not
// known.
struct BeforeAPassage {
  explicit BeforeAPassage(double beside_m, bool is_seen = true)
      : mission(test::openWater(), widths(beside_m)) {
    mission.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
    mission.knows_waves = false;
    if (!is_seen) {
      map::OccupancyGrid seen = mission.grid;
      test::block(seen, {-35.0, -10.0}, {40.0, 10.0});
      mission.known.emplace(test::fieldOf(seen));
    }
    asked = mission.goTo({40.0, 0.0})->plan;
  }
  static SupervisorOptions widths(double beside_m) {
    SupervisorOptions options;
    options.side_clearances_m = {beside_m, 0.5 * beside_m};
    return options;
  }
  bool sails() {
    return mission.answer(asked.value(), eastward({-40.0, 0.0}, 80.0, 4.0)).sail.has_value();
  }
  // For how long nothing more is asked.
  double waitsFor(double at_most_s) {
    const double began_s = mission.now_s;
    asked.reset();
    while (!asked && mission.now_s < began_s + at_most_s) {
      asked = mission.update(0.1).plan;
    }
    return mission.now_s - began_s;
  }
  ScriptedMission mission;
  std::optional<PlanRequest> asked;
};

// Its corners would swing in them; where the water is wide that is no matter.
TEST(Goal, LearnsTheWavesBeforeItGoesThroughNarrowWater) {
  EXPECT_TRUE(BeforeAPassage(0.5).sails());
  BeforeAPassage narrow(0.2);
  EXPECT_FALSE(narrow.sails());
  EXPECT_GE(narrow.waitsFor(10.0), 10.0);
  EXPECT_EQ(narrow.mission.supervisor->phase(), Phase::kPlanning);
  narrow.mission.knows_waves = true;
  EXPECT_LT(narrow.waitsFor(10.0), 0.2);
  EXPECT_TRUE(narrow.sails());
}

// What comes into sight there may be narrow.
TEST(Goal, LearnsTheWavesBeforeItGoesIntoUnknownWater) {
  BeforeAPassage unseen(0.5, false);
  EXPECT_FALSE(unseen.sails());
  EXPECT_GE(unseen.waitsFor(10.0), 10.0);
  unseen.mission.knows_waves = true;
  EXPECT_LT(unseen.waitsFor(10.0), 0.2);
  EXPECT_TRUE(unseen.asked.has_value());
}

// The tracker keeps the place about which waves swing the hull abeam: from the end of a swing on it
// would be off by all of it. Along the heading there are thrusters, and it lies where it is.
TEST(Goal, PlansFromTheMiddleOfASwing) {
  struct Case {
    double psi_rad;
    Eigen::Vector2d still_m;  // place that the tracker keeps, from where the hull is
    double old_s;
    Eigen::Vector2d begins_m;  // likewise
  };
  const Case cases[] = {{0.0, {0.0, 0.1}, 0.0, {0.0, 0.1}},
                        {0.0, {0.05, -0.08}, 0.2, {0.0, -0.08}},
                        {0.5 * kPi, {0.1, 0.05}, 0.0, {0.1, 0.0}},
                        {0.0, {0.0, 0.1}, 1.0, {0.0, 0.0}},    // of a moment ago
                        {0.0, {0.0, -2.0}, 0.0, {0.0, -0.3}},  // no swing is that wide
                        {0.0, {0.0, 0.0}, 0.0, {0.0, 0.0}}};
  for (const Case& c : cases) {
    ScriptedMission mission;
    mission.rest << -40.0, 0.0, c.psi_rad, 0.0, 0.0, 0.0;
    Situation swinging = mission.situation();
    vessel::State still = mission.rest;
    still.head<2>() += c.still_m;
    swinging.foreseen = test::foreseenFrom(mission.now_s - c.old_s, still, {0.0, 0.0});
    const auto orders = mission.supervisor->setGoal(mission.now_s, {{40.0, 0.0}, 0.0}, swinging,
                                                    mission.obstacles());
    ASSERT_TRUE(orders.has_value() && orders->plan.has_value());
    const Eigen::Vector2d begins = orders->plan->query.start.flat.position;
    EXPECT_LT((begins - mission.rest.head<2>() - c.begins_m).norm(), 1e-9)
        << c.still_m.transpose() << ", " << c.old_s << " s old, heading " << c.psi_rad;
  }
}

TEST(Goal, WaitsForNoTrackerThatNeverKnowsTheWaves) {
  BeforeAPassage narrow(0.2);
  EXPECT_FALSE(narrow.sails());
  EXPECT_NEAR(narrow.waitsFor(60.0), 20.0, 0.5);
  EXPECT_TRUE(narrow.sails());
}

}  // namespace
}  // namespace otter_nav::mission
