// What scans gather and remember, whatever the clock and however the lidar is mounted.
#include "traffic/scan_clusters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::traffic {
namespace {

constexpr int kBeams = 720;

// Round about, nothing met.
Scan turnOf(double increment_rad) {
  Scan scan;
  scan.angle_min_rad = increment_rad > 0.0 ? -kPi : kPi;
  scan.angle_increment_rad = increment_rad;
  scan.range_min_m = 0.2;
  scan.range_max_m = 25.0;
  scan.ranges_m.assign(kBeams, std::numeric_limits<float>::infinity());
  return scan;
}

// What comes into water seen free is new on any clock, and stands after a while.
TEST(ScanMemory, TellsWhatIsNewOnAnEpochClock) {
  for (const double first_s : {0.0, 1.75e9}) {
    ScanMemory memory;
    const Eigen::Vector2d eye(0.1, 0.1);
    const Eigen::Vector2d there(10.1, 0.1);
    double now = first_s;
    const auto scan = [&] {
      memory.begin(now, eye);
      now += 1.0 / 15.0;
    };
    for (int k = 0; k < 30; ++k) {
      scan();
      memory.passed(eye, {14.0, 0.1});
    }
    scan();
    EXPECT_TRUE(memory.isNew(there)) << first_s;
    for (int k = 0; k < 30; ++k) {
      scan();
      memory.met(there);
    }
    EXPECT_TRUE(memory.isNew(there)) << first_s;
    EXPECT_FALSE(memory.stands(there)) << first_s;
    for (int k = 0; k < 30; ++k) {
      scan();
      memory.met(there);
    }
    EXPECT_FALSE(memory.isNew(there)) << first_s;
    EXPECT_TRUE(memory.stands(there)) << first_s;
  }
}

// What has stood and is hidden by something nearer stands there still when it comes into sight
// again, beside water that beams have passed through; what was seen to be gone doesn't, nor what
// was met once on its way.
TEST(ScanMemory, KnowsAgainWhatWasHiddenMeanwhile) {
  enum class Meanwhile { kHidden, kSeenFree };
  struct Case {
    double met_s;
    Meanwhile meanwhile;
    bool stands;
  };
  for (const Case& one :
       {Case{4.0, Meanwhile::kHidden, true}, Case{4.0, Meanwhile::kSeenFree, false},
        Case{1.0, Meanwhile::kHidden, false}}) {
    ScanMemory memory;
    const Eigen::Vector2d eye(0.1, 0.1);
    const Eigen::Vector2d there(10.1, 0.1);
    double now = 0.0;
    const auto scans = [&](double for_s, const std::function<void()>& each) {
      for (const double until = now + for_s; now < until; now += 1.0 / 15.0) {
        memory.begin(now, eye);
        each();
      }
    };
    const auto seeFree = [&] { memory.passed(eye, {14.0, 0.1}); };
    const auto meet = [&] { memory.met(there); };
    scans(2.0, seeFree);
    scans(one.met_s, meet);
    scans(4.0, one.meanwhile == Meanwhile::kHidden ? [] {} : std::function<void()>(seeFree));
    scans(0.3, meet);
    EXPECT_EQ(memory.stands(there), one.stands) << one.met_s;
    EXPECT_EQ(memory.isNew(there + Eigen::Vector2d(0.0, 0.1)), !one.stands) << one.met_s;
  }
}

const Eigen::Vector2d kScannerAt(0.1, 0.1);
const Eigen::Vector2d kThere(10.1, 0.1);

// Something stands there for four seconds.
void stand(ScanMemory& memory, double now_s) {
  for (int k = 0; k < 60; ++k) {
    memory.begin(now_s + k / 15.0, kScannerAt);
    memory.met(kThere);
  }
}

// However long it runs, and whatever the clock is set to.
TEST(ScanMemory, TellsWhatStandsAfterAMonth) {
  constexpr double kMonthS = 30.0 * 24.0 * 3600.0;
  ScanMemory memory;
  double now_s = 1.75e9;
  stand(memory, now_s);
  for (const double end_s = now_s + kMonthS; now_s < end_s;) {
    now_s += 19.0;
    memory.begin(now_s, kScannerAt);
    memory.met(kThere);
    ASSERT_TRUE(memory.stands(kThere)) << now_s - 1.75e9;
  }
}

TEST(ScanMemory, ForgetsWhereTheClockIsSet) {
  for (const double by_s : {-1000.0, -10.0, 1000.0, 1e7}) {
    ScanMemory memory;
    stand(memory, 1.75e9);
    ASSERT_TRUE(memory.stands(kThere)) << by_s;
    const double now_s = 1.75e9 + 4.0 + by_s;
    memory.begin(now_s, kScannerAt);
    EXPECT_FALSE(memory.stands(kThere)) << by_s;
    memory.met(kThere);
    EXPECT_FALSE(memory.stands(kThere)) << by_s;
    stand(memory, now_s);
    EXPECT_TRUE(memory.stands(kThere)) << by_s;
  }
}

// Counter-clockwise or clockwise, upright or upside down: what is behind a wall to port is hidden,
// what is to starboard isn't.
TEST(ScanClusters, SeesThroughAnyMounting) {
  constexpr double kWallRad = 0.7;
  for (const double sign : {1.0, -1.0}) {
    for (const double roll : {0.0, kPi}) {
      Scan scan = turnOf(sign * 2.0 * kPi / kBeams);
      map::SensorPose sensor;
      sensor.position = {1.0, 2.0, 0.8};
      sensor.roll_rad = roll;
      sensor.yaw_rad = 0.4;
      const Eigen::Matrix3d rotation = sensor.rotation();
      for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
        const Eigen::Vector3d beam = rotation * scan.direction(i);
        if (std::abs(wrapAngle(std::atan2(beam.y(), beam.x()) - kWallRad)) < 0.2) {
          scan.ranges_m[i] = 8.0F;
        }
      }
      ScanClusters clusters({}, {2.0, 1.08});
      clusters.gather(0.0, sensor, {{1.0, 2.0}, 0.4}, scan);
      const Eigen::Vector2d eye(1.0, 2.0);
      const auto inSight = [&](double bearing) {
        return clusters.inSight(eye + 15.0 * unitVector(bearing), 1.0, 0.1, 2.0);
      };
      EXPECT_EQ(inSight(kWallRad), 0.0) << sign << ' ' << roll;
      for (const double off : {1.0, 2.0, 3.0, 4.0, 5.0}) {
        EXPECT_EQ(inSight(kWallRad + off), 1.0) << sign << ' ' << roll << ' ' << off;
      }
    }
  }
}

}  // namespace
}  // namespace otter_nav::traffic
