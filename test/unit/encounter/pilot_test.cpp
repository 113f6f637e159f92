#include "otter_nav/encounter/pilot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "encounter/candidates.hpp"
#include "encounter/lookout.hpp"
#include "encounter/manoeuvre.hpp"
#include "open_water.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/feasibility/verifier.hpp"

namespace otter_nav::encounter {
namespace {

// We go north at 2 m/s from (0, -200) along a straight trajectory; the other is at the origin with
// us after 100 s.
class PilotTest : public ::testing::Test {
 protected:
  PilotTest() {
    vessel::FlatPoint start;
    start.position = {0.0, -200.0};
    start.velocity = {0.0, 2.0};
    sailed_ = {steer(start, {}, 200.0), 0.0};
    limits_ = feasibility::SafetyLimits::of(vessel_);
    limits_.speed_max_mps = 2.0;
    pilot_.newGoal(-60.0);
  }

  traffic::Track trackAt(double heading_deg, double speed, double now) const {
    traffic::Track track;
    track.id = 7;
    track.stamp_s = now;
    track.velocity =
        speed * Eigen::Vector2d(std::sin(heading_deg * kDegree), std::cos(heading_deg * kDegree));
    track.position = (now - 100.0) * track.velocity;
    track.heading_rad = std::atan2(track.velocity.y(), track.velocity.x());
    track.length_m = 6.0;
    track.beam_m = 2.0;
    return track;
  }

  std::optional<Manoeuvre> decideAt(double now, double heading_deg, double speed) {
    for (double t = now - 3.0; t <= now; t += 0.5) {
      const vessel::FlatPoint z = sailed_.trajectory.flat(t);
      pilot_.observe(t, {z.position, z.velocity}, z.position, {trackAt(heading_deg, speed, t)},
                     goal_, 1.98);
    }
    return pilot_.decide({now, sailed_, goal_, now + 0.3, limits_, water_});
  }

  vessel::Parameters vessel_ = *vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) +
                                                       "/config/vessels/otter_gazebo.yaml");
  map::DistanceField water_ = test::openWater();
  feasibility::SafetyLimits limits_;
  trajectory::TimedTrajectory sailed_;
  Eigen::Vector2d goal_{0.0, 200.0};
  Pilot pilot_{Options(), vessel_};
};

TEST_F(PilotTest, GivesWayToStarboardHeadOn) {
  const std::optional<Manoeuvre> way = decideAt(10.0, 180.0, 2.0);
  ASSERT_TRUE(way);
  const auto encounters = pilot_.encounters();
  ASSERT_EQ(encounters.size(), 1U);
  EXPECT_EQ(encounters[0].role, Role::kHeadOn);
  EXPECT_NE(describe(encounters[0]).find("rule 14"), std::string::npos);
  double turn = 0.0;
  for (double t = 0.0; t < way->path.trajectory.duration(); t += 0.5) {
    const Eigen::Vector2d v = way->path.trajectory.flat(t).velocity;
    turn = std::max(turn, std::atan2(v.x(), v.y()));
    EXPECT_GT(v.x(), -1e-3);  // to starboard first, and not to port before it is over
    if (turn > 0.52) {
      break;
    }
  }
  EXPECT_GT(turn, 30.0 * kDegree);
}

TEST_F(PilotTest, TheWayContinuesWhatIsSailedAndIsVerified) {
  const std::optional<Manoeuvre> way = decideAt(10.0, 270.0, 2.0);
  ASSERT_TRUE(way);
  const vessel::FlatPoint was = sailed_.trajectory.flat(way->path.start_time_s);
  const vessel::FlatPoint is = way->path.trajectory.flat(0.0);
  EXPECT_NEAR((is.position - was.position).norm(), 0.0, 1e-9);
  EXPECT_NEAR((is.velocity - was.velocity).norm(), 0.0, 1e-9);
  limits_.speed_max_mps = 2.01;
  const auto verification = feasibility::verify(way->path.trajectory, water_, vessel_, limits_);
  EXPECT_TRUE(verification.ok) << verification.reason;
}

// What it leads to was planned slower and with less thrust, for the weather, than what is sailed
// until then: making way goes on from what is sailed.
TEST_F(PilotTest, MakesWayFromAWayThatIsFasterThanItsLimits) {
  limits_.speed_max_mps = 1.9;
  EXPECT_FALSE(feasibility::verify(sailed_.trajectory, water_, vessel_, limits_).ok);
  EXPECT_TRUE(decideAt(10.0, 270.0, 2.0));
}

