#include "otter_nav/encounter/evasion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "encounter/space_time_search.hpp"
#include "open_water.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/trajectory/joint.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::encounter {
namespace {

using test::square;

constexpr double kHorizonS = SpaceTimeSearch::kHorizonS;

vessel::Parameters vesselNamed(const std::string& name) {
  return *vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/" + name +
                                 ".yaml");
}

// Under way east at 2 m/s, or at rest; the goal 40 m ahead.
Evasion::Task taskAt(double mps, double speed_max_mps) {
  Evasion::Task task;
  task.start.velocity = {mps, 0.0};
  task.state << 0.0, 0.0, 0.0, mps, 0.0, 0.0;
  task.speed_max_mps = speed_max_mps;
  task.goal = {{40.0, 0.0}, 0.0};
  return task;
}

// The least distance between the outline of a square and a disc round our hull.
double leastGap(const trajectory::TimedTrajectory& path, const traffic::Track& track) {
  double least = 1e3;
  for (double t = 0.0; t <= path.trajectory.duration(); t += 0.05) {
    const Eigen::Vector2d off =
        path.trajectory.flat(t).position - track.position - t * track.velocity;
    const Eigen::Vector2d local = turned(off, -track.heading_rad).cwiseAbs();
    least = std::min(least, (local - Eigen::Vector2d(2.0, 2.0)).cwiseMax(0.0).norm());
  }
  return least;
}

TEST(Helmsman, DoesAsToldWithinTheThrustersAndTheSpeedLimit) {
  for (const char* name : {"otter_gazebo", "otter"}) {
    const vessel::Parameters vessel = vesselNamed(name);
    const Helmsman helmsman(vessel, {}, 2.0);
    Hull hull;
    for (const Helm& helm : {Helm{helmsman.speedMost(), 0.0}, Helm{0.5, 0.5 * helmsman.turnMost()},
                             Helm{0.0, 0.0}, Helm{-0.5, 0.0}}) {
      for (int k = 0; k < 100; ++k) {
        helmsman.step(hull, helm, 0.1);
        const vessel::Thrusts thrusts = vessel::thrustsFromTau(hull.tau, vessel.thrusters);
        EXPECT_LE(vessel::shareOfLimit(thrusts, vessel.thrusters), 0.91) << name;
        EXPECT_LT(hull.velocity().norm(), 2.0) << name;
      }
      EXPECT_NEAR(hull.surge_mps, helm.surge_mps, 0.15) << name;
      EXPECT_NEAR(hull.yaw_rate_radps, helm.turn_radps, 0.1) << name;
    }
  }
}

TEST(Evasion, PassesWhoCrossesWithoutAJumpAndComesNearerToTheGoal) {
  const map::DistanceField water = test::openWater();
  for (const char* name : {"otter_gazebo", "otter"}) {
    const Evasion evasion(vesselNamed(name));
    const Evasion::Task task = taskAt(2.0, 3.0);
    // She would be where we are after 5 s.
    const traffic::Track she = square(1, {10.0, -12.0}, {0.0, 2.4});
    const Evasion::Way way = evasion.find(task, {she}, water);
    ASSERT_FALSE(way.path.trajectory.empty()) << name;
    EXPECT_GT(leastGap(way.path, she), 1.14) << name;
    EXPECT_GT(way.danger.gap_m, 0.5) << name;
    const vessel::FlatPoint first = way.path.trajectory.flat(0.0);
    EXPECT_NEAR((first.velocity - task.start.velocity).norm(), 0.0, 1e-9);
    EXPECT_NEAR((first.acceleration - task.start.acceleration).norm(), 0.0, 1e-9);
    EXPECT_TRUE(trajectory::checkPieces(way.path.trajectory.pieces(), {1e-6, 1e-6, 1e-6, 1e-6}));
    EXPECT_GT(way.path.trajectory.flat(kHorizonS).position.x(), 5.0) << name;
  }
}

