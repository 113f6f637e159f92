#include "traffic/association.hpp"

#include <gtest/gtest.h>

namespace otter_nav::traffic {
namespace {

TEST(Association, AFewTracksShareTheirDetectionsExactly) {
  // Both may be either; events: none, one of four, two of two.
  const Marginals both =
      jointMarginals({0.5, 0.5}, {{{0, 2.0}, {1, 1.0}}, {{0, 1.0}, {1, 2.0}}}, 2);
  const double none = 0.25;
  const double sum = none + 0.5 * (2.0 + 1.0 + 1.0 + 2.0) + 2.0 * 2.0 + 1.0 * 1.0;
  EXPECT_NEAR(both.none[0], (none + 0.5 * (1.0 + 2.0)) / sum, 1e-12);
  EXPECT_NEAR(both.links[0][0], (2.0 * 0.5 + 2.0 * 2.0) / sum, 1e-12);
  EXPECT_NEAR(both.links[0][1], (1.0 * 0.5 + 1.0 * 1.0) / sum, 1e-12);
}

// Each of many has a detection that fits, and their neighbours' hardly: tied together they could be
// given out in more ways than anybody can count.
TEST(Association, ManyInARowThatHardlyTouchAreDealtWith) {
  constexpr std::size_t kMany = 60;
  std::vector<std::vector<Link>> links(kMany);
  for (std::size_t t = 0; t < kMany; ++t) {
    links[t].push_back({t, 100.0});
    links[t].push_back({(t + 1) % kMany, 1e-3});
    links[t].push_back({(t + 2) % kMany, 1e-3});
  }
  const Marginals all = jointMarginals(std::vector<double>(kMany, 0.1), links, kMany);
  for (std::size_t t = 0; t < kMany; ++t) {
    EXPECT_GT(all.links[t][0], 0.99);
    EXPECT_NEAR(all.none[t] + all.links[t][0] + all.links[t][1] + all.links[t][2], 1.0, 1e-9);
  }
}

// Even where all fit alike.
TEST(Association, ManyThatFitAlikeAreDealtWith) {
  constexpr std::size_t kMany = 30;
  std::vector<std::vector<Link>> links(kMany);
  for (std::vector<Link>& of_track : links) {
    for (std::size_t d = 0; d < kMany; ++d) {
      of_track.push_back({d, 1.0 + 0.01 * static_cast<double>(d)});
    }
  }
  const Marginals all = jointMarginals(std::vector<double>(kMany, 0.5), links, kMany);
  double taken = 0.0;
  for (const std::vector<double>& of_track : all.links) {
    for (const double link : of_track) {
      taken += link;
    }
  }
  EXPECT_GT(taken, 0.4);
  EXPECT_LE(taken, static_cast<double>(kMany));
}

}  // namespace
}  // namespace otter_nav::traffic
