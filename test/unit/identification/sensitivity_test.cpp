// The analytic derivatives of rollouts and of the cost against central differences.
#include "identification/sensitivity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "identification/problem.hpp"
#include "simulated.hpp"

namespace otter_nav::identification {
namespace {

constexpr double kDt = 0.05;
constexpr int kSteps = 40;

Model turningModel() {
  Model model;
  model.coefficients = {85.0, 150.0, 40.0, 140.0, 80.0,  60.0,  70.0,
                        90.0, 30.0,  5.0,  180.0, 300.0, -12.0, 20.0};
  model.thrusters = {0.395, 119.7, 66.7};
  model.current_mps = {0.3, -0.2};
  return model;
}

vessel::State startState() {
  return (vessel::State() << 1.0, -2.0, 0.4, 1.2, 0.2, -0.3).finished();
}

vessel::Thrusts thrustsAt(int i) {
  return {40.0 + i, 70.0 - 2.0 * i};
}

vessel::State rollout(const Model& model, vessel::State state) {
  for (int i = 0; i < kSteps; ++i) {
    state = step(model, thrustsAt(i), kDt, state);
  }
  return state;
}

TEST(Sensitivity, MatchesDifferencesOfTheRollout) {
  const Model model = turningModel();
  const CoefficientMap map = CoefficientMap::Identity(kCoefficientCount, kCoefficientCount);
  Sensitivity s = Sensitivity::Zero(vessel::kStateSize, kMaxColumns);
  s.rightCols<vessel::kStateSize>().setIdentity();
  vessel::State state = startState();
  for (int i = 0; i < kSteps; ++i) {
    stepWithSensitivity(model, map, true, thrustsAt(i), kDt, state, s);
  }
  EXPECT_LT((state - rollout(model, startState())).norm(), 1e-12);

  const auto compare = [&](int column, double h, const vessel::State& up,
                           const vessel::State& down) {
    const vessel::State expected = (up - down) / (2.0 * h);
    EXPECT_LT((s.col(column) - expected).norm(), 1e-6 + 1e-5 * expected.norm()) << column;
  };
  const Coefficients values = coefficientsOf(model.coefficients);
  for (int i = 0; i < kCoefficientCount; ++i) {
    const double h = 1e-3;
    Model up = model;
    Model down = model;
    up.coefficients = modelOf<vessel::ManoeuvringModel>(values + h * Coefficients::Unit(i));
    down.coefficients = modelOf<vessel::ManoeuvringModel>(values - h * Coefficients::Unit(i));
    compare(i, h, rollout(up, startState()), rollout(down, startState()));
  }
  for (int i = 0; i < 2; ++i) {
    const double h = 1e-5;
    Model up = model;
    Model down = model;
    up.current_mps[i] += h;
    down.current_mps[i] -= h;
    compare(kCoefficientCount + i, h, rollout(up, startState()), rollout(down, startState()));
  }
  for (int i = 0; i < vessel::kStateSize; ++i) {
    const double h = 1e-5;
    const vessel::State off = h * vessel::State::Unit(i);
    compare(kMaxParameters + i, h, rollout(model, startState() + off),
            rollout(model, startState() - off));
  }
}

TEST(Problem, GradientMatchesDifferencesOfTheCost) {
  const vessel::PaperModel h{92.0, 31.0, 71.0, 140.0, 55.0};
  testing::RandomSteps steps(1);
  const Recording recording = testing::record(
      testing::paperModel(h), [&](double t) { return steps.at(t); }, 40.0, 0.05,
      testing::odometryNoise(), 2);
  const Result<DataSet> data = assemble(recording, DataOptions(), 0.0);
  ASSERT_TRUE(data) << data.error().message;
  ProblemOptions options;
  options.estimate_current = true;
  const vessel::PaperModel guess{80.0, 40.0, 60.0, 100.0, 50.0};
  const Problem problem(*data, {{100, 181}}, paperSet(guess, PaperBounds(guess)),
                        testing::paperModel(h).thrusters, options);
  Eigen::VectorXd x = problem.startPoint();
  x.tail<8>() << 0.1, -0.1, 0.01, 0.02, 0.01, 0.02, -0.01, 0.03;
  WindowTerms terms;
  const double cost = problem.evaluateWindow(0, x, &terms);
  EXPECT_NEAR(cost, problem.evaluateWindow(0, x, nullptr), 1e-9 * cost);
  for (int i = 0; i < x.size(); ++i) {
    const double step = 1e-5 * std::max(1.0, std::abs(x[i]));
    const Eigen::VectorXd off = step * Eigen::VectorXd::Unit(x.size(), i);
    const double difference = (problem.evaluateWindow(0, x + off, nullptr) -
                               problem.evaluateWindow(0, x - off, nullptr)) /
                              (2.0 * step);
    EXPECT_NEAR(terms.gradient[i], difference, 1e-4 * std::abs(difference) + 1e-3) << i;
  }
}

TEST(Coefficients, RoundTripAndPaperMap) {
  Coefficients c;
  for (int i = 0; i < kCoefficientCount; ++i) {
    c[i] = i + 1.0;
  }
  EXPECT_EQ(coefficientsOf(modelOf<vessel::ManoeuvringModel>(c)), c);
  const vessel::PaperModel h{92.0, 31.0, 71.0, 140.0, 55.0};
  const ParameterSet set = paperSet(h, PaperBounds(h));
  EXPECT_EQ(Coefficients(set.map * coefficientsOf(h)),
            coefficientsOf(vessel::ManoeuvringModel::fromPaper(h)));
}

// A small boat's and a ship's alike: nothing is bounded by numbers of one vessel.
TEST(PaperSet, BoundsGoWithTheGuess) {
  for (const double size : {0.01, 1.0, 100.0}) {
    const vessel::PaperModel guess{92.0 * size, 31.0 * size, 71.0 * size, 140.0 * size,
                                   55.0 * size};
    for (const Parameter& p : paperSet(guess, PaperBounds(guess)).parameters) {
      EXPECT_DOUBLE_EQ(p.lower, p.guess / 20.0) << p.name;
      EXPECT_DOUBLE_EQ(p.upper, p.guess * 20.0) << p.name;
    }
  }
}

}  // namespace
}  // namespace otter_nav::identification