TEST_F(PilotTest, MakesWayFromAWayThatAsksForMoreThrustThanItsLimits) {
  vessel::FlatPoint start;
  start.position = {0.0, -200.0};
  start.velocity = {0.0, 2.0};
  start.acceleration = {0.0, 1.0};
  sailed_ = {steer(start, {}, 200.0), 10.3};
  limits_.speed_max_mps = 3.0;
  limits_.thrust_share = 0.7;
  EXPECT_FALSE(feasibility::verify(sailed_.trajectory, water_, vessel_, limits_).ok);
  EXPECT_TRUE(decideAt(10.0, 270.0, 2.0));
}

TEST_F(PilotTest, StandsOnUntilSheHasNotActed) {
  EXPECT_FALSE(decideAt(10.0, 67.5, 2.0));
  ASSERT_EQ(pilot_.encounters().size(), 1U);
  EXPECT_EQ(pilot_.encounters()[0].role, Role::kStandOn);
  EXPECT_FALSE(decideAt(60.0, 67.5, 2.0));
  std::optional<Manoeuvre> way;
  double now = 66.0;
  for (; now < 90.0 && !way; now += 1.0) {
    way = decideAt(now, 67.5, 2.0);
  }
  ASSERT_TRUE(way);
  EXPECT_GE(now, 69.0);  // 30 s left
  EXPECT_LE(now, 80.0);
}

// At first it seems that she is near sooner; what was put off until then is put off again.
TEST_F(PilotTest, StandsOnWhenSheIsNearLaterThanItSeemed) {
  for (const double sooner_s : {6.0, 7.0}) {
    pilot_ = Pilot(Options(), vessel_);
    pilot_.newGoal(-60.0);
    std::optional<Manoeuvre> way;
    double now = 8.0;
    for (; now < 90.0 && !way; now += 1.0) {
      for (double t = now - 0.5; t <= now; t += 0.5) {
        const vessel::FlatPoint z = sailed_.trajectory.flat(t);
        traffic::Track track = trackAt(67.5, 2.0, t);
        // On the same bearing, nearer by as much.
        constexpr double kSeemsS = 25.0;
        constexpr double kUntilS = 65.0;
        const double share = std::clamp((kUntilS - t) / (kUntilS - kSeemsS), 0.0, 1.0);
        const Eigen::Vector2d closing = track.velocity - z.velocity;
        track.position += share * sooner_s * closing;
        if (share > 0.0 && share < 1.0) {
          track.velocity -= sooner_s / (kUntilS - kSeemsS) * closing;
        }
        pilot_.observe(t, {z.position, z.velocity}, z.position, {track}, {0.0, 200.0}, 1.98);
      }
      way = pilot_.decide({now, sailed_, {0.0, 200.0}, now + 0.3, limits_, water_});
    }
    ASSERT_TRUE(way);
    EXPECT_EQ(pilot_.encounters()[0].role, Role::kStandOn);
    EXPECT_GE(now, 69.0) << sooner_s;
    EXPECT_LE(now, 82.0) << sooner_s;
  }
}

// From astern, so slowly that she is near before there are 30 s left: waiting for that is among
// what there is to choose from.
TEST_F(PilotTest, StandsOnUntilWhoOvertakesIsNear) {
  for (const double closing_mps : {0.5, 0.8, 1.0}) {
    pilot_ = Pilot(Options(), vessel_);
    pilot_.newGoal(-60.0);
    std::optional<Manoeuvre> way;
    double range_m = 0.0;
    for (double now = 8.0; now < 80.0 && !way; now += 1.0) {
      for (double t = now - 0.5; t <= now; t += 0.5) {
        const vessel::FlatPoint z = sailed_.trajectory.flat(t);
        traffic::Track track = trackAt(0.0, 2.0 + closing_mps, t);
        track.covariance.diagonal() << 0.1, 0.1, 0.04, 0.04;
        pilot_.observe(t, {z.position, z.velocity}, z.position, {track}, {0.0, 200.0}, 1.98);
      }
      range_m = closing_mps * (100.0 - now);
      way = pilot_.decide({now, sailed_, {0.0, 200.0}, now + 0.3, limits_, water_});
    }
    ASSERT_TRUE(way);
    EXPECT_EQ(pilot_.encounters()[0].role, Role::kOvertaken);
    EXPECT_LT(range_m, 31.0) << closing_mps;
    EXPECT_GT(range_m, 20.0) << closing_mps;
  }
}

