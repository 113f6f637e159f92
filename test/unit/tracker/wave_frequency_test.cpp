#include "tracker/wave_frequency.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::tracker {
namespace {

constexpr double kSampleS = 0.01;
constexpr double kUsualRadps = 2.0;

struct Swell {
  double radps = kUsualRadps;
  double amplitude_m = 0.0;
  double drift_mps = 0.0;
  double yaw_rate_radps = 0.0;
  double crawling = 1.0;
  double noise_mps = 0.0;
};

// What is found after a minute and a half.
double found(const Swell& swell) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise;
  WaveFrequency frequency;
  for (double t = 0.0; t < 90.0; t += kSampleS) {
    const double sway = swell.drift_mps +
                        swell.amplitude_m * swell.radps * std::cos(swell.radps * t) +
                        swell.noise_mps * noise(random);
    frequency.add(sway, swell.yaw_rate_radps, swell.crawling, kSampleS);
  }
  return frequency.radps();
}

TEST(WaveFrequency, IsFoundFromTheSway) {
  for (const double radps : {1.1, 1.26, 1.6, 2.5, 2.9}) {
    Swell swell{radps, 0.09};
    EXPECT_NEAR(found(swell), radps, 0.1 * radps);
    swell.drift_mps = 0.3;
    swell.noise_mps = 0.02;
    EXPECT_NEAR(found(swell), radps, 0.1 * radps) << "in a current, with noise";
  }
  EXPECT_NEAR(found({1.26, 0.09, 0.0, 0.12}), 1.26, 0.126) << "turning a little";
}

TEST(WaveFrequency, StaysTheUsualWhereNoWavesAreFelt) {
  EXPECT_NEAR(found({1.26, 0.0, 0.2, 0.0, 1.0, 0.02}), kUsualRadps, 0.1);
  EXPECT_EQ(found({1.26, 0.09, 0.0, 0.0, 0.0}), kUsualRadps) << "at speed";
  EXPECT_EQ(found({1.26, 0.09, 0.0, 0.2, 1.0}), kUsualRadps) << "in a turn";
}

// Half a way among narrow places is sailed by then.
TEST(WaveFrequency, IsFoundSoonWhereAHullThatCrawlsTurnsALittle) {
  for (const double radps : {1.26, 2.5}) {
    for (int k = 0; k < 8; ++k) {
      WaveFrequency frequency;
      for (double t = 0.0; t < 20.0; t += kSampleS) {
        const double sway = 0.09 * radps * std::cos(radps * t + 0.25 * kPi * k);
        frequency.add(sway, 0.12 * std::sin(0.7 * t), 1.0, kSampleS);
      }
      EXPECT_NEAR(frequency.radps(), radps, 0.25 * radps) << "eighth " << k;
    }
  }
}

// What sways a hull that is launched in gusts is no swell.
TEST(WaveFrequency, IsNotLearnedFromALaunch) {
  WaveFrequency frequency;
  for (double t = 0.0; t < 120.0; t += kSampleS) {
    const bool launch = std::fmod(t, 30.0) < 12.0;
    frequency.add(0.2 * std::cos(0.8 * t), 0.0, launch ? 1.0 : 0.0, kSampleS);
  }
  EXPECT_EQ(frequency.radps(), kUsualRadps);
  for (double t = 0.0; t < 16.0; t += kSampleS) {
    frequency.add(0.0, 0.0, 1.0, kSampleS);
  }
  EXPECT_NEAR(frequency.radps(), kUsualRadps, 0.1) << "nor once she lies still";
}

// What is slower than waves is none, however much it moves the hull.
TEST(WaveFrequency, IsNoSlowerThanWavesAre) {
  EXPECT_GE(found({0.3, 1.0}), 1.0);
}

// When it is known that they are so and no otherwise, or that there are none.
double knownAfter(double amplitude_m, double crawling) {
  WaveFrequency frequency;
  double t = 0.0;
  while (!frequency.isKnown() && t < 60.0) {
    frequency.add(amplitude_m * 1.26 * std::cos(1.26 * t), 0.0, crawling, kSampleS);
    t += kSampleS;
  }
  return t;
}

TEST(WaveFrequency, TellsWhenItIsKnown) {
  EXPECT_NEAR(knownAfter(0.09, 1.0), 15.0, 1.0);
  EXPECT_NEAR(knownAfter(0.005, 1.0), 3.0, 0.1) << "calm";
  EXPECT_GE(knownAfter(0.09, 0.0), 60.0) << "at speed";
}

}  // namespace
}  // namespace otter_nav::tracker
