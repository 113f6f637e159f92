#include "otter_nav/map/occupancy_map.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "otter_nav/base/text.hpp"
#include "otter_nav/vessel/hull.hpp"
#include "sensed_layers.hpp"

namespace otter_nav::map {
namespace {

constexpr double kRangeErrorM = 0.03;        // three standard deviations of a usual lidar
constexpr double kTreeReachCells = 32768.0;  // to each side, by OctoMap's keys

// Why the scan cannot be used, or nothing.
std::string whyRefused(const GridGeometry& grid, const SensorPose& sensor, const Scan& scan) {
  if (!sensor.position.allFinite() || !std::isfinite(sensor.roll_rad) ||
      !std::isfinite(sensor.pitch_rad) || !std::isfinite(sensor.yaw_rad)) {
    return "the sensor's pose is not a number";
  }
  if (!grid.contains(sensor.position.head<2>())) {
    return "the sensor is outside the map";
  }
  return whyUnusable(scan);
}

}  // namespace

struct OccupancyMap::Sensed {
  Sensed(OccupancyGrid the_chart, const vessel::Hull& own_hull,
         const OccupancyMapOptions& the_options)
      : hull(own_hull),
        hull_margin_m(the_options.hull_margin_m),
        chart(std::move(the_chart)),
        trust_chart(the_options.trust_chart),
        projection(chart),
        layers(chart.geometry, the_options) {
    for (std::size_t i = 0; i < projection.cells.size(); ++i) {
      projection.cells[i] = unseen(i);
    }
  }

  // What a column is before any beam met it.
  [[nodiscard]] Cell unseen(std::size_t index) const {
    const Cell charted = chart.cells[index];
    return charted == Cell::kFree && !trust_chart ? Cell::kUnknown : charted;
  }
  // A column that changed: what it is now.
  void project(std::size_t index, CellRectangle& changed);
  void clearOwnHull(const vessel::Pose& own, CellRectangle& changed);
  void insert(const SensorPose& sensor, const vessel::Pose& own, const Scan& scan,
              CellRectangle& changed);
  // An echo of which it isn't clear by itself what cell's face it comes from.
  void insertUnclear(const Eigen::Vector3d& sensor, const Eigen::Vector3d& direction,
                     double range_m, int layer, CellRectangle& changed);