// Until it acts it goes on watching her: what isn't known yet of how near she will come is no
// reason to act before that.
TEST_F(PilotTest, StandsOnThoughItIsNotSureHowNearWhoOvertakesWillCome) {
  const vessel::Parameters otter =
      *vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/otter.yaml");
  for (const double heading_deg : {0.0, 5.0}) {
    pilot_ = Pilot(Options(), otter);
    pilot_.newGoal(-60.0);
    std::optional<Manoeuvre> way;
    double now = 8.0;
    for (; now < 80.0 && !way; now += 1.0) {
      for (double t = now - 0.5; t <= now; t += 0.5) {
        const vessel::FlatPoint z = sailed_.trajectory.flat(t);
        traffic::Track track = trackAt(heading_deg, 3.0, t);
        track.covariance.diagonal() << 0.3, 0.3, 0.04, 0.04;
        pilot_.observe(t, {z.position, z.velocity}, z.position, {track}, goal_, 1.98);
      }
      way = pilot_.decide({now, sailed_, goal_, now + 0.3, limits_, water_});
    }
    EXPECT_GT(now, 66.0) << heading_deg;  // a turn shows seconds after it was begun
  }
}

// She reports but every half minute; meanwhile we have turned for somebody else. What counts is
// the course from which we turned.
TEST_F(PilotTest, WhoIsHeardOfLateWasThereBefore) {
  const Eigen::Vector2d goal(0.0, 200.0);
  const Eigen::Vector2d aside = 2.0 * Eigen::Vector2d(std::sin(0.7), std::cos(0.7));
  Eigen::Vector2d position(0.0, -200.0);
  for (double t = 0.0; t <= 18.0; t += 0.5) {
    const Eigen::Vector2d velocity = t < 10.0 ? Eigen::Vector2d(0.0, 2.0) : aside;
    std::vector<traffic::Track> tracks;
    if (t > 17.0) {
      tracks.push_back(trackAt(270.0, 2.0, t));
    }
    pilot_.observe(t, {position, velocity}, position, tracks, goal, 1.98);
    position += 0.5 * velocity;
  }
  const auto encounters = pilot_.encounters();
  ASSERT_EQ(encounters.size(), 1U);
  EXPECT_EQ(encounters[0].role, Role::kGiveWay);
  EXPECT_LT(encounters[0].since_s, 5.0);
  EXPECT_NEAR(encounters[0].bearing_rad, 45.0 * kDegree, 3.0 * kDegree);
  EXPECT_TRUE(encounters[0].acted);
}

// Under another number she is who she was: since when we give way to her, and what we did, stays.
TEST_F(PilotTest, KnowsWhoComesBackAsAnotherTrack) {
  EXPECT_TRUE(decideAt(10.0, 270.0, 2.0));
  ASSERT_EQ(pilot_.encounters().size(), 1U);
  const double since = pilot_.encounters()[0].since_s;
  for (double t = 10.5; t <= 20.0; t += 0.5) {
    const vessel::FlatPoint z = sailed_.trajectory.flat(t);
    std::vector<traffic::Track> tracks;
    if (t > 18.0) {
      tracks.push_back(trackAt(270.0, 2.0, t));
      tracks.back().id = 8;
      tracks.back().position.x() += 3.0;
    }
    pilot_.observe(t, {z.position, z.velocity}, z.position, tracks, {0.0, 200.0}, 1.98);
    if (t > 16.0 && t <= 18.0) {
      EXPECT_TRUE(pilot_.encounters().empty());
    }
  }
  ASSERT_EQ(pilot_.encounters().size(), 1U);
  EXPECT_EQ(pilot_.encounters()[0].id, 8);
  EXPECT_EQ(pilot_.encounters()[0].since_s, since);
}

