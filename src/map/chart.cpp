#include "otter_nav/map/chart.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "image.hpp"
#include "otter_nav/config/section.hpp"

namespace otter_nav::map {
namespace {

namespace fs = std::filesystem;

struct ChartFile {
  std::string image;
  double resolution_m = 0.0;
  std::vector<double> origin;
  int negate = 0;
  double occupied_thresh = 0.0;
  double free_thresh = 0.0;
};

Result<ChartFile> readChartFile(const std::string& path) {
  const Result<YAML::Node> node = config::loadFile(path);
  if (!node) {
    return failure(node.error().message);
  }
  config::Section section(*node, path);
  ChartFile chart;
  section.read("image", chart.image);
  section.read("resolution", chart.resolution_m, {1e-3, 100.0});
  section.read("origin", chart.origin, 3, {-1e7, 1e7});
  section.read("negate", chart.negate, {0.0, 1.0});
  section.read("occupied_thresh", chart.occupied_thresh, {0.0, 1.0});
  section.read("free_thresh", chart.free_thresh, {0.0, 1.0});
  if (section.has("mode")) {
    std::string mode;
    section.read("mode", mode, {"trinary"});
  }
  if (const Status status = section.finish(); !status) {
    return failure(status.error().message);
  }
  if (chart.image.empty()) {
    return failure(path + ": parameter 'image' is empty");
  }
  if (chart.free_thresh > chart.occupied_thresh) {
    return failure(path + ": parameter 'free_thresh' is above 'occupied_thresh'");
  }
  if (chart.origin[2] != 0.0) {
    return failure(path + ": parameter 'origin' has a yaw of " + std::to_string(chart.origin[2]) +
                   " rad; only charts drawn north up (yaw 0) can be used");
  }
  return chart;
}

OccupancyGrid toGrid(const ChartFile& chart, const GreyImage& image) {
  OccupancyGrid grid;
  grid.geometry = {
      image.width, image.height, chart.resolution_m, {chart.origin[0], chart.origin[1]}};
  grid.cells.resize(image.pixels.size());
  std::vector<Cell> cell_of(static_cast<std::size_t>(image.white) + 1);
  for (std::size_t value = 0; value < cell_of.size(); ++value) {
    const double lightness = static_cast<double>(value) / image.white;
    const double occupied = chart.negate != 0 ? lightness : 1.0 - lightness;
    cell_of[value] = occupied > chart.occupied_thresh ? Cell::kOccupied
                     : occupied < chart.free_thresh   ? Cell::kFree
                                                      : Cell::kUnknown;
  }
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  for (std::size_t row = 0; row < height; ++row) {  // the picture's top is north
    for (std::size_t column = 0; column < width; ++column) {
      grid.cells[row * width + column] = cell_of[image.pixels[(height - 1 - row) * width + column]];
    }
  }
  return grid;
}

}  // namespace

Result<OccupancyGrid> loadChart(const std::string& yaml_path) {
  const Result<ChartFile> chart = readChartFile(yaml_path);
  if (!chart) {
    return failure(chart.error().message);
  }
  const fs::path picture = fs::path(yaml_path).parent_path() / chart->image;
  const Result<GreyImage> image = loadImage(picture.string());
  if (!image) {
    return failure(image.error().message + " (the 'image' of " + yaml_path + ")");
  }
  return toGrid(*chart, *image);
}

Status saveChart(const OccupancyGrid& grid, const std::string& yaml_path) {
  // map_server's usual greys.
  constexpr std::uint16_t kGreyOf[] = {254, 0, 205};  // free, occupied, unknown
  const GridGeometry& g = grid.geometry;
  GreyImage image{g.width, g.height, 255, {}};
  image.pixels.reserve(grid.cells.size());
  for (int row = g.height - 1; row >= 0; --row) {
    for (int column = 0; column < g.width; ++column) {
      image.pixels.push_back(kGreyOf[static_cast<std::size_t>(grid.at(column, row))]);
    }
  }
  const fs::path picture = fs::path(yaml_path).replace_extension(".pgm");
  if (Status saved = savePgm(image, picture.string()); !saved) {
    return saved;
  }
  std::ofstream file(yaml_path);
  file.precision(std::numeric_limits<double>::max_digits10);
  file << "image: " << picture.filename().string() << "\nresolution: " << g.resolution_m
       << "\norigin: [" << g.origin.x() << ", " << g.origin.y()
       << ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  file.close();
  if (!file) {
    return failure(yaml_path + ": cannot be written");
  }
  return {};
}

std::vector<bool> coastOf(const OccupancyGrid& chart) {
  const GridGeometry& g = chart.geometry;
  const int reach = static_cast<int>(std::ceil(kCoastM / g.resolution_m));
  std::vector<bool> coast(chart.cells.size(), false);
  for (std::size_t i = 0; i < chart.cells.size(); ++i) {
    if (chart.cells[i] != Cell::kOccupied) {
      continue;
    }
    const int row = static_cast<int>(i) / g.width;
    const int column = static_cast<int>(i) % g.width;
    for (int y = std::max(0, row - reach); y <= std::min(g.height - 1, row + reach); ++y) {
      for (int x = std::max(0, column - reach); x <= std::min(g.width - 1, column + reach); ++x) {
        coast[g.index(x, y)] = true;
      }
    }
  }
  return coast;
}

}  // namespace otter_nav::map