TEST(Evasion, DoesNotLieStillInTheWayOfWhoComesOverHer) {
  const map::DistanceField water = test::openWater();
  const Evasion evasion(vesselNamed("otter_gazebo"));
  Evasion::Task task = taskAt(0.0, 3.0);
  const traffic::Track she = square(1, {18.0, 0.0}, {-3.0, 0.0});
  EXPECT_LT(evasion.danger(vessel::Pose{}, 0.0, 8.0, {she}).gap_m, 0.0);
  const Evasion::Way way = evasion.find(task, {she}, water);
  EXPECT_GT(leastGap(way.path, she), 1.14);
  // Nor where what is sailed ends.
  trajectory::TimedTrajectory stays;
  vessel::FlatPoint here;
  stays.trajectory = trajectory::Trajectory({trajectory::hermitePiece(here, here, 1.0)});
  EXPECT_LT(evasion.danger(stays, 0.0, 8.0, {she}).gap_m, 0.0);
  EXPECT_GT(evasion.judge(task, stays, {she}, water).price, way.price + 5.0);
}

// Whether a way comes to rest at the goal, within what counts as arrival, and when; negative:
// never.
double arrivalTime(const trajectory::TimedTrajectory& path, const Evasion::Task& task,
                   const vessel::Parameters& vessel) {
  for (double t = 0.0; t <= path.trajectory.duration(); t += 0.05) {
    const vessel::State x = path.trajectory.sample(t, vessel).state;
    if ((x.head<2>() - task.goal.position).norm() < 0.9 &&
        std::abs(wrapAngle(x[vessel::kPsi] - task.goal.psi_rad)) < 0.15 &&
        x.segment<2>(vessel::kSurge).norm() < 0.25) {
      return t;
    }
  }
  return -1.0;
}

TEST(Evasion, ArrivesBeforeSheComesByThoughItCouldNotStayThere) {
  const map::DistanceField water = test::openWater();
  const vessel::Parameters vessel = vesselNamed("otter_gazebo");
  const Evasion evasion(vessel);
  Evasion::Task task = taskAt(0.0, 3.0);
  task.goal = {{1.5, 0.0}, 0.0};
  // Over the goal after 7 s.
  const traffic::Track she = square(1, {1.5, 21.0}, {0.0, -3.0});
  EXPECT_LT(arrivalTime(evasion.find(task, {she}, water).path, task, vessel), 0.0);
  task.arrival_m = 0.9;
  task.arrival_rad = 0.15;
  const Evasion::Way way = evasion.find(task, {she}, water);
  const double arrived_s = arrivalTime(way.path, task, vessel);
  EXPECT_GE(arrived_s, 0.0);
  EXPECT_LT(arrived_s, 5.0);
  // And lies there: it is not to be found so at a moment alone.
  const vessel::FlatPoint end = way.path.trajectory.flat(kHorizonS);
  EXPECT_LT((end.position - task.goal.position).norm(), 0.9);
  EXPECT_LT(end.velocity.norm(), 0.25);
  // What was found is worth keeping, and dearer the later it arrives.
  EXPECT_NEAR(evasion.judge(task, way.path, {she}, water).price, way.price, 0.7);
}

// A wall across from beside the vessel: through it there is no way.
TEST(Evasion, KeepsClearOfWhatLiesStill) {
  map::OccupancyGrid grid;
  grid.geometry = {160, 160, 0.5, {-40.0, -40.0}};
  grid.cells.assign(160U * 160U, map::Cell::kFree);
  for (int row = 60; row < 100; ++row) {
    for (int column = 90; column < 92; ++column) {  // x from 5 m, y from -10 to 10 m
      grid.cells[grid.geometry.index(column, row)] = map::Cell::kOccupied;
    }
  }
  const map::DistanceField walled(grid, {});
  const Evasion evasion(vesselNamed("otter_gazebo"));
  const Evasion::Way way = evasion.find(taskAt(1.0, 3.0), {}, walled);
  ASSERT_FALSE(way.path.trajectory.empty());
  for (double t = 0.0; t <= way.path.trajectory.duration(); t += 0.05) {
    EXPECT_GT(walled.clearance(way.path.trajectory.flat(t).position), 0.54) << t;
  }
}

