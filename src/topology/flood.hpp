// Whether there is any way at all: a flood over the corners of the cells, or over a grid finer than
// these. A channel that slants across the cells passes steps along them only where it is wider than
// the clearance by a part of a step.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "otter_nav/map/distance_field.hpp"

namespace otter_nav::topology {

class Flood {
 public:
  // Whether steps from corner to corner, each keeping `clearance_m`, lead from start to goal.
  // `parts`: steps a cell's side.
  bool connects(const map::DistanceField& field, const Eigen::Vector2d& start,
                const Eigen::Vector2d& goal, double clearance_m, int parts = 1);
  // The same steps as a path from start to goal, after connects() was true.
  void collect(std::vector<Eigen::Vector2d>& path) const;

 private:
  struct Side {
    std::vector<std::int32_t> queue;
    std::size_t next = 0;
  };
  void seed(Side& side, const Eigen::Vector2d& p, std::uint8_t mark);
  bool grow(Side& side, std::uint8_t mark);
  [[nodiscard]] Eigen::Vector2d corner(int x, int y) const;
  [[nodiscard]] bool isClear(int x, int y) const;

  const map::DistanceField* field_ = nullptr;
  double clearance_m_ = 0.0;
  double corner_clearance_m_ = 0.0;
  int parts_ = 1;
  int columns_ = 0, rows_ = 0;
  Eigen::Vector2d start_, goal_;
  std::vector<std::uint8_t> marks_;  // which side came, and from where
  Side from_start_, from_goal_;
  std::int32_t meeting_start_ = -1, meeting_goal_ = -1;
};

}  // namespace otter_nav::topology
