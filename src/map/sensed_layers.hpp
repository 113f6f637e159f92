// What the lidar has seen over the chart: an OctoMap of the layers within the height band, and for
// each column which layers are occupied, free for certain, or seen at all, so that the projection
// and repeated misses never touch the tree.
#pragma once

#include <octomap/OcTree.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "beams.hpp"
#include "otter_nav/map/occupancy_map.hpp"

namespace otter_nav::map {

class SensedLayers {
 public:
  SensedLayers(const GridGeometry& grid, const OccupancyMapOptions& options);

  [[nodiscard]] const Layers& layers() const { return layers_; }
  [[nodiscard]] bool occupied(std::size_t column) const { return columns_[column].occupied != 0; }
  [[nodiscard]] bool occupied(std::size_t column, int layer) const {
    return (columns_[column].occupied >> static_cast<unsigned>(layer) & 1U) != 0;
  }
  [[nodiscard]] bool seen(std::size_t column) const { return columns_[column].seen != 0; }

  // One scan: all its hits first, then its misses; a voxel counts once, a hit before a miss.
  // True if the column's occupied() or seen() changed.
  void beginScan();
  bool hit(std::size_t column, int layer);
  bool miss(std::size_t column, int layer);
  // A hit on a voxel that this scan may have missed before.
  bool hitAfterAll(std::size_t column, int layer);
  // Whether this scan found it free, or needed no more to do so.
  [[nodiscard]] bool missed(std::size_t column, int layer) const;
  // Another miss would change nothing.
  [[nodiscard]] bool freeForCertain(std::size_t column, int layer) const {
    return (certainly_free_[column] >> static_cast<unsigned>(layer) & 1U) != 0;
  }
  // As free as can be, in all layers that were occupied.
  bool clear(std::size_t column);
  // As likely occupied as the fewest hits of what was unknown that make it so, if it wasn't before.
  bool fill(std::size_t column, int layer);

  void reset();
  [[nodiscard]] std::unique_ptr<octomap::OcTree> copyTree() const;
  [[nodiscard]] octomap::OcTreeKey keyOf(std::size_t column, int layer) const;

 private:
  struct Column {
    std::uint32_t scan = 0;     // the last one that touched it, for which `touched` holds
    std::uint32_t touched = 0;  // layers, a bit each, as below
    std::uint32_t missed = 0;   // of these, what it found free
    std::uint32_t occupied = 0;
    std::uint32_t seen = 0;
  };
  // Whether this is the scan's first word on the voxel.
  bool claim(Column& column, std::uint32_t bit);
  // Adds to the voxel's log-odds, within the tree's limits.
  const octomap::OcTreeNode& add(std::size_t column, int layer, float log_odds);
  // Where the voxel's node is kept at hand once it was met.
  octomap::OcTreeNode*& nodeOf(std::size_t column, int layer);
  bool judge(std::size_t column, std::uint32_t bit, const octomap::OcTreeNode& node);

  GridGeometry grid_;
  Layers layers_;
  octomap::OcTree tree_;
  octomap::OcTreeKey first_;  // of column 0, layer 0
  float hit_log_odds_, miss_log_odds_;
  std::uint32_t scan_ = 0;
  std::vector<Column> columns_;
  // Layers, a bit each, apart from the rest: most beams pass where nothing else is asked for.
  std::vector<std::uint32_t> certainly_free_;
  // The nodes that were met, so that no beam looks for them in the tree again: for so many columns
  // after each other those of the lowest layer, then of the next; empty where no beam passed. Nodes
  // stay where they are until the tree is cleared, for it isn't pruned.
  static constexpr std::size_t kColumnsInRun = 32;
  std::vector<std::unique_ptr<octomap::OcTreeNode*[]>> runs_;
};

}  // namespace otter_nav::map
