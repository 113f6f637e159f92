#include "plant/waves.hpp"

#include <gtest/gtest.h>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::plant {
namespace {

const Eigen::Vector2d kHalfSize(0.5, 0.4);
constexpr double kPsi = 0.7;
constexpr double kTime = 1.3;

WaveField threeWaves() {
  WaveOptions options;
  options.components = {{0.09, 5.0, kPi}, {0.01, 0.7, 0.75 * kPi}, {0.02, 6.3, 0.25 * kPi}};
  return WaveField(options, 1);
}

Eigen::Vector2d gridPoint(const Eigen::Vector2d& centre, double x, double y) {
  const Eigen::Vector2d ahead(std::cos(kPsi), std::sin(kPsi));
  const Eigen::Vector2d port(-ahead.y(), ahead.x());
  return centre + x * ahead + y * port;
}

TEST(WaveField, RegularWaveTravelsTheWayItPoints) {
  WaveOptions options;
  options.components = {{0.1, 5.0, 0.0}};
  const WaveField field(options, 1);
  const double speed = 9.81 * 5.0 / (2.0 * kPi);  // deep water
  EXPECT_DOUBLE_EQ(field.elevation({0.0, 0.0}, 0.0), 0.1);
  EXPECT_NEAR(field.elevation({2.0 * speed, 7.0}, 2.0), 0.1, 1e-12);
  EXPECT_LT(field.elevation({-2.0 * speed, 7.0}, 2.0), 0.09);
}

// The closed form over the grid against the four points themselves.
TEST(WaveField, PlaneUnderTheHullIsTheFitToItsGrid) {
  const WaveField field = threeWaves();
  const Eigen::Vector2d centre(3.0, -2.0);
  const HullWaves w = field.underHull(centre, kPsi, kTime, kHalfSize, 0.2);
  double mean = 0.0;
  double ahead = 0.0;
  double port = 0.0;
  for (const double sx : {-1.0, 1.0}) {
    for (const double sy : {-1.0, 1.0}) {
      const double height =
          field.elevation(gridPoint(centre, sx * kHalfSize.x(), sy * kHalfSize.y()), kTime);
      mean += height / 4.0;
      ahead += sx * height / (4.0 * kHalfSize.x());
      port += sy * height / (4.0 * kHalfSize.y());
    }
  }
  EXPECT_NEAR(w.elevation_m, mean, 1e-12);
  EXPECT_NEAR(w.slope.x(), ahead, 1e-12);
  EXPECT_NEAR(w.slope.y(), port, 1e-12);
}

TEST(WaveField, RatesAreTimeDerivatives) {
  const WaveField field = threeWaves();
  const Eigen::Vector2d centre(-1.0, 8.0);
  constexpr double kStep = 1e-5;
  const HullWaves w = field.underHull(centre, kPsi, kTime, kHalfSize, 0.2);
  const HullWaves after = field.underHull(centre, kPsi, kTime + kStep, kHalfSize, 0.2);
  const HullWaves before = field.underHull(centre, kPsi, kTime - kStep, kHalfSize, 0.2);
  const double span = 2.0 * kStep;
  EXPECT_NEAR(w.elevation_rate_mps, (after.elevation_m - before.elevation_m) / span, 1e-7);
  EXPECT_TRUE(w.slope_rate_radps.isApprox((after.slope - before.slope) / span, 1e-6));
  EXPECT_TRUE(w.orbital_acceleration_mps2.isApprox(
      (after.orbital_velocity_mps - before.orbital_velocity_mps) / span, 1e-6));
  EXPECT_NEAR(w.rotation_rate_radps2, (after.rotation_radps - before.rotation_radps) / span, 1e-7);
}

// Linear deep-water waves: particles circle with the surface's amplitude times the frequency.
TEST(WaveField, LongWavesMoveTheHullInCircles) {
  WaveOptions options;
  options.components = {{0.1, 6.0, 0.0}};
  const WaveField field(options, 1);
  const HullWaves crest = field.underHull({0.0, 0.0}, 0.0, 0.0, kHalfSize, 0.0);
  const double omega = 2.0 * kPi / 6.0;
  EXPECT_NEAR(crest.orbital_velocity_mps.x(), 0.1 * omega, 1e-3);
  EXPECT_NEAR(crest.orbital_velocity_mps.y(), 0.0, 1e-12);
  EXPECT_NEAR(crest.elevation_m, 0.1, 1e-3);
}

TEST(WaveField, WavesShorterThanTheHullCancel) {
  WaveOptions options;
  options.components = {{0.05, 0.7, 0.0}};  // 0.77 m long, the grid's points 1 m apart
  const WaveField field(options, 1);
  double most = 0.0;
  for (int i = 0; i < 100; ++i) {
    most = std::max(
        most, std::abs(field.underHull({0.01 * i, 0.0}, 0.0, 0.0, {0.1915, 0.4}, 0.0).elevation_m));
  }
  EXPECT_LT(most, 0.001);
}

TEST(Jonswap, PeaksWhereItShould) {
  const double peak = jonswapShape(2.0, 2.0, 3.3);
  EXPECT_GT(peak, jonswapShape(1.95, 2.0, 3.3));
  EXPECT_GT(peak, jonswapShape(2.05, 2.0, 3.3));
  // The peak stands over Pierson and Moskowitz's spectrum by its factor.
  EXPECT_NEAR(peak / jonswapShape(2.0, 2.0, 1.0), 3.3, 1e-12);
}

}  // namespace
}  // namespace otter_nav::plant
