#include "encounter/prospect.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::encounter {
namespace {

Eigen::Vector2d north(double speed, double to_starboard_deg = 0.0) {
  return speed * Eigen::Vector2d(std::sin(to_starboard_deg * kDegree),
                                 std::cos(to_starboard_deg * kDegree));
}

// From (0, -200) on legs of given course and duration; each change takes its time.
Course sail(const std::vector<std::pair<Eigen::Vector2d, double>>& legs) {
  Course course;
  Eigen::Vector2d p(0.0, -200.0);
  for (const auto& [velocity, duration] : legs) {
    course.legs.push_back({course.end_s, p, velocity, course.legs.empty() ? 0.0 : 9.0});
    p += duration * velocity;
    course.end_s += duration;
  }
  return course;
}

Other meeting(double heading_deg, double speed) {
  Other other;
  other.motion.velocity = north(speed, heading_deg);
  other.motion.position = -100.0 * other.motion.velocity;
  other.heading_rad = other.motion.course();
  other.length_m = 6.0;
  other.beam_m = 2.0;
  other.known_s = 300.0;
  return other;
}

vessel::Hull hull() {
  vessel::Hull hull;
  hull.length_m = 2.0;
  hull.beam_m = 1.08;
  return hull;
}

Outlook look(const Course& course, const Other& other) {
  return Prospect(Options(), hull()).look(course, other);
}

TEST(Prospect, OutlinesAreExact) {
  // Abeam of each other at rest relative to each other: 20 m between the centres.
  Other other = meeting(0.0, 2.0);
  other.motion.position = {20.0, -200.0};
  EXPECT_NEAR(look(sail({{north(2.0), 50.0}}), other).outlines_m, 20.0 - 1.0 - 0.54, 1e-9);
  // Bow to bow, and she crosses 12 m ahead of where we turn away.
  other = meeting(180.0, 2.0);
  other.motion.position = {0.0, -100.0};
  EXPECT_NEAR(look(sail({{north(2.0), 10.0}}), other).outlines_m, 60.0 - 1.0 - 3.0, 1e-9);
  other = meeting(90.0, 2.0);
  other.motion.position = {-40.0, -150.0};
  const Course short_of = sail({{north(2.0), 19.0}, {north(-2.0), 20.0}});
  EXPECT_NEAR(look(short_of, other).outlines_m, 12.0 - 1.0 - 1.0, 1e-9);
  EXPECT_DOUBLE_EQ(look(sail({{north(2.0), 200.0}}), meeting(180.0, 2.0)).outlines_m, 0.0);
}

TEST(Prospect, WhoGoesRoundIsWhereHerTurnLeads) {
  Other other = meeting(270.0, 2.0);
  other.motion.position = {20.0, -180.0};
  other.known_s = 12.0;
  const Course on = sail({{north(2.0), 50.0}});
  EXPECT_DOUBLE_EQ(look(on, other).outlines_m, 0.0);
  // She turns away before she has come to our course: nearest as she draws off again, when we have
  // come up to 13.23 m to each side between the outlines.
  other.round = {{0.0, {20.0, -180.0}, {-2.0, 0.0}},
                 {2.0, {16.0, -180.0}, {0.0, 2.0}},
                 {4.0, {16.0, -176.0}, {2.0, 0.0}}};
  const Outlook away = look(on, other);
  EXPECT_NEAR(away.outlines_m, 13.23 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(away.nearest_s, 2.0, 1e-6);
}

TEST(Prospect, HeadOnAsksForABoldTurnToStarboardInTime) {
  const Other other = meeting(180.0, 2.0);
  const auto broken = [&](const std::vector<std::pair<Eigen::Vector2d, double>>& legs) {
    return look(sail(legs), other).broken;
  };
  EXPECT_EQ(broken({{north(2.0), 10.0}, {north(2.0, 40.0), 15.0}, {north(2.0), 120.0}}), 0U);
  EXPECT_NE(broken({{north(2.0), 200.0}}) & kLate, 0U);
  EXPECT_NE(broken({{north(2.0), 85.0}, {north(2.0, 40.0), 15.0}, {north(2.0), 90.0}}) & kLate, 0U);
  EXPECT_EQ(broken({{north(2.0), 10.0}, {north(2.0, 15.0), 40.0}, {north(2.0), 120.0}}),
            unsigned{kNotApparent});
  const unsigned to_port =
      broken({{north(2.0), 10.0}, {north(2.0, -40.0), 15.0}, {north(2.0), 120.0}});
  EXPECT_EQ(to_port, unsigned{kWrongTurn} | unsigned{kWrongSide});
}

TEST(Prospect, CrossingAheadIsHerLane) {
  const Other other = meeting(270.0, 2.0);
  const auto broken = [&](const std::vector<std::pair<Eigen::Vector2d, double>>& legs) {
    return look(sail(legs), other).broken;
  };
  // To port and round ahead of her bow; to starboard under her stern; slowing down.
  EXPECT_NE(broken({{north(2.0), 5.0}, {north(2.0, -40.0), 15.0}, {north(2.0), 160.0}}) &
                (kIntoHerLane | kWrongTurn),
            0U);
  EXPECT_EQ(broken({{north(2.0), 5.0}, {north(2.0, 45.0), 30.0}, {north(2.0), 160.0}}), 0U);
  EXPECT_EQ(broken({{north(2.0), 5.0}, {north(0.8), 25.0}, {north(2.0), 190.0}}), 0U);
}

// Before somebody who is being overtaken, in a minute or in three: until then there is time to
// decide, and her course by now tells little of where her lane will be. Crossing there is not.
TEST(Prospect, TheLaneOfWhomWeOvertakeCountsLessTheLaterItIsEntered) {
  Options without;
  without.rules_of_the_road = false;
  Other other = meeting(0.0, 1.0);
  other.motion.position = {-30.0, -230.0};
  other.record.kept_velocity = north(2.0);
  other.record.acted = true;
  other.record.first_turn = 1;
  other.record.turn_max_rad = 1.0;
  constexpr double kTurnsForS = 13.5;  // until her lane is reached
  for (const double at_s : {60.0, 120.0, 180.0}) {
    const Course before_her =
        sail({{north(1.0), at_s - kTurnsForS}, {north(2.0, -90.0), 15.0}, {north(2.0), 20.0}});
    const auto rules = [&] {
      return Prospect(Options(), hull()).price(before_her, {other}, 1e9) -
             Prospect(without, hull()).price(before_her, {other}, 1e9);
    };
    other.record.role = Role::kOvertaking;
    EXPECT_EQ(look(before_her, other).broken, unsigned{kIntoHerLane}) << at_s;
    EXPECT_NEAR(look(before_her, other).lane_s, at_s, 1e-6);
    EXPECT_NEAR(rules(), at_s < 90.0 ? 60.0 : at_s < 150.0 ? 30.0 : 0.0, 1e-6) << at_s;
    other.record.role = Role::kGiveWay;
    EXPECT_EQ(look(before_her, other).broken, unsigned{kIntoHerLane}) << at_s;
    EXPECT_NEAR(rules(), 60.0, 1e-6) << at_s;
  }
}

TEST(Prospect, WhoStandsOnWaits) {
  const Other other = meeting(67.5, 2.0);  // from port
  ASSERT_EQ(look(sail({{north(2.0), 200.0}}), other).role, Role::kStandOn);
  EXPECT_EQ(look(sail({{north(2.0), 200.0}}), other).broken, 0U);
  const auto broken = [&](double at_s, double turn_deg) {
    return look(sail({{north(2.0), at_s}, {north(2.0, turn_deg), 20.0}, {north(2.0), 100.0}}),
                other)
        .broken;
  };
  EXPECT_EQ(broken(50.0, 50.0), unsigned{kActedEarly});
  EXPECT_EQ(broken(80.0, 50.0), 0U);
  EXPECT_EQ(broken(80.0, -50.0), unsigned{kToPort});
}

// The farther it turns the longer that takes, and the sooner before the corner it shows.
TEST(Prospect, WhoStandsOnWaitsForALargeTurnLonger) {
  const Other other = meeting(67.5, 2.0);
  const auto broken = [&](double at_s, double turn_deg, double change_s) {
    Course course = sail({{north(2.0), at_s}, {north(2.0, turn_deg), 20.0}, {north(2.0), 100.0}});
    course.legs[1].change_s = change_s;
    return look(course, other).broken;
  };
  EXPECT_EQ(broken(75.0, 40.0, 9.0), 0U);
  EXPECT_EQ(broken(75.0, 130.0, 30.0), unsigned{kActedEarly});
  EXPECT_EQ(broken(82.0, 130.0, 30.0), 0U);
}

// She is nearest where it turns, and draws apart from then on.
TEST(Prospect, TurningBackIsAnActionToo) {
  const Other other = meeting(67.5, 2.0);
  const auto turnsBack = [&](double at_s) {
    return look(sail({{north(2.0), at_s}, {north(1.6, 150.0), 90.0}}), other);
  };
  for (const double at_s : {50.0, 60.0, 70.0}) {
    const Outlook early = turnsBack(at_s);
    ASSERT_NEAR(early.nearest_s, at_s, 1e-6);
    EXPECT_EQ(early.acted_s, at_s);
    EXPECT_EQ(early.broken, unsigned{kActedEarly}) << at_s;
  }
  EXPECT_EQ(turnsBack(80.0).broken, 0U);
}

// Who comes up slowly is near long before she is past: near when the turn begins, not at its
// middle.
TEST(Prospect, WhoIsOvertakenTurnsOnceSheIsNear) {
  const Other other = meeting(0.0, 2.8);
  ASSERT_EQ(look(sail({{north(2.0), 200.0}}), other).role, Role::kOvertaken);
  const auto broken = [&](double at_s) {
    return look(sail({{north(2.0), at_s}, {north(2.0, 40.0), 20.0}, {north(2.0), 60.0}}), other)
        .broken;
  };
  EXPECT_EQ(broken(63.0), unsigned{kActedEarly});
  EXPECT_EQ(broken(67.5), 0U);
}

// Slower, waves swing the course by what counts as a turn: after one to starboard that is no
// matter.
TEST(Prospect, SlowingDownInWavesMayShowATurnToPort) {
  Prospect prospect(Options(), hull());
  const Course slows = sail({{north(2.0), 80.0}, {north(1.4), 15.0}, {north(2.0), 100.0}});
  const Course turns =
      sail({{north(2.0), 78.0}, {north(2.0, 30.0), 4.0}, {north(1.4), 15.0}, {north(2.0), 100.0}});
  const Other from_port = meeting(67.5, 2.0);
  const Other from_starboard = meeting(270.0, 2.0);
  const Course early = sail({{north(2.0), 5.0}, {north(1.4), 60.0}, {north(2.0), 190.0}});
  for (const double swing_mps : {0.1, 0.15}) {
    const bool swings = swing_mps > 0.12;
    prospect.feel(swing_mps);
    EXPECT_EQ(prospect.look(slows, from_port).broken, swings ? unsigned{kToPort} : 0U);
    EXPECT_EQ(prospect.look(turns, from_port).broken, 0U);
    EXPECT_EQ(prospect.look(early, from_starboard).broken & kWrongTurn,
              swings ? unsigned{kWrongTurn} : 0U);
  }
}

TEST(Prospect, GettingUnderWayIsNoAction) {
  Other other = meeting(67.5, 2.0);
  other.record.role = Role::kStandOn;
  other.record.kept_velocity = north(2.0);
  EXPECT_EQ(look(sail({{north(0.5), 2.0}, {north(1.2), 2.0}, {north(2.0), 190.0}}), other).broken,
            0U);
  EXPECT_EQ(
      look(sail({{north(0.5), 2.0}, {north(2.0), 5.0}, {north(1.2), 20.0}, {north(2.0), 170.0}}),
           other)
          .broken,
      unsigned{kActedEarly});
}

// Rule 2: giving way to one comes before standing on for another.
TEST(Prospect, GivingWayExcusesFromStandingOn) {
  const Prospect prospect(Options(), hull());
  const Course early = sail({{north(2.0), 5.0}, {north(0.8), 30.0}, {north(2.0), 190.0}});
  const double alone = prospect.price(early, {meeting(67.5, 2.0)}, 1e9);
  const double both = prospect.price(early, {meeting(67.5, 2.0), meeting(270.0, 2.0)}, 1e9);
  EXPECT_GT(alone, 50.0);
  EXPECT_LT(both, alone - 50.0);
  // If there is a risk with her,
  Other doubtful = meeting(270.0, 2.0);
  doubtful.record.doubtful = true;
  EXPECT_GT(prospect.price(early, {meeting(67.5, 2.0), doubtful}, 1e9), alone - 1.0);
  // and not as soon as it arises.
  Other later = meeting(270.0, 2.0);
  later.motion.position = Eigen::Vector2d(0.0, 40.0) - 120.0 * later.motion.velocity;
  EXPECT_GT(prospect.price(early, {meeting(67.5, 2.0), later}, 1e9), alone - 1.0);
}

TEST(Prospect, WithoutRulesDistancesCountAlone) {
  Options options;
  options.rules_of_the_road = false;
  const Course to_port = sail({{north(2.0), 5.0}, {north(2.0, -40.0), 20.0}, {north(2.0), 150.0}});
  EXPECT_GT(Prospect(Options(), hull()).price(to_port, {meeting(180.0, 2.0)}, 1e9), 50.0);
  EXPECT_EQ(Prospect(options, hull()).price(to_port, {meeting(180.0, 2.0)}, 1e9), 0.0);
}

}  // namespace
}  // namespace otter_nav::encounter
