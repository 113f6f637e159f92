// Verification passes a sound trajectory and names each kind of fault put into it.
#include "otter_nav/feasibility/verifier.hpp"

#include <gtest/gtest.h>

#include "otter_nav/optimizer/global_optimizer.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::feasibility {
namespace {

using trajectory::Piece;
using trajectory::Trajectory;

// 60 m by 60 m of water with a rock of one cell at (30.25, 29.25).
map::DistanceField rockField(bool with_rock = true) {
  map::OccupancyGrid grid;
  grid.geometry = {120, 120, 0.5, {0.0, 0.0}};
  grid.cells.assign(14400, map::Cell::kFree);
  if (with_rock) {
    grid.cells[grid.geometry.index(60, 58)] = map::Cell::kOccupied;
  }
  return map::DistanceField(grid, {});
}

trajectory::Boundary berth(double x, double y, double psi_rad) {
  trajectory::Boundary b;
  b.flat.position = {x, y};
  b.psi_rad = psi_rad;
  return b;
}

class VerificationTest : public ::testing::Test {
 protected:
  VerificationTest() {
    optimizer::GlobalOptimizer optimizer(optimizer::GlobalOptions(), vessel);
    const auto result = optimizer.optimize(
        field, std::vector<Eigen::Vector2d>{{10.0, 30.0}, {30.0, 31.5}, {50.0, 30.0}}, start, goal,
        optimizer::Budget(), options);
    EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().message);
    pieces = result ? result->trajectory.pieces() : std::vector<Piece>();
  }

  [[nodiscard]] Verification check() const {
    return verify(Trajectory(pieces), field, vessel, start, goal, options);
  }
  // A piece well under way.
  Piece& middle() { return pieces[pieces.size() / 2]; }

  void expectFault(const std::string& word) const {
    const Verification v = check();
    EXPECT_FALSE(v.ok);
    EXPECT_NE(v.reason.find(word), std::string::npos) << v.reason;
  }

  vessel::Parameters vessel;
  map::DistanceField field = rockField();
  trajectory::Boundary start = berth(10.0, 30.0, 0.4);
  trajectory::Boundary goal = berth(50.0, 30.0, -2.0);
  std::vector<Piece> pieces;
  SafetyLimits options = SafetyLimits::of(vessel);
};

TEST_F(VerificationTest, PassesWhatIsSound) {
  const Verification v = check();
  EXPECT_TRUE(v.ok) << v.reason;
  EXPECT_GE(v.clearance_m, 0.8);
  EXPECT_LE(v.thrust_share, options.thrust_share);
}

TEST_F(VerificationTest, EmptyAndNotFinite) {
  pieces[1].position(0, 3) = std::nan("");
  expectFault("not finite");
  pieces.clear();
  expectFault("empty");
}

TEST_F(VerificationTest, JumpsOfEachOrder) {
  const std::vector<Piece> sound = pieces;
  const char* names[] = {"position jumps", "velocity jumps", "acceleration jumps", "jerk jumps"};
  const double jumps[] = {1e-3, 1e-3, 1e-3, 1e-3};
  for (int order = 0; order < 4; ++order) {
    pieces = sound;
    middle().position(1, order) += jumps[order];
    expectFault(names[order]);
  }
}

TEST_F(VerificationTest, RockInTheWay) {
  for (Piece& piece : pieces) {
    piece.position(1, 0) -= 1.6;
  }
  start.flat.position.y() -= 1.6;
  goal.flat.position.y() -= 1.6;
  expectFault("obstacle");
}

TEST_F(VerificationTest, OutOfTheMap) {
  for (Piece& piece : pieces) {
    piece.position(1, 0) += 29.5;
  }
  start.flat.position.y() += 29.5;
  goal.flat.position.y() += 29.5;
  expectFault("obstacle");
}

TEST_F(VerificationTest, LimitsOfThrustSpeedAndTurning) {
  const SafetyLimits sound = options;
  options.thrust_share = 0.7;
  expectFault("thrust");
  options = sound;
  options.speed_max_mps = 2.0;
  expectFault("too fast");
  options = sound;
  options.yaw_rate_max_radps = 0.05;
  expectFault("turns too fast");
}

// In a bend the outer thruster does more than the inner one.
TEST_F(VerificationTest, EachThrusterKeepsToItsLimit) {
  for (const double side : {-1.0, 1.0}) {
    const Eigen::Vector2d out(std::cos(0.9), side * std::sin(0.9));
    vessel::FlatPoint from;
    vessel::FlatPoint to;
    from.position = {15.0, 30.0 + 10.0 * side};
    from.velocity = {2.5, 0.0};
    to.position = from.position + 3.0 * Eigen::Vector2d::UnitX() + 3.0 * out;
    to.velocity = 2.5 * out;
    const Trajectory bend({trajectory::hermitePiece(from, to, 2.4)});
    Eigen::Array2d most = Eigen::Array2d::Zero();
    for (double t = 0.0; t <= bend.duration(); t += 0.01) {
      const vessel::Thrusts thrusts = bend.sample(t, vessel).thrusts;
      for (const int i : {vessel::kLeft, vessel::kRight}) {
        most[i] = std::max(most[i], vessel::shareOfLimit(thrusts[i], vessel.thrusters));
      }
    }
    const int outer = side > 0.0 ? vessel::kRight : vessel::kLeft;
    ASSERT_GT(most[outer], most[1 - outer] + 0.05);
    options.yaw_rate_max_radps = 1e3;
    options.thrust_share = most[outer] + 0.02;
    const Verification sound = verify(bend, field, vessel, options);
    EXPECT_TRUE(sound.ok) << sound.reason;
    options.thrust_share = most[outer] - 0.02;
    const Verification v = verify(bend, field, vessel, options);
    EXPECT_FALSE(v.ok);
    EXPECT_NE(v.reason.find("thrust"), std::string::npos) << v.reason;
  }
}

