#include "otter_nav/identification/manoeuvres.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "otter_nav/base/angles.hpp"
#include "simulated.hpp"

namespace otter_nav::identification {
namespace {

constexpr double kCommandPeriodS = 0.02;

struct Track {
  std::vector<double> psi;  // unwrapped
  std::vector<vessel::Thrusts> thrusts;
  vessel::State last;
};

Track sail(const std::vector<ManoeuvreOptions>& manoeuvres, double limit_s) {
  const Model model = testing::paperModel({90.0, 40.0, 77.0, 150.0, 60.0});
  Excitation excitation(manoeuvres, model.thrusters);
  Track track;
  vessel::State state = vessel::State::Zero();
  for (int i = 0; i * kCommandPeriodS < limit_s; ++i) {
    vessel::State wrapped = state;
    wrapped[vessel::kPsi] = wrapAngle(state[vessel::kPsi]);
    const vessel::Thrusts thrusts = excitation.step(100.0 + i * kCommandPeriodS, wrapped);
    if (excitation.finished()) {
      EXPECT_EQ(thrusts, vessel::Thrusts::Zero());
      break;
    }
    track.psi.push_back(state[vessel::kPsi]);
    track.thrusts.push_back(thrusts);
    state = step(model, thrusts, kCommandPeriodS, state);
  }
  EXPECT_TRUE(excitation.finished());
  EXPECT_EQ(excitation.progress(), "finished");
  track.last = state;
  return track;
}

TEST(Manoeuvres, ThrustsKeepTheDifferenceAndTheLimits) {
  const vessel::Thrusters limits{0.395, 100.0, 50.0};
  EXPECT_TRUE(thrustsOf(0.5, 0.2, limits).isApprox(vessel::Thrusts(30.0, 70.0)));
  EXPECT_TRUE(thrustsOf(1.0, 0.2, limits).isApprox(vessel::Thrusts(60.0, 100.0)));
  EXPECT_TRUE(thrustsOf(-1.0, 0.2, limits).isApprox(vessel::Thrusts(-50.0, -10.0)));
  EXPECT_TRUE(thrustsOf(0.0, 1.0, limits).isApprox(vessel::Thrusts(-50.0, 100.0)));
}

TEST(Manoeuvres, ZigzagSwingsBetweenItsAngles) {
  ManoeuvreOptions zigzag;
  zigzag.kind = ManoeuvreKind::kZigzag;
  zigzag.ahead = 0.5;
  zigzag.turn = 0.2;
  zigzag.angle_rad = 20.0 * kPi / 180.0;
  zigzag.count = 4;
  zigzag.seconds = 100.0;
  const Track track = sail({zigzag}, 200.0);
  int switches = 0;
  for (std::size_t i = 1; i < track.thrusts.size(); ++i) {
    const bool was_port =
        track.thrusts[i - 1][vessel::kRight] > track.thrusts[i - 1][vessel::kLeft];
    const bool is_port = track.thrusts[i][vessel::kRight] > track.thrusts[i][vessel::kLeft];
    if (was_port != is_port) {
      ++switches;
      EXPECT_NEAR(std::abs(track.psi[i]), zigzag.angle_rad, 0.02);
      EXPECT_EQ(track.psi[i] > 0.0, was_port);
    }
  }
  EXPECT_EQ(switches, 3);  // the fourth ends it
}

// It would last until the clock has come there again.
TEST(Manoeuvres, BeginAgainOnAClockThatWasSetBack) {
  ManoeuvreOptions step;
  step.seconds = 10.0;
  Excitation excitation({step, step}, vessel::Thrusters{0.395, 100.0, 50.0});
  const vessel::State rest = vessel::State::Zero();
  EXPECT_GT(excitation.step(1000.0, rest).sum(), 0.0);
  EXPECT_GT(excitation.step(1008.0, rest).sum(), 0.0);
  EXPECT_GT(excitation.step(8.0, rest).sum(), 0.0);
  EXPECT_GT(excitation.step(17.9, rest).sum(), 0.0);
  EXPECT_EQ(excitation.progress(), "1 of 2: speed_step");
  EXPECT_GT(excitation.step(18.1, rest).sum(), 0.0);
  EXPECT_EQ(excitation.progress(), "2 of 2: speed_step");
}

TEST(Manoeuvres, CircleTurnsToItsSideByItsAngle) {
  for (const double side : {1.0, -1.0}) {
    ManoeuvreOptions circle;
    circle.kind = ManoeuvreKind::kCircle;
    circle.ahead = 0.4;
    circle.turn = 0.3 * side;
    circle.angle_rad = 3.0 * kPi;
    circle.seconds = 200.0;
    const Track track = sail({circle}, 300.0);
    EXPECT_NEAR(side * track.psi.back(), 3.0 * kPi, 0.02);
  }
}

TEST(Manoeuvres, SpiralGoesThereAndBack) {
  ManoeuvreOptions spiral;
  spiral.kind = ManoeuvreKind::kSpiral;
  spiral.ahead = 0.4;
  spiral.turn = 0.3;
  spiral.count = 4;
  spiral.seconds = 2.0;
  const Track track = sail({spiral}, 100.0);
  const auto difference = [&](double t) {
    const vessel::Thrusts& f = track.thrusts[static_cast<std::size_t>(t / kCommandPeriodS)];
    return (f[vessel::kRight] - f[vessel::kLeft]) / (2.0 * 119.7);
  };
  EXPECT_NEAR(difference(1.0), 0.3, 1e-9);
  EXPECT_NEAR(difference(3.0), 0.15, 1e-9);
  EXPECT_NEAR(difference(9.0), -0.3, 1e-9);
  EXPECT_NEAR(difference(17.0), 0.3, 1e-9);
  EXPECT_NEAR(static_cast<double>(track.thrusts.size()) * kCommandPeriodS, 18.0,
              2.0 * kCommandPeriodS);
}

TEST(Manoeuvres, SpeedStepHoldsTheHeading) {
  ManoeuvreOptions circle;
  circle.kind = ManoeuvreKind::kCircle;
  circle.ahead = 0.4;
  circle.turn = 0.3;
  circle.angle_rad = 0.5;
  circle.seconds = 60.0;
  ManoeuvreOptions straight;
  straight.ahead = 0.6;
  straight.seconds = 20.0;
  const Track track = sail({circle, straight}, 100.0);
  EXPECT_NEAR(track.last[vessel::kPsi], 0.5, 0.1);
  EXPECT_NEAR(track.last[vessel::kYawRate], 0.0, 0.01);
}

TEST(Manoeuvres, ShippedListLoadsAndEnds) {
  const std::string path = OTTER_NAV_SOURCE_DIR "/config/excitation.yaml";
  const auto manoeuvres = readExcitation(config::Section(*config::loadFile(path), path));
  ASSERT_TRUE(manoeuvres) << manoeuvres.error().message;
  for (const ManoeuvreKind kind : {ManoeuvreKind::kSpeedStep, ManoeuvreKind::kZigzag,
                                   ManoeuvreKind::kCircle, ManoeuvreKind::kSpiral}) {
    EXPECT_TRUE(std::any_of(manoeuvres->begin(), manoeuvres->end(),
                            [&](const ManoeuvreOptions& m) { return m.kind == kind; }));
  }
  sail(*manoeuvres, 1500.0);
}

TEST(Manoeuvres, WrongListsNameTheKey) {
  const auto errorOf = [](const char* text) {
    const auto read = readExcitation(config::Section(YAML::Load(text), "x.yaml"));
    return read ? "" : read.error().message;
  };
  EXPECT_NE(errorOf("manoeuvres: [{kind: loop, ahead: 0.5, seconds: 3}]").find("kind"),
            std::string::npos);
  EXPECT_NE(errorOf("manoeuvres: [{kind: zigzag, ahead: 0.5, seconds: 3, turn: 2.0, count: 3, "
                    "angle_deg: 10}]")
                .find("turn"),
            std::string::npos);
  EXPECT_NE(
      errorOf("manoeuvres: [{kind: speed_step, ahead: 0.5, seconds: 3, turn: 0.1}]").find("turn"),
      std::string::npos);
}

}  // namespace
}  // namespace otter_nav::identification