// Slowing down at the goal makes her faster than us, and brings a risk: no ground to turn away.
TEST_F(PilotTest, ArrivesAheadOfWhoFollows) {
  vessel::FlatPoint start;
  start.position = {0.0, -20.0};
  start.velocity = {0.0, 2.0};
  Change stop;
  stop.at_s = 8.0;
  stop.duration_s = 4.0;
  stop.velocity = {0.0, 0.02};
  sailed_ = {steer(start, {stop}, 12.0), 0.0};
  const Eigen::Vector2d goal = sailed_.trajectory.flat(12.0).position;
  for (const double now : {2.0, 4.0, 5.0, 6.0, 7.0, 8.0}) {
    for (double t = now - 1.0; t <= now; t += 0.5) {
      const vessel::FlatPoint z = sailed_.trajectory.flat(t);
      traffic::Track track = trackAt(0.0, 1.4, t);
      track.position = {0.0, -60.0 + 1.4 * t};
      pilot_.observe(t, {z.position, z.velocity}, z.position, {track}, goal, 1.98);
    }
    EXPECT_FALSE(pilot_.decide({now, sailed_, goal, now + 0.3, limits_, water_})) << now;
  }
}

// Waves that set the course aside for moments are no action of ours; a course kept up is.
TEST_F(PilotTest, ActsOnlyByWhatLasts) {
  constexpr double kAsideRad = 0.175;
  constexpr double kWaveS = 4.0;
  for (const bool waves : {true, false}) {
    pilot_ = Pilot(Options(), vessel_);
    pilot_.newGoal(-60.0);
    Eigen::Vector2d position(0.0, -180.0);
    for (double t = 10.0; t <= 40.0; t += 0.1) {
      const double shape = waves ? std::sin(2.0 * kPi * t / kWaveS) : 1.0;
      const double aside = t > 20.0 ? kAsideRad * shape : 0.0;
      const Eigen::Vector2d velocity = 2.0 * Eigen::Vector2d(std::sin(aside), std::cos(aside));
      pilot_.observe(t, {position, velocity}, position, {trackAt(67.5, 2.0, t)}, {0.0, 200.0},
                     1.98);
      position += 0.1 * velocity;
    }
    ASSERT_EQ(pilot_.encounters().size(), 1U);
    EXPECT_EQ(pilot_.encounters()[0].acted, !waves);
  }
}

// Long waves swing the hull for longer than an action lasts: what is steered tells what we do, and
// what was kept.
TEST_F(PilotTest, SwingingAboutWhatIsSteeredIsNoAction) {
  constexpr double kSwingMps = 0.3;
  constexpr double kWaveS = 9.0;
  for (const bool steers : {false, true}) {
    pilot_ = Pilot(Options(), vessel_);
    pilot_.newGoal(-60.0);
    Eigen::Vector2d position(0.0, -180.0);
    for (double t = 10.0; t <= 40.0; t += 0.1) {
      const Eigen::Vector2d straight(0.0, -200.0 + 2.0 * t);
      const Eigen::Vector2d velocity(kSwingMps * std::sin(2.0 * kPi * (t - 10.0) / kWaveS), 2.0);
      pilot_.observe(t, {position, velocity}, steers ? position : straight, {trackAt(67.5, 2.0, t)},
                     {0.0, 200.0}, 1.98);
      position += 0.1 * velocity;
    }
    ASSERT_EQ(pilot_.encounters().size(), 1U);
    EXPECT_EQ(pilot_.encounters()[0].acted, steers);
  }
}

// It swings onto its way as it gets under way, and somebody is heard of meanwhile: what it keeps to
// is the way that it is about to sail.
TEST_F(PilotTest, SwingingOntoItsWayIsNoAction) {
  constexpr double kAsideRad = 0.12;
  for (const bool swings : {true, false}) {
    pilot_ = Pilot(Options(), vessel_);
    pilot_.newGoal(0.0);
    Eigen::Vector2d position(0.0, -200.0);
    for (double t = 0.0; t <= 40.0; t += 0.1) {
      const double aside = (swings ? t > 6.0 && t < 11.0 : t > 25.0) ? kAsideRad : 0.0;
      const Eigen::Vector2d velocity = 2.0 * Eigen::Vector2d(std::sin(aside), std::cos(aside));
      std::vector<traffic::Track> tracks;
      if (t > 10.0) {
        tracks.push_back(trackAt(67.5, 2.0, t));
      }
      pilot_.observe(t, {position, velocity}, position, tracks, {0.0, 200.0}, 1.98);
      position += 0.1 * velocity;
    }
    ASSERT_EQ(pilot_.encounters().size(), 1U);
    EXPECT_EQ(pilot_.encounters()[0].acted, !swings);
  }
}

