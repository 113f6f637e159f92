#include "otter_nav/encounter/lying_off.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "open_water.hpp"

namespace otter_nav::encounter {
namespace {

// Eight beside each other to and fro across the way, 12 m and more ahead.
std::vector<traffic::Track> across(double now_s) {
  std::vector<traffic::Track> tracks;
  for (int k = 0; k < 8; ++k) {
    const double s = std::fmod(2.0 * now_s + 3.0 * k, 40.0);
    traffic::Track track;
    track.id = k;
    track.stamp_s = now_s;
    track.position = {12.0 + 4.0 * k, s < 20.0 ? s - 10.0 : 30.0 - s};
    track.velocity = {0.0, s < 20.0 ? 2.0 : -2.0};
    track.length_m = track.beam_m = 4.0;
    track.covariance.diagonal() << 0.02, 0.02, 0.02, 0.02;
    tracks.push_back(track);
  }
  return tracks;
}

struct Looks {
  double until_s = 0.0;    // it went on then
  double nearest_m = 1e3;  // of all places it chose, to any of their ways
};

Looks lookOn(std::size_t others, const Eigen::Vector2d& goal = {50.0, 0.0}) {
  const map::DistanceField water = test::openWater();
  Evasion evasion(*vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) +
                                          "/config/vessels/otter_gazebo.yaml"));
  LyingOff lying_off;
  Looks looks;
  for (; looks.until_s < 100.0; looks.until_s += 0.25) {
    std::vector<traffic::Track> tracks = across(looks.until_s);
    tracks.resize(others);
    evasion.observe(tracks);
    const auto place = lying_off.place(looks.until_s, {8.0, 0.0}, goal, tracks, water, evasion);
    if (!place) {
      break;
    }
    looks.nearest_m = std::min(looks.nearest_m, 12.0 - place->x());
  }
  // And does not lie off again.
  const bool again =
      lying_off.place(looks.until_s + 1.0, {8.0, 0.0}, goal, across(0.0), water, evasion)
          .has_value();
  EXPECT_EQ(again, others < 8U);
  return looks;
}

TEST(LyingOff, LooksOnUntilTheirWaysAreKnown) {
  const Looks looks = lookOn(8);
  // There and back again takes each 20 s.
  EXPECT_GT(looks.until_s, 15.0);
  EXPECT_LT(looks.until_s, 40.0);
  EXPECT_GT(looks.nearest_m, 6.0);
}

TEST(LyingOff, GoesOnAtOnceAmongFewOrRightBeforeTheGoal) {
  EXPECT_EQ(lookOn(6).until_s, 0.0);
  EXPECT_EQ(lookOn(8, {12.0, 0.0}).until_s, 0.0);
}

}  // namespace
}  // namespace otter_nav::encounter
