// The tracker against the plant where a plan to leeward begins with a turn during which the load
// carries the hull.
#include "../../unit/planner/planner_ground.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/planner/planner.hpp"
#include "otter_nav/trajectory/motion_along.hpp"
#include "vessel_at_sea.hpp"

namespace otter_nav::tracker {
namespace {

using test::VesselAtSea;

// A hull abeam of a load is set aside, but here that is the plan: the heading doesn't yield, or it
// would be gone where the way goes on. The load turns after the plan was made, and is half as much
// again.
TEST(CarriedTurn, EndsWhereThePlanGoesOn) {
  constexpr double kPlannedN = 40.0;
  constexpr double kWaitS = 10.0;
  const auto otter = vessel::loadParameters(test::kSource + "/config/vessels/otter.yaml");
  ASSERT_TRUE(otter);
  planner::Query query;
  query.limits = feasibility::SafetyLimits::of(*otter, 1.0, 0.7);
  query.limits.disturbance.force_n = {kPlannedN, 0.0};
  query.start.psi_rad = query.goal.psi_rad = kPi;
  query.goal.flat.position = {30.0, 2.0};
  const map::DistanceField field = planner::test::openWater();
  planner::Planner planner(planner::Options{}, *otter);
  planner::Termination termination;
  const planner::Plan plan = planner.plan(feasibility::Obstacles(field), query, termination);
  ASSERT_EQ(plan.outcome, planner::Outcome::kSolved);
  const trajectory::MotionAlong planned(plan.trajectory, *otter, query.limits.disturbance, kPi);
  double turn_s = 0.0;
  for (const trajectory::Piece& piece : plan.trajectory.pieces()) {
    if (piece.kind != trajectory::PieceKind::kSpin) {
      break;
    }
    turn_s += piece.duration_s;
  }
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
    VesselAtSea sea("none", 0.0, "otter", pushed_n * unitVector(turned_rad));
    sea.plant().placeAt({0.0, 0.0}, kPi);
    sea.tracker().requestStop("until the load is known", sea.now(), 1);
    sea.sail(kWaitS);
    ASSERT_TRUE(sea.tracker().setTrajectory({plan.trajectory, kWaitS}, 2));
    sea.sail(turn_s);
    const vessel::State end = planned.sample(turn_s).state;
    EXPECT_LT((sea.truth() - end).head<2>().norm(), most_m) << pushed_n << " N, " << turned_rad;
    EXPECT_NEAR(wrapAngle((sea.truth() - end)[vessel::kPsi]), 0.0, 0.4)
        << pushed_n << " N, " << turned_rad;
  }
}

}  // namespace
}  // namespace otter_nav::tracker
