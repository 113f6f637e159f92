// The tracker against the plant where a plan to leeward begins with a turn during which the load
// carries the hull.
#include "../../unit/planner/planner_ground.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/planner/planner.hpp"
#include "otter_nav/stopping/braking.hpp"
#include "otter_nav/trajectory/motion_along.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "vessel_at_sea.hpp"

namespace otter_nav::tracker {
namespace {

using test::VesselAtSea;

constexpr double kPlannedN = 40.0;
constexpr double kLiesStillS = 10.0;

vessel::Parameters otter() {
  const auto vessel = vessel::loadParameters(test::kSource + "/config/vessels/otter.yaml");
  EXPECT_TRUE(vessel);
  return *vessel;
}

feasibility::SafetyLimits inTheLoad(const vessel::Parameters& vessel) {
  auto limits = feasibility::SafetyLimits::of(vessel, 1.0, 0.7);
  limits.disturbance.force_n = {kPlannedN, 0.0};
  return limits;
}

// From rest bow to the load, away with it; and how long its turn takes.
struct ToLeeward {
  trajectory::Trajectory trajectory;
  double turn_s = 0.0;
};
ToLeeward toLeeward(const vessel::Parameters& vessel) {
  planner::Query query;
  query.limits = inTheLoad(vessel);
  query.start.psi_rad = query.goal.psi_rad = kPi;
  query.goal.flat.position = {30.0, 2.0};
  const map::DistanceField field = planner::test::openWater();
  planner::Planner planner(planner::Options{}, vessel);
  planner::Termination termination;
  planner::Plan plan = planner.plan(feasibility::Obstacles(field), query, termination);
  EXPECT_EQ(plan.outcome, planner::Outcome::kSolved);
  ToLeeward way{std::move(plan.trajectory)};
  for (const trajectory::Piece& piece : way.trajectory.pieces()) {
    if (piece.kind != trajectory::PieceKind::kSpin) {
      break;
    }
    way.turn_s += piece.duration_s;
  }
  return way;
}

// The load pushes otter with `force_n`; she lies bow to it until it is known.
VesselAtSea lyingIn(const Eigen::Vector2d& force_n) {
  VesselAtSea sea("none", 0.0, "otter", force_n);
  sea.plant().placeAt({0.0, 0.0}, kPi);
  sea.tracker().requestStop("until the load is known", sea.now(), 1);
  sea.sail(kLiesStillS);
  return sea;
}

// A hull abeam of a load is set aside, but here that is the plan: the heading doesn't yield, or it
// would be gone where the way goes on. The load turns after the plan was made, and is half as much
// again.
TEST(CarriedTurn, EndsWhereThePlanGoesOn) {
  const vessel::Parameters vessel = otter();
  const auto [trajectory, turn_s] = toLeeward(vessel);
  const trajectory::MotionAlong planned(trajectory, vessel, inTheLoad(vessel).disturbance, kPi);
  ASSERT_GT(turn_s, 5.0);
  ASSERT_GT(planned.sample(turn_s).flat.velocity.norm(), 0.3);
  struct Load {
    double pushed_n, turned_rad;
    double most_m = 0.6;
  };
  for (const auto [pushed_n, turned_rad, most_m] :
       {Load{kPlannedN, -0.5}, Load{kPlannedN, 0.0}, Load{kPlannedN, 0.5},
        // What lay still before takes the force for a current; the last is more than the thrust
        // holds.
        Load{1.5 * kPlannedN, -0.5}, Load{1.5 * kPlannedN, 0.0}, Load{1.5 * kPlannedN, 0.25, 1.2},
        Load{1.5 * kPlannedN, 0.5, 2.3}}) {
    VesselAtSea sea = lyingIn(pushed_n * unitVector(turned_rad));
    ASSERT_TRUE(sea.tracker().setTrajectory({trajectory, kLiesStillS}, 2));
    sea.sail(turn_s);
    const vessel::State end = planned.sample(turn_s).state;
    EXPECT_LT((sea.truth() - end).head<2>().norm(), most_m) << pushed_n << " N, " << turned_rad;
    EXPECT_NEAR(wrapAngle((sea.truth() - end)[vessel::kPsi]), 0.0, 0.4)
        << pushed_n << " N, " << turned_rad;
  }
}

// No stop along that turn's path is one, for the hull lies across it. Off the stop by what it
// doesn't know of the load, it lies still bow to it in the end, near where the stop ends.
TEST(CarriedTurn, StopsOnTheWay) {
  constexpr double kFirstS = 1.0;
  constexpr double kApartS = 1.0;
  constexpr double kSettlesS = 15.0;
  constexpr double kMostM = 1.2;
  const vessel::Parameters vessel = otter();
  const auto [trajectory, turn_s] = toLeeward(vessel);
  const map::DistanceField field = planner::test::openWater();
  stopping::StopLimits limits;
  limits.clearance_m = 1.0;
  limits.disturbance = inTheLoad(vessel).disturbance;
  int under_way = 0;
  for (double at_s = kFirstS; at_s < turn_s; at_s += kApartS) {
    under_way += trajectory.flat(at_s).velocity.norm() > 0.3 ? 1 : 0;
    const stopping::Braking stop = stopping::brakingTrajectory(
        trajectory, at_s, feasibility::Obstacles(field), vessel, limits);
    ASSERT_TRUE(stop.clear) << at_s;
    VesselAtSea sea = lyingIn(limits.disturbance.force_n);
    ASSERT_TRUE(sea.tracker().setTrajectory({trajectory, kLiesStillS}, 2));
    sea.sail(at_s);
    ASSERT_TRUE(sea.tracker().setTrajectory({stop.trajectory, sea.now()}, 3));
    EXPECT_LT(sea.sail(stop.trajectory.duration()).max_error_m, kMostM) << at_s;
    EXPECT_LT(sea.sail(kSettlesS).max_error_m, kMostM) << at_s;
    EXPECT_LT(vessel::speedOf(sea.truth()), vessel::kRestMps) << at_s;
    EXPECT_NEAR(std::abs(wrapAngle(sea.truth()[vessel::kPsi])), kPi, 0.8) << at_s;
  }
  EXPECT_GE(under_way, 5);
}

}  // namespace
}  // namespace otter_nav::tracker
