// Routes of other vessels: a walk from point to point over open water.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "archipelago/archipelago.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/vessel/hull.hpp"

namespace otter_nav::scenario {
namespace {

constexpr int kDrawsPerVessel = 20000;  // in small waters few starts have room for a way on
constexpr int kDrawsPerLeg = 200;
constexpr double kLegMinM = 20.0;
constexpr double kLegMaxM = 120.0;
constexpr double kBendMaxRad = 1.9;

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double share = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - share * along).norm();
}

class Router {
 public:
  Router(const map::OccupancyGrid& world, const std::vector<Mission>& missions,
         const ArchipelagoOptions& options, Random& random)
      : missions_(missions),
        options_(options),
        random_(random),
        field_(world, {options.route_clear_m + 8.0, false}) {}

  [[nodiscard]] std::optional<vessel::ScriptedVessel> draw(int id) {
    vessel::ScriptedVessel vessel;
    vessel.id = id;
    // As written to the file, so that what is checked is what is read back.
    vessel.hull.length_m = std::round(random_.uniform(4.0, 10.0) * 100.0) / 100.0;
    vessel.hull.beam_m =
        std::round(vessel.hull.length_m * random_.uniform(0.28, 0.42) * 100.0) / 100.0;
    vessel.speeds_mps = {std::round(random_.uniform(0.6, 2.4) * 100.0) / 100.0};
    clear_m_ = options_.route_clear_m + vessel::circumscribedRadius(vessel.hull);
    vessel.waypoints = {anywhere()};
    double course = random_.uniform(-kPi, kPi);
    double length = 0.0;
    while (length < vessel.speeds_mps[0] * options_.route_time_s) {
      const std::optional<Eigen::Vector2d> next = legFrom(vessel.waypoints.back(), course);
      if (!next) {
        return std::nullopt;
      }
      length += (*next - vessel.waypoints.back()).norm();
      vessel.waypoints.push_back(*next);
    }
    return vessel;
  }

 private:
  [[nodiscard]] Eigen::Vector2d rounded(const Eigen::Vector2d& p) const {
    return (p * 100.0).array().round() / 100.0;
  }
  [[nodiscard]] Eigen::Vector2d anywhere() {
    const map::GridGeometry& g = field_.geometry();
    const double x = random_.uniform(0.0, g.width * g.resolution_m);
    const double y = random_.uniform(0.0, g.height * g.resolution_m);
    return rounded(g.origin + Eigen::Vector2d(x, y));
  }
  [[nodiscard]] bool isFree(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
    const auto near = [&](const vessel::Pose& end) {
      return distanceToSegment(end.position, a, b) < clear_m_;
    };
    return map::segmentIsClear(field_, a, b, clear_m_) &&
           std::none_of(missions_.begin(), missions_.end(), [&](const Mission& mission) {
             return near(mission.start) || near(mission.goal);
           });
  }
  // Ahead within the bend that is allowed; where nothing is free there, anywhere.
  [[nodiscard]] std::optional<Eigen::Vector2d> legFrom(const Eigen::Vector2d& from,
                                                       double& course) {
    for (int k = 0; k < kDrawsPerLeg; ++k) {
      const double bend = k < kDrawsPerLeg / 2 ? kBendMaxRad : kPi;
      const double towards = course + random_.uniform(-bend, bend);
      const double length = random_.uniform(kLegMinM, kLegMaxM);
      const Eigen::Vector2d to = rounded(from + length * unitVector(towards));
      if (isFree(from, to)) {
        course = towards;
        return to;
      }
    }
    return std::nullopt;
  }

  const std::vector<Mission>& missions_;
  const ArchipelagoOptions& options_;
  Random& random_;
  map::DistanceField field_;
  double clear_m_ = 0.0;
};

}  // namespace

Result<std::vector<vessel::ScriptedVessel>> chooseRoutes(const map::OccupancyGrid& world,
                                                         const std::vector<Mission>& missions,
                                                         const ArchipelagoOptions& options,
                                                         Random& random) {
  std::vector<vessel::ScriptedVessel> vessels;
  if (options.vessels == 0) {
    return vessels;
  }
  Router router(world, missions, options, random);
  for (int id = 1; id <= options.vessels; ++id) {
    std::optional<vessel::ScriptedVessel> vessel;
    for (int k = 0; k < kDrawsPerVessel && !vessel; ++k) {
      vessel = router.draw(id);
    }
    if (!vessel) {
      return failure("archipelago: no route found for vessel " + std::to_string(id) + " in " +
                     std::to_string(kDrawsPerVessel) +
                     " draws; fewer islands, missions or floating things, or a larger map help");
    }
    vessels.push_back(std::move(*vessel));
  }
  return vessels;
}

}  // namespace otter_nav::scenario
