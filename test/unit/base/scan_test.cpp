#include "otter_nav/base/scan.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

namespace otter_nav {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Scan scanOf(std::vector<float> ranges_m) {
  return {-1.0, 0.5, 0.2, 25.0, std::move(ranges_m)};
}

TEST(Scan, SaysWhyItIsUnusable) {
  EXPECT_EQ(whyUnusable(scanOf({3.0F, kInf, kNaN})), "");
  EXPECT_EQ(whyUnusable(scanOf({3.0F, -1.0F})), "range 1 is negative");
  EXPECT_NE(whyUnusable(scanOf({})), "");
  Scan scan = scanOf({3.0F, 4.0F});
  scan.range_max_m = 0.0;
  EXPECT_NE(whyUnusable(scan), "");
}

TEST(Scan, IsBlindIfNoBeamSaysAnything) {
  EXPECT_EQ(whyBlind(scanOf({kNaN, kInf})), "");
  EXPECT_EQ(whyBlind(scanOf({kNaN, 25.0F})), "");
  EXPECT_NE(whyBlind(scanOf({kNaN, -kInf})), "");
  EXPECT_NE(whyBlind(scanOf({0.1F, 26.0F})), "");
  EXPECT_EQ(whyUnusable(scanOf({kNaN, -kInf})), "");
}

}  // namespace
}  // namespace otter_nav