// Alongside a wall with hardly any room, drifting off it: turning away at once, the stern swings
// into the wall, though the discs that the search has for the hull keep their distance.
TEST(Evasion, SwingsNoCornerOfTheHullIntoAWall) {
  constexpr double kWallM = -0.5;
  map::OccupancyGrid grid;
  grid.geometry = {320, 320, 0.25, {-40.0, -40.0}};
  grid.cells.assign(320U * 320U, map::Cell::kFree);
  for (int column = 0; column < 320; ++column) {
    grid.cells[grid.geometry.index(column, 157)] = map::Cell::kOccupied;
  }
  const map::DistanceField walled(grid, {});
  const vessel::Parameters vessel = vesselNamed("otter_gazebo");
  const Evasion evasion(vessel);
  int found = 0;
  for (const double turn_radps : {0.0, 0.8, 1.2}) {
    for (const double room : {0.02, 0.1, 0.5}) {
      Evasion::Task task = taskAt(0.0, 3.0);
      task.start.velocity = {0.0, 0.5};
      task.state[vessel::kSway] = 0.5;
      task.state[vessel::kYawRate] = turn_radps;
      task.goal = {{0.0, 30.0}, 0.5 * kPi};
      task.start.position = {0.0, kWallM + 0.5 * vessel.hull.beam_m + room};
      task.state.head<2>() = task.start.position;
      const Evasion::Way way = evasion.find(task, {}, walled);
      if (way.path.trajectory.empty()) {
        continue;
      }
      ++found;
      double least = 1e3;
      for (double t = 0.0; t <= way.path.trajectory.duration(); t += 0.02) {
        const vessel::State x = way.path.trajectory.sample(t, vessel).state;
        const Eigen::Vector2d ahead = unitVector(x[vessel::kPsi]);
        const double aside = 0.5 * vessel.hull.length_m * std::abs(ahead.y()) +
                             0.5 * vessel.hull.beam_m * std::abs(ahead.x());
        least = std::min(least, x[vessel::kY] - aside - kWallM);
      }
      EXPECT_GT(least, 0.0) << room << " m of room, " << turn_radps << " rad/s";
    }
  }
  EXPECT_GT(found, 1);
}

// What begins in a way that costs time is not given up for what ends in contact.
TEST(SpaceTimeSearch, FindsNothingDearerThanAnOrderThatIsHeld) {
  const vessel::Parameters vessel = vesselNamed("otter_gazebo");
  const map::DistanceField water = test::openWater();
  const Helmsman helmsman(vessel, {}, 4.0);
  // A wall of squares comes from ahead, and one from either side: astern alone it is free.
  std::vector<traffic::Track> tracks;
  for (int k = -3; k <= 3; ++k) {
    tracks.push_back(square(k, {14.0, 5.0 * k}, {-1.5, 0.0}));
  }
  tracks.push_back(square(10, {2.0, -12.0}, {-0.3, 1.0}));
  tracks.push_back(square(11, {2.0, 12.0}, {-0.3, -1.0}));
  const Foretold foretold(tracks, {}, 0.0, kHorizonS, {0.0, 0.0}, helmsman.speedMost(),
                          vessel.hull);
  Aim aim;
  aim.points = {{40.0, 0.0}};
  aim.left_m = {0.0};
  aim.goal = {{40.0, 0.0}, 0.0};
  Hull start;
  start.surge_mps = 2.0;
  const SpaceTimeSearch search(vessel.hull, helmsman, aim, foretold, water, start);
  const SpaceTimeSearch::Way found = search.find();
  const std::vector<int> all = foretold.all();
  for (const double speed : {1.0, 0.5, 0.0, -0.6}) {
    Hull hull = start;
    double price = 0.0;
    Foretold::Nearness worst;
    for (int k = 1; k <= foretold.steps(); ++k) {
      for (int half = 0; half < 2; ++half) {
        helmsman.step(hull, {speed * helmsman.speedMost(), 0.0}, 0.5 * Foretold::kStepS);
      }
      price += search.priceAt(hull, k, all, worst);
    }
    EXPECT_LT(found.price, price + search.left(hull) + 1e-6) << speed;
  }
  EXPECT_GT(found.worst.gap_m, 0.0);
}

