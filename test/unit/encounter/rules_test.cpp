#include "otter_nav/encounter/rules.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::encounter {
namespace {

// A vessel that meets us at the origin after 100 s on compass heading `heading_deg`; we go north
// at 2 m/s.
struct Meeting {
  Motion own{{0.0, -200.0}, {0.0, 2.0}};
  Motion other;
  Meeting(double heading_deg, double speed_mps) {
    other.velocity = speed_mps * Eigen::Vector2d(std::sin(heading_deg * kDegree),
                                                 std::cos(heading_deg * kDegree));
    other.position = -100.0 * other.velocity;
  }
};

TEST(Rules, EverybodyMeetsAtTheOrigin) {
  const Meeting m(270.0, 2.0);
  const Approach approach = nearestApproach(m.own, m.other);
  EXPECT_NEAR(approach.time_s, 100.0, 1e-9);
  EXPECT_NEAR(approach.distance_m, 0.0, 1e-9);
  EXPECT_TRUE(riskOfCollision(approach));
  EXPECT_FALSE(riskOfCollision({-1.0, 0.0}));
  EXPECT_FALSE(riskOfCollision({100.0, 15.1}));
  EXPECT_FALSE(riskOfCollision({120.1, 0.0}));
}

TEST(Rules, BearingsArePositiveToStarboard) {
  const Meeting m(270.0, 2.0);  // she comes from the east
  EXPECT_NEAR(bearing(m.own, m.other), 45.0 * kDegree, 1e-9);
  EXPECT_NEAR(aspect(m.own, m.other), -45.0 * kDegree, 1e-9);
}

// Imazu's headings, and both sides of each limit.
TEST(Rules, GeometryDecides) {
  EXPECT_EQ(classify(Meeting(180.0, 2.0).own, Meeting(180.0, 2.0).other), Role::kHeadOn);
  EXPECT_EQ(classify(Meeting(0.0, 1.4).own, Meeting(0.0, 1.4).other), Role::kOvertaking);
  EXPECT_EQ(classify(Meeting(0.0, 3.0).own, Meeting(0.0, 3.0).other), Role::kOvertaken);
  EXPECT_EQ(classify(Meeting(270.0, 2.0).own, Meeting(270.0, 2.0).other), Role::kGiveWay);
  EXPECT_EQ(classify(Meeting(45.0, 2.0).own, Meeting(45.0, 2.0).other), Role::kStandOn);
  EXPECT_EQ(classify(Meeting(350.0, 2.0).own, Meeting(350.0, 2.0).other), Role::kGiveWay);
  // 11.5 and 12.5 deg on both bows.
  EXPECT_EQ(classify(Meeting(203.0, 2.0).own, Meeting(203.0, 2.0).other), Role::kHeadOn);
  EXPECT_EQ(classify(Meeting(205.0, 2.0).own, Meeting(205.0, 2.0).other), Role::kGiveWay);
  // As slow as she is, nobody overtakes.
  EXPECT_NE(classify(Meeting(0.0, 1.99).own, Meeting(0.0, 1.99).other), Role::kGiveWay);
  const Motion abeam{{30.0, -210.0}, {-0.3, 2.0}};
  EXPECT_EQ(classify(Meeting(0.0, 1.4).own, abeam), Role::kGiveWay);
}

TEST(Rules, WhoActs) {
  for (const Role role : {Role::kHeadOn, Role::kOvertaking, Role::kGiveWay}) {
    EXPECT_TRUE(givesWay(role));
    EXPECT_FALSE(standsOn(role));
  }
  EXPECT_TRUE(standsOn(Role::kStandOn));
  EXPECT_TRUE(standsOn(Role::kOvertaken));
  EXPECT_FALSE(givesWay(Role::kNone) || standsOn(Role::kNone));
}

}  // namespace
}  // namespace otter_nav::encounter
