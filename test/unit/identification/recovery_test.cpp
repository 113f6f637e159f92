// The paper's model is found again in data simulated with it.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "identification/prediction.hpp"
#include "otter_nav/identification/identify.hpp"
#include "simulated.hpp"

namespace otter_nav::identification {
namespace {

const vessel::PaperModel kTruth{92.0, 31.0, 71.0, 140.0, 55.0};

vessel::Parameters guessOff() {
  vessel::Parameters guess;
  guess.name = "tested";
  guess.thrusters = {0.395, 119.7, 66.7};
  guess.paper = {60.0, 50.0, 110.0, 90.0, 30.0};
  guess.manoeuvring = vessel::ManoeuvringModel::fromPaper(guess.paper);
  return guess;
}

Options paperOnly() {
  Options options;
  options.fit_manoeuvring = false;
  return options;
}

Recording recordTruth(double duration_s, const testing::Noise& noise, std::uint64_t seed) {
  testing::RandomSteps steps(seed);
  return testing::record(
      testing::paperModel(kTruth), [&](double t) { return steps.at(t); }, duration_s, 0.01, noise,
      seed + 1000);
}

std::vector<double> truthVector() {
  return {kTruth.m1_kg, kTruth.m2_kgm2, kTruth.d1_kgps, kTruth.d2_kgps, kTruth.d3_kgm2ps};
}

void expectWithin(const Fit& fit, double relative) {
  const std::vector<double> truth = truthVector();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(fit.estimates[i].value, truth[i], relative * truth[i]) << fit.estimates[i].name;
  }
}

TEST(Recovery, WithoutNoiseWithinAPerMille) {
  const auto result = identify(recordTruth(120.0, {}, 1), guessOff(), paperOnly());
  ASSERT_TRUE(result) << result.error().message;
  expectWithin(result->paper, 0.001);
}

TEST(Recovery, WithOdometryNoiseWithinFivePercent) {
  for (std::uint64_t seed : {2, 3, 4}) {
    const auto result =
        identify(recordTruth(120.0, testing::odometryNoise(), seed), guessOff(), paperOnly());
    ASSERT_TRUE(result) << result.error().message;
    expectWithin(result->paper, 0.05);
  }
}

TEST(Recovery, FromMeasuredInitialStates) {
  Options options = paperOnly();
  options.problem.free_initial_states = false;
  const auto result = identify(recordTruth(120.0, {}, 5), guessOff(), options);
  ASSERT_TRUE(result) << result.error().message;
  expectWithin(result->paper, 0.001);
}

TEST(Recovery, WindLoadsOfTheGuessStay) {
  vessel::Parameters guess = guessOff();
  guess.manoeuvring.wind_surge_kgpm = 0.4;
  guess.manoeuvring.wind_sway_kgpm = 0.6;
  guess.manoeuvring.wind_yaw_kg = -0.2;
  for (const bool fit_manoeuvring : {false, true}) {
    Options options;
    options.fit_manoeuvring = fit_manoeuvring;
    const auto result = identify(recordTruth(60.0, {}, 11), guess, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->vessel.manoeuvring.wind_surge_kgpm, 0.4);
    EXPECT_EQ(result->vessel.manoeuvring.wind_sway_kgpm, 0.6);
    EXPECT_EQ(result->vessel.manoeuvring.wind_yaw_kg, -0.2);
  }
}

TEST(Recovery, CurrentIsFoundBeside) {
  Model model = testing::paperModel(kTruth);
  model.current_mps = {0.3, -0.4};
  testing::RandomSteps steps(6);
  const Recording recording = testing::record(
      model, [&](double t) { return steps.at(t); }, 120.0, 0.01, testing::odometryNoise(), 7);
  Options options = paperOnly();
  options.problem.estimate_current = true;
  const auto result = identify(recording, guessOff(), options);
  ASSERT_TRUE(result) << result.error().message;
  expectWithin(result->paper, 0.05);
  EXPECT_NEAR(result->paper.model.current_mps.x(), 0.3, 0.02);
  EXPECT_NEAR(result->paper.model.current_mps.y(), -0.4, 0.02);
}

TEST(Recovery, ManoeuvringModelPredictsWhatItWasMadeFrom) {
  Model model = testing::paperModel(kTruth);
  model.coefficients.sway_inertia_kg = 150.0;
  model.coefficients.surge_centripetal_kg = 150.0;
  model.coefficients.munk_kg = 60.0;
  model.coefficients.yaw_drag_quadratic_kgm2 = 120.0;
  model.coefficients.sway_drag_quadratic_kgpm = 80.0;
  testing::RandomSteps steps(8);
  const Recording recording = testing::record(
      model, [&](double t) { return steps.at(t); }, 150.0, 0.01, testing::odometryNoise(), 9);
  Options options;
  options.data.sample_interval_s = 0.1;
  const auto result = identify(recording, guessOff(), options);
  ASSERT_TRUE(result) << result.error().message;
  const auto error = [&](const Model& m) {
    return predictionError(result->data, result->split.validation_blocks, m, 5.0, 1.0).position_m;
  };
  EXPECT_LT(error(result->manoeuvring.model), 0.3 * error(result->paper.model));
  EXPECT_LT(error(result->manoeuvring.model), 1.1 * error(model));
}

// The standard errors say how much the estimates scatter from seed to seed.
TEST(Recovery, StandardErrorsMatchTheSpread) {
  constexpr int kRuns = 12;
  const std::vector<double> truth = truthVector();
  std::vector<double> spread2(truth.size(), 0.0);
  std::vector<double> stated2(truth.size(), 0.0);
  for (int run = 0; run < kRuns; ++run) {
    testing::RandomSteps steps(40);
    const Recording recording = testing::record(
        testing::paperModel(kTruth), [&](double t) { return steps.at(t); }, 90.0, 0.02,
        testing::odometryNoise(), 100 + static_cast<std::uint64_t>(run));
    const auto result = identify(recording, guessOff(), paperOnly());
    ASSERT_TRUE(result) << result.error().message;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const Estimate& e = result->paper.estimates[i];
      spread2[i] += (e.value - truth[i]) * (e.value - truth[i]) / kRuns;
      stated2[i] += e.standard_error * e.standard_error / kRuns;
    }
  }
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double ratio = std::sqrt(stated2[i] / spread2[i]);
    EXPECT_GT(ratio, 0.4) << i;
    EXPECT_LT(ratio, 2.5) << i;
  }
}

}  // namespace
}  // namespace otter_nav::identification