// That it comes to contact costs more than what it lasts does.
TEST(SpaceTimeSearch, PaysForContactHoweverBriefItIs) {
  const vessel::Parameters vessel = vesselNamed("otter_gazebo");
  const map::DistanceField water = test::openWater();
  const Helmsman helmsman(vessel, {}, 4.0);
  const Foretold foretold({square(1, {0.0, 0.0}, {0.1, 0.0})}, {}, 0.0, kHorizonS, {0.0, 0.0},
                          helmsman.speedMost(), vessel.hull);
  Aim aim;
  aim.points = {{40.0, 0.0}};
  aim.left_m = {0.0};
  aim.goal = {{40.0, 0.0}, 0.0};
  Hull hull;
  const SpaceTimeSearch search(vessel.hull, helmsman, aim, foretold, water, hull);
  Foretold::Nearness worst;
  const double touched = search.priceAt(hull, 1, foretold.all(), worst);
  const double on = search.priceAt(hull, 2, foretold.all(), worst);
  EXPECT_GT(touched, 30.0);
  EXPECT_LT(on, 15.0);
}

// To and fro between x = 0 and 20 m at 2 m/s.
Eigen::Vector2d toAndFro(double t) {
  const double s = std::fmod(2.0 * t, 40.0);
  return {s < 20.0 ? s : 40.0 - s, 0.0};
}

TEST(Habits, WhoHasTurnedThereBeforeIsForetoldToTurnAgain) {
  Habits habits;
  const auto track = [](double t) {
    traffic::Track she = square(t < 21.0 ? 1 : 2, toAndFro(t), {0.0, 0.0});
    she.stamp_s = t;
    she.velocity = (toAndFro(t + 0.01) - toAndFro(t)) / 0.01;
    return she;
  };
  // From x = 14 m eastward; she turns 3 s later. As another track she is the same.
  for (const double now : {7.0, 27.0}) {
    for (double t = now < 10.0 ? 0.0 : 7.1; t <= now; t += 0.1) {
      habits.observe({track(t)});
    }
    const std::vector<Eigen::Vector2d> told = habits.foretell(track(now), now, 0.5, 16);
    if (now < 10.0) {
      EXPECT_TRUE(told.empty());
      continue;
    }
    ASSERT_EQ(told.size(), 17U);
    for (std::size_t k = 0; k < told.size(); ++k) {
      EXPECT_LT((told[k] - toAndFro(now + 0.5 * static_cast<double>(k))).norm(), 1.2) << k;
    }
  }
}

// On a circle, and then not heard for a while: whoever is still among the tracks is known, however
// old what was heard of her is.
TEST(Habits, ForgetsNobodyWhoIsStillAmongTheTracks) {
  for (const bool stays : {true, false}) {
    Habits habits;
    traffic::Track turning;
    for (double t = 0.0; t <= 10.0; t += 0.1) {
      const double angle = 0.2 * t;
      turning = square(1, 10.0 * unitVector(angle), 2.0 * across(unitVector(angle)));
      turning.stamp_s = t;
      habits.observe({turning});
    }
    ASSERT_TRUE(habits.steadyTurn(turning));
    for (double t = 10.1; t <= 50.0; t += 0.1) {
      traffic::Track other = square(2, {100.0 + t, 0.0}, {1.0, 0.0});
      other.stamp_s = t;
      habits.observe(stays ? std::vector<traffic::Track>{other, turning}
                           : std::vector<traffic::Track>{other});
    }
    EXPECT_EQ(habits.steadyTurn(turning).has_value(), stays);
  }
}

