#include "tracker/reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::tracker {
namespace {

constexpr int kHorizonStages = 20;
constexpr double kHorizonStepS = 0.1;

vessel::Parameters otterGazebo() {
  return *vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) +
                                 "/config/vessels/otter_gazebo.yaml");
}

// North at half a metre a second.
trajectory::TimedTrajectory northward(double start_s) {
  vessel::FlatPoint start;
  vessel::FlatPoint end;
  start.velocity = end.velocity = {0.0, 0.5};
  end.position = {0.0, 20.0};
  return {trajectory::Trajectory({trajectory::hermitePiece(start, end, 40.0)}), start_s};
}

vessel::Disturbance eastwardWind() {
  vessel::Disturbance wind;
  wind.wind_mps = {9.0, 0.0};
  return wind;
}

// Of a hull on this heading that makes way north.
OcpReference across(double psi_rad, bool stern_to_wind) {
  const trajectory::TimedTrajectory sailed = northward(0.0);
  ReferenceSource source(Options{}, otterGazebo());
  source.start(sailed, 0.0);
  const vessel::Disturbance wind = eastwardWind();
  OcpReference reference;
  reference.corridor.is_sterns = stern_to_wind;
  for (int k = 0; k < 100; ++k) {
    source.fill(10.0 + 0.01 * k, kHorizonStepS, kHorizonStages, psi_rad, wind, reference);
  }
  return reference;
}

// What holds a hull that lies stern to the wind is thrust astern, on the reverse of the heading on
// which thrust ahead does.
TEST(Reference, SternToTheWindIsTheReverseOfBowToIt) {
  const OcpReference bow = across(kPi - 0.3, false);
  const OcpReference stern = across(-0.3, true);
  for (int k = 0; k < kHorizonStages; ++k) {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_LT(std::abs(wrapAngle(bow.states[i][vessel::kPsi] - kPi)), 0.6) << k;
    EXPECT_NEAR(wrapAngle(stern.states[i][vessel::kPsi] - bow.states[i][vessel::kPsi] - kPi), 0.0,
                0.05)
        << k;
    EXPECT_GT(bow.thrusts[i].sum(), 20.0) << k;
    EXPECT_NEAR(stern.thrusts[i].sum(), -bow.thrusts[i].sum(), 3.0) << k;
    EXPECT_NEAR(stern.attitude[i], bow.attitude[i], 0.1) << k;
    EXPECT_NEAR(stern.states[i][vessel::kSurge], -bow.states[i][vessel::kSurge], 0.05) << k;
  }
}

// It lay stern to the wind; the way begins abeam.
TEST(Reference, ANewTrajectoryDoesNotTurnItInStrongWind) {
  const trajectory::TimedTrajectory sailed = northward(1.0);
  ReferenceSource source(Options{}, otterGazebo());
  OcpReference reference;
  reference.corridor = {0.0, 0.4, true};
  source.rest({0.0, 0.0}, -0.1);
  for (int k = 0; k < 100; ++k) {
    source.fill(0.01 * k, kHorizonStepS, kHorizonStages, -0.1, eastwardWind(), reference);
  }
  source.start(sailed, 1.0);
  source.fill(1.0, kHorizonStepS, kHorizonStages, -0.1, eastwardWind(), reference);
  for (int k = 0; k <= kHorizonStages; ++k) {
    EXPECT_NEAR(wrapAngle(reference.states[static_cast<std::size_t>(k)][vessel::kPsi]), 0.0, 0.6)
        << k;
  }
}

// Abeam of a wind that sets the hull aside: where it is so by the model's own motion the headings
// are meant, from the first on, though the hull lay bow to the wind.
TEST(Reference, HeadingsOfARolledOutMotionAreMeant) {
  const double begins_rad = 0.5 * kPi - 0.2;
  trajectory::TimedTrajectory sailed;
  trajectory::Piece carried =
      trajectory::spinPiece(Eigen::Vector2d::Zero(), begins_rad, 0.5 * kPi + 0.2, 8.0);
  carried.position.col(1) = Eigen::Vector2d(0.3, 0.6);
  sailed.trajectory = trajectory::Trajectory({carried});
  for (const bool rolled_out : {false, true}) {
    sailed.rolled_out = rolled_out;
    ReferenceSource source(Options{}, otterGazebo());
    OcpReference reference;
    reference.corridor = {kPi, 0.4, false};
    source.rest({0.0, 0.0}, kPi);
    source.fill(-0.1, kHorizonStepS, kHorizonStages, kPi, eastwardWind(), reference);
    source.start(sailed, 0.0);
    EXPECT_EQ(source.isRolledOut(), rolled_out);
    if (rolled_out) {
      reference.corridor = {};
    }
    source.fill(0.0, kHorizonStepS, kHorizonStages, kPi, eastwardWind(), reference);
    double off_rad = 0.0;
    for (int k = 0; k <= kHorizonStages; ++k) {
      const double meant =
          sailed.trajectory.sample(k * kHorizonStepS, otterGazebo()).state[vessel::kPsi];
      const double psi = reference.states[static_cast<std::size_t>(k)][vessel::kPsi];
      off_rad = std::max(off_rad, std::abs(wrapAngle(psi - meant)));
    }
    EXPECT_EQ(off_rad < 0.05, rolled_out) << off_rad;
    source.rest({0.0, 0.0}, kPi);
    EXPECT_FALSE(source.isRolledOut());
  }
}

}  // namespace
}  // namespace otter_nav::tracker
