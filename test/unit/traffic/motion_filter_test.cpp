// The filter on motion drawn from its own models: its covariance is what it claims to be.
#include "traffic/motion_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/random.hpp"
#include "traffic/association.hpp"

namespace otter_nav::traffic {
namespace {

Measurement at(const Eigen::Vector2d& position, double deviation_m) {
  Measurement measurement;
  measurement.value.head<2>() = position;
  measurement.covariance.topLeftCorner<2, 2>().diagonal().setConstant(deviation_m * deviation_m);
  return measurement;
}

// Straight legs with a little noise and turns now and then, as the models have them.
class Vessel {
 public:
  explicit Vessel(Random& random) : random_(random) {
    const double course = random.uniform(-kPi, kPi);
    velocity_ = random.uniform(0.5, 3.0) * Eigen::Vector2d(std::cos(course), std::sin(course));
  }
  void sail(double time_s) {
    constexpr double kStepS = 0.05;
    for (double t = 0.0; t < time_s - 1e-9; t += kStepS) {
      if (random_.uniform() < kStepS / (turning_ ? 2.0 : 120.0)) {
        turning_ = !turning_;
        rate_radps_ = turning_ ? 0.2 * random_.normal() : 0.0;
      }
      const double acceleration = turning_ ? 0.2 : 0.0002;
      const double angle = rate_radps_ * kStepS;
      const Eigen::Vector2d before = velocity_;
      velocity_ =
          Eigen::Vector2d(std::cos(angle) * before.x() - std::sin(angle) * before.y(),
                          std::sin(angle) * before.x() + std::cos(angle) * before.y()) +
          std::sqrt(acceleration * kStepS) * Eigen::Vector2d(random_.normal(), random_.normal());
      position_ += 0.5 * kStepS * (before + velocity_);
    }
  }
  [[nodiscard]] Eigen::Vector4d state() const {
    return (Eigen::Vector4d() << position_, velocity_).finished();
  }

