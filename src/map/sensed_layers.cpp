#include "sensed_layers.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::map {
namespace {

constexpr int kMostLayers = 32;  // a bit each

Layers layersOf(const HeightBand& band, double resolution_m) {
  const double height = band.max_m - band.min_m;
  const int count =
      std::clamp(static_cast<int>(std::ceil(height / resolution_m - 1e-6)), 1, kMostLayers);
  return {band.min_m, std::max(resolution_m, height / count), count};
}

}  // namespace

SensedLayers::SensedLayers(const GridGeometry& grid, const OccupancyMapOptions& options)
    : grid_(grid),
      layers_(layersOf(options.band, grid.resolution_m)),
      tree_(grid.resolution_m),
      hit_log_odds_(octomap::logodds(options.hit_probability)),
      miss_log_odds_(octomap::logodds(options.miss_probability)) {
  tree_.setOccupancyThres(options.occupied_probability);
  tree_.setClampingThresMin(OccupancyMapOptions::kMinProbability);
  tree_.setClampingThresMax(OccupancyMapOptions::kMaxProbability);
  const Eigen::Vector2d corner = grid.centreOf(0, 0);
  first_ = tree_.coordToKey(corner.x(), corner.y(), options.band.min_m + 0.5 * grid.resolution_m);
  columns_.resize(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  certainly_free_.resize(columns_.size());
  runs_.resize(columns_.size() / kColumnsInRun + 1);
}

octomap::OcTreeKey SensedLayers::keyOf(std::size_t column, int layer) const {
  const auto width = static_cast<std::size_t>(grid_.width);
  return {static_cast<octomap::key_type>(first_[0] + column % width),
          static_cast<octomap::key_type>(first_[1] + column / width),
          static_cast<octomap::key_type>(first_[2] + layer)};
}

void SensedLayers::beginScan() {
  ++scan_;
  if (scan_ == 0) {  // the counter came round
    for (Column& column : columns_) {
      column.scan = 0;
    }
    scan_ = 1;
  }
}

bool SensedLayers::claim(Column& column, std::uint32_t bit) {
  if (column.scan != scan_) {
    column.scan = scan_;
    column.touched = 0;
    column.missed = 0;
  }
  const bool first = (column.touched & bit) == 0;
  column.touched |= bit;
  return first;
}

octomap::OcTreeNode*& SensedLayers::nodeOf(std::size_t column, int layer) {
  std::unique_ptr<octomap::OcTreeNode*[]>& run = runs_[column / kColumnsInRun];
  if (run == nullptr) {
    const std::size_t nodes = kColumnsInRun * static_cast<std::size_t>(layers_.count);
    run = std::make_unique<octomap::OcTreeNode*[]>(nodes);
  }
  return run[static_cast<std::size_t>(layer) * kColumnsInRun + column % kColumnsInRun];
}

const octomap::OcTreeNode& SensedLayers::add(std::size_t column, int layer, float log_odds) {
  octomap::OcTreeNode*& node = nodeOf(column, layer);
  if (node == nullptr) {
    node = tree_.updateNode(keyOf(column, layer), log_odds, true);
  } else {
    tree_.updateNodeLogOdds(node, log_odds);
  }
  return *node;
}

bool SensedLayers::judge(std::size_t index, std::uint32_t bit, const octomap::OcTreeNode& node) {
  Column& column = columns_[index];
  const bool was_occupied = column.occupied != 0;
  const bool was_seen = column.seen != 0;
  // Echoes that don't make it an obstacle yet have not seen it free either.
  column.seen |= tree_.isNodeOccupied(node) || node.getLogOdds() <= 0.0F ? bit : 0U;
  column.occupied = tree_.isNodeOccupied(node) ? column.occupied | bit : column.occupied & ~bit;
  std::uint32_t& free = certainly_free_[index];
  free = node.getLogOdds() <= tree_.getClampingThresMinLog() ? free | bit : free & ~bit;
  return was_occupied != (column.occupied != 0) || was_seen != (column.seen != 0);
}

bool SensedLayers::hit(std::size_t index, int layer) {
  const std::uint32_t bit = 1U << static_cast<unsigned>(layer);
  return claim(columns_[index], bit) && judge(index, bit, add(index, layer, hit_log_odds_));
}

bool SensedLayers::miss(std::size_t index, int layer) {
  const std::uint32_t bit = 1U << static_cast<unsigned>(layer);
  if (!claim(columns_[index], bit)) {
    return false;
  }
  columns_[index].missed |= bit;
  return judge(index, bit, add(index, layer, miss_log_odds_));
}

bool SensedLayers::missed(std::size_t index, int layer) const {
  const Column& column = columns_[index];
  return freeForCertain(index, layer) ||
         (column.scan == scan_ && (column.missed >> static_cast<unsigned>(layer) & 1U) != 0);
}

bool SensedLayers::hitAfterAll(std::size_t index, int layer) {
  const std::uint32_t bit = 1U << static_cast<unsigned>(layer);
  Column& column = columns_[index];
  if (!claim(column, bit) && (column.missed & bit) == 0) {
    return false;
  }
  column.missed &= ~bit;
  return judge(index, bit, add(index, layer, hit_log_odds_));
}

bool SensedLayers::clear(std::size_t index) {
  Column& column = columns_[index];
  const bool changed = column.occupied != 0;
  for (int layer = 0; column.occupied != 0; ++layer) {
    const std::uint32_t bit = 1U << static_cast<unsigned>(layer);
    if ((column.occupied & bit) != 0) {
      judge(index, bit,
            *tree_.setNodeValue(keyOf(index, layer), tree_.getClampingThresMinLog(), true));
    }
  }
  return changed;
}

bool SensedLayers::fill(std::size_t index, int layer) {
  const std::uint32_t bit = 1U << static_cast<unsigned>(layer);
  return !occupied(index) &&
         judge(index, bit,
               *tree_.setNodeValue(keyOf(index, layer),
                                   std::max(hit_log_odds_, tree_.getOccupancyThresLog()), true));
}

void SensedLayers::reset() {
  tree_.clear();
  for (auto& run : runs_) {
    run.reset();
  }
  std::fill(certainly_free_.begin(), certainly_free_.end(), 0U);
  std::fill(columns_.begin(), columns_.end(), Column{});
}

std::unique_ptr<octomap::OcTree> SensedLayers::copyTree() const {
  return std::make_unique<octomap::OcTree>(tree_);
}

}  // namespace otter_nav::map