  vessel::Hull hull;
  double hull_margin_m;
  OccupancyGrid chart;
  bool trust_chart;
  OccupancyGrid projection;
  SensedLayers layers;
  struct Unclear {
    std::size_t beam;
    int layer;
  };
  std::vector<Unclear> unclear;
};

void OccupancyMap::Sensed::project(std::size_t index, CellRectangle& changed) {
  Cell cell = unseen(index);
  if (layers.occupied(index)) {
    cell = Cell::kOccupied;
  } else if (cell == Cell::kUnknown && layers.seen(index)) {
    cell = Cell::kFree;
  }
  if (cell != projection.cells[index]) {
    projection.cells[index] = cell;
    const auto width = static_cast<std::size_t>(chart.geometry.width);
    changed.include(static_cast<int>(index % width), static_cast<int>(index / width));
  }
}

// Where the vessel is, nothing else is. What lies right beside it stays, though no echo of it is
// taken for more than the hull's own.
void OccupancyMap::Sensed::clearOwnHull(const vessel::Pose& own, CellRectangle& changed) {
  const GridGeometry& g = chart.geometry;
  const CellRectangle near = g.around(own.position, vessel::circumscribedRadius(hull));
  for (int row = near.row; row < near.row + near.height; ++row) {
    for (int column = near.column; column < near.column + near.width; ++column) {
      const std::size_t index = g.index(column, row);
      if (layers.occupied(index) && vessel::covers(hull, own, g.centreOf(column, row), 0.0) &&
          layers.clear(index)) {
        project(index, changed);
      }
    }
  }
}

// Hits first, so that a beam passing close by an obstacle does not take from what another met. An
// echo comes from a thing's near face, and often that is where two cells meet: a little further on
// is the thing, whatever the range's noise. Without, things grow by a cell on the sides that are
// seen. Where a beam crosses more faces than one within that much, as at a corner that it clips,
// the echo waits for what the others tell.
void OccupancyMap::Sensed::insert(const SensorPose& sensor, const vessel::Pose& own,
                                  const Scan& scan, CellRectangle& changed) {
  const GridGeometry& g = chart.geometry;
  const Eigen::Matrix3d rotation = sensor.rotation();
  layers.beginScan();
  unclear.clear();
  const auto alongBeam = [&](std::size_t i, double range_m) {
    return Eigen::Vector3d(sensor.position + range_m * (rotation * scan.direction(i)));
  };
  const auto isOwn = [&](const Eigen::Vector3d& end) {
    return vessel::covers(hull, own, end.head<2>(), hull_margin_m);
  };
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (!scan.metSomething(i)) {
      continue;
    }
    const Eigen::Vector3d end = alongBeam(i, scan.ranges_m[i] + kRangeErrorM);
    const int layer = layers.layers().at(end.z());
    if (layer < 0 || !g.contains(end.head<2>()) || isOwn(end)) {
      continue;
    }
    const Eigen::Vector2i cell = g.cellAt(end.head<2>());
    const Eigen::Vector2i before =
        g.cellAt(alongBeam(i, scan.ranges_m[i] - kRangeErrorM).head<2>());
    if ((cell - before).lpNorm<1>() > 1) {
      unclear.push_back({i, layer});
      continue;
    }
    const std::size_t index = g.index(cell.x(), cell.y());
    if (chart.cells[index] != Cell::kOccupied && layers.hit(index, layer)) {
      project(index, changed);
    }
  }
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    // An echo beside the hull may be a thing's, and no hit of it keeps its cell: such a beam tells
    // nothing.
    if (!scan.metNothing(i) &&
        (!scan.metSomething(i) || isOwn(alongBeam(i, scan.ranges_m[i] + kRangeErrorM)))) {
      continue;
    }
    walkBeam(g, layers.layers(), sensor.position, rotation * scan.direction(i),
             scan.metNothing(i) ? scan.range_max_m : scan.ranges_m[i] - kRangeErrorM,
             [&](std::size_t index, int layer) {
               if (!layers.freeForCertain(index, layer) && chart.cells[index] != Cell::kOccupied &&
                   layers.miss(index, layer)) {
                 project(index, changed);
               }
             });
  }
  for (const auto& [i, layer] : unclear) {
    insertUnclear(sensor.position, rotation * scan.direction(i), scan.ranges_m[i], layer, changed);
  }
}

// The face is the nearest one before a cell that no other beam has passed, if there is any. One of
// an obstacle known already counts as nearer by a standard deviation.
void OccupancyMap::Sensed::insertUnclear(const Eigen::Vector3d& sensor,
                                         const Eigen::Vector3d& direction, double range_m,
                                         int layer, CellRectangle& changed) {
  const GridGeometry& g = chart.geometry;
  std::size_t met = 0;
  double nearest_m = std::numeric_limits<double>::infinity();
  bool met_passed = true;
  enteredWithin(g, sensor, direction, range_m, kRangeErrorM,
                [&](const Eigen::Vector2i& cell, double off_m) {
                  if (!g.containsCell(cell.x(), cell.y())) {
                    return;
                  }
                  const std::size_t index = g.index(cell.x(), cell.y());
                  const bool charted = chart.cells[index] == Cell::kOccupied;
                  const bool passed = !charted && layers.missed(index, layer);
                  const bool known = charted || layers.occupied(index, layer);
                  const double counts_m = known ? off_m - kRangeErrorM / 3.0 : off_m;
                  if (passed < met_passed || (passed == met_passed && counts_m < nearest_m)) {
                    met = index;
                    nearest_m = counts_m;
                    met_passed = passed;
                  }
                });
  if (std::isfinite(nearest_m) && chart.cells[met] != Cell::kOccupied &&
      layers.hitAfterAll(met, layer)) {
    project(met, changed);
  }
}

OccupancyMap::OccupancyMap(OccupancyGrid chart, const vessel::Hull& own_hull,
                           const OccupancyMapOptions& options)
    : sensed_(std::make_unique<Sensed>(std::move(chart), own_hull, options)) {}
OccupancyMap::~OccupancyMap() = default;
OccupancyMap::OccupancyMap(OccupancyMap&&) noexcept = default;
OccupancyMap& OccupancyMap::operator=(OccupancyMap&&) noexcept = default;

