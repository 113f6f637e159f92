// What the disturbances' statistics promise.
#include <gtest/gtest.h>

#include "otter_nav/base/angles.hpp"
#include "plant/current.hpp"
#include "plant/waves.hpp"
#include "plant/wind.hpp"

namespace otter_nav::plant {
namespace {

TEST(WindStatistics, GustsHaveTheirVarianceAndCorrelation) {
  WindOptions options;
  options.speed_mps = 8.0;
  options.gust_intensity = 0.15;
  options.gust_time_s = 2.0;
  Wind wind(options, 5);
  constexpr int kSamples = 400000;
  constexpr double kStep = 0.05;
  constexpr int kLag = 40;  // one correlation time
  std::vector<double> speed;
  for (int i = 0; i < kSamples; ++i) {
    wind.advance(kStep);
    speed.push_back(wind.velocity().x() - options.speed_mps);
  }
  double mean = 0.0;
  double variance = 0.0;
  double covariance = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    mean += speed[i] / kSamples;
    variance += speed[i] * speed[i] / kSamples;
    covariance += i >= kLag ? speed[i] * speed[i - kLag] / kSamples : 0.0;
  }
  EXPECT_NEAR(mean, 0.0, 0.06);
  EXPECT_NEAR(std::sqrt(variance), 1.2, 0.05);
  EXPECT_NEAR(covariance / variance, std::exp(-1.0), 0.04);
}

TEST(WindStatistics, GustsDoNotDependOnTheStep) {
  WindOptions options;
  options.speed_mps = 10.0;
  options.gust_intensity = 0.1;
  options.gust_time_s = 1.0;
  for (const double step : {0.01, 1.0}) {
    Wind wind(options, 9);
    double variance = 0.0;
    constexpr int kSamples = 100000;
    for (int i = 0; i < kSamples; ++i) {
      wind.advance(step);
      variance += std::pow(wind.velocity().x() - 10.0, 2) / kSamples;
    }
    EXPECT_NEAR(std::sqrt(variance), 1.0, 0.1) << "step " << step;
  }
}

TEST(CurrentStatistics, TurnsAtItsRate) {
  CurrentOptions options;
  options.speed_mps = 0.5;
  options.direction_rad = 1.0;
  options.turning_radps = 0.01;
  Current current(options, 1);
  for (int i = 0; i < 5000; ++i) current.advance(0.01);
  EXPECT_NEAR(current.velocity().x(), 0.5 * std::cos(1.5), 1e-9);
  EXPECT_NEAR(current.velocity().y(), 0.5 * std::sin(1.5), 1e-9);
}

WaveField sea(std::uint64_t seed) {
  WaveOptions options;
  options.spectrum.significant_height_m = 0.3;
  return WaveField(options, seed);
}

// Four times the standard deviation of the surface, over places and times far apart.
TEST(WaveStatistics, SeaHasItsSignificantHeight) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const WaveField field = sea(seed);
    Random random(seed);
    double variance = 0.0;
    constexpr int kSamples = 40000;
    for (int i = 0; i < kSamples; ++i) {
      const Eigen::Vector2d p(random.uniform(-500.0, 500.0), random.uniform(-500.0, 500.0));
      variance += std::pow(field.elevation(p, random.uniform(0.0, 1000.0)), 2) / kSamples;
    }
    EXPECT_NEAR(4.0 * std::sqrt(variance), 0.3, 0.01);
  }
}

TEST(WaveStatistics, SeaHasItsPeakPeriod) {
  const WaveField field = sea(4);
  // The mean period between upward zero crossings of JONSWAP is about 0.78 of the peak's.
  int crossings = 0;
  constexpr double kStep = 0.02;
  constexpr int kSamples = 100000;
  double before = field.elevation({0.0, 0.0}, 0.0);
  for (int i = 1; i < kSamples; ++i) {
    const double now = field.elevation({0.0, 0.0}, i * kStep);
    crossings += before < 0.0 && now >= 0.0 ? 1 : 0;
    before = now;
  }
  EXPECT_NEAR(kSamples * kStep / crossings / 2.2, 0.78, 0.06);
}

TEST(WaveStatistics, SeedsDiffer) {
  EXPECT_NE(sea(1).elevation({3.0, 4.0}, 5.0), sea(2).elevation({3.0, 4.0}, 5.0));
  EXPECT_EQ(sea(1).elevation({3.0, 4.0}, 5.0), sea(1).elevation({3.0, 4.0}, 5.0));
}

}  // namespace
}  // namespace otter_nav::plant
