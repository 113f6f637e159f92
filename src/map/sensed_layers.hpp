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
  [[nodiscard]] bool seen(std::size_t column) const { return columns_[column].seen != 0; }

  // One scan: all its hits first, then its misses; a voxel counts once, a hit before a miss.
  // True if the column's occupied() or seen() changed.
  void beginScan();
  bool hit(std::size_t column, int layer);
  bool miss(std::size_t column, int layer);
  // As free as can be, in all layers that were occupied.
  bool clear(std::size_t column);

  void reset();
  [[nodiscard]] std::unique_ptr<octomap::OcTree> copyTree() const;
  [[nodiscard]] octomap::OcTreeKey keyOf(std::size_t column, int layer) const;

 private:
  struct Column {
    std::uint32_t scan = 0;     // the last one that touched it, for which `touched` holds
    std::uint32_t touched = 0;  // layers, a bit each, as below
    std::uint32_t occupied = 0;
    std::uint32_t certainly_free = 0;
    std::uint32_t seen = 0;
  };
  // Whether this is the scan's first word on the voxel.
  bool claim(Column& column, std::uint32_t bit);
  bool judge(Column& column, std::uint32_t bit, const octomap::OcTreeNode& node);

  GridGeometry grid_;
  Layers layers_;
  octomap::OcTree tree_;
  octomap::OcTreeKey first_;  // of column 0, layer 0
  float hit_log_odds_, miss_log_odds_;
  std::uint32_t scan_ = 0;
  std::vector<Column> columns_;
};

}  // namespace otter_nav::map
