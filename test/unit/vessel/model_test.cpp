#include "otter_nav/vessel/model.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "otter_nav/base/random.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::vessel {
namespace {

ManoeuvringModel everyTermModel() {
  ManoeuvringModel m;
  m.surge_inertia_kg = 85.0;
  m.sway_inertia_kg = 190.0;
  m.yaw_inertia_kgm2 = 40.0;
  m.surge_centripetal_kg = 170.0;
  m.sway_centripetal_kg = 90.0;
  m.munk_kg = 60.0;
  m.surge_drag_kgps = 70.0;
  m.sway_drag_kgps = 30.0;
  m.yaw_drag_kgm2ps = 45.0;
  m.surge_drag_quadratic_kgpm = 3.0;
  m.sway_drag_quadratic_kgpm = 120.0;
  m.yaw_drag_quadratic_kgm2 = 200.0;
  m.sway_from_yaw_kgmps = 5.0;
  m.yaw_from_sway_kgmps = -4.0;
  m.wind_surge_kgpm = 0.4;
  m.wind_sway_kgpm = 0.6;
  m.wind_yaw_kg = -0.7;
  return m;
}

TEST(StateDerivative, PaperModelMatchesItsThreeEquations) {
  PaperModel h;
  const Thrusters thrusters;
  State x;
  x << 3.0, -2.0, 0.7, 2.0, 0.3, -0.4;
  const Thrusts f(20.0, 35.0);
  const State dx = stateDerivative(x, f, ManoeuvringModel::fromPaper(h), thrusters, {});
  EXPECT_NEAR(h.m1_kg * (dx[kSurge] - x[kSway] * x[kYawRate]), 55.0 - h.d1_kgps * x[kSurge], 1e-9);
  EXPECT_NEAR(h.m1_kg * (dx[kSway] + x[kSurge] * x[kYawRate]), -h.d2_kgps * x[kSway], 1e-9);
  EXPECT_NEAR(h.m2_kgm2 * dx[kYawRate], 0.39 * 15.0 - h.d3_kgm2ps * x[kYawRate], 1e-9);
}

TEST(StateDerivative, DriftingWithTheCurrentIsAtRestInTheWater) {
  Disturbance d;
  d.current_mps = {0.4, -0.3};
  State x = State::Zero();
  x[kPsi] = 1.1;
  x[kYawRate] = 0.2;
  x[kSurge] = std::cos(x[kPsi]) * 0.4 + std::sin(x[kPsi]) * -0.3;
  x[kSway] = -std::sin(x[kPsi]) * 0.4 + std::cos(x[kPsi]) * -0.3;
  ManoeuvringModel m = ManoeuvringModel::fromPaper({});
  const State dx = stateDerivative(x, Thrusts::Zero(), m, {}, d);
  // The velocity over ground stays the current: its body components only rotate.
  EXPECT_NEAR(dx[kSurge], x[kYawRate] * x[kSway], 1e-12);
  EXPECT_NEAR(dx[kSway], -x[kYawRate] * x[kSurge], 1e-12);
}

// Each term of docs/model.md, written out.
TEST(StateDerivative, HasEveryTermOfTheManoeuvringModel) {
  const ManoeuvringModel m = everyTermModel();
  Disturbance d;
  d.current_mps = {0.3, 0.1};
  d.wind_mps = {2.0, -5.0};
  d.force_n = {3.0, 7.0};
  d.moment_nm = -2.0;
  State x = State::Zero();
  x.tail<3>() << 1.3, -0.4, -0.5;  // heading east: body and earth frame agree
  const double u = 1.0;
  const double v = -0.5;
  const double r = -0.5;
  const State dx = stateDerivative(x, {20.0, 35.0}, m, {}, d);
  EXPECT_NEAR(dx[kX], 1.3, 1e-12);
  EXPECT_NEAR(dx[kY], -0.4, 1e-12);
  EXPECT_EQ(dx[kPsi], r);
  EXPECT_NEAR(85.0 * (dx[kSurge] - r * 0.1),
              170.0 * v * r - 70.0 * u - 3.0 * u * u + 55.0 + 3.0 + 0.4 * 4.0, 1e-9);
  EXPECT_NEAR(190.0 * (dx[kSway] + r * 0.3),
              -90.0 * u * r - 30.0 * v + 120.0 * v * v - 5.0 * r + 7.0 - 0.6 * 25.0, 1e-9);
  EXPECT_NEAR(40.0 * dx[kYawRate],
              -60.0 * u * v - 45.0 * r + 200.0 * r * r + 4.0 * v + 0.39 * 15.0 - 2.0 + 0.7 * 10.0,
              1e-9);
  x[kPsi] = 0.5 * M_PI;  // heading north: ahead is y, to port is -x
  x[kSurge] = 1.1;
  x[kSway] = -0.8;
  const State north = stateDerivative(x, {20.0, 35.0}, m, {}, d);
  EXPECT_NEAR(north[kX], 0.8, 1e-12);
  EXPECT_NEAR(north[kY], 1.1, 1e-12);
  EXPECT_NEAR(85.0 * (north[kSurge] - r * -0.3),
              170.0 * v * r - 70.0 * u - 3.0 * u * u + 55.0 + 7.0 - 0.4 * 25.0, 1e-9);
  EXPECT_NEAR(190.0 * (north[kSway] + r * 0.1),
              -90.0 * u * r - 30.0 * v + 120.0 * v * v - 5.0 * r - 3.0 - 0.6 * 4.0, 1e-9);
}

TEST(Linearize, AgreesWithCentralDifferences) {
  const ManoeuvringModel m = everyTermModel();
  const Thrusters thrusters;
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    State x;
    Thrusts f;
    Disturbance d;
    for (int i = 0; i < kStateSize; ++i) x[i] = random.uniform(-2.0, 2.0);
    for (int i = 0; i < kInputSize; ++i) f[i] = random.uniform(-50.0, 50.0);
    d.current_mps = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    d.force_n = {random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0)};
    d.moment_nm = random.uniform(-5.0, 5.0);
    d.wind_mps = {random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0)};
    const Linearization l = linearize(x, f, m, thrusters, d);
    EXPECT_TRUE(l.derivative.isApprox(stateDerivative(x, f, m, thrusters, d)));
    constexpr double kStep = 1e-6;
    for (int j = 0; j < kStateSize; ++j) {
      State up = x;
      State down = x;
      up[j] += kStep;
      down[j] -= kStep;
      const State column =
          (stateDerivative(up, f, m, thrusters, d) - stateDerivative(down, f, m, thrusters, d)) /
          (2.0 * kStep);
      EXPECT_LT((column - l.state_jacobian.col(j)).cwiseAbs().maxCoeff(), 2e-5) << "column " << j;
    }
    for (int j = 0; j < 2; ++j) {
      Disturbance up = d;
      Disturbance down = d;
      up.current_mps[j] += kStep;
      down.current_mps[j] -= kStep;
      const State column =
          (stateDerivative(x, f, m, thrusters, up) - stateDerivative(x, f, m, thrusters, down)) /
          (2.0 * kStep);
      EXPECT_LT((column.tail<3>() - l.current_jacobian.col(j)).cwiseAbs().maxCoeff(), 2e-5);
    }
    for (int j = 0; j < kInputSize; ++j) {
      Thrusts plus = f;
      plus[j] += 1.0;
      const State column =
          stateDerivative(x, plus, m, thrusters, d) - stateDerivative(x, f, m, thrusters, d);
      EXPECT_LT((column - l.input_jacobian.col(j)).cwiseAbs().maxCoeff(), 1e-9);
    }
  }
}