// What is remembered is reckoned with for four of five, and the straight way for the fifth.
TEST(Foretold, KeepsTheStraightWayInMindBesideTheRememberedOne) {
  constexpr double kNowS = 27.0;  // at x = 14 m, eastward
  constexpr double kLaterS = 4.6;
  Habits habits;
  traffic::Track she;
  for (int k = 0; k <= 270; ++k) {
    const double t = 0.1 * k;
    she = square(1, toAndFro(t), (toAndFro(t + 0.01) - toAndFro(t)) / 0.01);
    she.stamp_s = t;
    habits.observe({she});
  }
  const vessel::Hull hull;
  const Foretold foretold({she}, habits, kNowS, 8.0, {20.0, 0.0}, 2.0, hull);
  const auto dangerAt = [&](const Eigen::Vector2d& place) {
    const int k = static_cast<int>(kLaterS / Foretold::kStepS);
    return foretold.at(place, {0.0, 1.0}, k, foretold.all()).danger;
  };
  const double straight = dangerAt(she.position + kLaterS * she.velocity);
  const double remembered = dangerAt(toAndFro(kNowS + kLaterS));
  EXPECT_GT(straight, 0.1);
  EXPECT_LT(straight, 0.25);
  EXPECT_GT(remembered, 2.5 * straight);
}

// Where a known way ends she is carried on straight from there, without a jump.
TEST(Habits, CarriesOnFromTheEndOfAKnownWay) {
  constexpr double kMps = 3.0;
  constexpr double kStepS = 0.2;
  Habits habits;
  traffic::Track she;
  const auto at = [&](double x, double now) {
    she = square(1, {x, 0.0}, {kMps, 0.0});
    she.stamp_s = now;
    return she;
  };
  for (double t = 0.0; t <= 4.3; t += 0.1) {
    habits.observe({at(kMps * t, t)});
  }
  const std::vector<Eigen::Vector2d> told = habits.foretell(at(1.0, 20.0), 20.0, kStepS, 30);
  ASSERT_EQ(told.size(), 31U);
  for (std::size_t k = 1; k < told.size(); ++k) {
    EXPECT_NEAR((told[k] - told[k - 1]).norm(), kMps * kStepS, 1e-6) << k;
  }
}

// Of who is far off or has just turned course and speed are hardly known.
TEST(Habits, KnowsWhoIsOnAWayAgainThoughCourseAndSpeedWander) {
  Habits habits;
  traffic::Track she;
  for (double t = 0.0; t <= 8.0; t += 0.4) {
    she = square(1, {2.0 * t, 0.0}, {2.0, 0.0});
    she.stamp_s = t;
    habits.observe({she});
  }
  const auto again = [&](const Eigen::Vector2d& velocity) {
    traffic::Track now = square(1, {4.0, 0.8}, velocity);
    now.stamp_s = 30.0;
    return habits.foretell(now, 30.0, 0.5, 8);
  };
  for (const Eigen::Vector2d& velocity :
       {Eigen::Vector2d(2.0, 0.0), Eigen::Vector2d(2.4, 0.0), Eigen::Vector2d(1.8, 0.8)}) {
    const std::vector<Eigen::Vector2d> told = again(velocity);
    ASSERT_EQ(told.size(), 9U);
    EXPECT_LT((told[6] - Eigen::Vector2d(10.0, 0.8)).norm(), 0.3);
  }
  EXPECT_TRUE(again({1.0, 1.7}).empty());
  EXPECT_TRUE(again({3.2, 0.0}).empty());
}

// East until x = 20 m, then north, at 2 m/s.
Eigen::Vector2d roundTheCorner(double t) {
  const double s = 2.0 * t;
  return s < 20.0 ? Eigen::Vector2d(s, 0.0) : Eigen::Vector2d(20.0, s - 20.0);
}

