#include "mission/weather.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/random.hpp"
#include "otter_nav/base/rk4.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/steady_motion.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::mission {
namespace {

vessel::Parameters windy() {
  vessel::Parameters vessel;
  vessel.manoeuvring.wind_surge_kgpm = 0.5;
  vessel.manoeuvring.wind_sway_kgpm = 0.5;
  vessel.manoeuvring.wind_yaw_kg = -0.66;
  return vessel;
}

// `wind` m/s towards east by time.
template <typename Wind>
Weather felt(const vessel::Parameters& vessel, double duration_s, Wind wind) {
  Weather weather(vessel);
  for (int k = 0; k <= static_cast<int>(10.0 * duration_s); ++k) {
    vessel::Disturbance estimate;
    estimate.wind_mps = {wind(0.1 * k), 0.0};
    weather.feel(0.1 * k, estimate);
  }
  return weather;
}

TEST(Weather, IsUnknownInTheFirstSecondsAndForgetsThem) {
  const auto wind = [](double t) { return t < 0.8 ? 20.0 * t : 6.0; };
  EXPECT_FALSE(felt(windy(), 0.8, wind).isKnown());
  const Weather weather = felt(windy(), 20.0, wind);
  EXPECT_TRUE(weather.isKnown());
  EXPECT_NEAR(weather.mean().wind_mps.x(), 6.0, 0.05);
  EXPECT_LT(weather.gust().wind_mps.x(), 1.21 * 6.0);
}

TEST(Weather, LearnsMeanAndGustsFromWhatItSaw) {
  const auto steady = [](double) { return 8.0; };
  const auto gusty = [](double t) { return 8.0 + 2.0 * std::sin(t); };
  const auto once = [](double t) { return t > 40.0 && t < 42.0 ? 14.0 : 8.0; };
  EXPECT_NEAR(felt(windy(), 60.0, steady).gust().wind_mps.x(), 8.0, 1e-6);
  const Weather learned = felt(windy(), 60.0, gusty);
  EXPECT_NEAR(learned.mean().wind_mps.x(), 8.0, 0.3);
  EXPECT_NEAR(learned.gust().wind_mps.x(), 8.0 + 2.0 * std::sqrt(2.0), 0.5);
  EXPECT_GT(felt(windy(), 60.0, once).gust().wind_mps.x(), 11.5);
  // While little was seen, a fifth more.
  EXPECT_NEAR(felt(windy(), 3.0, steady).gust().wind_mps.x(), 9.5, 0.15);
}

// Odometry that comes back after a while says what blows now, not what blew meanwhile.
TEST(Weather, AGapTellsLittle) {
  for (const double gap_s : {1.0, 60.0, 300.0}) {
    Weather weather(windy());
    vessel::Disturbance estimate;
    double t = 0.0;
    for (estimate.force_n = {5.0, 0.0}; t < 60.0; t += 0.1) {
      weather.feel(t, estimate);
    }
    estimate.force_n.x() = 2.0;
    weather.feel(t + gap_s, estimate);
    EXPECT_LE(weather.mean().force_n.x(), 5.0) << gap_s;
    EXPECT_GE(weather.mean().force_n.x(), 2.0) << gap_s;
    EXPECT_TRUE(std::isfinite(weather.gust().moment_nm)) << gap_s;
  }
}

TEST(Weather, CalmAsksForNothing) {
  const Weather weather = felt(windy(), 60.0, [](double) { return 0.0; });
  EXPECT_EQ(weather.gustShare(), 0.0);
  EXPECT_EQ(weather.gustReach(), 0.0);
  EXPECT_EQ(weather.drift().norm(), 0.0);
}

// The least share of the thrusters' moment that holds a heading on the worst course.
double worstMoment(const vessel::Parameters& vessel, const vessel::Disturbance& wind,
                   double speed_mps) {
  double worst = 0.0;
  for (double course = 0.0; course < 2.0 * kPi; course += 0.1) {
    const Eigen::Vector2d velocity =
        speed_mps * Eigen::Vector2d(std::cos(course), std::sin(course));
    double least = 10.0;
    for (const vessel::SteadyMotion& motion :
         vessel::steadyHeadings(velocity, course, vessel, wind)) {
      const double moment_nm = vessel::tauFromThrusts(motion.thrusts, vessel.thrusters).yaw_nm;
      if (motion.thrusts.sum() > 0.0) {
        least = std::min(least, std::abs(moment_nm) / vessel::greatestMoment(vessel.thrusters));
      }
    }
    worst = std::max(worst, least);
  }
  return worst;
}

TEST(Weather, SailsSlowlyWhereGustsTakeTheMomentThatHoldsTheHeadings) {
  const vessel::Parameters vessel = windy();
  const auto gusty = [](double mean) {
    return [mean](double t) { return mean * (1.0 + 0.2 * std::sin(t)); };
  };
  const Weather light = felt(vessel, 60.0, gusty(4.0));
  EXPECT_EQ(light.sailingSpeed(4.0), 4.0);
  const Weather strong = felt(vessel, 60.0, gusty(8.0));
  const double speed = strong.sailingSpeed(2.0);
  EXPECT_LT(speed, 1.0);
  EXPECT_GT(speed, 0.5);
  EXPECT_GT(worstMoment(vessel, strong.gust(), 2.0), 0.9);
  EXPECT_LT(worstMoment(vessel, strong.gust(), speed), 0.8);
}

// At more than 9 m/s some courses take more than the thrusters have at any speed; the others still
// want to be held.
TEST(Weather, SailsSlowlyWhereNotEveryCourseCanBeHeld) {
  const vessel::Parameters vessel = windy();
  const Weather weather =
      felt(vessel, 60.0, [](double t) { return 9.4 * (1.0 + 0.15 * std::sin(t)); });
  const double speed = weather.sailingSpeed(2.0);
  EXPECT_LT(speed, 1.0);
  EXPECT_LT(worstMoment(vessel, weather.gust(), speed),
            worstMoment(vessel, weather.gust(), 2.0) - 0.1);
}

// Seven metres a second seen for three seconds may be the lull of a wind that gusts to ten.
TEST(Weather, SailsSlowlyUntilGustsAreKnown) {
  const auto steady = [](double) { return 7.0; };
  EXPECT_LT(felt(windy(), 3.0, steady).sailingSpeed(2.0), 1.0);
  EXPECT_EQ(felt(windy(), 60.0, steady).sailingSpeed(2.0), 2.0);
}

TEST(Weather, GustsAskForMoreTheFasterTheyAre) {
  const auto gusts = [](double by) { return [by](double t) { return 6.0 + by * std::sin(t); }; };
  const Weather light = felt(windy(), 60.0, gusts(0.5));
  const Weather strong = felt(windy(), 60.0, gusts(2.0));
  EXPECT_GT(light.gustShare(), 0.0);
  EXPECT_GT(strong.gustShare(), 2.0 * light.gustShare());
  EXPECT_GT(strong.gustReach(), 1.5 * light.gustReach());
}

}  // namespace
}  // namespace otter_nav::mission