TEST(Thrusters, TauRoundTripAndMargin) {
  Thrusters t;
  t.astern_max_n = 30.0;
  const Thrusts f(-20.0, 45.0);
  EXPECT_TRUE(thrustsFromTau(tauFromThrusts(f, t), t).isApprox(f, 1e-12));
  EXPECT_DOUBLE_EQ(thrustMargin(f, t), 5.0);
  EXPECT_LT(thrustMargin({-31.0, 0.0}, t), 0.0);
  EXPECT_DOUBLE_EQ(clampThrusts({-100.0, 100.0}, t)[kLeft], -30.0);
}

// Beside m2 r' = M - d3 r integrated in steps of 0.1 ms.
// The thrusts under which a state moves on as the path says: its acceleration and the port part of
// its jerk are linear in the surge force and the yaw moment.
Thrusts thrustsOnto(const FlatPoint& path, const State& state, const Parameters& vessel) {
  constexpr double kLaterS = 1e-6;
  const Eigen::Vector2d e(std::cos(state[kPsi]), std::sin(state[kPsi]));
  const Eigen::Vector2d n(-e.y(), e.x());
  const auto accelerationOf = [&](const State& x, const Thrusts& thrusts) {
    const State dx = stateDerivative(x, thrusts, vessel.manoeuvring, vessel.thrusters, {});
    const Eigen::Rotation2D<double> earth_from_body(x[kPsi]);
    return Eigen::Vector2d(earth_from_body * Eigen::Vector2d(dx[kSurge] - x[kYawRate] * x[kSway],
                                                             dx[kSway] + x[kYawRate] * x[kSurge]));
  };
  const auto portJerkOf = [&](const Tau& tau) {
    const Thrusts thrusts = thrustsFromTau(tau, vessel.thrusters);
    const State later =
        state + kLaterS * stateDerivative(state, thrusts, vessel.manoeuvring, vessel.thrusters, {});
    return n.dot(accelerationOf(later, thrusts) - accelerationOf(state, thrusts)) / kLaterS;
  };
  Tau tau;
  tau.surge_n = vessel.manoeuvring.surge_inertia_kg *
                e.dot(path.acceleration - accelerationOf(state, Thrusts::Zero()));
  const double with_none = portJerkOf(tau);
  tau.yaw_nm = 1.0;
  tau.yaw_nm = (n.dot(path.jerk) - with_none) / (portJerkOf(tau) - with_none);
  return thrustsFromTau(tau, vessel.thrusters);
}

