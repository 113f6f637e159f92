// Guide paths (paper, section IV-A): the Dubins curve from start to goal pose, its colliding
// stretches led around obstacles, pushed out to a safe distance and drawn taut. Its points are the
// key topological points, and the free width around them the corridor the planner samples in.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/topology/dubins.hpp"

namespace otter_nav::topology {

struct Options {
  double turning_radius_m = 3.0;     // of the Dubins curve
  double clearance_m = 0.8;          // every segment keeps this from every occupied square
  double clearance_margin_m = 0.02;  // on top where there is room, for what rounds the path off
  double safe_distance_m = 1.6;      // collision points are pushed out to this
  double corridor_max_m = 6.0;       // corridor radii end here
  double lattice_m = 1.0;            // spacing of the A* search's nodes
  double long_way_m = 120.0;         // from this distance on the spacing is twice that
  double greed = 1.01;           // the search's result may be this much longer than its shortest
  double local_window_m = 15.0;  // a repair looks this far around its stretch
  int max_repairs = 2;           // with more colliding stretches the whole way is searched at once
  double good_ratio = 1.01;      // a repaired path this close to the straight line is not improved
  int max_expansions = 20000;    // then a flood makes sure that there is a way at all
};
[[nodiscard]] Result<Options> readOptions(config::Section section);

struct GuidePath {
  // Start to goal; every segment between neighbours keeps the clearance.
  std::vector<Eigen::Vector2d> points;
  // Free width around each point: distance to the nearest obstacle, capped.
  std::vector<double> corridor_m;
  double length_m = 0.0;
  // The curve the search began with, and its colliding stretches [from, to] in m along it.
  std::vector<Pose> dubins;
  std::vector<Eigen::Vector2d> collisions_m;
  // Collision points of the curve as pushed out to the safe distance.
  std::vector<Eigen::Vector2d> pushed_points;
  // Whether stretches were repaired singly (true) or the whole way was searched at once.
  bool repaired_dubins = true;
};

enum class Failure { kStartBlocked, kGoalBlocked, kNoWay };
struct FindError {
  Failure failure;
  std::string message;
};

// Workspaces are kept between calls: after the first on a map, nothing grows. One thread at a
// time. The same inputs give the same path.
class GuidePathFinder {
 public:
  explicit GuidePathFinder(const Options& options);
  ~GuidePathFinder();
  GuidePathFinder(GuidePathFinder&&) noexcept;
  GuidePathFinder& operator=(GuidePathFinder&&) noexcept;

  // The message names start, goal or the way between them.
  [[nodiscard]] Result<GuidePath> find(const map::DistanceField& field, const Pose& start,
                                       const Pose& goal);
  // The same with the kind of failure, into a path whose storage is reused.
  [[nodiscard]] tl::expected<void, FindError> find(const map::DistanceField& field,
                                                   const Pose& start, const Pose& goal,
                                                   GuidePath& path);

 private:
  struct Workspace;
  bool searchWhole(const map::DistanceField& field, double clearance_m, const Pose& start,
                   const Pose& goal);
  void improve(const map::DistanceField& field, double clearance_m, const Pose& start,
               const Pose& goal);

  Options options_;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace otter_nav::topology
