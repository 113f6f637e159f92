// The estimator alone, fed with what the model does under known disturbances.
#include "tracker/estimator.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/rk4.hpp"
#include "otter_nav/tracker/options.hpp"

namespace otter_nav::tracker {
namespace {

using vessel::kPsi;
using vessel::kSurge;

constexpr double kStepS = 0.01;

EstimatorOptions shipped() {
  const auto options =
      config::load<Options>(std::string(OTTER_NAV_SOURCE_DIR) + "/config/tracker.yaml");
  EXPECT_TRUE(options) << options.error().message;
  return options->estimator;
}

// A vessel on a slow turn; `wave_m` of motion east and west with the waves on top of it.
struct Sea {
  vessel::Parameters vessel;
  vessel::Disturbance disturbance;
  vessel::State x = vessel::State::Zero();
  double t = 0.0;
  double wave_m = 0.0;
  double wave_radps = 2.0;

  double push_n = 22.0;  // of each thruster, more or less
  double turn_n = 2.0;

  vessel::Thrusts thrusts() const { return {push_n - turn_n, push_n + turn_n}; }
  void advance() {
    x = rk4Step(
        [&](double, const vessel::State& s) {
          return vessel::stateDerivative(s, thrusts(), vessel.manoeuvring, vessel.thrusters,
                                         disturbance);
        },
        t, x, kStepS);
    t += kStepS;
  }
  vessel::State measured() const {
    vessel::State m = x;
    const double rate = wave_m * wave_radps * std::cos(wave_radps * t);
    m[0] += wave_m * std::sin(wave_radps * t);
    m[kSurge] += std::cos(x[kPsi]) * rate;
    m[vessel::kSway] -= std::sin(x[kPsi]) * rate;
    return m;
  }
};

TEST(Estimator, FindsForceAndMoment) {
  Sea sea;
  sea.disturbance.force_n = {6.0, -9.0};
  sea.disturbance.moment_nm = 2.0;
  Estimator estimator(shipped(), sea.vessel);
  estimator.reset(sea.measured());
  for (int i = 0; i < 6000; ++i) {
    sea.advance();
    estimator.predict(sea.thrusts(), kStepS);
    estimator.update(sea.measured());
  }
  EXPECT_LT((estimator.disturbance().force_n - sea.disturbance.force_n).norm(), 0.1);
  EXPECT_NEAR(estimator.disturbance().moment_nm, 2.0, 0.05);
}

// The wind turns force and moment with the heading; a vessel that knows its wind loads finds it.
TEST(Estimator, FindsTheWindOfAVesselThatKnowsItsLoads) {
  Sea sea;
  sea.vessel.manoeuvring.wind_surge_kgpm = 0.5;
  sea.vessel.manoeuvring.wind_sway_kgpm = 0.5;
  sea.vessel.manoeuvring.wind_yaw_kg = -0.3;
  sea.disturbance.wind_mps = {3.0, -5.0};
  Estimator estimator(shipped(), sea.vessel);
  estimator.reset(sea.measured());
  for (int i = 0; i < 12000; ++i) {
    sea.advance();
    estimator.predict(sea.thrusts(), kStepS);
    estimator.update(sea.measured());
  }
  EXPECT_LT((estimator.disturbance().wind_mps - sea.disturbance.wind_mps).norm(), 0.5);
  EXPECT_LT(estimator.disturbance().force_n.norm(), 2.5);  // the prior's share
  // What is told of the uncertainty covers the error.
  using Estimate = vessel::DisturbanceEstimate;
  const Estimate told = estimator.disturbanceEstimate();
  const Eigen::Vector2d off = told.mean.wind_mps - sea.disturbance.wind_mps;
  const Eigen::Matrix2d of_wind = told.covariance.block<2, 2>(Estimate::kWind, Estimate::kWind);
  EXPECT_LT(off.dot(of_wind.inverse() * off), 9.0);
  EXPECT_EQ(told.covariance(Estimate::kCurrent, Estimate::kCurrent), 0.0);  // one drag: a force
}

// A hull that lies still on its heading doesn't tell a moment of its own from one of the wind: it
// is the wind's, which comes from another side then.
TEST(Estimator, PutsALastingMomentDownToTheWind) {
  Sea sea;
  sea.vessel.manoeuvring.wind_surge_kgpm = 0.5;
  sea.vessel.manoeuvring.wind_sway_kgpm = 0.5;
  sea.vessel.manoeuvring.wind_yaw_kg = -0.66;
  Estimator estimator(shipped(), sea.vessel);
  estimator.reset(sea.measured());
  for (int i = 0; i < 6000; ++i) {
    const double from_rad = i < 3000 ? 0.0 : 0.2;
    sea.disturbance.wind_mps = {-9.0 * std::cos(from_rad), -9.0 * std::sin(from_rad)};
    sea.push_n = 20.0 - 20.0 * sea.x[kSurge] - 5.0 * sea.x[0];
    sea.turn_n = -80.0 * sea.x[kPsi] - 60.0 * sea.x[vessel::kYawRate];
    sea.advance();
    estimator.predict(sea.thrusts(), kStepS);
    estimator.update(sea.measured());
  }
  EXPECT_LT(std::abs(estimator.disturbance().moment_nm), 1.5);
  const Eigen::Vector2d wind = -estimator.disturbance().wind_mps;
  EXPECT_NEAR(std::atan2(wind.y(), wind.x()), 0.2, 0.05);
}

vessel::Parameters otter() {
  return *vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/otter.yaml");
}

struct Off {
  double current_mps = 0.0;
  double force_n = 0.0;
  double moment_nm = 0.0;
};

// The most that the estimate is off in a second minute, in a current, a force and waves.
Off worstOff(double turn_n, double wave_m) {
  Sea sea;
  sea.vessel = otter();
  sea.push_n = 60.0;
  sea.turn_n = turn_n;
  sea.wave_m = wave_m;
  sea.wave_radps = 2.5;
  sea.disturbance.current_mps = {0.4, -0.2};
  sea.disturbance.force_n = {5.0, 8.0};
  Estimator estimator(shipped(), sea.vessel);
  estimator.reset(sea.measured());
  Off worst;
  for (int i = 0; i < 12000; ++i) {
    sea.advance();
    estimator.predict(sea.thrusts(), kStepS);
    estimator.update(sea.measured());
    if (i > 6000) {
      const vessel::Disturbance& found = estimator.disturbance();
      const auto off = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
        return (a - b).norm();
      };
      worst.current_mps =
          std::max(worst.current_mps, off(found.current_mps, sea.disturbance.current_mps));
      worst.force_n = std::max(worst.force_n, off(found.force_n, sea.disturbance.force_n));
      worst.moment_nm = std::max(worst.moment_nm, std::abs(found.moment_nm));
    }
  }
  return worst;
}

constexpr double kInCirclesN = 15.0;

TEST(Estimator, TellsTheCurrentFromAForceInCircles) {
  const Off off = worstOff(kInCirclesN, 0.0);
  EXPECT_LT(off.current_mps, 0.1);
  EXPECT_LT(off.force_n, 7.0);  // it fades
  EXPECT_LT(off.moment_nm, 8.0);
}

// What waves do to the hull is put down neither to a force nor to a moment.
TEST(Estimator, KeepsWavesOutOfTheForce) {
  const Off off = worstOff(kInCirclesN, 0.15);
  EXPECT_LT(off.current_mps, 0.5);
  EXPECT_LT(off.force_n, 25.0);
  EXPECT_LT(off.moment_nm, 45.0);
}

// Where the heading stays the same, force and current can't be told apart.
TEST(Estimator, KeepsForceAndCurrentTogetherOnASteadyCourse) {
  const Off off = worstOff(2.0, 0.15);
  EXPECT_LT(off.current_mps, 0.9);
  EXPECT_LT(off.force_n, 60.0);
}

// Once round in ten minutes, while the vessel sails on with waves: the force doesn't make up for
// the current of minutes ago.
TEST(Estimator, FollowsACurrentThatTurns) {
  constexpr double kCurrentMps = 0.5;
  constexpr double kTurnsRadps = 0.01;
  Sea sea;
  sea.vessel = otter();
  sea.push_n = 60.0;
  sea.turn_n = 0.5;
  sea.wave_m = 0.15;
  sea.wave_radps = 2.5;
  Estimator estimator(shipped(), sea.vessel);
  estimator.reset(sea.measured());
  double square = 0.0;
  double largest_n = 0.0;
  constexpr int kSteps = 30000;
  for (int i = 0; i < kSteps; ++i) {
    sea.disturbance.current_mps = kCurrentMps * unitVector(kTurnsRadps * sea.t);
    sea.advance();
    estimator.predict(sea.thrusts(), kStepS);
    estimator.update(sea.measured());
    const vessel::Disturbance& found = estimator.disturbance();
    square += (found.current_mps - sea.disturbance.current_mps).squaredNorm() / kSteps;
    largest_n = std::max(largest_n, found.force_n.norm());
  }
  EXPECT_LT(std::sqrt(square), 0.16);
  EXPECT_LT(largest_n, 20.0);  // there is none
}

// Root mean square of what the water's velocity half a second later is foreseen wrong by, and of
// that velocity: a hull at speed in a current and in waves that take it along.
struct Foreseen {
  double off_mps = 0.0;
  double of_mps = 0.0;
  double current_off_mps = 0.0;  // at the end
};

Foreseen foreseenBy(Waves waves) {
  constexpr double kAheadS = 0.5;
  constexpr double kOrbitalMps = 0.2;
  constexpr double kRadps = 1.8;
  Sea sea;
  sea.vessel = otter();
  sea.disturbance.current_mps = {0.3, -0.2};
  const auto water = [&](double t) -> WaterMotion {
    return {{kOrbitalMps * std::sin(kRadps * t), 0.5 * kOrbitalMps * std::sin(kRadps * t)},
            kRadps * Eigen::Vector2d(kOrbitalMps * std::cos(kRadps * t),
                                     0.5 * kOrbitalMps * std::cos(kRadps * t))};
  };
  const vessel::Thrusts thrusts(58.0, 62.0);
  Estimator estimator(shipped(), sea.vessel, waves);
  estimator.reset(sea.x);
  Foreseen result;
  int count = 0;
  for (int i = 0; i < 9000; ++i) {
    sea.x = rk4Step(
        [&](double t, const vessel::State& s) {
          return derivativeInWater(s, thrusts, sea.vessel, sea.disturbance, water(t));
        },
        sea.t, sea.x, kStepS);
    sea.t += kStepS;
    estimator.predict(thrusts, kStepS);
    estimator.update(sea.x);
    if (i > 6000) {
      const Eigen::Vector2d then = water(sea.t + kAheadS).velocity_mps;
      result.off_mps += (estimator.water().at(kAheadS).velocity_mps - then).squaredNorm();
      result.of_mps += then.squaredNorm();
      ++count;
    }
  }
  result.off_mps = std::sqrt(result.off_mps / count);
  result.of_mps = std::sqrt(result.of_mps / count);
  result.current_off_mps =
      (estimator.disturbance().current_mps - sea.disturbance.current_mps).norm();
  return result;
}

TEST(Estimator, ForeseesTheWater) {
  const Foreseen seaway = foreseenBy(Waves::kInTheWater);
  EXPECT_LT(seaway.off_mps, 0.5 * seaway.of_mps);
  EXPECT_LT(seaway.current_off_mps, 0.15);
  const Foreseen on_top = foreseenBy(Waves::kOnTop);
  EXPECT_EQ(on_top.off_mps, on_top.of_mps);
}

// Largest error of the estimated velocity against the motion without its waves, at crawling pace.
double worstVelocityError(const EstimatorOptions& options) {
  Sea sea;
  sea.push_n = 5.0;
  sea.wave_m = 0.1;
  Estimator estimator(options, sea.vessel);
  estimator.reset(sea.measured());
  double worst = 0.0;
  for (int i = 0; i < 8000; ++i) {
    sea.advance();
    estimator.predict(sea.thrusts(), kStepS);
    estimator.update(sea.measured());
    if (i > 4000) {
      const vessel::State error = estimator.state() - sea.x;
      worst = std::max(worst, error.segment<2>(kSurge).norm());
    }
  }
  return worst;
}

TEST(Estimator, LeavesWaveMotionAside) {
  EstimatorOptions options = shipped();
  options.wave_velocity_mps = 0.0;
  const double without = worstVelocityError(options);
  options.wave_velocity_mps = 0.15;
  const double with = worstVelocityError(options);
  EXPECT_GT(without, 0.05);
  EXPECT_LT(with, 0.25 * without);
}

// How far a state of the estimator is off the measured position at most, in waves of 0.1 m.
template <typename StateOf>
double worstPositionOff(double push_n, StateOf stateOf) {
  Sea sea;
  sea.push_n = push_n;
  sea.wave_m = 0.1;
  Estimator estimator(shipped(), sea.vessel);
  estimator.reset(sea.measured());
  double worst = 0.0;
  for (int i = 0; i < 6000; ++i) {
    sea.advance();
    estimator.predict(sea.thrusts(), kStepS);
    estimator.update(sea.measured());
    if (i > 4000) {
      worst = std::max(worst, (stateOf(estimator) - sea.measured()).template head<2>().norm());
    }
  }
  return worst;
}

// At speed nothing of the motion is put down to waves.
TEST(Estimator, TakesNothingForWavesAtSpeed) {
  EXPECT_LT(worstPositionOff(90.0, [](const Estimator& e) { return e.state(); }), 0.03);
}

TEST(Estimator, IsSteeredAgainstWavesAtSpeedAlone) {
  const auto steered = [](const Estimator& e) { return e.steered(); };
  EXPECT_GT(worstPositionOff(5.0, steered), 0.06);
  EXPECT_LT(worstPositionOff(90.0, steered), 0.03);
}

// The waves' frequency is learned: a swell is left aside as well as a lake's short waves.
TEST(Estimator, LeavesSwellAside) {
  for (const double radps : {1.26, 2.0}) {
    Sea sea;
    sea.push_n = 5.0;
    sea.turn_n = 0.0;
    sea.x[kPsi] = 1.5;
    sea.wave_m = 0.1;
    sea.wave_radps = radps;
    Estimator estimator(shipped(), sea.vessel);
    estimator.reset(sea.measured());
    double worst = 0.0;
    for (int i = 0; i < 9000; ++i) {
      sea.advance();
      estimator.predict(sea.thrusts(), kStepS);
      estimator.update(sea.measured());
      if (i > 7000) {
        worst = std::max(worst, (estimator.steered() - sea.x).head<2>().norm());
      }
    }
    EXPECT_LT(worst, 0.04) << radps << " rad/s";
  }
}

}  // namespace
}  // namespace otter_nav::tracker