// Sliding broadside at speed takes more moment than there is: the hull goes on turning.
TEST(PathFromState, BeginsWithWhatTheThrustersHave) {
  const auto otter =
      loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/otter.yaml");
  ASSERT_TRUE(otter);
  constexpr double kShare = 0.6;
  for (const double sway_mps : {-1.0, -0.3, 0.0, 0.3, 1.0}) {
    for (const double yaw_rate : {-0.4, 0.0, 0.4}) {
      State state;
      state << 3.0, -2.0, 0.7, 1.7, sway_mps, yaw_rate;
      const FlatPoint path =
          pathFromState(state, kShare * 2.0 * otter->thrusters.ahead_max_n, *otter, {});
      const Thrusts thrusts = thrustsOnto(path, state, *otter);
      EXPECT_LE(shareOfLimit(thrusts, otter->thrusters), kShare + 1e-3)
          << sway_mps << " m/s abeam, " << yaw_rate << " rad/s";
      EXPECT_GT(thrusts.sum(), 0.0);
    }
  }
}

TEST(TurnLaw, TellsWhenAHeadingIsReached) {
  for (const double lag_s : {0.05, 0.5, 5.0}) {
    for (const double angle_rad : {0.01, 0.2, 3.0}) {
      const TurnLaw law{lag_s, 0.8};
      constexpr double kStepS = 1e-4;
      double psi = 0.0;
      double r = 0.0;
      double time_s = 0.0;
      while (psi < angle_rad) {
        r += (law.r_full - r) / lag_s * kStepS;
        psi += r * kStepS;
        time_s += kStepS;
      }
      EXPECT_NEAR(law.timeTo(angle_rad), time_s, 3.0 * kStepS + 1e-3 * time_s)
          << lag_s << " " << angle_rad;
    }
  }
}

}  // namespace
}  // namespace otter_nav::vessel
