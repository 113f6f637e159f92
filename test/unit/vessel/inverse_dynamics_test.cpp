// Inverse dynamics against the equations of motion, its gradients against finite differences.
#include "otter_nav/vessel/inverse_dynamics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/random.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::vessel {
namespace {

using Eigen::Vector2d;

// Drag, inertia and wind loads all differ from each other.
Parameters someVessel() {
  Parameters p;
  p.paper = {40.0, 12.0, 18.0, 27.0, 22.0};
  p.manoeuvring = ManoeuvringModel::fromPaper(p.paper);
  p.manoeuvring.wind_surge_kgpm = 0.4;
  p.manoeuvring.wind_sway_kgpm = 0.6;
  p.manoeuvring.wind_yaw_kg = -0.7;
  return p;
}

std::vector<Disturbance> weathers() {
  Disturbance current;
  current.current_mps = {0.3, -0.4};
  Disturbance push;
  push.force_n = {-4.0, 6.0};
  push.moment_nm = 1.5;
  Disturbance all = push;
  all.current_mps = {-0.2, 0.3};
  all.wind_mps = {3.0, 4.0};
  return {{}, current, push, all};
}

Vector2d random2(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size)};
}

FlatPoint underWay(Random& random) {
  FlatPoint z;
  z.velocity = Vector2d(2.0, 0.5) + random2(random, 0.5);
  z.acceleration = random2(random, 0.4);
  z.jerk = random2(random, 0.4);
  z.snap = random2(random, 0.5);
  return z;
}

// Moves along the path by `dt_s`.
FlatPoint later(FlatPoint z, double t) {
  z.position += t * z.velocity + t * t / 2 * z.acceleration + t * t * t / 6 * z.jerk;
  z.velocity += t * z.acceleration + t * t / 2 * z.jerk + t * t * t / 6 * z.snap;
  z.acceleration += t * z.jerk + t * t / 2 * z.snap;
  z.jerk += t * z.snap;
  return z;
}

// State and thrusts of a path obey the equations of motion, in any weather.
TEST(InverseDynamics, GivesTheMotionBack) {
  const Parameters vessel = someVessel();
  Random random(2);
  for (const Disturbance& weather : weathers()) {
    const InverseDynamics inverse(vessel, weather);
    for (int trial = 0; trial < 50; ++trial) {
      const FlatPoint z = underWay(random);
      const FlatState now = inverse.state(z, z.velocity);
      const double h = 1e-5;
      const State after = inverse.state(later(z, h), z.velocity).state;
      const State before = inverse.state(later(z, -h), z.velocity).state;
      const State rate = (after - before) / (2.0 * h);
      const State expected = stateDerivative(now.state, thrustsFromTau(now.tau, vessel.thrusters),
                                             vessel.manoeuvring, vessel.thrusters, weather);
      EXPECT_LT((rate - expected).cwiseAbs().maxCoeff(), 1e-5) << rate.transpose() << "\n"
                                                               << expected.transpose();
    }
  }
}

TEST(InverseDynamics, GradientMatchesDifferences) {
  Random random(3);
  for (const Disturbance& weather : weathers()) {
    const InverseDynamics inverse(someVessel(), weather);
    for (const double floor_n : {1.0, 200.0}) {
      if (floor_n > 100.0 && !weather.wind_mps.isZero()) {
        continue;  // a floored D leaves the search of the bow in wind unfinished
      }
      for (int trial = 0; trial < 20; ++trial) {
        const FlatPoint z = underWay(random);
        const FlatGradient g = inverse.gradient(z, floor_n);
        for (int order = 0; order < 4; ++order) {
          for (int axis = 0; axis < 2; ++axis) {
            constexpr double kStep = 1e-5;
            const auto at = [&](double off) {
              FlatPoint moved = z;
              Vector2d* const orders[] = {&moved.velocity, &moved.acceleration, &moved.jerk,
                                          &moved.snap};
              (*orders[order])[axis] += off;
              return inverse.gradient(moved, floor_n);
            };
            const FlatGradient up = at(kStep);
            const FlatGradient down = at(-kStep);
            const auto compare = [&](const FlatRow& row, double higher, double lower) {
              const double slope = (higher - lower) / (2.0 * kStep);
              EXPECT_NEAR(row(axis, order), slope, 1e-5 * (1.0 + std::abs(slope)))
                  << order << ' ' << axis;
            };
            compare(g.yaw_rate, up.yaw_rate_radps, down.yaw_rate_radps);
            if (floor_n < 100.0) {  // with the floor at work the bow is not a unit vector
              compare(g.surge, up.surge_n, down.surge_n);
              compare(g.difference, up.difference_n, down.difference_n);
            }
          }
        }
      }
    }
  }
}