// For a moment her track goes on as before the corner: nobody went there on such a course.
TEST(Habits, FollowsHerRoundACornerThatHerTrackIsLateFor) {
  constexpr double kAgainS = 30.0;
  Habits habits;
  const auto track = [](int id, double t, double began_s) {
    traffic::Track she = square(id, roundTheCorner(t - began_s), {0.0, 0.0});
    she.stamp_s = t;
    she.velocity = t - began_s < 10.0 ? Eigen::Vector2d(2.0, 0.0) : Eigen::Vector2d(0.0, 2.0);
    return she;
  };
  for (double t = 0.0; t <= 16.0; t += 0.1) {
    habits.observe({track(1, t, 0.0)});
  }
  for (double t = kAgainS; t <= kAgainS + 10.0; t += 0.1) {
    habits.observe({track(2, t, kAgainS)});
  }
  traffic::Track late = track(2, kAgainS + 10.0, kAgainS);
  late.velocity = {2.0, 0.2};
  for (const double after : {0.1, 0.2, 0.3}) {
    late.stamp_s = kAgainS + 10.0 + after;
    late.position = {20.0 + 1.5 * after, after};
    habits.observe({late});
  }
  const std::vector<Eigen::Vector2d> told = habits.foretell(late, late.stamp_s, 0.5, 8);
  ASSERT_EQ(told.size(), 9U);
  EXPECT_LT((told[8] - roundTheCorner(14.3)).norm(), 1.0);

  // Who really goes on straight there is not on that way for long.
  for (int k = 1; k <= 12; ++k) {
    late.stamp_s += 0.1;
    late.position += Eigen::Vector2d(0.2, 0.0);
    late.velocity = {2.0, 0.0};
    habits.observe({late});
  }
  EXPECT_TRUE(habits.foretell(late, late.stamp_s, 0.5, 8).empty());
}

// Places as a radar tells them, now to one side and now to the other.
TEST(Habits, RemembersAWaySmootherThanItWasTracked) {
  Habits habits;
  traffic::Track she;
  int side = 1;
  for (double t = 0.0; t <= 12.0; t += 0.401) {
    side = -side;
    she = square(1, {2.0 * t, 0.6 * side}, {2.0, 0.5 * side});
    she.covariance.diagonal() << 0.4, 0.4, 0.3, 0.3;
    she.stamp_s = t;
    habits.observe({she});
  }
  traffic::Track now = square(2, {4.0, 0.0}, {2.0, 0.0});
  now.stamp_s = 30.0;
  const std::vector<Eigen::Vector2d> told = habits.foretell(now, 30.0, 0.2, 30);
  ASSERT_EQ(told.size(), 31U);
  for (std::size_t k = 0; k < told.size(); ++k) {
    EXPECT_NEAR(told[k].y(), 0.0, 0.45) << k;
  }
}

// Remembers somebody on a way, 2 m/s along the points given, known to a variance.
void remember(Habits& habits, int id, double from_s, double variance,
              const std::vector<Eigen::Vector2d>& way) {
  constexpr double kMps = 2.0;
  constexpr double kEachS = 0.2;
  double t = from_s;
  for (std::size_t k = 0; k + 1 < way.size(); ++k) {
    const Eigen::Vector2d leg = way[k + 1] - way[k];
    for (double s = 0.0; s < leg.norm(); s += kMps * kEachS) {
      traffic::Track she = square(id, way[k] + s * leg.normalized(), kMps * leg.normalized());
      she.covariance.diagonal() << variance, variance, variance, variance;
      she.stamp_s = t;
      habits.observe({she});
      t += kEachS;
    }
  }
}
traffic::Track seenAt(int id, double now, const Eigen::Vector2d& position,
                      const Eigen::Vector2d& velocity) {
  traffic::Track she = square(id, position, velocity);
  she.stamp_s = now;
  return she;
}

constexpr double kByLidarM2 = 0.02;
constexpr double kByRadarM2 = 0.5;

// Two ways lie side by side; what the radar alone has met is not known to be the nearer one.
TEST(Habits, TakesAWayThatTheLidarHasMetForOneOfTheRadars) {
  Habits habits;
  remember(habits, 1, 0.0, kByLidarM2, {{0.0, 0.0}, {40.0, 0.0}});
  remember(habits, 2, 30.0, kByRadarM2, {{0.0, 0.5}, {12.0, 0.5}, {12.0, 30.0}});
  const auto told = habits.foretell(seenAt(3, 80.0, {4.0, 0.3}, {2.0, 0.0}), 80.0, 0.5, 16);
  ASSERT_EQ(told.size(), 17U);
  EXPECT_LT((told[16] - Eigen::Vector2d(20.0, 0.3)).norm(), 1.0);
}

