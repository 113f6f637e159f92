// A scenario: a chart, a world, and missions in it. One YAML file:
//
//   chart: NAME_chart.yaml     what the vessel is told (map_server's format), beside this file
//   world: NAME_world.yaml     what is there
//   missions:
//     - {kind: local, start: [x m, y m, yaw rad], goal: [x, y, yaw]}
//   vessels:                   others that sail there, from each mission's start on; may be absent
//     - {id: 1, length_m: 6.0, beam_m: 2.0, waypoints: [[x, y], ...], speeds_mps: [2.0]}
//
// A mission may have `speed_mps`, a limit of our own speed. A vessel has one speed or one a leg,
// and with `ais: false` keeps silent.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/map/occupancy_grid.hpp"
#include "otter_nav/vessel/pose.hpp"
#include "otter_nav/vessel/scripted_vessel.hpp"

namespace otter_nav::scenario {

struct Mission {
  std::string kind = "local";  // or "cross", or "encounter": open water and other vessels
  vessel::Pose start;
  vessel::Pose goal;
  std::optional<double> speed_mps = std::nullopt;  // never faster over ground in this mission
};

struct Scenario {
  std::string name;        // the file's, without folder and ending
  std::string chart_path;  // absolute or relative to the working directory, as the scenario's
  std::string world_path;
  std::vector<Mission> missions;
  std::vector<vessel::ScriptedVessel> vessels;
};

// Strict: a missing or unknown key, a pose that isn't three finite numbers, an unknown kind, an
// empty list of missions, a vessel with fewer than two waypoints, a speed that isn't positive or
// one id twice is an error that names the file, the mission or vessel, and the key.
[[nodiscard]] Result<Scenario> loadScenario(const std::string& path);

// The scenario itself, or all in a folder, by name: YAML files that aren't maps. An error if there
// is none.
[[nodiscard]] Result<std::vector<std::string>> scenarioFiles(const std::string& path);

// Mission `index`, or an error that says how many there are.
[[nodiscard]] Result<Mission> missionOf(const Scenario& scenario, int index);

// Writes NAME.yaml, NAME_chart.{yaml,pgm} and NAME_world.{yaml,pgm} into `folder`.
[[nodiscard]] Status saveScenario(const std::string& folder, const std::string& name,
                                  const map::OccupancyGrid& chart, const map::OccupancyGrid& world,
                                  const std::vector<Mission>& missions,
                                  const std::vector<vessel::ScriptedVessel>& vessels = {});

// NAME.yaml alone, on a chart and a world that are in `folder` already.
[[nodiscard]] Status saveMissions(const std::string& folder, const std::string& name,
                                  const std::string& chart, const std::string& world,
                                  const std::vector<Mission>& missions,
                                  const std::vector<vessel::ScriptedVessel>& vessels);

}  // namespace otter_nav::scenario
