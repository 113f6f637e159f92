#include <cstdio>
#include <filesystem>
#include <fstream>
#include <vector>

#include "otter_nav/map/chart.hpp"
#include "otter_nav/scenario/scenario.hpp"

namespace otter_nav::scenario {
namespace {

namespace fs = std::filesystem;

Status written(const std::ofstream& file, const fs::path& path) {
  if (!file) {
    return failure("can't write " + path.string());
  }
  return {};
}

std::string poseText(const vessel::Pose& pose) {
  char text[96];
  std::snprintf(text, sizeof(text), "[%.2f, %.2f, %.3f]", pose.position.x(), pose.position.y(),
                pose.psi_rad);
  return text;
}

}  // namespace

Status saveScenario(const std::string& folder, const std::string& name,
                    const map::OccupancyGrid& chart, const map::OccupancyGrid& world,
                    const std::vector<Mission>& missions) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return failure("can't make folder " + folder + ": " + error.message());
  }
  if (Status status = map::saveChart(chart, (fs::path(folder) / (name + "_chart.yaml")).string());
      !status) {
    return status;
  }
  if (Status status = map::saveChart(world, (fs::path(folder) / (name + "_world.yaml")).string());
      !status) {
    return status;
  }
  const fs::path path = fs::path(folder) / (name + ".yaml");
  std::ofstream file(path);
  file << "chart: " << name << "_chart.yaml\nworld: " << name << "_world.yaml\nmissions:\n";
  for (const Mission& mission : missions) {
    file << "  - {kind: " << mission.kind << ", start: " << poseText(mission.start)
         << ", goal: " << poseText(mission.goal) << "}\n";
  }
  file.close();
  return written(file, path);
}

}  // namespace otter_nav::scenario