// A floored D leaves the search of the bow in wind unfinished: its slopes are near, not the same.
TEST(InverseDynamics, TheFlooredGradientInWindIsNear) {
  constexpr double kStep = 1e-5;
  constexpr double kFloorN = 200.0;
  Random random(3);
  for (const Disturbance& weather : weathers()) {
    const InverseDynamics inverse(someVessel(), weather);
    std::vector<double> errors;
    for (int trial = 0; trial < 200 && !weather.wind_mps.isZero(); ++trial) {
      const FlatPoint z = underWay(random);
      const FlatGradient g = inverse.gradient(z, kFloorN);
      for (int axis = 0; axis < 2; ++axis) {
        const auto surgeAt = [&](double off) {
          FlatPoint moved = z;
          moved.acceleration[axis] += off;
          return inverse.gradient(moved, kFloorN).surge_n;
        };
        const double slope = (surgeAt(kStep) - surgeAt(-kStep)) / (2.0 * kStep);
        errors.push_back(std::abs(g.surge(axis, 1) - slope) / (1.0 + std::abs(slope)));
      }
    }
    if (!errors.empty()) {
      const auto middle = errors.begin() + static_cast<long>(errors.size() / 2);
      std::nth_element(errors.begin(), middle, errors.end());
      EXPECT_LT(*middle, 0.06);
    }
  }
}

TEST(InverseDynamics, GradientAndSailingHaveTheSameValues) {
  const Parameters vessel = someVessel();
  Random random(4);
  for (const Disturbance& weather : weathers()) {
    const InverseDynamics inverse(vessel, weather);
    const FlatPoint z = underWay(random);
    const FlatGradient g = inverse.gradient(z, 3.0);
    const Sailing s = inverse.sailing(z, inverse.headingForce(z.velocity, z.acceleration), 3.0);
    EXPECT_NEAR(g.yaw_rate_radps, s.yaw_rate_radps, 1e-12);
    EXPECT_NEAR(g.surge_n, s.tau.surge_n, 1e-9);
    EXPECT_NEAR(g.difference_n, s.tau.yaw_nm / vessel.thrusters.lever_arm_m, 1e-9);
  }
}

// What is pushed along a heading has that heading.
TEST(InverseDynamics, PushIsTheInverseOfSailing) {
  const Parameters vessel = someVessel();
  for (const Disturbance& weather : weathers()) {
    const InverseDynamics inverse(vessel, weather);
    FlatPoint z;
    z.velocity = {2.0, 0.4};
    inverse.push(0.3, 0.25, 60.0, 5.0, z);
    const FlatState back = inverse.state(z, {1.0, 0.0});
    EXPECT_NEAR(back.state[kPsi], 0.3, 1e-9);
    EXPECT_NEAR(back.state[kYawRate], 0.25, 1e-9);
    EXPECT_NEAR(back.tau.surge_n, 60.0, 1e-9);
    const double h = 1e-5;  // the surge force's rate
    z.snap = Vector2d::Zero();
    const double rate = (inverse.state(later(z, h), {1.0, 0.0}).tau.surge_n -
                         inverse.state(later(z, -h), {1.0, 0.0}).tau.surge_n) /
                        (2.0 * h);
    EXPECT_NEAR(rate, 5.0, 1e-4);
  }
}

TEST(InverseDynamics, FromStateGivesTheStateBack) {
  const Parameters vessel = someVessel();
  State state;
  state << 3.0, -2.0, 0.7, 2.5, 0.3, 0.2;
  for (const Disturbance& weather : weathers()) {
    const InverseDynamics inverse(vessel, weather);
    const FlatPoint z = inverse.fromState(state, 0.0, 100.0);
    const FlatState back = inverse.state(z, z.velocity);
    EXPECT_TRUE(back.state.isApprox(state, 1e-9)) << back.state.transpose();
  }
}

