// Other vessels in the plant: moved as they are written, seen, heard, and touched.
#include "otter_nav/plant/other_vessels.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "otter_nav/ais/message.hpp"
#include "otter_nav/base/random.hpp"
#include "otter_nav/plant/simulator.hpp"
#include "otter_nav/vessel/hull.hpp"

namespace otter_nav::plant {
namespace {

Options calmSea() {
  const std::string config = std::string(OTTER_NAV_SOURCE_DIR) + "/config/";
  return loadOptions(vessel::loadParameters(config + "vessels/otter_gazebo.yaml").value(),
                     config + "plant.yaml", config + "disturbances/none.yaml")
      .value();
}

vessel::ScriptedVessel eastward(int id, double y, double speed_mps) {
  return {id, {6.0, 2.0}, true, {{-100.0, y}, {1e5, y}}, {speed_mps}};
}

// Rectangles against points sown all along their outlines.
TEST(OtherVessels, AreAsFarAsTheirOutlines) {
  Random random(4);
  for (int run = 0; run < 300; ++run) {
    const vessel::Hull own{random.uniform(1.0, 3.0), random.uniform(0.5, 2.0)};
    const vessel::Hull hers{random.uniform(1.0, 8.0), random.uniform(0.5, 3.0)};
    const Eigen::Vector2d at(random.uniform(-7.0, 7.0), random.uniform(-7.0, 7.0));
    const double psi = random.uniform(-kPi, kPi);
    const double course = random.uniform(-kPi, kPi);
    OtherVessels others;
    const Eigen::Vector2d along(std::cos(course), std::sin(course));
    others.set({{1, hers, true, {{0.0, 0.0}, along}, {1.0}}}, 0.0);
    double sown = 1e9;
    const auto corners = vessel::outline(own, at, psi);
    const auto their = vessel::outline(hers, {0.0, 0.0}, course);
    bool inside = false;
    for (std::size_t i = 0; i < 4; ++i) {
      for (int k = 0; k <= 60; ++k) {
        const Eigen::Vector2d p = corners[i] + k / 60.0 * (corners[(i + 1) % 4] - corners[i]);
        const Eigen::Vector2d local(along.dot(p), along.x() * p.y() - along.y() * p.x());
        const Eigen::Vector2d over =
            local.cwiseAbs() - 0.5 * Eigen::Vector2d(hers.length_m, hers.beam_m);
        inside = inside || over.maxCoeff() <= 0.0;
        for (std::size_t j = 0; j < 4; ++j) {
          const Eigen::Vector2d side = their[(j + 1) % 4] - their[j];
          const double share = std::clamp((p - their[j]).dot(side) / side.squaredNorm(), 0.0, 1.0);
          sown = std::min(sown, (p - their[j] - share * side).norm());
        }
      }
    }
    const auto nearest = others.nearest(own, at, psi);
    ASSERT_TRUE(nearest);
    if (inside) {
      EXPECT_EQ(nearest->distance_m, 0.0);
    } else {
      EXPECT_LE(nearest->distance_m, sown + 1e-9);
      EXPECT_GE(nearest->distance_m, sown - 0.06);
    }
  }
}

TEST(OtherVessels, AreMetByBeams) {
  OtherVessels others;
  others.set({eastward(1, 5.0, 2.0)}, 50.0);  // at the origin's height, beam 4 to 6
  const Eigen::Vector2d north(0.0, 1.0);
  EXPECT_NEAR(others.castRay({0.0, 0.0}, north, 25.0), 4.0, 1e-12);
  EXPECT_NEAR(others.castRay({2.9, 0.0}, north, 25.0), 4.0, 1e-12);
  EXPECT_TRUE(std::isinf(others.castRay({3.1, 0.0}, north, 25.0)));
  EXPECT_TRUE(std::isinf(others.castRay({0.0, 0.0}, north, 3.9)));
  EXPECT_TRUE(std::isinf(others.castRay({0.0, 0.0}, -north, 25.0)));
  EXPECT_EQ(others.castRay({0.0, 5.0}, north, 25.0), 0.0);
  EXPECT_NEAR(others.castRay({-7.0, 1.0}, Eigen::Vector2d(0.8, 0.6), 25.0), 5.0, 1e-12);
}

TEST(OtherVessels, AreSeenByTheLidarWhereTheyAre) {
  Options options = calmSea();
  options.lidar.range_noise_m = 0.0;
  options.lidar.dropout_probability = 0.0;
  Simulator simulator(options, {}, 1);
  simulator.setVessels({eastward(1, 8.0, 2.0)});
  simulator.placeAt({0.0, 0.0}, 0.0);
  simulator.advance(50.0);  // she is abeam to port
  ASSERT_NEAR(simulator.others()[0].motion.pose.position.x(), 0.0, 1e-6);
  const Scan& scan = simulator.scan();
  const auto abeam = static_cast<std::size_t>(
      std::lround((0.5 * kPi - scan.angle_min_rad) / scan.angle_increment_rad));
  EXPECT_NEAR(scan.ranges_m[abeam], 7.0, 0.02);
  EXPECT_TRUE(std::isinf(scan.ranges_m[abeam / 3]));
}

TEST(OtherVessels, TouchAndAreNamed) {
  Simulator simulator(calmSea(), {}, 1);
  simulator.setVessels({eastward(3, 40.0, 2.0), eastward(7, 1.3, 2.0)});
  simulator.placeAt({0.0, 0.0}, 0.0);
  // Bow at x = -100 + 2 t + 3, own stern at x = -1, the outlines overlap across (1.3 < 1 + 0.54).
  simulator.advance(47.9);
  EXPECT_FALSE(simulator.inContact());
  EXPECT_NEAR(simulator.clearance(), 0.2, 0.02);
  simulator.advance(0.2);
  EXPECT_TRUE(simulator.inContact());
  EXPECT_EQ(simulator.clearance(), 0.0);
  EXPECT_EQ(simulator.touchedVessel(), 7);
  simulator.advance(20.0);
  EXPECT_FALSE(simulator.inContact());
  EXPECT_TRUE(simulator.hadContact());
}

TEST(Radar, SeesFarAndSometimesWrong) {
  Options options = calmSea();
  options.radar.noise_m = 2.0;
  Simulator simulator(options, {}, 2);
  simulator.setVessels(
      {eastward(1, 120.0, 1e-6), eastward(2, 260.0, 1e-6)});  // 102 m and 189 m off
  simulator.placeAt({0.0, 100.0}, 0.5);
  int scans = 0;
  int seen = 0;
  int other = 0;
  double squares = 0.0;
  const Eigen::Vector2d expected = Eigen::Rotation2Dd(-0.5) * Eigen::Vector2d(-100.0, 20.0);
  for (int k = 0; k < 60000; ++k) {
    simulator.advance(0.01);
    if (!simulator.radarDue()) {
      continue;
    }
    ++scans;
    for (const Eigen::Vector2d& p : simulator.radar()) {
      const double off = (p - expected).norm();
      seen += off < 12.0 ? 1 : 0;
      other += off < 12.0 ? 0 : 1;
      squares += off < 12.0 ? off * off : 0.0;
      EXPECT_LT(p.norm(), 160.0);
    }
  }
  EXPECT_NEAR(scans, 600, 1);
  EXPECT_NEAR(seen, 570, 20);
  EXPECT_NEAR(other, 30, 20);
  EXPECT_NEAR(std::sqrt(squares / seen / 2.0), 2.0, 0.15);
  options.radar.range_m = 0.0;
  EXPECT_FALSE(Simulator(options, {}, 1).radarDue());
}

TEST(Ais, IsSentAtClassBsRates) {
  Simulator simulator(calmSea(), {}, 5);
  vessel::ScriptedVessel silent = eastward(4, 80.0, 2.0);
  silent.ais = false;
  simulator.setVessels(
      {eastward(1, 0.0, 2.0), eastward(2, 40.0, 0.5), eastward(3, 60.0, 8.0), silent});
  simulator.placeAt({0.0, 300.0}, 0.0);
  std::map<std::uint32_t, std::map<int, int>> count;
  ais::Decoder decoder;
  const ais::LocalFrame frame(calmSea().datum);
  for (int k = 0; k < 14400; ++k) {
    simulator.advance(0.05);
    for (const std::string& sentence : simulator.takeAis()) {
      const auto message = decoder.add(sentence);
      ASSERT_TRUE(message) << message.error().message;
      if (!*message) {
        continue;
      }
      const ais::Message& m = **message;
      ++count[m.mmsi][m.type];
      if (m.type == 18 && m.mmsi == 200000001) {
        const Eigen::Vector2d at = frame.toMap(m.latitude_deg, m.longitude_deg);
        EXPECT_NEAR((at - simulator.others()[0].motion.pose.position).norm(), 0.0, 8.0);
        EXPECT_NEAR(m.speed_knots * ais::kKnotMps, 2.0, 0.03);
        EXPECT_NEAR(m.course_deg, 90.0, 6.0);
      } else if (m.type == 24 && m.part == 1) {
        EXPECT_EQ(m.to_bow_m + m.to_stern_m, 6);
        EXPECT_EQ(m.to_port_m + m.to_starboard_m, 2);
      }
    }
  }
  ASSERT_EQ(count.size(), 3U);  // 720 s of three vessels
  EXPECT_NEAR(count[200000001][18], 24, 1);
  EXPECT_NEAR(count[200000002][18], 4, 1);
  EXPECT_NEAR(count[200000003][18], 48, 1);  // 15.6 knots
  EXPECT_GE(count[200000001][24], 4);
  EXPECT_LE(count[200000001][24], 6);
}

// Without others nothing differs: same noise, same motion.
TEST(OtherVessels, LeaveTheRestAsItIs) {
  Simulator alone(calmSea(), {}, 9);
  Simulator busy(calmSea(), {}, 9);
  busy.setVessels({eastward(1, 500.0, 2.0)});
  for (int k = 0; k < 50; ++k) {
    alone.step({20.0, 25.0}, 0.02);
    busy.step({20.0, 25.0}, 0.02);
    if (busy.radarDue()) {
      (void)busy.radar();
    }
    EXPECT_EQ(alone.truth().planar, busy.truth().planar);
    const std::vector<float> a = alone.scan().ranges_m;
    const std::vector<float>& b = busy.scan().ranges_m;
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_TRUE(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i])));
    }
  }
}

}  // namespace
}  // namespace otter_nav::plant
