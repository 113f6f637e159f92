#include "otter_nav/encounter/surprise.hpp"

#include <gtest/gtest.h>

namespace otter_nav::encounter {
namespace {

traffic::Track trackAt(int id, const Eigen::Vector2d& position, const Eigen::Vector2d& velocity) {
  traffic::Track track;
  track.id = id;
  track.position = position;
  track.velocity = velocity;
  return track;
}

const Eigen::Vector2d kHere = Eigen::Vector2d::Zero();

TEST(Surprise, IsWhoTurnsNear) {
  Surprise surprise;
  surprise.decided({trackAt(1, {8.0, 0.0}, {0.0, 2.0})});
  EXPECT_FALSE(surprise.isNear(kHere, {trackAt(1, {8.0, 0.4}, {0.0, 2.0})}));
  EXPECT_FALSE(surprise.isNear(kHere, {trackAt(1, {8.0, 0.4}, {0.3, 1.8})}));  // tracks wander
  EXPECT_TRUE(surprise.isNear(kHere, {trackAt(1, {8.0, 0.4}, {-1.0, 1.8})}));
  EXPECT_TRUE(surprise.isNear(kHere, {trackAt(1, {8.0, 0.4}, {0.0, 0.2})}));
  // Decided again she is none any more.
  surprise.decided({trackAt(1, {8.0, 0.4}, {-1.0, 1.8})});
  EXPECT_FALSE(surprise.isNear(kHere, {trackAt(1, {7.8, 0.6}, {-1.1, 1.8})}));
}

TEST(Surprise, IsWhoComesIntoSightNear) {
  Surprise surprise;
  surprise.decided({});
  EXPECT_TRUE(surprise.isNear(kHere, {trackAt(1, {8.0, 0.0}, {0.0, 2.0})}));
  EXPECT_FALSE(surprise.isNear(kHere, {trackAt(1, {8.0, 0.0}, {0.0, 0.2})}));  // she lies still
}

TEST(Surprise, IsNobodyFarOff) {
  Surprise surprise;
  surprise.decided({trackAt(1, {15.0, 0.0}, {0.0, 2.0})});
  EXPECT_FALSE(surprise.isNear(kHere, {trackAt(1, {15.0, 0.2}, {-2.0, 0.0})}));
  EXPECT_FALSE(surprise.isNear(kHere, {trackAt(2, {15.0, 0.2}, {-2.0, 0.0})}));
}

}  // namespace
}  // namespace otter_nav::encounter