TEST(InverseDynamics, SlowsDownWhereTheForceIsTooSmallForTheSpeed) {
  const InverseDynamics inverse(Parameters{});
  State state;
  state << 3.0, -2.0, 0.7, 4.0, 0.3, 0.2;
  const FlatPoint z = inverse.fromState(state, 0.0, 50.0);
  EXPECT_TRUE(inverse.state(z, z.velocity).state.isApprox(state, 1e-9));
  EXPECT_NEAR(inverse.headingForce(z.velocity, z.acceleration).norm(), 50.0, 1e-9);
}

TEST(InverseDynamics, StandsStillWhereNothingPointsAhead) {
  const FlatState flat = InverseDynamics(Parameters{}).state({}, {0.0, 2.0});
  EXPECT_NEAR(flat.state[kPsi], M_PI / 2.0, 1e-12);
  EXPECT_EQ(flat.state[kYawRate], 0.0);
  EXPECT_EQ(flat.tau.yaw_nm, 0.0);
}

// On any heading, what demandOf() asks for brings the motion about, but for the side force.
TEST(DemandOf, InvertsTheEquationsOfMotion) {
  Parameters vessel = someVessel();
  ManoeuvringModel& m = vessel.manoeuvring;
  m.sway_inertia_kg = 90.0;
  m.surge_centripetal_kg = 70.0;
  m.sway_centripetal_kg = 50.0;
  m.munk_kg = 20.0;
  m.sway_drag_quadratic_kgpm = 60.0;
  m.yaw_drag_quadratic_kgm2 = 30.0;
  m.sway_from_yaw_kgmps = 5.0;
  m.yaw_from_sway_kgmps = -4.0;
  Random random(5);
  for (const Disturbance& weather : weathers()) {
    for (int trial = 0; trial < 50; ++trial) {
      const double psi = random.uniform(-3.0, 3.0);
      const double r = random.uniform(-0.5, 0.5);
      const double r1 = random.uniform(-0.5, 0.5);
      const Vector2d velocity = random2(random, 2.0);
      const Vector2d acceleration = random2(random, 0.5);
      const Demand demand = demandOf(m, weather, psi, r, r1, velocity, acceleration);
      State x;
      x << 0.0, 0.0, psi, demand.surge_mps, demand.sway_mps, r;
      const State rate = stateDerivative(x, thrustsFromTau(demand.tau, vessel.thrusters), m,
                                         vessel.thrusters, weather);
      EXPECT_TRUE(rate.head<2>().isApprox(velocity, 1e-12));
      EXPECT_NEAR(rate[kYawRate], r1, 1e-12);
      const Vector2d e(std::cos(psi), std::sin(psi));
      EXPECT_NEAR(rate[kSurge], e.dot(acceleration) + r * demand.sway_mps, 1e-12);
      EXPECT_NEAR(rate[kSway] + demand.sway_n / m.sway_inertia_kg,
                  cross(e, acceleration) - r * demand.surge_mps, 1e-12);
    }
  }
}

// The paper's model is the manoeuvring model's special case: both ask for the same.
TEST(DemandOf, AgreesWithTheFlatMapOfThePaper) {
  const Parameters vessel = someVessel();
  Random random(6);
  for (const Disturbance& weather : weathers()) {
    const InverseDynamics inverse(vessel, weather);
    const FlatPoint z = underWay(random);
    const FlatState flat = inverse.state(z, z.velocity);
    const Demand demand = demandOf(vessel.manoeuvring, weather, flat.state[kPsi],
                                   flat.state[kYawRate], 0.1, z.velocity, z.acceleration);
    const Vector2d e(std::cos(flat.state[kPsi]), std::sin(flat.state[kPsi]));
    const HeldDemand held = inverse.held(e, flat.state[kYawRate], 0.1, z.velocity, z.acceleration);
    EXPECT_NEAR(demand.tau.surge_n, flat.tau.surge_n, 1e-9);
    EXPECT_NEAR(demand.tau.surge_n, held.tau.surge_n, 1e-9);
    EXPECT_NEAR(demand.tau.yaw_nm, held.tau.yaw_nm, 1e-9);
    EXPECT_NEAR(demand.sway_n, 0.0, 1e-9);
    EXPECT_NEAR(held.sway_n, 0.0, 1e-9);
    const SwayHeading heading = swayHeading(vessel, weather, z.velocity, z.acceleration,
                                            flat.state[kPsi] + 0.05, flat.state[kPsi] + 0.1, 0.1);
    EXPECT_NEAR(heading.psi_rad, flat.state[kPsi], 1e-6);
  }
}

