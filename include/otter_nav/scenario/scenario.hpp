// A scenario: a chart, a world, and missions in it. One YAML file:
//
//   chart: NAME_chart.yaml     what the vessel is told (map_server's format), beside this file
//   world: NAME_world.yaml     what is there
//   missions:
//     - {kind: local, start: [x m, y m, yaw rad], goal: [x, y, yaw]}
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/map/occupancy_grid.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::scenario {

struct Mission {
  std::string kind = "local";  // or "cross"
  vessel::Pose start;
  vessel::Pose goal;
};

struct Scenario {
  std::string name;        // the file's, without folder and ending
  std::string chart_path;  // absolute or relative to the working directory, as the scenario's
  std::string world_path;
  std::vector<Mission> missions;
};

// Strict: a missing or unknown key, a pose that isn't three finite numbers, an unknown kind or an
// empty list of missions is an error that names the file, the mission and the key.
[[nodiscard]] Result<Scenario> loadScenario(const std::string& path);

// Mission `index`, or an error that says how many there are.
[[nodiscard]] Result<Mission> missionOf(const Scenario& scenario, int index);

// Writes NAME.yaml, NAME_chart.{yaml,pgm} and NAME_world.{yaml,pgm} into `folder`.
[[nodiscard]] Status saveScenario(const std::string& folder, const std::string& name,
                                  const map::OccupancyGrid& chart, const map::OccupancyGrid& world,
                                  const std::vector<Mission>& missions);

}  // namespace otter_nav::scenario