TEST_F(VerificationTest, EndsNotMet) {
  const trajectory::Boundary right = start;
  start.psi_rad += 0.1;
  expectFault("start heading");
  start = right;
  start.flat.position.x() += 0.1;
  expectFault("start position");
  start = right;
  start.flat.velocity.x() = 1.0;
  expectFault("start motion");
  start = right;
  goal.psi_rad += 0.1;
  expectFault("goal heading");
}

TEST_F(VerificationTest, SailsAsternOnAStraight) {
  vessel::FlatPoint from;
  vessel::FlatPoint to;
  from.position = {10.0, 30.0};
  to.position = {16.0, 30.0};
  to.velocity = {-1.0, 0.0};
  to.acceleration = {-0.5, 0.0};
  pieces = {trajectory::hermitePiece(from, to, 6.0)};
  const Verification v = verify(Trajectory(pieces), field, vessel, options);
  EXPECT_FALSE(v.ok);
  EXPECT_NE(v.reason.find("astern"), std::string::npos) << v.reason;
}

// Turning while |w| vanishes: the heading is undefined there.
TEST_F(VerificationTest, TurnsWithoutForce) {
  vessel::FlatPoint from;
  vessel::FlatPoint to;
  from.position = {10.0, 30.0};
  from.velocity = {3.0, 0.0};
  to.position = {16.0, 30.2};
  to.velocity = {0.2, 0.4};
  pieces = {trajectory::hermitePiece(from, to, 3.0)};
  options.thrust_share = 1e3;
  options.yaw_rate_max_radps = 1e3;
  const Verification v = verify(Trajectory(pieces), field, vessel, options);
  EXPECT_FALSE(v.ok);
}

TEST_F(VerificationTest, ASpinMustMeetTheHeadingBefore) {
  for (Piece& piece : pieces) {
    if (&piece > &middle() && piece.kind == trajectory::PieceKind::kSpin) {
      piece.heading[0] += 0.1;
    }
  }
  expectFault("heading");
}

TEST_F(VerificationTest, ASpinMustMeetTheYawRateBefore) {
  // Half a second on the spot, at rest but for its heading, then a turn that is under way at once.
  Piece still = trajectory::spinPiece(goal.flat.position, 0.0, 0.0, 0.5);
  Piece turning = still;
  turning.heading[1] = 0.3;
  const Trajectory trajectory({still, turning});
  const Verification v = verify(trajectory, field, vessel, options);
  EXPECT_FALSE(v.ok);
  EXPECT_NE(v.reason.find("yaw rate"), std::string::npos) << v.reason;
}

TEST_F(VerificationTest, ASpinSlidesOnlyAsTheModelLetsIt) {
  const auto under_way = std::find_if(pieces.rbegin(), pieces.rend(), [](const Piece& piece) {
    return piece.kind != trajectory::PieceKind::kSpin;
  });
  const std::vector<Piece> arrival(under_way.base(), pieces.end());
  ASSERT_FALSE(arrival.empty());
  EXPECT_GT((arrival.back().position.col(0) - arrival.front().position.col(0)).norm(), 0.5);
  EXPECT_TRUE(verify(Trajectory(arrival), field, vessel, options).ok);
  // The same way with another heading would need a force from the side.
  std::vector<Piece> turned = arrival;
  for (Piece& piece : turned) {
    piece.heading[0] += 0.3;
  }
  const Verification v = verify(Trajectory(turned), field, vessel, options);
  EXPECT_FALSE(v.ok);
  EXPECT_NE(v.reason.find("slides"), std::string::npos) << v.reason;
  EXPECT_EQ(v.fault, Fault::kSway);
  EXPECT_NE(v.reason.find("(limit 0.1"), std::string::npos) << v.reason;
}

// Slowly past a rock beside the bow: lying along its path the hull passes it, leaning into a wind
// from the other side it doesn't. Where it touches at the start, what leads away is no worse.
TEST(Verifier, LooksAtTheHullAsItLeansIntoALightWind) {
  vessel::Parameters vessel;
  vessel.manoeuvring = vessel::ManoeuvringModel::fromPaper(vessel.paper);
  vessel.manoeuvring.wind_surge_kgpm = 0.5;
  vessel.manoeuvring.wind_sway_kgpm = 0.5;
  const map::DistanceField rock = rockField();
  const auto eastward = [](double x, double speed_mps) {
    vessel::FlatPoint from;
    vessel::FlatPoint to;
    from.position = {x, 29.25 + 1.0};
    from.velocity = to.velocity = {speed_mps, 0.0};
    to.position = from.position + Eigen::Vector2d(4.0, 0.0);
    return Trajectory({trajectory::hermitePiece(from, to, 4.0 / speed_mps)});
  };
  SafetyLimits limits = SafetyLimits::of(vessel, 0.7);
  limits.hull_margin_m = 0.05;
  const auto passes = [&](const Trajectory& way) {
    return verify(way, Obstacles(rock), vessel, limits).ok;
  };
  const Trajectory slow = eastward(28.0, 0.6);
  EXPECT_TRUE(passes(slow));
  limits.felt.wind_mps = {0.0, 3.0};
  EXPECT_FALSE(passes(slow));
  EXPECT_TRUE(passes(eastward(28.0, 3.0)));
  EXPECT_TRUE(passes(eastward(31.0, 0.6)));
  limits.felt.wind_mps = {3.0, 0.0};
  EXPECT_TRUE(passes(slow));
}

}  // namespace
}  // namespace otter_nav::feasibility
