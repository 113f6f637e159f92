// The Dubins curve as a chain of samples, its colliding stretches, and the way round each.
#pragma once

#include <vector>

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/topology/guide_path.hpp"
#include "topology/lattice_search.hpp"
#include "topology/shortcut.hpp"

namespace otter_nav::topology {

// The lattice's spacing in cells.
[[nodiscard]] int blockCells(const Options& options, const map::GridGeometry& geometry);

class DubinsRepair {
 public:
  // The curve from start to goal into `path.dubins`, what of it collides into
  // `path.collisions_m`, and the points pushed out into `path.pushed_points`.
  void begin(const map::DistanceField& field, const Options& options, double clearance_m,
             const Pose& start, const Pose& goal, GuidePath& path);

  [[nodiscard]] int stretches() const { return static_cast<int>(stretches_.size()); }

  // The curve with each stretch replaced by its pushed points where these are clear, by A* near
  // by otherwise. False if some stretch has no way round within its window.
  bool run(LatticeSearch& lattice, Polyline& result);

 private:
  struct Stretch {
    std::size_t from, to;              // samples before and after
    std::size_t pushed, pushed_count;  // in pushed_
  };
  void sample(const Pose& start, const Pose& goal, GuidePath& path);
  void findStretches();
  void push(Stretch& stretch);
  bool chainIsClear(const Stretch& stretch) const;
  bool searchAround(const Stretch& stretch, LatticeSearch& lattice);

  const map::DistanceField* field_ = nullptr;
  const Options* options_ = nullptr;
  double clearance_m_ = 0.0;
  double spacing_m_ = 0.0;
  Polyline samples_, pushed_, detour_;
  std::vector<Stretch> stretches_;
};

}  // namespace otter_nav::topology
