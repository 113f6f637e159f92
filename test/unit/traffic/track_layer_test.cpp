// Tracks as obstacles: outlines where they will be, grown by what is uncertain, and the bounds that
// every walk through space and time relies on.
#include "otter_nav/traffic/track_layer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/random.hpp"

namespace otter_nav::traffic {
namespace {

PredictionOptions certain() {
  PredictionOptions options;
  options.stray_deviation_mps = 0.0;
  return options;
}

Track eastward() {
  Track track;
  track.stamp_s = 100.0;
  track.position = {10.0, 5.0};
  track.velocity = {2.0, 0.0};
  track.length_m = 6.0;
  track.beam_m = 2.0;
  return track;
}

TEST(TrackLayer, HoldsTheOutlineWhereItWillBe) {
  const TrackLayer layer({eastward()}, certain());
  // 20 s on, the middle is at (50, 5).
  EXPECT_NEAR(layer.clearance({58.0, 5.0}, 120.0), 5.0, 1e-9);
  EXPECT_NEAR(layer.clearance({50.0, 9.0}, 120.0), 3.0, 1e-9);
  EXPECT_NEAR(layer.clearance({56.0, 10.0}, 120.0), 5.0, 1e-9);  // 3, 4 off the corner
  EXPECT_EQ(layer.clearance({50.0, 5.5}, 120.0), 0.0);
  EXPECT_NEAR(layer.smooth({50.0, 5.5}, 120.0).distance_m, -0.5, 1e-9);
  // Before the stamp it was astern of here, beyond the horizon it goes on.
  EXPECT_NEAR(layer.clearance({3.0, 5.0}, 99.0), 2.0, 1e-9);
  EXPECT_NEAR(layer.clearance({10.0 + 2.0 * 500.0 + 4.0, 5.0}, 600.0), 1.0, 1e-6);
  EXPECT_NEAR(layer.rateBound(), 2.0, 1e-9);
}

TEST(TrackLayer, OfNothingIsFarAway) {
  const TrackLayer layer;
  EXPECT_EQ(layer.clearance({0.0, 0.0}, 1.0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(layer.rateBound(), 0.0);
}

TEST(TrackLayer, TurnsWithATrackThatTurns) {
  Track track = eastward();
  track.turn_rate_radps = 0.1;
  track.turn_time_s = 1e6;  // goes on turning
  const TrackLayer layer({track}, certain());
  // A quarter of the circle of 20 m about (10, 25).
  const double quarter_s = 100.0 + 0.5 * kPi / 0.1;
  const Outline outline = layer.paths()[0].at(quarter_s);
  EXPECT_NEAR((outline.position - Eigen::Vector2d(30.0, 25.0)).norm(), 0.0, 0.05);
  EXPECT_NEAR(outline.heading_rad, 0.5 * kPi, 1e-2);
  EXPECT_NEAR((outline.bow - unitVector(outline.heading_rad)).norm(), 0.0, 1e-12);
  // Half a metre before the bow, which points north by then.
  const double before_bow = outline.half_length_m + 0.5;
  EXPECT_NEAR(outline.distanceTo(outline.position + Eigen::Vector2d(0.0, before_bow)).distance_m,
              0.5, 0.05);
  // A turn that dies out ends at its time constant's worth of angle.
  track.turn_time_s = 5.0;
  const Outline late = PredictedPath(track, certain()).at(200.0);
  EXPECT_NEAR(late.heading_rad, 0.5, 1e-2);
}

TEST(TrackLayer, GrowsWithTimeAndNotBeyondItsLimit) {
  Track track = eastward();
  track.covariance.diagonal() << 0.25, 0.01, 0.04, 0.0;
  PredictionOptions options = certain();
  const PredictedPath path(track, options);
  EXPECT_NEAR(path.at(100.0).half_length_m, 3.0 + 2.0 * 0.5, 1e-9);
  EXPECT_NEAR(path.at(100.0).half_beam_m, 1.0 + 2.0 * 0.1, 1e-9);
  EXPECT_NEAR(path.at(105.0).half_length_m, 3.0 + 2.0 * std::sqrt(0.25 + 25.0 * 0.04), 1e-9);
  EXPECT_NEAR(path.at(150.0).half_length_m, 3.0 + options.growth_max_m, 1e-9);
  EXPECT_NEAR(path.at(150.0).half_beam_m, 1.2, 1e-9);
}

// Who keeps her place may be off by what is not known of it, and by no more as time goes on.
TEST(TrackLayer, DoesNotLetStrayWhoKeepsHerPlace) {
  Track track = eastward();
  track.velocity.setZero();
  track.covariance.setZero();
  track.covariance.diagonal().head<2>().setConstant(0.25);
  const PredictionOptions options;
  EXPECT_GT(PredictedPath(track, options).at(130.0).half_beam_m, 2.2);
  track.keeps_place = true;
  const PredictedPath path(track, options);
  EXPECT_NEAR(path.at(130.0).half_beam_m, 1.0 + options.sigmas * 0.5, 1e-9);
  EXPECT_EQ(path.rateBound(), 0.0);
}

// The strayed positions of many simulated vessels have the variance that is said.
TEST(TrackLayer, StraysAsAnOrnsteinUhlenbeckProcess) {
  PredictionOptions options;
  options.stray_deviation_mps = 0.3;
  options.stray_time_s = 4.0;
  const Track after = predicted(eastward(), 110.0, options);
  Random random(3);
  const double dt = 0.02;
  const double kept = std::exp(-dt / options.stray_time_s);
  const double kick = options.stray_deviation_mps * std::sqrt(1.0 - kept * kept);
  double xx = 0.0;
  double xv = 0.0;
  double vv = 0.0;
  constexpr int kRuns = 4000;
  for (int run = 0; run < kRuns; ++run) {
    double x = 0.0;
    double v = 0.0;
    for (int k = 0; k < 500; ++k) {
      x += dt * v;
      v = kept * v + kick * random.normal();
    }
    xx += x * x / kRuns;
    xv += x * v / kRuns;
    vv += v * v / kRuns;
  }
  EXPECT_NEAR(after.covariance(0, 0) / xx, 1.0, 0.08);
  EXPECT_NEAR(after.covariance(0, 2) / xv, 1.0, 0.1);
  EXPECT_NEAR(after.covariance(2, 2) / vv, 1.0, 0.08);
  EXPECT_EQ(after.covariance(0, 1), 0.0);
}

Track anyTrack(Random& random) {
  Track track;
  track.position = {random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0)};
  const double course = random.uniform(-kPi, kPi);
  track.velocity = random.uniform(0.0, 4.0) * Eigen::Vector2d(std::cos(course), std::sin(course));
  track.heading_rad = course + random.uniform(-0.3, 0.3);
  track.turn_rate_radps = random.uniform(-0.3, 0.3);
  track.shape = random.uniform() < 0.3 ? Shape::kDisc : Shape::kBox;
  track.length_m = random.uniform(1.0, 8.0);
  track.beam_m = track.shape == Shape::kDisc ? track.length_m : random.uniform(0.5, 3.0);
  const Eigen::Matrix4d root = 0.2 * Eigen::Matrix4d::NullaryExpr([&] { return random.normal(); });
  track.covariance = root * root.transpose();
  return track;
}

// Whatever the tracks: 1-Lipschitz in place, within the bound in time, and a slope that is one.
TEST(TrackLayer, KeepsItsBounds) {
  Random random(11);
  for (int run = 0; run < 200; ++run) {
    const TrackLayer layer({anyTrack(random), anyTrack(random)}, PredictionOptions{});
    for (int k = 0; k < 50; ++k) {
      const Eigen::Vector2d p(random.uniform(-30.0, 30.0), random.uniform(-30.0, 30.0));
      const double t = random.uniform(-5.0, 130.0);
      const Eigen::Vector2d q = p + Eigen::Vector2d(random.normal(), random.normal());
      const double dt = random.uniform(0.0, 2.0);
      const double here = layer.clearance(p, t);
      EXPECT_LE(std::abs(layer.clearance(q, t) - here), (q - p).norm() + 1e-9);
      EXPECT_LE(std::abs(layer.clearance(p, t + dt) - here), layer.rateBound() * dt + 1e-9);
      const double enough = random.uniform(0.0, 40.0);
      const double within = layer.clearanceWithin(p, t, enough);
      EXPECT_TRUE(here < enough ? within == here : within >= enough);
      const auto smooth = layer.smooth(p, t);
      EXPECT_NEAR(std::max(0.0, smooth.distance_m), here, 1e-12);
      EXPECT_NEAR(smooth.gradient.norm(), 1.0, 1e-9);
      const Eigen::Vector2d step = 1e-6 * smooth.gradient;
      if (smooth.distance_m > 0.1) {
        EXPECT_NEAR((layer.smooth(p + step, t).distance_m - smooth.distance_m) / 1e-6, 1.0, 1e-3);
      }
    }
  }
}

}  // namespace
}  // namespace otter_nav::traffic
