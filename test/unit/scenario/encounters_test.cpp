#include "archipelago/encounters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::scenario {
namespace {

constexpr double kMeetS = 100.0;

// Degrees from our course north, to starboard positive, at the start.
double bearingDeg(const Encounter& encounter, std::size_t k) {
  const Eigen::Vector2d away =
      encounter.vessels[k].waypoints.front() - encounter.mission.start.position;
  return std::atan2(away.x(), away.y()) * 180.0 / kPi;
}

TEST(Encounters, EverybodyMeetsAtTheOrigin) {
  for (const auto& set : {imazuCases(), stubbornCaptains()}) {
    for (const Encounter& encounter : set) {
      const Mission& mission = encounter.mission;
      EXPECT_EQ(mission.kind, "encounter");
      ASSERT_TRUE(mission.speed_mps.has_value());
      EXPECT_NEAR(mission.start.position.norm(), kMeetS * *mission.speed_mps, 1e-9);
      std::set<int> ids;
      for (const vessel::ScriptedVessel& vessel : encounter.vessels) {
        ids.insert(vessel.id);
        const bool turns = vessel.waypoints.size() > 2;
        const double before_s = turns ? 50.0 : kMeetS;
        const vessel::ScriptedMotion then = vessel::motionAt(vessel, before_s);
        const Eigen::Vector2d ahead(std::cos(then.pose.psi_rad), std::sin(then.pose.psi_rad));
        const Eigen::Vector2d there =
            then.pose.position + (kMeetS - before_s) * then.speed_mps * ahead;
        EXPECT_NEAR(there.norm(), 0.0, 1e-6);
        // She is still under way long after.
        EXPECT_GT(vessel::motionAt(vessel, 250.0).speed_mps, 0.0);
      }
      EXPECT_EQ(ids.size(), encounter.vessels.size());
    }
  }
}

// Sawada, Sato and Majima's figure: head-on, from starboard, overtaken, from port; then two, then
// three others.
TEST(Encounters, ImazusCasesAreAsDrawn) {
  const std::vector<Encounter> cases = imazuCases();
  ASSERT_EQ(cases.size(), 22U);
  EXPECT_NEAR(bearingDeg(cases[0], 0), 0.0, 1e-6);
  EXPECT_NEAR(bearingDeg(cases[1], 0), 45.0, 1e-6);
  EXPECT_EQ(cases[2].vessels[0].speeds_mps, std::vector<double>{1.4});
  EXPECT_NEAR(bearingDeg(cases[3], 0), -67.5, 1e-6);
  for (std::size_t k = 0; k < cases.size(); ++k) {
    EXPECT_EQ(cases[k].vessels.size(), k < 4 ? 1U : (k < 11 ? 2U : 3U)) << "case " << k + 1;
  }
  // From port come those of cases 10, 11, 13, 16, 17, 19 and 21, one or two of them.
  std::vector<int> from_port;
  for (const Encounter& encounter : cases) {
    int count = 0;
    for (std::size_t k = 0; k < encounter.vessels.size(); ++k) {
      count += bearingDeg(encounter, k) < -1.0 ? 1 : 0;
    }
    from_port.push_back(count);
  }
  EXPECT_EQ(from_port,
            (std::vector<int>{0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0, 1, 0, 1, 0}));
}

TEST(Encounters, CaptainsComeFromPortOrOvertakeOrTurn) {
  const std::vector<Encounter> cases = stubbornCaptains();
  ASSERT_EQ(cases.size(), 8U);
  for (const std::size_t from_port : {0U, 1U, 2U, 3U, 7U}) {
    EXPECT_LT(bearingDeg(cases[from_port], 0), -20.0);
  }
  for (const std::size_t overtakes : {4U, 5U}) {
    EXPECT_GT(std::abs(bearingDeg(cases[overtakes], 0)), 112.5);
  }
  for (const std::size_t turns : {6U, 7U}) {
    EXPECT_EQ(cases[turns].vessels[0].waypoints.size(), 3U);
  }
}

TEST(Encounters, SquaresGoRoundInsideTheWaterAndLeaveRoomToStart) {
  const std::vector<Encounter> fields = movingFields(7, 4);
  ASSERT_EQ(fields.size(), 12U);
  const map::GridGeometry water = openWater(80.0).geometry;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const Encounter& field = fields[k];
    const std::size_t difficulty = k / 4;
    EXPECT_EQ(field.kind, std::vector<std::string>({"easy", "medium", "hard"})[difficulty]);
    ASSERT_EQ(field.vessels.size(), std::vector<std::size_t>({5, 12, 24})[difficulty]);
    const Eigen::Vector2d across = field.mission.goal.position - field.mission.start.position;
    EXPECT_GE(across.cwiseAbs().maxCoeff(), 68.0 - 1e-9);
    for (const vessel::ScriptedVessel& square : field.vessels) {
      for (double t = 0.0; t < 300.0; t += 1.0) {
        const vessel::ScriptedMotion motion = vessel::motionAt(square, t);
        EXPECT_GE(motion.speed_mps, 1.0);
        EXPECT_LE(motion.speed_mps, 2.0 + static_cast<double>(difficulty));
        EXPECT_TRUE(water.contains(motion.pose.position));
        if (t <= 5.0) {
          EXPECT_GT((motion.pose.position - field.mission.start.position).norm(), 8.0);
        }
      }
    }
  }
}

TEST(Encounters, AFieldIsTheSameHoweverManyAreAskedForAndAnotherWithAnotherSeed) {
  const auto way = [](const Encounter& field) { return field.vessels.front().waypoints; };
  const std::vector<Encounter> few = movingFields(7, 1);
  const std::vector<Encounter> more = movingFields(7, 2);
  ASSERT_EQ(few.size(), 3U);
  ASSERT_EQ(more.size(), 6U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(way(few[k]), way(more[2 * k]));
    EXPECT_NE(way(more[2 * k]), way(more[2 * k + 1]));
  }
  EXPECT_NE(way(few[0]), way(movingFields(8, 1)[0]));
}

TEST(Encounters, TheWaterIsOpenAndHoldsTheWay) {
  const map::OccupancyGrid water = openWater(520.0);
  EXPECT_TRUE(std::all_of(water.cells.begin(), water.cells.end(),
                          [](map::Cell cell) { return cell == map::Cell::kFree; }));
  for (const Encounter& encounter : imazuCases()) {
    EXPECT_TRUE(water.geometry.contains(encounter.mission.start.position));
    EXPECT_TRUE(water.geometry.contains(encounter.mission.goal.position));
  }
}

}  // namespace
}  // namespace otter_nav::scenario
