#include <cmath>
#include <string>
#include <utility>

#include "archipelago/archipelago.hpp"
#include "otter_nav/map/distance_field.hpp"

namespace otter_nav::scenario {
namespace {

constexpr int kDrawsPerMission = 200000;  // between walls few places are clear enough
constexpr double kCrossMin = 0.63;
constexpr double kCrossMax = 1.1;

// Which connected water a cell lies in, at a clearance; 0 where the clearance isn't kept.
std::vector<int> labelWaters(const map::DistanceField& field, double clearance_m) {
  const map::GridGeometry& geometry = field.geometry();
  const auto cells = static_cast<std::size_t>(geometry.width) * geometry.height;
  std::vector<char> free(cells);
  for (int row = 0; row < geometry.height; ++row) {
    for (int column = 0; column < geometry.width; ++column) {
      free[geometry.index(column, row)] =
          field.clearance(geometry.centreOf(column, row)) >= clearance_m ? 1 : 0;
    }
  }
  std::vector<int> label(cells, 0);
  std::vector<std::size_t> front;
  const auto width = static_cast<std::size_t>(geometry.width);
  const auto visit = [&](std::size_t cell, int water) {
    if (free[cell] != 0 && label[cell] == 0) {
      label[cell] = water;
      front.push_back(cell);
    }
  };
  int waters = 0;
  for (std::size_t seed = 0; seed < cells; ++seed) {
    if (free[seed] == 0 || label[seed] != 0) {
      continue;
    }
    visit(seed, ++waters);
    while (!front.empty()) {
      const std::size_t cell = front.back();
      front.pop_back();
      // The border is never free (it counts as occupied), so all four neighbours exist.
      visit(cell - 1, waters);
      visit(cell + 1, waters);
      visit(cell - width, waters);
      visit(cell + width, waters);
    }
  }
  return label;
}

double rounded(double value, double unit) {
  return std::round(value / unit) * unit;
}

// As written to the file, so that what is checked is what is read back.
vessel::Pose drawPose(const map::GridGeometry& geometry, Random& random) {
  vessel::Pose pose;
  const double x = random.uniform(0.0, geometry.width * geometry.resolution_m);
  const double y = random.uniform(0.0, geometry.height * geometry.resolution_m);
  pose.position = {rounded(geometry.origin.x() + x, 0.01), rounded(geometry.origin.y() + y, 0.01)};
  pose.psi_rad = rounded(random.uniform(-kPi, kPi), 0.001);
  return pose;
}

class Chooser {
 public:
  Chooser(const map::OccupancyGrid& world, const ArchipelagoOptions& options, Random& random)
      : options_(options),
        random_(random),
        field_(world, {options.clear_m + 2.0, false}),
        waters_(labelWaters(field_, options.passage_clearance_m)) {}

  [[nodiscard]] Result<Mission> choose(const std::string& kind, double min_m, double max_m) {
    for (int k = 0; k < kDrawsPerMission; ++k) {
      Mission mission{kind, drawPose(field_.geometry(), random_),
                      drawPose(field_.geometry(), random_)};
      const double apart = (mission.goal.position - mission.start.position).norm();
      if (apart >= min_m && apart <= max_m && sailable(mission)) {
        return mission;
      }
    }
    return failure("archipelago: no " + kind + " mission found in " +
                   std::to_string(kDrawsPerMission) + " draws; fewer islands or a larger map help");
  }

 private:
  [[nodiscard]] bool sailable(const Mission& mission) const {
    return isClear(mission.start) && isClear(mission.goal) &&
           waterAt(mission.start) == waterAt(mission.goal) &&
           !map::segmentIsClear(field_, mission.start.position, mission.goal.position, 0.0);
  }
  [[nodiscard]] bool isClear(const vessel::Pose& pose) const {
    return field_.geometry().contains(pose.position) &&
           field_.clearance(pose.position) >= options_.clear_m;
  }
  [[nodiscard]] int waterAt(const vessel::Pose& pose) const {
    const Eigen::Vector2i cell = field_.geometry().cellAt(pose.position);
    return waters_[field_.geometry().index(cell.x(), cell.y())];
  }

  const ArchipelagoOptions& options_;
  Random& random_;
  map::DistanceField field_;
  std::vector<int> waters_;
};

}  // namespace

Result<std::vector<Mission>> chooseMissions(const map::OccupancyGrid& world,
                                            const ArchipelagoOptions& options, Random& random) {
  Chooser chooser(world, options, random);
  std::vector<Mission> missions;
  const auto add = [&](int count, const std::string& kind, double min_m, double max_m) -> Status {
    for (int k = 0; k < count; ++k) {
      Result<Mission> mission = chooser.choose(kind, min_m, max_m);
      if (!mission) {
        return failure(mission.error().message);
      }
      missions.push_back(std::move(*mission));
    }
    return {};
  };
  const double local = options.local_distance_m;
  Status status = add(options.local_missions, "local", 0.9 * local, 1.1 * local);
  if (status) {
    status = add(options.cross_missions, "cross", kCrossMin * options.size_m,
                 kCrossMax * options.size_m);
  }
  if (!status) {
    return failure(status.error().message);
  }
  return missions;
}

}  // namespace otter_nav::scenario
