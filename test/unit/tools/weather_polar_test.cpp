#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "otter_nav/base/angles.hpp"
#include "weather_polar/polar.hpp"

namespace otter_nav::tools {
namespace {

vessel::Parameters windy() {
  vessel::Parameters vessel;
  vessel.manoeuvring.wind_surge_kgpm = 0.5;
  vessel.manoeuvring.wind_sway_kgpm = 0.5;
  vessel.manoeuvring.wind_yaw_kg = -0.66;
  return vessel;
}

double fastest(const std::vector<PolarPoint>& points, double wind_mps, double course_rad) {
  double fastest = -1.0;
  for (const PolarPoint& p : points) {
    if (p.wind_mps == wind_mps && std::abs(wrapAngle(p.course_rad - course_rad)) < 1e-6 && p.held) {
      fastest = std::max(fastest, p.speed_mps);
    }
  }
  return fastest;
}

PolarOptions withoutReserve(double wind_mps, int courses) {
  PolarOptions options;
  options.winds_mps = {wind_mps};
  options.reserve = 0.0;
  options.courses = courses;
  return options;
}

TEST(WeatherPolar, CalmWaterAllowsTheTopSpeedOnEachCourse) {
  const auto points = polar(windy(), withoutReserve(0.0, 8));
  ASSERT_TRUE(points);
  for (int k = 0; k < 8; ++k) {
    EXPECT_NEAR(fastest(*points, 0.0, 0.25 * kPi * k), 5.0, 0.051);  // 100 N at 20 kg/s
  }
}

// Dead against W, 20 v + W^2 / 2 newtons; the picture is the same on both sides.
TEST(WeatherPolar, SpeedAgainstTheWindIsWhatTheThrustLeaves) {
  PolarOptions options = withoutReserve(8.0, 24);
  const auto points = polar(windy(), options);
  ASSERT_TRUE(points);
  EXPECT_NEAR(fastest(*points, 8.0, 0.0), (100.0 - 32.0) / 20.0, 0.051);
  for (int k = 1; k < 12; ++k) {
    EXPECT_NEAR(fastest(*points, 8.0, k * kPi / 12.0), fastest(*points, 8.0, -k * kPi / 12.0),
                1e-9);
  }
  options.gust = 0.3;
  const auto gusty = polar(windy(), options);
  EXPECT_LT(fastest(*gusty, 8.0, 0.0), fastest(*points, 8.0, 0.0));
}

TEST(WeatherPolar, RefusesWindForAVesselThatKnowsNoWindLoads) {
  PolarOptions options;
  options.winds_mps = {8.0};
  vessel::Parameters vessel;
  vessel.name = "dinghy";
  const auto points = polar(vessel, options);
  ASSERT_FALSE(points);
  EXPECT_NE(points.error().message.find("dinghy"), std::string::npos);
}

TEST(WeatherPolar, WritesWhatItFound) {
  PolarOptions options;
  options.winds_mps = {6.0};
  options.courses = 4;
  options.speed_step_mps = 1.0;
  const auto points = polar(windy(), options);
  ASSERT_TRUE(points);
  const std::string base = ::testing::TempDir() + "polar_test";
  ASSERT_TRUE(savePolarCsv(base + ".csv", *points));
  ASSERT_TRUE(savePolarSvg(base + ".svg", "title", *points, options.speed_step_mps));
  std::ifstream csv(base + ".csv");
  std::string line;
  std::size_t lines = 0;
  while (std::getline(csv, line)) {
    ++lines;
  }
  EXPECT_EQ(lines, points->size() + 1);
  std::stringstream svg;
  svg << std::ifstream(base + ".svg").rdbuf();
  EXPECT_NE(svg.str().find("6 m/s of wind"), std::string::npos);
  EXPECT_NE(svg.str().find("<path"), std::string::npos);
  EXPECT_FALSE(savePolarCsv(OTTER_NAV_SOURCE_DIR "/package.xml/all.csv", *points));
}

}  // namespace
}  // namespace otter_nav::tools