// A way just begun winds a little: who stands on keeps the course of the first ten seconds, not
// that of one moment.
TEST_F(PilotTest, ACourseKeptIsKnownTheBetterTheLongerItIsKept) {
  Eigen::Vector2d position(0.0, -180.0);
  for (double t = 10.0; t <= 45.0; t += 0.1) {
    const double to_port_deg = t < 12.5 ? 4.0 : t < 24.0 ? 0.0 : -1.5;
    const Eigen::Vector2d velocity = 2.0 * unitVector(0.5 * kPi + to_port_deg * kDegree);
    pilot_.observe(t, {position, velocity}, position, {trackAt(67.5, 2.0, t)}, {0.0, 200.0}, 1.98);
    position += 0.1 * velocity;
  }
  ASSERT_EQ(pilot_.encounters().size(), 1U);
  EXPECT_EQ(pilot_.encounters()[0].role, Role::kStandOn);
  EXPECT_FALSE(pilot_.encounters()[0].acted);
}

// In waves slowing down shows a turn to either side before one is meant.
TEST_F(PilotTest, InWavesWhoStandsOnTurnsToStarboardFirst) {
  constexpr double kSwingMps = 0.16;
  constexpr double kWaveS = 8.0;
  constexpr double kLastS = 85.0;
  for (const bool waves : {false, true}) {
    pilot_ = Pilot(Options(), vessel_);
    pilot_.newGoal(-60.0);
    std::optional<Manoeuvre> way;
    for (double t = 30.0; t <= kLastS && !way; t += 0.1) {
      const Eigen::Vector2d steered = sailed_.trajectory.flat(t).position;
      const double phase = 2.0 * kPi * t / kWaveS;
      const double swing = waves ? kSwingMps : 0.0;
      const Eigen::Vector2d off(swing * kWaveS / (2.0 * kPi) * std::sin(phase), 0.0);
      pilot_.observe(t, {steered + off, {swing * std::cos(phase), 2.0}}, steered,
                     {trackAt(67.5, 2.0, t)}, {0.0, 200.0}, 1.98);
      way = pilot_.decide({t, sailed_, {0.0, 200.0}, t + 0.3, limits_, water_});
    }
    ASSERT_TRUE(way);
    double first_turn = 0.0;
    for (double t = 0.0; t < 15.0 && first_turn < 0.1; t += 0.5) {
      const Eigen::Vector2d v = way->path.trajectory.flat(t).velocity;
      first_turn = std::atan2(v.x(), v.y());
    }
    EXPECT_EQ(first_turn > 0.1, waves) << first_turn;
  }
}

// For one from abaft of the beam a turn to port is fair, but not before there was a moment to hear
// who else is there.
TEST_F(PilotTest, TurnsToPortOnlyOnceItHasListened) {
  constexpr double kNow = 9.0;
  for (const double since : {1.0, 7.0}) {
    pilot_ = Pilot(Options(), vessel_);
    pilot_.newGoal(-60.0);
    for (double t = kNow - since; t <= kNow; t += 0.5) {
      const vessel::FlatPoint z = sailed_.trajectory.flat(t);
      pilot_.observe(t, {z.position, z.velocity}, z.position, {trackAt(340.0, 2.4, t)},
                     {0.0, 200.0}, 1.98);
    }
    const auto way = pilot_.decide({kNow, sailed_, {0.0, 200.0}, kNow + 0.3, limits_, water_});
    ASSERT_TRUE(way) << since;
    double to_port = 0.0;
    for (double t = 0.0; t < std::min(10.0, way->path.trajectory.duration()); t += 0.5) {
      const Eigen::Vector2d v = way->path.trajectory.flat(t).velocity;
      to_port = std::max(to_port, std::atan2(-v.x(), v.y()));
    }
    EXPECT_EQ(to_port > 0.3, since > 6.0) << to_port;
    EXPECT_TRUE(since > 6.0 || to_port < 0.02) << to_port;
  }
}