const OccupancyGrid& OccupancyMap::projection() const {
  return sensed_->projection;
}
const OccupancyGrid& OccupancyMap::chart() const {
  return sensed_->chart;
}

Result<CellRectangle> OccupancyMap::insertScan(const SensorPose& sensor, const vessel::Pose& own,
                                               const Scan& scan) {
  std::string why = whyRefused(sensed_->chart.geometry, sensor, scan);
  if (why.empty() && !(own.position.allFinite() && std::isfinite(own.psi_rad))) {
    why = "the hull's pose is not a number";
  }
  if (!why.empty()) {
    return failure("scan refused: " + why);
  }
  CellRectangle changed;
  sensed_->insert(sensor, own, scan, changed);
  sensed_->clearOwnHull(own, changed);
  return changed;
}

CellRectangle OccupancyMap::forget(const std::vector<Eigen::Vector2d>& points) {
  CellRectangle changed;
  const GridGeometry& g = sensed_->chart.geometry;
  for (const Eigen::Vector2d& p : points) {
    if (!g.contains(p)) {
      continue;
    }
    const Eigen::Vector2i cell = g.cellAt(p);
    const std::size_t index = g.index(cell.x(), cell.y());
    if (sensed_->layers.occupied(index) && sensed_->layers.clear(index)) {
      sensed_->project(index, changed);
    }
  }
  return changed;
}

CellRectangle OccupancyMap::fill(const std::vector<Eigen::Vector3d>& points) {
  CellRectangle changed;
  const GridGeometry& g = sensed_->chart.geometry;
  for (const Eigen::Vector3d& p : points) {
    const int layer = sensed_->layers.layers().at(p.z());
    if (layer < 0 || !g.contains(p.head<2>())) {
      continue;
    }
    const Eigen::Vector2i cell = g.cellAt(p.head<2>());
    const std::size_t index = g.index(cell.x(), cell.y());
    if (sensed_->chart.cells[index] != Cell::kOccupied && sensed_->layers.fill(index, layer)) {
      sensed_->project(index, changed);
    }
  }
  return changed;
}

CellRectangle OccupancyMap::reset() {
  CellRectangle changed;
  sensed_->layers.reset();
  for (std::size_t i = 0; i < sensed_->projection.cells.size(); ++i) {
    sensed_->project(i, changed);
  }
  return changed;
}

// The tree that is saved also holds the chart, in its lowest layer, so that it stands alone.
Status OccupancyMap::save(const std::string& path) const {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".yaml") {
    return saveChart(sensed_->projection, path);
  }
  if (ending != ".bt" && ending != ".ot") {
    return failure(path + ": maps are saved as .bt, .ot or .yaml");
  }
  // Keys from beyond are those of other places: within this map that matters to nobody.
  const GridGeometry& g = sensed_->chart.geometry;
  const double reach_m = kTreeReachCells * g.resolution_m;
  if (g.centreOf(0, 0).minCoeff() < -reach_m ||
      g.centreOf(g.width - 1, g.height - 1).maxCoeff() > reach_m) {
    return failure(path + text(": the map's origin is (%.10g, %.10g) m and its size %g m by %g m; "
                               "an OctoMap of %g m cells holds coordinates in [%g, %g] m only; "
                               "save it as .yaml",
                               g.origin.x(), g.origin.y(), g.width * g.resolution_m,
                               g.height * g.resolution_m, g.resolution_m, -reach_m, reach_m));
  }
  const std::unique_ptr<octomap::OcTree> tree = sensed_->layers.copyTree();
  for (std::size_t i = 0; i < sensed_->chart.cells.size(); ++i) {
    const Cell cell = sensed_->chart.cells[i];
    const octomap::OcTreeKey key = sensed_->layers.keyOf(i, 0);
    if (cell == Cell::kOccupied) {
      tree->setNodeValue(key, tree->getClampingThresMaxLog(), true);
    } else if (cell == Cell::kFree && tree->search(key) == nullptr) {
      tree->setNodeValue(key, tree->getClampingThresMinLog(), true);
    }
  }
  tree->updateInnerOccupancy();
  if (!(ending == ".bt" ? tree->writeBinary(path) : tree->write(path))) {
    return failure(path + ": cannot be written");
  }
  return {};
}

}  // namespace otter_nav::map
