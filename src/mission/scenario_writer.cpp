#include <cstdio>
#include <filesystem>
#include <fstream>
#include <vector>

#include "otter_nav/mission/scenario.hpp"

namespace otter_nav::mission {
namespace {

namespace fs = std::filesystem;

// map_server's greys.
std::uint8_t grey(map::Cell cell) {
  switch (cell) {
    case map::Cell::kFree:
      return 254;
    case map::Cell::kOccupied:
      return 0;
    case map::Cell::kUnknown:
      break;
  }
  return 205;
}

Status written(const std::ofstream& file, const fs::path& path) {
  if (!file) {
    return failure("can't write " + path.string());
  }
  return {};
}

// Binary PGM, north up.
Status savePgm(const fs::path& path, const map::OccupancyGrid& grid) {
  std::ofstream file(path, std::ios::binary);
  const map::GridGeometry& geometry = grid.geometry;
  file << "P5\n" << geometry.width << ' ' << geometry.height << "\n255\n";
  std::vector<char> line(static_cast<std::size_t>(geometry.width));
  for (int row = geometry.height - 1; row >= 0; --row) {
    for (int column = 0; column < geometry.width; ++column) {
      line[static_cast<std::size_t>(column)] = static_cast<char>(grey(grid.at(column, row)));
    }
    file.write(line.data(), geometry.width);
  }
  file.close();
  return written(file, path);
}

Status saveMap(const fs::path& folder, const std::string& name, const map::OccupancyGrid& grid) {
  if (Status status = savePgm(folder / (name + ".pgm"), grid); !status) {
    return status;
  }
  const fs::path path = folder / (name + ".yaml");
  std::ofstream file(path);
  file << "image: " << name << ".pgm\nresolution: " << grid.geometry.resolution_m << "\norigin: ["
       << grid.geometry.origin.x() << ", " << grid.geometry.origin.y()
       << ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  file.close();
  return written(file, path);
}

std::string poseText(const Berth& berth) {
  char text[96];
  std::snprintf(text, sizeof(text), "[%.2f, %.2f, %.3f]", berth.position.x(), berth.position.y(),
                berth.psi_rad);
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
  if (Status status = saveMap(folder, name + "_chart", chart); !status) {
    return status;
  }
  if (Status status = saveMap(folder, name + "_world", world); !status) {
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

}  // namespace otter_nav::mission
