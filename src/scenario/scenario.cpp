#include "otter_nav/scenario/scenario.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>

#include "otter_nav/base/text.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/map/chart.hpp"

namespace otter_nav::scenario {
namespace {

namespace fs = std::filesystem;

constexpr double kFarthestM = 1e6;
constexpr double kSlowestMps = 1e-6;  // positive
constexpr double kFastestMps = 100.0;

vessel::Pose readPose(config::Section& section, const std::string& key) {
  std::vector<double> pose = {0.0, 0.0, 0.0};
  section.read(key, pose, 3, {-kFarthestM, kFarthestM});
  return {{pose[0], pose[1]}, pose[2]};
}

Result<Mission> readMission(const YAML::Node& node, const std::string& where) {
  config::Section section(node, where);
  Mission mission;
  section.read("kind", mission.kind, {"local", "cross", "encounter"});
  mission.start = readPose(section, "start");
  mission.goal = readPose(section, "goal");
  if (section.has("speed_mps")) {
    section.read("speed_mps", mission.speed_mps.emplace(), {kSlowestMps, kFastestMps});
  }
  if (const Status status = section.finish(); !status) {
    return failure(status.error().message);
  }
  return mission;
}

// Named by its id, and by its place in the list while that is not known.
Result<vessel::ScriptedVessel> readVessel(const YAML::Node& node, const std::string& path,
                                          std::size_t place) {
  const bool named = node.IsMap() && node["id"] && node["id"].IsScalar();
  config::Section section(
      node, path + ": vessel " + (named ? node["id"].Scalar() : "#" + std::to_string(place)));
  vessel::ScriptedVessel vessel;
  section.read("id", vessel.id, {0.0, 1e9});
  section.read("length_m", vessel.hull.length_m, {0.01, 1000.0});
  section.read("beam_m", vessel.hull.beam_m, {0.01, 1000.0});
  if (section.has("ais")) {
    section.read("ais", vessel.ais);
  }
  std::vector<std::vector<double>> waypoints;
  section.read("waypoints", waypoints, 2, {-kFarthestM, kFarthestM});
  section.read("speeds_mps", vessel.speeds_mps, {kSlowestMps, kFastestMps});
  if (const Status status = section.finish(); !status) {
    return failure(status.error().message);
  }
  if (waypoints.size() < 2) {
    return failure(section.where() + ": 'waypoints' are fewer than two");
  }
  const std::size_t legs = waypoints.size() - 1;
  if (vessel.speeds_mps.size() != 1 && vessel.speeds_mps.size() != legs) {
    return failure(section.where() + ": 'speeds_mps' holds " +
                   std::to_string(vessel.speeds_mps.size()) +
                   " speeds, not one, nor one for each of " + std::to_string(legs) + " legs");
  }
  for (const std::vector<double>& waypoint : waypoints) {
    vessel.waypoints.emplace_back(waypoint[0], waypoint[1]);
  }
  return vessel;
}

Status readVessels(const YAML::Node& list, const std::string& path,
                   std::vector<vessel::ScriptedVessel>& vessels) {
  if (!list.IsSequence()) {
    return failure(path + ": 'vessels' is not a list");
  }
  for (std::size_t k = 0; k < list.size(); ++k) {
    Result<vessel::ScriptedVessel> vessel = readVessel(list[k], path, k);
    if (!vessel) {
      return failure(vessel.error().message);
    }
    if (std::any_of(vessels.begin(), vessels.end(),
                    [&](const auto& other) { return other.id == vessel->id; })) {
      return failure(path + ": vessel " + std::to_string(vessel->id) + ": 'id' is there twice");
    }
    vessels.push_back(std::move(*vessel));
  }
  return {};
}

std::string vesselText(const vessel::ScriptedVessel& vessel) {
  std::string waypoints;
  for (const Eigen::Vector2d& p : vessel.waypoints) {
    waypoints += text("%s[%.2f, %.2f]", waypoints.empty() ? "" : ", ", p.x(), p.y());
  }
  std::string speeds;
  for (const double speed : vessel.speeds_mps) {
    speeds += text("%s%.3f", speeds.empty() ? "" : ", ", speed);
  }
  return text("{id: %d, length_m: %.2f, beam_m: %.2f, %swaypoints: [%s], speeds_mps: [%s]}",
              vessel.id, vessel.hull.length_m, vessel.hull.beam_m, vessel.ais ? "" : "ais: false, ",
              waypoints.c_str(), speeds.c_str());
}

Result<std::string> besideFile(const std::string& path, const std::string& key,
                               const std::string& named) {
  const fs::path file = fs::path(path).parent_path() / named;
  if (!fs::is_regular_file(file)) {
    return failure(path + ": " + key + " '" + file.string() + "' is not a file");
  }
  return file.string();
}

std::string poseText(const vessel::Pose& pose) {
  return text("[%.2f, %.2f, %.4f]", pose.position.x(), pose.position.y(), pose.psi_rad);
}

// Whether a YAML file is map_server's.
bool isMap(const std::string& path) {
  const Result<YAML::Node> root = config::loadFile(path);
  return root && root->IsMap() && (*root)["image"];
}

}  // namespace

Result<Scenario> loadScenario(const std::string& path) {
  const Result<YAML::Node> root = config::loadFile(path);
  if (!root) {
    return failure(root.error().message);
  }
  for (const auto& entry : *root) {
    const auto key = entry.first.as<std::string>();
    if (key != "chart" && key != "world" && key != "missions" && key != "vessels") {
      return failure(path + ": unknown key '" + key +
                     "' (allowed: chart, world, missions, vessels)");
    }
  }
  Scenario scenario;
  scenario.name = fs::path(path).stem().string();
  for (auto [key, target] : {std::pair<const char*, std::string*>{"chart", &scenario.chart_path},
                             {"world", &scenario.world_path}}) {
    const YAML::Node node = (*root)[key];
    if (!node || !node.IsScalar()) {
      return failure(path + ": '" + key + "' is missing or not a file's name");
    }
    Result<std::string> file = besideFile(path, key, node.as<std::string>());
    if (!file) {
      return failure(file.error().message);
    }
    *target = std::move(*file);
  }
  const YAML::Node missions = (*root)["missions"];
  if (!missions || !missions.IsSequence() || missions.size() == 0) {
    return failure(path + ": 'missions' is missing or not a list of at least one");
  }
  for (std::size_t k = 0; k < missions.size(); ++k) {
    Result<Mission> mission = readMission(missions[k], path + ": mission " + std::to_string(k));
    if (!mission) {
      return failure(mission.error().message);
    }
    scenario.missions.push_back(std::move(*mission));
  }
  if (const YAML::Node vessels = (*root)["vessels"]) {
    if (const Status status = readVessels(vessels, path, scenario.vessels); !status) {
      return failure(status.error().message);
    }
  }
  return scenario;
}

Result<std::vector<std::string>> scenarioFiles(const std::string& path) {
  if (fs::is_regular_file(path)) {
    return std::vector<std::string>{path};
  }
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(path, error)) {
    std::error_code unknown;  // of what can't be looked at loading will tell
    if (entry.path().extension() == ".yaml" && !entry.is_directory(unknown) &&
        !isMap(entry.path().string())) {
      files.push_back(entry.path().string());
    }
  }
  if (error || files.empty()) {
    return failure(path + ": " + (error ? error.message() : "no scenario (a .yaml file)"));
  }
  std::sort(files.begin(), files.end());
  return files;
}