// The lidar met somebody there only farther on.
TEST(Habits, ChangesToAWayThatIsBetterKnown) {
  Habits habits;
  remember(habits, 1, 0.0, kByRadarM2, {{0.0, 0.0}, {24.0, 0.0}, {24.0, 30.0}});
  remember(habits, 2, 40.0, kByLidarM2, {{10.0, 0.0}, {60.0, 0.0}});
  remember(habits, 3, 80.0, kByLidarM2, {{0.0, 0.0}, {14.0, 0.0}});
  const auto told = habits.foretell(seenAt(3, 87.0, {14.0, 0.0}, {2.0, 0.0}), 87.0, 0.5, 20);
  ASSERT_EQ(told.size(), 21U);
  EXPECT_LT((told[20] - Eigen::Vector2d(34.0, 0.0)).norm(), 1.0);
}

// At a fork some went to the one side and some to the other, and nobody straight on.
TEST(Foretold, ReckonsWithEachWayWhereTheyPart) {
  constexpr double kNowS = 122.0;  // at x = 14 m
  constexpr int kAt = 35;          // of the foretold's steps: 4 m past the fork
  Habits habits;
  remember(habits, 1, 0.0, kByLidarM2, {{0.0, 0.0}, {24.0, 0.0}, {24.0, 30.0}});
  remember(habits, 2, 60.0, kByLidarM2, {{0.0, 0.0}, {24.0, 0.0}, {24.0, -30.0}});
  const traffic::Track she = seenAt(3, kNowS, {14.0, 0.0}, {2.0, 0.0});
  const Foretold foretold({she}, habits, kNowS, 8.0, {20.0, 0.0}, 2.0, vessel::Hull());
  for (const double side : {1.0, -1.0}) {
    const Eigen::Vector2d place(24.0, side * 4.0);
    EXPECT_GT(foretold.at(place, {0.0, 1.0}, kAt, foretold.all()).danger, 0.2) << side;
  }
  const std::vector<Way> ways = habits.ways(she, kNowS, 0.2, 40);
  ASSERT_EQ(ways.size(), 2U);
  EXPECT_NEAR(ways[0].share + ways[1].share, 1.0, 1e-9);
}

// Who is met once a second is met before a corner and after it, and may have gone on for a while.
TEST(Foretold, IsNotSureOfACornerThatTheRadarAloneHasSeen) {
  constexpr double kNowS = 80.0;
  constexpr int kAt = 10;  // of the foretold's steps: at the corner
  const auto dangerBeyond = [](double variance_m2) {
    Habits habits;
    remember(habits, 1, 0.0, variance_m2, {{0.0, 0.0}, {24.0, 0.0}, {24.0, 30.0}});
    const traffic::Track she = seenAt(2, kNowS, {20.0, 0.0}, {2.0, 0.0});
    const Foretold foretold({she}, habits, kNowS, 8.0, {30.0, 0.0}, 2.0, vessel::Hull());
    return foretold.at({28.0, 0.0}, {0.0, 1.0}, kAt, foretold.all()).danger;
  };
  EXPECT_GT(dangerBeyond(kByRadarM2), 2.0 * dangerBeyond(kByLidarM2));
}

// The lidar lost her right before the corner that the radar has seen her turn.
TEST(Habits, TellsACornerFromWhoWasSeenToTurnItAndNotFromWhoWasLost) {
  Habits habits;
  remember(habits, 1, 0.0, kByRadarM2, {{0.0, 0.0}, {24.0, 0.0}, {24.0, 30.0}});
  remember(habits, 2, 40.0, kByLidarM2, {{0.0, 0.0}, {22.0, 0.0}});
  for (const double x : {10.0, 18.0, 20.0}) {
    const auto told = habits.foretell(seenAt(3, 80.0, {x, 0.0}, {2.0, 0.0}), 80.0, 0.5, 16);
    ASSERT_EQ(told.size(), 17U) << x;
    EXPECT_LT((told[16] - Eigen::Vector2d(24.0, x - 8.0)).norm(), 2.0) << x;
  }
}

