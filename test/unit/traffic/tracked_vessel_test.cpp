// What single views of a hull tell of her.
#include "traffic/tracked_vessel.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::traffic {
namespace {

constexpr double kSpacingM = 0.1;
const Eigen::Vector2d kEye(0.0, 0.0);
const Eigen::Vector2d kMiddle(15.0, 10.0);

// Northbound at 2 m/s, north-east of the sensor at the origin.
TrackedVessel northbound(double speed_deviation_mps = 0.1) {
  Measurement first;
  first.has_velocity = true;
  first.value << kMiddle.x(), kMiddle.y(), 0.0, 2.0;
  first.covariance.diagonal() << 0.1, 0.1, speed_deviation_mps * speed_deviation_mps,
      speed_deviation_mps * speed_deviation_mps;
  TrackedVessel vessel(1, first, 0.0, kLidar);
  vessel.followCourse();
  return vessel;
}

// The sides of a hull that the origin sees: her port side and her stern. Her middle is kMiddle.
Cluster sidesOf(double length_m, double beam_m) {
  const Eigen::Vector2d corner = kMiddle - 0.5 * Eigen::Vector2d(beam_m, length_m);
  Cluster cluster;
  for (double off = beam_m; off > 0.0; off -= kSpacingM) {
    cluster.points.emplace_back(corner.x() + off, corner.y());
  }
  for (double off = 0.0; off < length_m; off += kSpacingM) {
    cluster.points.emplace_back(corner.x(), corner.y() + off);
  }
  cluster.beams.resize(cluster.points.size());
  return cluster;
}

TEST(TrackedVessel, LearnsHerSizeAndIsNoFasterForIt) {
  TrackedVessel vessel = northbound();
  ASSERT_TRUE(vessel.heading_rad);
  vessel.learnSize(sidesOf(5.0, 2.0), kEye);
  EXPECT_NEAR(vessel.length_m, 5.0, 0.2);
  EXPECT_NEAR(vessel.beam_m, 2.0, 0.2);
  EXPECT_NEAR(vessel.motion.state()[3], 2.0, 1e-9);
}

// Two abreast that look like one.
TEST(TrackedVessel, IsNotBroaderThanLong) {
  TrackedVessel vessel = northbound();
  vessel.size = TrackedVessel::Size::kSeen;
  vessel.length_m = 5.0;
  vessel.beam_m = 2.0;
  for (const double beam_m : {6.5, 9.0}) {
    vessel.learnSize(sidesOf(5.5, beam_m), kEye);
    EXPECT_EQ(vessel.length_m, 5.0);
    EXPECT_EQ(vessel.beam_m, 2.0);
  }
}

TEST(TrackedVessel, LiesAlongHerLongerSide) {
  const std::optional<double> axis = TrackedVessel::axisOf(sidesOf(5.0, 2.0), kEye);
  ASSERT_TRUE(axis);
  EXPECT_NEAR(std::abs(unitVector(*axis).y()), 1.0, 0.01);
  EXPECT_FALSE(TrackedVessel::axisOf(sidesOf(4.0, 3.5), kEye));  // about as broad as long
  Cluster cut = sidesOf(5.0, 2.0);
  cut.out_of_range = true;
  EXPECT_FALSE(TrackedVessel::axisOf(cut, kEye));
}

// What a first course is off by, her sides make good.
TEST(TrackedVessel, IsMeasuredAlongHerSidesWhereHerCourseIsHardlyKnown) {
  TrackedVessel vessel = northbound(0.5);
  vessel.heading_rad = 0.0;
  const Eigen::Vector2d middle = vessel.measure(sidesOf(5.0, 2.0), kEye).value.head<2>();
  EXPECT_LT((middle - kMiddle).norm(), 0.1);
  vessel.learnSize(sidesOf(5.0, 2.0), kEye);
  EXPECT_NEAR(vessel.length_m, 5.0, 0.2);
  EXPECT_NEAR(vessel.beam_m, 2.0, 0.2);
}

// And where they don't, as where she is half in range, that course makes nothing of her.
TEST(TrackedVessel, IsNotMeasuredAlongACourseThatIsHardlyKnown) {
  Cluster cut = sidesOf(6.0, 2.0);
  cut.out_of_range = true;
  TrackedVessel vessel = northbound(0.7);
  vessel.hits = 100;
  vessel.heading_rad = 0.5 * kPi;
  const Eigen::Vector2d middle = vessel.measure(cut, kEye).value.head<2>();
  vessel.heading_rad = 0.0;
  EXPECT_LT((vessel.measure(cut, kEye).value.head<2>() - middle).norm(), 1e-9);
  const double beam_m = vessel.beam_m;
  vessel.learnSize(cut, kEye);
  EXPECT_EQ(vessel.beam_m, beam_m);
}

TEST(TrackedVessel, ForgetsWhatAWorseHeadingMadeOfHer) {
  TrackedVessel vessel = northbound();
  vessel.size = TrackedVessel::Size::kSeen;
  vessel.length_m = 5.0;
  vessel.beam_m = 4.0;
  vessel.sized_within_rad = 0.3;
  vessel.learnSize(sidesOf(5.0, 2.0), kEye);
  EXPECT_NEAR(vessel.beam_m, 2.0, 0.2);
}

ais::Message dimensions(int bow_m, int stern_m, int port_m, int starboard_m) {
  ais::Message message;
  message.to_bow_m = bow_m;
  message.to_stern_m = stern_m;
  message.to_port_m = port_m;
  message.to_starboard_m = starboard_m;
  return message;
}

// A hull that comes into sight shows more of herself with each look, one in waves more or less,
// where she was expected; or she is met elsewhere, the same as ever. Clutter does both.
TEST(TrackedVessel, IsAlikeInShapeOrInCourse) {
  constexpr int kLooks = 20;
  const auto looksAlike = [&](double other_length_m, double surprise2, TrackedVessel& vessel) {
    for (int look = 0; look < kLooks; ++look) {
      vessel.compare(sidesOf(look % 2 == 0 ? 2.0 : other_length_m, 1.0), surprise2);
    }
    return vessel.isAlike();
  };
  const auto anew = [&](double other_length_m, double surprise2) {
    TrackedVessel vessel = northbound();
    return looksAlike(other_length_m, surprise2, vessel);
  };
  EXPECT_TRUE(anew(2.0, 0.1));
  EXPECT_TRUE(anew(4.0, 0.1));
  EXPECT_TRUE(anew(2.0, 3.0));
  EXPECT_FALSE(anew(4.0, 3.0));

  // What she was like before a doubt, or long ago, counts no more.
  TrackedVessel doubted = northbound();
  ASSERT_FALSE(looksAlike(4.0, 3.0, doubted));
  doubted.doubt(1.0);
  doubted.compare(sidesOf(4.0, 1.0), 3.0);
  doubted.compare(sidesOf(4.0, 1.0), 0.1);
  EXPECT_TRUE(doubted.isAlike());
  TrackedVessel before = northbound();
  ASSERT_FALSE(looksAlike(4.0, 3.0, before));
  for (int times = 0; times < 10; ++times) {
    looksAlike(2.0, 0.1, before);
  }
  EXPECT_TRUE(before.isAlike());
  for (int times = 0; times < 2; ++times) {
    looksAlike(4.0, 3.0, before);
  }
  EXPECT_FALSE(before.isAlike());
}

// A track beyond it is refused, and all others with it.
TEST(TrackedVessel, IsNoLongerThanAnyVessel) {
  for (const bool is_headed : {false, true}) {
    for (const ais::Message& reported :
         {dimensions(511, 511, 63, 63), dimensions(511, 0, 10, 10), dimensions(200, 20, 63, 63)}) {
      TrackedVessel vessel = northbound();
      if (!is_headed) {
        vessel.heading_rad.reset();
      }
      vessel.takeDimensions(reported);
      const Track track = vessel.track();
      EXPECT_LE(std::max(track.length_m, track.beam_m), kLongestM) << reported.to_bow_m;
      EXPECT_GT(std::min(track.length_m, track.beam_m), 0.0) << reported.to_bow_m;
    }
  }
}

TEST(TrackedVessel, KeepsTheSizeThatAReportCannotMean) {
  TrackedVessel vessel = northbound();
  vessel.takeDimensions(dimensions(20, 10, 4, 4));
  vessel.takeDimensions(dimensions(511, 511, 63, 63));
  EXPECT_EQ(vessel.length_m, 30.0);
  EXPECT_EQ(vessel.beam_m, 8.0);
  EXPECT_EQ(vessel.dimensions->to_bow_m, 20);
}

}  // namespace
}  // namespace otter_nav::traffic