// A first report leaves it open whether a far one from port will pass clear: it may be hers to act.
TEST_F(PilotTest, ListensBeforeItActsForOneItMayHaveToStandOnFor) {
  constexpr double kNow = 9.0;
  constexpr double kMeetsS = 126.0;
  for (const double since : {1.0, 7.0}) {
    pilot_ = Pilot(Options(), vessel_);
    pilot_.newGoal(-60.0);
    for (double t = kNow - since; t <= kNow; t += 0.5) {
      traffic::Track track = trackAt(90.0, 2.0, t);
      track.position = {2.0 * (t - kNow - kMeetsS), -200.0 + 2.0 * (kNow + kMeetsS) + 13.0};
      const vessel::FlatPoint z = sailed_.trajectory.flat(t);
      pilot_.observe(t, {z.position, z.velocity}, z.position, {track}, {0.0, 200.0}, 1.98);
    }
    const auto way = pilot_.decide({kNow, sailed_, {0.0, 200.0}, kNow + 0.3, limits_, water_});
    EXPECT_EQ(way.has_value(), since > 6.0);
  }
}

// In the first half minute who is farther off than the radar sees may not have been heard of. She
// who is known is given way to at once where that would be late, and else with the others.
TEST_F(PilotTest, HearsOfAllBeforeItActsForWhoIsFarOff) {
  constexpr double kNow = 9.0;
  for (const double meets_s : {40.0, 100.0}) {
    for (const double goal_s : {0.0, -60.0}) {
      pilot_ = Pilot(Options(), vessel_);
      pilot_.newGoal(goal_s);
      for (double t = kNow - 3.0; t <= kNow; t += 0.5) {
        const vessel::FlatPoint z = sailed_.trajectory.flat(t);
        traffic::Track track = trackAt(180.0, 2.0, t);
        track.position += Eigen::Vector2d(0.0, 4.0 * (meets_s - 100.0));
        pilot_.observe(t, {z.position, z.velocity}, z.position, {track}, goal_, 1.98);
      }
      const auto way = pilot_.decide({kNow, sailed_, goal_, kNow + 0.3, limits_, water_});
      EXPECT_EQ(way.has_value(), meets_s < 50.0 || goal_s < 0.0) << meets_s << " " << goal_s;
    }
  }
}

// Nor is a turn to port right for who isn't heard of.
TEST_F(PilotTest, TurnsToPortOnlyOnceItHasHeardOfAll) {
  constexpr double kNow = 26.0;
  for (const double goal_s : {0.0, -60.0}) {
    pilot_ = Pilot(Options(), vessel_);
    pilot_.newGoal(goal_s);
    for (double t = kNow - 7.0; t <= kNow; t += 0.5) {
      const vessel::FlatPoint z = sailed_.trajectory.flat(t);
      pilot_.observe(t, {z.position, z.velocity}, z.position, {trackAt(340.0, 2.4, t)}, goal_,
                     1.98);
    }
    const auto way = pilot_.decide({kNow, sailed_, goal_, kNow + 0.3, limits_, water_});
    ASSERT_TRUE(way) << goal_s;
    double to_port = 0.0;
    for (double t = 0.0; t < std::min(10.0, way->path.trajectory.duration()); t += 0.5) {
      const Eigen::Vector2d v = way->path.trajectory.flat(t).velocity;
      to_port = std::max(to_port, std::atan2(-v.x(), v.y()));
    }
    EXPECT_EQ(to_port > 0.3, goal_s < 0.0) << to_port;
    EXPECT_TRUE(goal_s < 0.0 || to_port < 0.02) << to_port;
  }
}

// Nor a speed at which waves turn the course to port.
TEST_F(PilotTest, SlowsDownToWhereWavesTurnItOnlyWhereItMayTurnToPort) {
  Course sailed;
  sailed.legs.push_back({0.0, {0.0, -200.0}, {0.0, 2.0}, 0.0});
  sailed.end_s = sailed.arrives_s = 200.0;
  const std::vector<Eigen::Vector2d> path = {goal_};
  const Water water{water_, limits_.clearance_m, sailed, path, 2.0, 0.4};
  Other other;
  other.motion = {{200.0, 0.0}, {-2.0, 0.0}};
  other.heading_rad = kPi;
  other.length_m = 6.0;
  other.beam_m = 2.0;
  other.known_s = 300.0;
  Chooser chooser(Options(), vessel_);
  chooser.feel(0.15);
  constexpr double kSwingsBelow = 0.857;  // of 2 m/s
  for (const bool may_turn_to_port : {true, false}) {
    const std::vector<Choice> choices = chooser.choose(water, {other}, 40, true, may_turn_to_port);
    EXPECT_FALSE(choices.empty());
    EXPECT_EQ(std::any_of(choices.begin(), choices.end(),
                          [](const Choice& c) { return c.intent.share < kSwingsBelow; }),
              may_turn_to_port);
  }
}

