// The tracker on ways that are decided several times a second, each of which may lead elsewhere.
#include "otter_nav/encounter/evasion.hpp"

#include "../../unit/encounter/open_water.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/random.hpp"
#include "otter_nav/stopping/splice.hpp"
#include "vessel_at_sea.hpp"

namespace otter_nav::tracker {
namespace {

using encounter::Evasion;

// What a voyage among others shows, who come up near her on any course once a second.
struct Followed {
  int moments = 0;
  int off = 0;          // the hull's velocity by more than 0.5 m/s
  double most_m = 0.0;  // off the reference
};
Followed followedAmongOthers(std::uint64_t seed) {
  constexpr double kVoyageS = 60.0;
  constexpr double kDecidesS = 0.25;
  constexpr double kAheadS = 0.15;
  constexpr double kLookS = 0.05;
  test::VesselAtSea sea("paper");
  const vessel::Parameters vessel =
      *vessel::loadParameters(test::kSource + "/config/vessels/otter_gazebo.yaml");
  const map::DistanceField water = encounter::test::openWater();
  const Evasion evasion(vessel);
  Random random(seed);
  trajectory::TimedTrajectory sailed;
  std::vector<traffic::Track> others;
  Followed followed;
  while (sea.now() < kVoyageS) {
    const vessel::State& hull = sea.truth();
    if (std::fmod(sea.now() + 1e-6, 1.0) < kDecidesS) {
      others.clear();
      for (int k = 0; k < 3; ++k) {
        const double bearing = random.uniform(-kPi, kPi);
        const Eigen::Vector2d from = random.uniform(7.0, 11.0) * unitVector(bearing);
        const double mps = random.uniform(1.5, 4.0);
        const double course = bearing + kPi + random.uniform(-0.5, 0.5);
        others.push_back(
            encounter::test::square(k + 1, hull.head<2>() + from, mps * unitVector(course)));
        others.back().stamp_s = sea.now();
      }
    }
    Evasion::Task task;
    task.start_s = sea.now();
    if (sailed.trajectory.empty()) {
      task.start.position = hull.head<2>();
      task.state = hull;
    } else {
      task.start_s += kAheadS;
      const trajectory::Sample there =
          sailed.trajectory.sample(sailed.elapsed(task.start_s), vessel);
      task.start = there.flat;
      task.state = there.state;
      task.thrusts = there.thrusts;
    }
    task.speed_max_mps = 3.5;
    task.goal = {Eigen::Vector2d(15.0, 0.0), 0.0};
    const Evasion::Way way = evasion.find(task, others, water);
    if (!way.path.trajectory.empty()) {
      sailed = sailed.trajectory.empty() ? way.path : stopping::splice(sailed, sea.now(), way.path);
      EXPECT_TRUE(sea.tracker().setTrajectory(sailed));
    }
    for (double t = 0.0; t < kDecidesS - 1e-6; t += kLookS) {
      const test::Stretch stretch = sea.sail(kLookS);
      const trajectory::Sample meant = sailed.trajectory.sample(sailed.elapsed(sea.now()), vessel);
      const Eigen::Vector2d velocity =
          turned(sea.truth().segment<2>(vessel::kSurge), sea.truth()[vessel::kPsi]);
      ++followed.moments;
      followed.off += (velocity - meant.flat.velocity).norm() > 0.5 ? 1 : 0;
      followed.most_m = std::max(followed.most_m, stretch.max_error_m);
    }
  }
  return followed;
}

// The plan of a way that is over, braking and turning for it, is no start for that of another one:
// from there the hull turns to the other side for a second.
TEST(EvasionAtSea, IsFollowedThoughEachWayLeadsElsewhere) {
  for (const std::uint64_t seed : {3U, 6U}) {
    const Followed followed = followedAmongOthers(seed);
    EXPECT_GT(followed.moments, 1000) << seed;
    EXPECT_LT(followed.off, 0.001 * followed.moments) << seed;
    EXPECT_LT(followed.most_m, 0.2) << seed;
  }
}

}  // namespace
}  // namespace otter_nav::tracker
