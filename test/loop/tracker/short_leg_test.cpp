// The tracker against the plant on a leg that is over before the hull has gathered way.
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "vessel_at_sea.hpp"

namespace otter_nav::tracker {
namespace {

using test::VesselAtSea;

// A few decimetres ahead from rest to rest, as plans from stop to stop have them where it is
// narrow. In a wind in which the hull lies on any heading it is not turned on the way.
TEST(ShortLeg, KeepsItsHeadingInALightWind) {
  constexpr double kWaitS = 5.0;
  for (const double psi : {-0.5, 0.0, 0.4, 1.95, 2.6}) {
    for (const double length : {0.1, 0.3, 0.6}) {
      VesselAtSea sea("paper");
      sea.plant().placeAt({0.0, 0.0}, psi);
      sea.tracker().requestStop("until the wind is known", sea.now(), 1);
      sea.sail(kWaitS);
      const double duration = 1.5 + length;
      ASSERT_TRUE(sea.tracker().setTrajectory(
          {VesselAtSea::line({0.0, 0.0}, length * unitVector(psi), duration), kWaitS}, 2));
      for (double t = 0.0; t < duration; t += 0.05) {
        sea.sail(0.05);
        EXPECT_NEAR(wrapAngle(sea.truth()[vessel::kPsi] - psi), 0.0, 0.3) << psi << ", " << length;
        EXPECT_NEAR(cross(unitVector(psi), sea.truth().head<2>()), 0.0, 0.15) << psi;
      }
    }
  }
}

}  // namespace
}  // namespace otter_nav::tracker