// Distances alone are kept as soon as they are known.
TEST_F(PilotTest, ActsAtOnceWithoutTheRulesOfTheRoad) {
  constexpr double kNow = 9.0;
  Options options;
  for (const bool rules : {true, false}) {
    options.rules_of_the_road = rules;
    pilot_ = Pilot(options, vessel_);
    pilot_.newGoal(0.0);
    EXPECT_EQ(decideAt(kNow, 270.0, 2.0).has_value(), !rules);
  }
}

// Behind a slow one in a channel. Slower than anything new can begin she would be bound to that
// until it is over, whatever comes of it.
TEST_F(PilotTest, StaysFastEnoughToDecideAnew) {
  constexpr double kNow = 10.0;
  constexpr double kBeginsMps = 0.6;
  const map::DistanceField channel = test::channel();
  for (const double begins_mps : {0.0, kBeginsMps}) {
    pilot_ = Pilot(Options(), vessel_);
    pilot_.newGoal(-60.0);
    for (double t = kNow - 8.0; t <= kNow; t += 0.5) {
      const vessel::FlatPoint z = sailed_.trajectory.flat(t);
      traffic::Track slow = trackAt(0.0, 1.0, t);
      slow.position = {0.0, -140.0 + t};
      pilot_.observe(t, {z.position, z.velocity}, z.position, {slow}, {0.0, 200.0}, 1.98);
    }
    const auto way =
        pilot_.decide({kNow, sailed_, {0.0, 200.0}, kNow + 0.3, limits_, channel, begins_mps});
    ASSERT_TRUE(way) << begins_mps;
    ASSERT_TRUE(way->to_the_goal);
    double slowest = 2.0;
    for (double t = 0.0; t < way->path.trajectory.duration(); t += 0.5) {
      slowest = std::min(slowest, way->path.trajectory.flat(t).velocity.norm());
    }
    EXPECT_EQ(slowest < kBeginsMps, begins_mps == 0.0) << slowest;
  }
}

// North at 2 m/s for 20 s, to rest within 5 m, and a turn on the spot of `turns_s`.
trajectory::TimedTrajectory arrivingAfter(double turns_s) {
  vessel::FlatPoint from;
  from.position = {0.0, -200.0};
  from.velocity = {0.0, 2.0};
  vessel::FlatPoint braking = from;
  braking.position.y() += 40.0;
  vessel::FlatPoint goal;
  goal.position = {0.0, -155.0};
  std::vector<trajectory::Piece> pieces = {trajectory::hermitePiece(from, braking, 20.0),
                                           trajectory::hermitePiece(braking, goal, 5.0)};
  if (turns_s > 0.0) {
    pieces.push_back(trajectory::spinPiece(goal.position, 0.5 * kPi, kPi, turns_s));
  }
  return {trajectory::Trajectory(std::move(pieces)), 0.0};
}

// She is to pass ahead from starboard in a minute and a half, and when it lies at its goal she is
// still far off.
TEST_F(PilotTest, ArrivesBeforeItWouldGiveWay) {
  sailed_ = arrivingAfter(0.0);
  goal_ = sailed_.trajectory.flat(25.0).position;
  for (double now = 4.0; now < 24.0; now += 4.0) {
    EXPECT_FALSE(decideAt(now, 270.0, 2.0)) << now;
  }
  ASSERT_EQ(pilot_.encounters().size(), 1U);
  EXPECT_EQ(pilot_.encounters()[0].role, Role::kGiveWay);
}