// Each time a radar makes something else of the same way.
TEST(Habits, TellsTheMeanOfSeveralPasses) {
  Habits habits;
  int id = 0;
  for (const double aside : {1.5, -1.6, 1.4, -1.3}) {
    ++id;
    remember(habits, id, 30.0 * id, kByRadarM2, {{0.0, -0.25 * aside}, {24.0, 1.25 * aside}});
  }
  const auto told = habits.foretell(seenAt(9, 200.0, {4.0, 0.0}, {2.0, 0.0}), 200.0, 0.5, 16);
  ASSERT_EQ(told.size(), 17U);
  EXPECT_LT(std::abs(told[16].y()), 0.4);
}

// Beside a way of the radar's, as that is wrong there: farther on it is wrong in another way.
TEST(Habits, ComesBackToAWayThatIsHardlyKnown) {
  Habits habits;
  remember(habits, 1, 0.0, kByRadarM2, {{0.0, 0.0}, {40.0, 0.0}});
  const auto told = habits.foretell(seenAt(2, 60.0, {4.0, 0.9}, {2.0, 0.0}), 60.0, 0.5, 16);
  ASSERT_EQ(told.size(), 17U);
  EXPECT_NEAR(told[0].y(), 0.9, 0.1);
  EXPECT_LT(std::abs(told[16].y()), 0.3);
}

// By and by she draws away from a way that is known well, on nearly the same course.
TEST(Habits, LeavesAWayThatIsKnownWellWithHer) {
  Habits habits;
  remember(habits, 1, 0.0, kByLidarM2, {{0.0, 0.0}, {30.0, 0.0}, {30.0, -30.0}});
  const Eigen::Vector2d end(18.0, 1.6);
  remember(habits, 2, 60.0, kByLidarM2, {{0.0, 0.0}, {10.0, 0.0}, end});
  const double now = 60.0 + 0.5 * (10.0 + (end - Eigen::Vector2d(10.0, 0.0)).norm());
  EXPECT_TRUE(habits.foretell(seenAt(2, now, end, {2.0, 0.4}), now, 0.5, 16).empty());
}

TEST(Habits, TellsARoundFromACorner) {
  constexpr double kTurnRadps = 0.3;
  Habits round;
  Habits corner;
  traffic::Track she;
  for (double t = 0.0; t <= 6.0; t += 0.2) {
    she = square(1, {0.0, 0.0}, 2.0 * unitVector(kTurnRadps * t));
    she.stamp_s = t;
    round.observe({she});
    traffic::Track turns = square(1, {0.0, 0.0}, 2.0 * unitVector(t < 5.0 ? 0.0 : 1.5));
    turns.stamp_s = t;
    corner.observe({turns});
  }
  ASSERT_TRUE(round.steadyTurn(she));
  EXPECT_NEAR(*round.steadyTurn(she), kTurnRadps, 0.02);
  EXPECT_FALSE(corner.steadyTurn(she));
}

// A track rounds the corner off, over half a second: that is no round either, at any time.
TEST(Habits, TakesNoCornerForARoundWheneverItIs) {
  for (double corner_s = 4.0; corner_s < 5.0; corner_s += 0.1) {
    Habits habits;
    for (double t = 0.0; t <= 9.0; t += 0.1) {
      const double turned = std::clamp((t - corner_s) / 0.5, 0.0, 1.0);
      traffic::Track she = square(1, {0.0, 0.0}, 2.0 * unitVector(1.3 * turned));
      she.stamp_s = t;
      habits.observe({she});
      EXPECT_FALSE(habits.steadyTurn(she)) << corner_s << " at " << t;
    }
  }
}

}  // namespace
}  // namespace otter_nav::encounter