 private:
  Random& random_;
  Eigen::Vector2d position_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity_;
  bool turning_ = false;
  double rate_radps_ = 0.0;
};

// Normalised estimation error squared, averaged over runs: of four components, chi squared with 4
// degrees of freedom a run. The band holds 95 % of the averages (normal approximation).
TEST(MotionFilter, IsConsistent) {
  constexpr int kRuns = 100;
  constexpr int kSeconds = 40;
  std::vector<double> sum(kSeconds, 0.0);
  Random random(21);
  for (int run = 0; run < kRuns; ++run) {
    Vessel vessel(random);
    const auto measured = [&] {
      return at(vessel.state().head<2>() + Eigen::Vector2d(random.normal(), random.normal()), 1.0);
    };
    MotionFilter filter(measured(), 0.0);
    for (int second = 1; second <= kSeconds; ++second) {
      vessel.sail(1.0);
      filter.predict(second);
      filter.update(measured());
      const Eigen::Vector4d off = vessel.state() - filter.state().head<4>();
      const Eigen::Matrix4d p = filter.likelyCovariance().topLeftCorner<4, 4>();
      sum[static_cast<std::size_t>(second - 1)] += off.dot(p.inverse() * off) / kRuns;
    }
  }
  const double half_band = 1.96 * std::sqrt(2.0 * 4.0 / kRuns);
  double mean = 0.0;
  for (int second = 5; second < kSeconds; ++second) {
    mean += sum[static_cast<std::size_t>(second)] / (kSeconds - 5);
  }
  EXPECT_NEAR(mean, 4.0, half_band) << mean;
}

// So far off that every model's density is nothing at all: she stays where she was.
TEST(MotionFilter, KeepsHerWhereNoModelExplainsWhatWasSeen) {
  MotionFilter filter(at({300.0, 200.0}, 0.5), 0.0);
  for (int k = 1; k <= 10; ++k) {
    filter.predict(k);
    filter.update(at({300.0 + k, 200.0}, 0.5));
  }
  const MotionState before = filter.state();
  const MotionCovariance covariance = filter.covariance();
  filter.update(at({5000.0, -3000.0}, 0.5));
  EXPECT_LT((filter.state() - before).norm(), 1e-6);
  EXPECT_LT((filter.covariance() - covariance).norm(), 1e-6);
}

// What counts is a probability: a straight way makes all other models improbable, down to a limit.
TEST(MotionFilter, SharesOutWhatIsProbable) {
  MotionFilter filter(at({300.0, 200.0}, 0.1), 0.0);
  for (int k = 1; k <= 200; ++k) {
    filter.predict(0.05 * k, 0.1);
    filter.update(at({300.0 + 0.1 * k, 200.0}, 0.1));
    // A mean of models that are all there is where they all are.
    EXPECT_NEAR(filter.state().y(), 200.0, 1e-4);
  }
}

TEST(MotionFilter, FollowsATurnAndTheLegAfterIt) {
  MotionFilter filter(at({0.0, 0.0}, 0.5), 0.0);
  const auto truth = [](double t) {
    return t < 20.0 ? Eigen::Vector2d(2.0 * t, 0.0) : Eigen::Vector2d(40.0, 2.0 * (t - 20.0));
  };
  for (int k = 1; k <= 20; ++k) {
    filter.predict(k);
    filter.update(at(truth(k), 0.5));
  }
  EXPECT_LT(filter.turningProbability(), 0.2);
  EXPECT_NEAR(filter.state()[2], 2.0, 0.1);
  double most = 0.0;
  for (int k = 21; k <= 50; ++k) {
    filter.predict(k);
    filter.update(at(truth(k), 0.5));
    most = std::max(most, filter.turningProbability());
  }
  EXPECT_GT(most, 0.8);  // she turned at once
  EXPECT_NEAR(filter.state()[3], 2.0, 0.1);
  EXPECT_NEAR(filter.state()[2], 0.0, 0.1);
}

// Back on her own track at a corner without any turn, seen by lidar.
TEST(MotionFilter, IsSoonOffOnANewCourseWhereThatIsReckonedWith) {
  constexpr double kMps = 3.0;
  constexpr double kScanS = 1.0 / 15.0;
  for (const double anew_per_s : {0.1, 0.0}) {
    MotionFilter filter(at({0.0, 0.0}, 0.5), 0.0);
    double t = 0.0;
    const auto sail = [&](double until_s) {
      while (t < until_s) {
        t += kScanS;
        filter.predict(t, anew_per_s);
        filter.update(at({kMps * (t < 8.0 ? t : 16.0 - t), 0.0}, 0.5));
      }
    };
    sail(8.0);
    EXPECT_NEAR(filter.usualState()[2], kMps, 0.2);
    EXPECT_LT(filter.usualCovariance()(2, 2), 0.1);
    // On the way back there at once, at either end of what the radar's next plot could be.
    MotionFilter after = filter;
    after.predict(t + 1.0, anew_per_s);
    const Measurement back = at({kMps * (7.0 - (t - 8.0)), 0.0}, 1.0);
    const bool is_hers = after.gateDistance2(back) < 16.0;
    EXPECT_EQ(is_hers, anew_per_s > 0.0);
    sail(9.3);
    const double off = std::abs(filter.usualState()[2] + kMps);
    if (anew_per_s > 0.0) {
      EXPECT_LT(off, 0.8);
    } else {
      EXPECT_GT(off, 1.2);
    }
  }
}

// Fast on a small circle, by radar first and then by lidar: she may have been on any new course,
// but it is a turn that is made of it, at her rate.
TEST(MotionFilter, KnowsWhoGoesRoundFastWhereNewCoursesAreReckonedWith) {
  constexpr double kRadiusM = 5.5;
  constexpr double kMps = 3.9;
  constexpr double kRate = kMps / kRadiusM;
  constexpr double kAnewPerS = 0.1;
  constexpr int kRuns = 10;
  Random random(6);
  for (int run = 0; run < kRuns; ++run) {
    const auto seen = [&](double t, double deviation_m) {
      const double east = random.normal();  // the order of arguments is the compiler's
      const Eigen::Vector2d off(east, random.normal());
      const Eigen::Vector2d middle = kRadiusM * unitVector(kRate * t);
      return at(middle + deviation_m * off, std::max(0.5, deviation_m));
    };
    MotionFilter filter(seen(0.0, 1.0), 0.0);
    for (int second = 1; second <= 8; ++second) {
      filter.predict(second, kAnewPerS);
      filter.update(seen(second, 1.0));
    }
    double now = 8.0;
    for (int scan = 1; scan <= 60; ++scan) {
      now = 8.0 + scan / 15.0;
      filter.predict(now, kAnewPerS);
      filter.update(seen(now, 0.1));
    }
    const Eigen::Vector2d velocity = kMps * across(unitVector(kRate * now));
    EXPECT_LT((filter.usualState().segment<2>(2) - velocity).norm(), 0.6);
    EXPECT_NEAR(filter.usualState()[4], kRate, 0.25);
  }
}

// Round and round at 1.5 m/s on a circle of 10 m, seen by radar.
TEST(MotionFilter, LearnsATurnThatLasts) {
  constexpr double kRate = 0.15;
  constexpr int kRuns = 20;
  double rate = 0.0;
  double steady = 0.0;
  double square = 0.0;
  Random random(5);
  for (int run = 0; run < kRuns; ++run) {
    const auto truth = [](double t) {
      return Eigen::Vector2d(10.0 * std::sin(kRate * t), -10.0 * std::cos(kRate * t));
    };
    const auto measured = [&](double t) {
      return at(truth(t) + Eigen::Vector2d(random.normal(), random.normal()), 1.0);
    };
    MotionFilter filter(measured(0.0), 0.0);
    for (int second = 1; second <= 60; ++second) {
      filter.predict(second);
      filter.update(measured(second));
    }
    const Eigen::Vector2d velocity =
        1.5 * Eigen::Vector2d(std::cos(60.0 * kRate), std::sin(60.0 * kRate));
    rate += filter.state()[4] / kRuns;
    steady += filter.turningProbability() * filter.steadiness() / kRuns;
    square += (filter.state().segment<2>(2) - velocity).squaredNorm() / kRuns;
  }
  EXPECT_NEAR(rate, kRate, 0.03);
  EXPECT_GT(steady, 0.8);
  EXPECT_LT(std::sqrt(square), 0.45);
}

// A hull that begins to turn gently, met by lidar at its middle; `leeway_rad`: she lies so much to
// port of her course. How far off it the filter has her course at the end, rad.
double courseOffOfWhoBeginsToTurn(bool by_sides, double leeway_rad, double turns_for_s,
                                  Random& random) {
  constexpr double kMps = 2.3;
  constexpr double kRate = -0.17;
  constexpr double kScanS = 1.0 / 15.0;
  constexpr double kBeginsS = 6.0;
  const double until_s = kBeginsS + turns_for_s;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double course = 0.7;
  MotionFilter filter(at(position, 0.3), 0.0);
  for (int scan = 1; scan * kScanS < until_s; ++scan) {
    const double now = scan * kScanS;
    course += now > kBeginsS ? kScanS * kRate : 0.0;
    position += kScanS * kMps * unitVector(course);
    filter.predict(now, 0.1);
    const double east = random.normal();  // the order of arguments is the compiler's
    filter.update(at(position + 0.1 * Eigen::Vector2d(east, random.normal()), 0.3));
    if (by_sides) {
      // Any of the four, with what a search among thirty directions is off.
      const double quarters = std::floor(random.uniform(0.0, 4.0));
      const double error = 0.03 * random.normal();
      filter.update(Sides{course + leeway_rad + error + 0.5 * kPi * quarters, 0.08});
    }
  }
  const Eigen::Vector2d velocity = filter.usualState().segment<2>(2);
  return std::abs(wrapAngle(angleOf(velocity) - course));
}

TEST(MotionFilter, KnowsTheCourseOfWhoBeginsToTurnByHerSides) {
  constexpr int kRuns = 40;
  constexpr double kTurnsForS = 1.5;
  Random random(8);
  double with = 0.0;
  double without = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    with += courseOffOfWhoBeginsToTurn(true, 0.0, kTurnsForS, random) / kRuns;
    without += courseOffOfWhoBeginsToTurn(false, 0.0, kTurnsForS, random) / kRuns;
  }
  EXPECT_LT(with, 0.1);
  EXPECT_GT(without, 1.5 * with);
}

// Wind and current set a hull aside from where she points: that is no turn, and no other course.
TEST(MotionFilter, LearnsHowFarAHullLiesOffHerCourse) {
  constexpr int kRuns = 20;
  Random random(9);
  double off = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    off += courseOffOfWhoBeginsToTurn(true, 0.25, 0.0, random) / kRuns;
  }
  EXPECT_LT(off, 0.03);
}

