// Spins: within the thrusters' limits, continuous, and as quick as the closed form says.
#include <gtest/gtest.h>

#include <cmath>

#include "otter_nav/optimizer/ends.hpp"

namespace otter_nav::optimizer {
namespace {

using trajectory::Piece;

TEST(Spin, TurnsFromRestToRestWithinLimits) {
  const vessel::Parameters vessel;
  SpinLimits limits;
  limits.yaw_rate_max_radps = 1.8;
  const double moment = 2.0 * 0.39 * 50.0 * limits.thrust_share;
  for (const double turn : {3.1, -1.2, 0.05, -0.4}) {
    std::vector<Piece> pieces;
    appendSpin({1.0, 2.0}, 0.7, turn, vessel, limits, pieces);
    double psi = 0.7;
    double r = 0.0;
    double time = 0.0;
    for (const Piece& piece : pieces) {
      EXPECT_NEAR(piece.spinHeading(0.0)[0], psi, 1e-9);
      EXPECT_NEAR(piece.spinHeading(0.0)[1], r, 1e-9);
      for (int i = 0; i <= 20; ++i) {
        const Eigen::Vector3d s = piece.spinHeading(piece.duration_s * i / 20);
        EXPECT_LE(std::abs(11.0 * s[2] + 20.0 * s[1]), moment * (1.0 + 1e-4));
        EXPECT_LE(std::abs(s[1]), limits.yaw_rate_max_radps + 1e-6);
      }
      psi = piece.spinHeading(piece.duration_s)[0];
      r = piece.spinHeading(piece.duration_s)[1];
      time += piece.duration_s;
    }
    EXPECT_NEAR(psi, 0.7 + turn, 1e-9);
    EXPECT_NEAR(r, 0.0, 1e-9);
    EXPECT_NEAR(time, spinDuration(turn, vessel, limits), 1e-12);
  }
}

// What the paper's model says of another lag doesn't count where the hull turns by its own law.
TEST(Spin, IsCutByTheLawThatItTurnsBy) {
  SpinLimits limits;
  limits.yaw_rate_max_radps = 1.8;
  const auto piecesOf = [&](double paper_m2_kgm2) {
    vessel::Parameters vessel;
    vessel.manoeuvring.sway_inertia_kg = 60.0;
    vessel.paper.m2_kgm2 = paper_m2_kgm2;
    std::vector<Piece> pieces;
    appendSpin({1.0, 2.0}, 0.7, 3.0, vessel, limits, pieces);
    return pieces.size();
  };
  EXPECT_EQ(piecesOf(110.0), piecesOf(11.0));
  EXPECT_EQ(piecesOf(1.1), piecesOf(11.0));
}

// m2 r' = tau - d3 r under full moment ahead, then back: integrated and searched for the switch.
TEST(Spin, IsTheTimeOptimalTurn) {
  const vessel::Parameters vessel;
  SpinLimits limits;
  limits.yaw_rate_max_radps = 100.0;
  const double moment = 2.0 * 0.39 * 50.0 * limits.thrust_share;
  constexpr double kDt = 1e-5;
  double r = 0.0;
  double psi = 0.0;
  double time = 0.0;
  for (; time < 1.0; time += kDt) {
    psi += kDt * r;
    r += kDt * (moment - 20.0 * r) / 11.0;
  }
  for (; r > 0.0; time += kDt) {
    psi += kDt * r;
    r -= kDt * (moment + 20.0 * r) / 11.0;
  }
  EXPECT_NEAR(spinDuration(psi, vessel, limits), time + limits.ramp_s, 1e-3);
}

}  // namespace
}  // namespace otter_nav::optimizer