// A hull with more sway inertia than its turn feels: the heading followed by steps leaves no side
// force, on a circle in wind and current.
TEST(SwayHeading, NeedsNoForceFromTheSideAlongACircle) {
  Parameters vessel = someVessel();
  vessel.manoeuvring.sway_inertia_kg = 90.0;
  vessel.manoeuvring.sway_centripetal_kg = 45.0;
  vessel.manoeuvring.sway_drag_quadratic_kgpm = 80.0;
  for (const Disturbance& weather : weathers()) {
    constexpr double kRate = 0.2;
    constexpr double kRadius = 10.0;
    constexpr double kStep = 0.02;
    double psi = M_PI / 2.0;
    double before = psi;
    for (int k = 1; k <= 2000; ++k) {
      const double a = kRate * kStep * k;
      const Vector2d out(std::cos(a), std::sin(a));
      const Vector2d velocity = kRate * kRadius * Vector2d(-out.y(), out.x());
      const Vector2d acceleration = -kRate * kRate * kRadius * out;
      before = psi;
      const SwayHeading next = swayHeading(vessel, weather, velocity, acceleration, psi,
                                           std::atan2(velocity.y(), velocity.x()), kStep);
      psi = unwrapNear(next.psi_rad, psi);
      if (k > 200) {
        const Demand demand = demandOf(vessel.manoeuvring, weather, psi, (psi - before) / kStep,
                                       0.0, velocity, acceleration);
        EXPECT_LT(std::abs(demand.sway_n), 0.05) << k;
        EXPECT_GT(next.trust, 0.0);
      }
    }
  }
}

Parameters feelingWind() {
  Parameters vessel;
  vessel.manoeuvring = ManoeuvringModel::fromPaper(vessel.paper);
  vessel.manoeuvring.wind_surge_kgpm = 0.5;
  vessel.manoeuvring.wind_sway_kgpm = 0.5;
  return vessel;
}

// Slow across a wind whose load abeam goes with the square of what comes from there: the bow stays
// near the wind, from whichever side it comes, though right in it nothing is firm to the first
// order.
TEST(SwayHeading, StaysNearTheWindThroughItsEye) {
  const Parameters vessel = feelingWind();
  Disturbance weather;
  weather.wind_mps = {-8.0, 0.0};
  for (const double speed : {0.3, 0.6}) {
    for (const double side : {1.0, -1.0}) {
      const Vector2d velocity(0.0, side * speed);
      for (double before = -0.6; before <= 0.6; before += 0.05) {
        const SwayHeading heading = swayHeading(vessel, weather, velocity, Vector2d::Zero(), before,
                                                side * M_PI / 2.0, 0.1);
        EXPECT_GT(side * heading.psi_rad, 0.1) << before;
        EXPECT_LT(side * heading.psi_rad, 0.7) << before;
        EXPECT_GT(heading.trust, 0.0) << before;
        const Demand demand = demandOf(vessel.manoeuvring, weather, heading.psi_rad, 0.0, 0.0,
                                       velocity, Vector2d::Zero());
        EXPECT_LT(std::abs(demand.sway_n), 2.0) << before;
      }
    }
  }
}

// At the ends of a short leg the path says next to nothing of the heading. In a wind in which the
// hull can lie on its own it isn't turned into it, however firm that would be.
TEST(SwayHeading, KeepsThePathsWhereTheHullCanLieOnIt) {
  const Parameters vessel = feelingWind();
  Disturbance weather;
  weather.wind_mps = {0.0, 3.0};
  for (double psi = -3.0; psi <= 3.0; psi += 0.25) {
    const Vector2d ahead(std::cos(psi), std::sin(psi));
    for (const double speed : {0.01, 0.03, 0.06, 0.1}) {
      for (const double acceleration : {0.0, -0.1, -0.2}) {
        const SwayHeading heading =
            swayHeading(vessel, weather, speed * ahead, acceleration * ahead, psi, psi, 0.1);
        EXPECT_NEAR(heading.psi_rad, psi, 1e-9) << psi << ", " << speed << ", " << acceleration;
      }
    }
  }
}

TEST(Thrusters, ShareOfTheLimitAheadOrAstern) {
  Thrusters t;
  t.astern_max_n = 20.0;
  EXPECT_DOUBLE_EQ(shareOfLimit(25.0, t), 0.5);
  EXPECT_DOUBLE_EQ(shareOfLimit(-25.0, t), 1.25);
}

}  // namespace
}  // namespace otter_nav::vessel