Result<Mission> missionOf(const Scenario& scenario, int index) {
  const auto count = static_cast<int>(scenario.missions.size());
  if (index < 0 || index >= count) {
    return failure("scenario " + scenario.name + ": mission " + std::to_string(index) +
                   " does not exist, allowed range [0, " + std::to_string(count - 1) + "]");
  }
  return scenario.missions[static_cast<std::size_t>(index)];
}

Status saveMissions(const std::string& folder, const std::string& name, const std::string& chart,
                    const std::string& world, const std::vector<Mission>& missions,
                    const std::vector<vessel::ScriptedVessel>& vessels) {
  const std::string path = (fs::path(folder) / name).string() + ".yaml";
  std::ofstream file(path);
  file << "chart: " << chart << "\nworld: " << world << "\nmissions:\n";
  for (const Mission& mission : missions) {
    file << "  - {kind: " << mission.kind << ", start: " << poseText(mission.start)
         << ", goal: " << poseText(mission.goal);
    if (mission.speed_mps) {
      file << ", speed_mps: " << *mission.speed_mps;
    }
    file << "}\n";
  }
  file << (vessels.empty() ? "" : "vessels:\n");
  for (const vessel::ScriptedVessel& vessel : vessels) {
    file << "  - " << vesselText(vessel) << '\n';
  }
  file.close();
  if (!file) {
    return failure("can't write " + path);
  }
  return {};
}

Status saveScenario(const std::string& folder, const std::string& name,
                    const map::OccupancyGrid& chart, const map::OccupancyGrid& world,
                    const std::vector<Mission>& missions,
                    const std::vector<vessel::ScriptedVessel>& vessels) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return failure("can't make folder " + folder + ": " + error.message());
  }
  const std::string chart_file = name + "_chart.yaml";
  const std::string world_file = name + "_world.yaml";
  for (const auto& [grid, file] : {std::pair(&chart, chart_file), std::pair(&world, world_file)}) {
    if (Status status = map::saveChart(*grid, (fs::path(folder) / file).string()); !status) {
      return status;
    }
  }
  return saveMissions(folder, name, chart_file, world_file, missions, vessels);
}

}  // namespace otter_nav::scenario
