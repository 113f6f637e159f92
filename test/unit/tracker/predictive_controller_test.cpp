#include "tracker/predictive_controller.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace otter_nav::tracker