// Whatever way it goes it has to come to rest and turn there: that makes no detour of this one.
TEST_F(PilotTest, KeepsAStraightWayThatEndsWithALongTurn) {
  sailed_ = arrivingAfter(12.0);
  goal_ = sailed_.trajectory.flat(25.0).position;
  for (double now = 0.0; now < 20.0; now += 0.5) {
    traffic::Track aside = trackAt(0.0, 1.0, now);
    aside.position = {-80.0, -150.0 + now};
    const vessel::FlatPoint z = sailed_.trajectory.flat(now);
    pilot_.observe(now, {z.position, z.velocity}, z.position, {aside}, goal_, 1.98);
    EXPECT_FALSE(pilot_.decide({now, sailed_, goal_, now + 0.3, limits_, water_})) << now;
  }
}

TEST_F(PilotTest, NobodyNearNothingToDo) {
  EXPECT_FALSE(pilot_.decide({10.0, sailed_, {0.0, 200.0}, 10.3, limits_, water_}));
  traffic::Track far = trackAt(180.0, 2.0, 10.0);
  far.position.x() += 60.0;
  pilot_.observe(10.0, {{0.0, -180.0}, {0.0, 2.0}}, {0.0, -180.0}, {far}, {0.0, 200.0}, 2.0);
  EXPECT_FALSE(pilot_.decide({10.0, sailed_, {0.0, 200.0}, 10.3, limits_, water_}));
  EXPECT_TRUE(pilot_.encounters().empty());
}

// A first estimate that was wrong: while both keep their courses, what comes out of it now came out
// of it then. Nothing more is learned of that once it was acted by it.
TEST_F(PilotTest, DoubtsARiskThatWasNone) {
  constexpr double kWrongS = 3.0;
  constexpr double kOffM = 36.0;  // of her bow crossing ours: 25 m between us
  constexpr double kStepS = 0.25;
  for (const double acts_s : {1e9, kWrongS, 20.0}) {
    for (const double off_m : {kOffM, 0.0}) {
      Lookout lookout((Options()));
      lookout.newGoal(-60.0);
      Motion own{{0.0, -200.0}, {0.0, 2.0}};
      for (double t = 0.0; t <= 30.0; t += kStepS) {
        if (t > acts_s) {
          own.velocity = 2.0 * unitVector((90.0 - 20.0) * kDegree);
        }
        traffic::Track track = trackAt(270.0, 2.0, t);
        track.position.x() += off_m;
        track.covariance.diagonal() << 0.25, 0.25, 0.0225, 0.0225;
        if (t <= kWrongS) {
          track.velocity.x() -= off_m / 144.0;
        }
        lookout.observe(t, own, own.position, {track}, goal_, 1.98);
        if (t == kWrongS) {
          ASSERT_EQ(lookout.others(water_).size(), 1U);
          EXPECT_EQ(lookout.others(water_)[0].record.role, Role::kGiveWay);
          EXPECT_FALSE(lookout.others(water_)[0].record.doubtful);
        }
        own = own.after(kStepS);
      }
      const Record record = lookout.others(water_)[0].record;
      EXPECT_EQ(record.role, Role::kGiveWay);
      EXPECT_EQ(record.acted, acts_s < 30.0);
      EXPECT_EQ(record.doubtful, off_m > 0.0 && acts_s > kWrongS) << off_m << ' ' << acts_s;
    }
  }
}

// A course is priced among so many: those who come nearest, whatever their numbers.
TEST_F(PilotTest, MindsTheNearestAmongMany) {
  Lookout lookout((Options()));
  lookout.newGoal(-60.0);
  for (double now = 57.0; now <= 60.0; now += 0.5) {
    std::vector<traffic::Track> tracks;
    for (int k = 0; k < 40; ++k) {
      traffic::Track far = trackAt(270.0, 1.0, now);
      far.id = k + 1;
      far.position = {-400.0 - 20.0 * k, 100.0};
      tracks.push_back(far);
    }
    tracks.push_back(trackAt(270.0, 2.0, now));
    tracks.back().id = 41;
    const vessel::FlatPoint z = sailed_.trajectory.flat(now);
    lookout.observe(now, {z.position, z.velocity}, z.position, tracks, {0.0, 200.0}, 1.98);
  }
  const std::vector<Other> others = lookout.others(water_);
  EXPECT_EQ(others.size(), kMostOthers);
  const Eigen::Vector2d nearest = trackAt(270.0, 2.0, 60.0).position;
  EXPECT_TRUE(std::any_of(others.begin(), others.end(), [&](const Other& other) {
    return (other.motion.position - nearest).norm() < 1.0;
  }));
}

}  // namespace
}  // namespace otter_nav::encounter
