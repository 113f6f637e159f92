// What is remembered of others by the places where they were met.
#include "encounter/met_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "encounter/habits.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/random.hpp"

namespace otter_nav::encounter {
namespace {

// Round a square of 12 m at 2 m/s, at its corner at 0 s.
Eigen::Vector2d roundASquare(double t) {
  constexpr double kSideM = 12.0;
  const double s = std::fmod(2.0 * t, 4.0 * kSideM);
  const double along = std::fmod(s, kSideM);
  switch (static_cast<int>(s / kSideM)) {
    case 0:
      return {along, 0.0};
    case 1:
      return {kSideM, along};
    case 2:
      return {kSideM - along, kSideM};
    default:
      return {0.0, kSideM - along};
  }
}

Eigen::Vector2d drawn(Random& random, double deviation) {
  const double x = deviation * random.normal();
  const double y = deviation * random.normal();
  return {x, y};
}

// As a filter tracks her that learns of each corner a second late, and doesn't know her velocity;
// met each second by a radar.
traffic::Track tracked(double t, Random& random) {
  traffic::Track she;
  she.id = 1;
  she.stamp_s = t;
  const double late = t < 1.0 ? 0.0 : 1.0;
  she.velocity = (roundASquare(t - late + 0.01) - roundASquare(t - late)) / 0.01;
  she.position = roundASquare(t - late) + late * she.velocity;
  she.heading_rad = angleOf(she.velocity);
  she.length_m = she.beam_m = 4.0;
  she.covariance.diagonal() << 1.0, 1.0, 1.2, 1.2;
  she.met = {t, roundASquare(t) + drawn(random, 0.5), 0.5};
  return she;
}

TEST(Habits, RemembersWhereSheWasMetAndNotWhatHerTrackMadeOfIt) {
  constexpr double kRoundS = 24.0;
  int told_well = 0;
  int told = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    Habits habits;
    for (int k = 0; k <= 30; ++k) {
      habits.observe({tracked(k, random)});
    }
    // Again on the first side, 3 m before the corner.
    traffic::Track again = tracked(kRoundS + 4.5, random);
    again.position = roundASquare(again.stamp_s);
    again.velocity = {2.0, 0.0};
    const std::vector<Eigen::Vector2d> places = habits.foretell(again, again.stamp_s, 0.5, 8);
    told += places.empty() ? 0 : 1;
    told_well +=
        !places.empty() && (places[8] - roundASquare(again.stamp_s + 4.0)).norm() < 1.5 ? 1 : 0;
  }
  EXPECT_GE(told, 9);
  EXPECT_GE(told_well, 8);
}

TEST(Habits, JoinsNoWaysOfATrackThatWasTakenForAnother) {
  Habits habits;
  Random random(1);
  // East at 2 m/s; after 8 s her track goes on 20 m farther north.
  const auto met = [](double t) { return Eigen::Vector2d(2.0 * t, t < 8.0 ? 0.0 : 20.0); };
  traffic::Track she;
  she.id = 1;
  she.velocity = {2.0, 0.0};
  she.covariance.diagonal() << 1.0, 1.0, 1.2, 1.2;
  for (int k = 0; k <= 16; ++k) {
    she.stamp_s = k;
    she.position = met(k);
    she.met = {she.stamp_s, met(k), 0.5};
    habits.observe({she});
  }
  traffic::Track again = she;
  again.stamp_s = 40.0;
  again.position = {4.0, 0.0};
  for (const Eigen::Vector2d& place : habits.foretell(again, 40.0, 0.5, 16)) {
    EXPECT_LT(std::abs(place.y()), 2.0) << place.x();
  }
}

// Back at once at either end of 20 m, at 4 m/s, behind something for the last 2 m: she comes out
// where she isn't looked for, but where she can be.
TEST(Habits, RemembersAWayThroughATurnAtOnce) {
  const auto toAndFro = [](double t) {
    const double s = std::fmod(4.0 * t, 40.0);
    return Eigen::Vector2d(s < 20.0 ? s : 40.0 - s, 0.0);
  };
  Habits habits;
  traffic::Track she;
  she.id = 1;
  she.covariance.diagonal().setConstant(0.02);
  const auto seen = [&](double t) {
    she.stamp_s = t;
    she.position = toAndFro(t);
    she.velocity = (toAndFro(t + 0.01) - toAndFro(t)) / 0.01;
    she.met = {t, she.position, 0.2};
    return she;
  };
  for (int k = 0; k < 90; ++k) {
    const bool hidden = seen(0.2 * k).velocity.x() < 0.0 && she.position.x() > 17.0;
    if (!hidden) {
      habits.observe({she});
    }
  }
  // At x = 10 m, 2.5 s before she turns.
  constexpr double kNowS = 22.5;
  const std::vector<Eigen::Vector2d> places = habits.foretell(seen(kNowS), kNowS, 0.5, 10);
  ASSERT_EQ(places.size(), 11U);
  for (const int k : {3, 7, 10}) {
    EXPECT_LT((places[static_cast<std::size_t>(k)] - toAndFro(kNowS + 0.5 * k)).norm(), 0.3) << k;
  }
}

}  // namespace
}  // namespace otter_nav::encounter