// Against all events written out by hand.
TEST(Association, GivesEachDetectionToOneTrack) {
  const std::vector<double> none = {0.2, 0.3};
  const std::vector<std::vector<Link>> links = {{{0, 2.0}, {1, 0.5}}, {{0, 1.5}}};
  const Marginals m = jointMarginals(none, links, 3);
  const double total = 0.2 * 0.3 + 0.2 * 1.5 + 2.0 * 0.3 + 0.5 * 0.3 + 0.5 * 1.5;
  EXPECT_NEAR(m.none[0], (0.2 * 0.3 + 0.2 * 1.5) / total, 1e-12);
  EXPECT_NEAR(m.links[0][0], 2.0 * 0.3 / total, 1e-12);
  EXPECT_NEAR(m.links[0][1], (0.5 * 0.3 + 0.5 * 1.5) / total, 1e-12);
  EXPECT_NEAR(m.none[1], (0.2 * 0.3 + 2.0 * 0.3 + 0.5 * 0.3) / total, 1e-12);
  EXPECT_NEAR(m.links[1][0], (0.2 * 1.5 + 0.5 * 1.5) / total, 1e-12);
}

TEST(Association, BearsCrowds) {
  Random random(2);
  std::vector<double> none(12, 0.1);
  std::vector<std::vector<Link>> links(12);
  for (auto& of_track : links) {
    for (std::size_t k = 0; k < 10; ++k) {
      of_track.push_back({k, random.uniform()});
    }
  }
  const Marginals m = jointMarginals(none, links, 10);
  for (std::size_t t = 0; t < 12; ++t) {
    double sum = m.none[t];
    for (const double link : m.links[t]) {
      sum += link;
    }
    EXPECT_NEAR(sum, 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace otter_nav::traffic
