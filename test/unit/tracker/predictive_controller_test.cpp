#include "tracker/predictive_controller.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::tracker {
namespace {

// Straight legs of 1.2 s at 1.2 m/s, each on another course by `turn_rad` at once.
trajectory::TimedTrajectory corners(double turn_rad) {
  constexpr double kLegS = 1.2;
  constexpr double kMps = 1.2;
  std::vector<trajectory::Piece> legs;
  vessel::FlatPoint from;
  for (int k = 0; k < 8; ++k) {
    vessel::FlatPoint to;
    from.velocity = to.velocity = kMps * unitVector(k * turn_rad);
    to.position = from.position + kLegS * from.velocity;
    legs.push_back(trajectory::hermitePiece(from, to, kLegS));
    from = to;
  }
  trajectory::TimedTrajectory sailed;
  sailed.trajectory = trajectory::Trajectory(std::move(legs));
  return sailed;
}

// Where the heading jumps there is a plan for the hull as well, from the first step on.
TEST(PredictiveController, PlansWhereTheHeadingJumps) {
  const auto vessel =
      vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/otter.yaml");
  ASSERT_TRUE(vessel);
  for (const double turn_rad : {0.5, 1.5, 2.5, 3.0}) {
    const trajectory::TimedTrajectory sailed = corners(turn_rad);
    Options options;
    ReferenceSource source(options, *vessel);
    source.start(sailed, 0.0);
    Navigator navigator(options, *vessel);
    vessel::State state = vessel::State::Zero();
    state[vessel::kSurge] = 1.2;
    navigator.addOdometry(0.0, state);
    PredictiveController controller(options, *vessel);
    controller.start(false);
    Command command;
    const auto thrusts =
        controller.step(0.0, state, vessel::Thrusts::Zero(), navigator, source, command);
    ASSERT_TRUE(thrusts) << turn_rad << ": " << name(command.solver);
    EXPECT_TRUE(usable(command.solver)) << turn_rad;
    EXPECT_TRUE(thrusts->allFinite());
    EXPECT_TRUE(command.reason.empty()) << command.reason;
  }
}

// Behind the spot on which it turns, in a current that will carry the hull ahead of it once it has
// turned: little of one may be waves, and it comes back at once.
TEST(PredictiveController, CountsLessOnWhatIsToComeInALightLoad) {
  constexpr double kBehindM = 0.13;
  constexpr double kFeltS = 20.0;
  constexpr double kPeriodS = 0.02;
  const auto vessel =
      vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/otter.yaml");
  ASSERT_TRUE(vessel);
  Options options;
  Navigator navigator(options, *vessel);
  vessel::State state = vessel::State::Zero();
  state.segment<2>(vessel::kSurge) << 0.03, 0.06;
  for (double t = 0.0; t < kFeltS; t += kPeriodS) {
    state.head<2>() += kPeriodS * state.segment<2>(vessel::kSurge);
    navigator.addCommand(t, vessel::Thrusts::Zero());
    navigator.addOdometry(t, state);
  }
  const Eigen::Vector2d spot = state.head<2>() + Eigen::Vector2d(kBehindM, 0.0);
  trajectory::TimedTrajectory sailed;
  sailed.trajectory = trajectory::Trajectory({trajectory::spinPiece(spot, 0.0, -0.6, 3.0)});
  sailed.start_time_s = kFeltS;
  ReferenceSource source(options, *vessel);
  source.start(sailed, kFeltS);
  PredictiveController controller(options, *vessel);
  controller.start(false);
  Command command;
  for (int i = 0; i < 30; ++i) {
    ASSERT_TRUE(
        controller.step(kFeltS, state, vessel::Thrusts::Zero(), navigator, source, command));
  }
  const Prediction& plan = controller.prediction();
  double most_behind_m = 0.0;
  for (int k = 0; k < plan.size; ++k) {
    const vessel::State& x = plan.states[static_cast<std::size_t>(k)];
    most_behind_m = std::max(most_behind_m, (spot - x.head<2>()).dot(unitVector(x[vessel::kPsi])));
  }
  EXPECT_LT(most_behind_m, 0.17);  // 0.24 with all weights alike
}

}  // namespace
}  // namespace otter_nav::tracker
