#include "otter_nav/scenario/scenario.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <utility>

#include "otter_nav/config/section.hpp"
#include "otter_nav/map/chart.hpp"

namespace otter_nav::scenario {
namespace {

namespace fs = std::filesystem;

constexpr double kFarthestM = 1e6;

vessel::Pose readPose(config::Section& section, const std::string& key) {
  std::vector<double> pose = {0.0, 0.0, 0.0};
  section.read(key, pose, 3, {-kFarthestM, kFarthestM});
  return {{pose[0], pose[1]}, pose[2]};
}

Result<Mission> readMission(const YAML::Node& node, const std::string& where) {
  config::Section section(node, where);
  Mission mission;
  section.read("kind", mission.kind, {"local", "cross"});
  mission.start = readPose(section, "start");
  mission.goal = readPose(section, "goal");
  if (const Status status = section.finish(); !status) {
    return failure(status.error().message);
  }
  return mission;
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
  char text[96];
  std::snprintf(text, sizeof(text), "[%.2f, %.2f, %.3f]", pose.position.x(), pose.position.y(),
                pose.psi_rad);
  return text;
}

}  // namespace

Result<Scenario> loadScenario(const std::string& path) {
  const Result<YAML::Node> root = config::loadFile(path);
  if (!root) {
    return failure(root.error().message);
  }
  for (const auto& entry : *root) {
    const auto key = entry.first.as<std::string>();
    if (key != "chart" && key != "world" && key != "missions") {
      return failure(path + ": unknown key '" + key + "' (allowed: chart, world, missions)");
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
  return scenario;
}

Result<Mission> missionOf(const Scenario& scenario, int index) {
  const auto count = static_cast<int>(scenario.missions.size());
  if (index < 0 || index >= count) {
    return failure("scenario " + scenario.name + ": mission " + std::to_string(index) +
                   " does not exist, allowed range [0, " + std::to_string(count - 1) + "]");
  }
  return scenario.missions[static_cast<std::size_t>(index)];
}

Status saveScenario(const std::string& folder, const std::string& name,
                    const map::OccupancyGrid& chart, const map::OccupancyGrid& world,
                    const std::vector<Mission>& missions) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return failure("can't make folder " + folder + ": " + error.message());
  }
  const std::string path = (fs::path(folder) / name).string();
  for (const auto& [grid, ending] :
       {std::pair(&chart, "_chart.yaml"), std::pair(&world, "_world.yaml")}) {
    if (Status status = map::saveChart(*grid, path + ending); !status) {
      return status;
    }
  }
  std::ofstream file(path + ".yaml");
  file << "chart: " << name << "_chart.yaml\nworld: " << name << "_world.yaml\nmissions:\n";
  for (const Mission& mission : missions) {
    file << "  - {kind: " << mission.kind << ", start: " << poseText(mission.start)
         << ", goal: " << poseText(mission.goal) << "}\n";
  }
  file.close();
  if (!file) {
    return failure("can't write " + path + ".yaml");
  }
  return {};
}

}  // namespace otter_nav::scenario
