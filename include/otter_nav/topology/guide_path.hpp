// Guide paths (paper, section IV-A): the Dubins curve from start to goal pose, its colliding
// stretches led around obstacles, pushed out to a safe distance and shortened. Its points are the
// key topological points, and the free width around them the corridor the planner samples in.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/topology/dubins.hpp"

namespace otter_nav::topology {

struct Options {
  double turning_radius_m = 3.0;
  double lattice_m = 1.0;
  int max_expansions = 20000;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("turning_radius_m", o.turning_radius_m, {0.1, 100.0}, "of the Dubins curve");
    fields("lattice_m", o.lattice_m, {0.01, 20.0}, "spacing of the search's nodes");
    fields("max_expansions", o.max_expansions, {1.0, 1e8},
           "of a search; then a flood makes sure that there is a path at all");
  }
};

// For who asks for a guide path without a plan in mind.
constexpr double kNarrowestM = 0.8;

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
  // Whether stretches were repaired singly (true) or the whole path was searched at once.
  bool repaired_dubins = true;
};

// Why a vessel can't be there, in words that follow its name; empty: it can.
[[nodiscard]] std::string whyBlocked(const map::DistanceField& field, const Pose& pose,
                                     double clearance_m);

enum class Failure { kStartBlocked, kGoalBlocked, kNoPath };
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

  // The message names start, goal or the path between them.
  // Every segment keeps `clearance_m` from every occupied square.
  [[nodiscard]] Result<GuidePath> find(const map::DistanceField& field, const Pose& start,
                                       const Pose& goal, double clearance_m = kNarrowestM);
  // The same with the kind of failure, into a path whose storage is reused.
  [[nodiscard]] tl::expected<void, FindError> find(const map::DistanceField& field,
                                                   const Pose& start, const Pose& goal,
                                                   GuidePath& path,
                                                   double clearance_m = kNarrowestM);

 private:
  struct Workspace;
  bool searchWhole(const map::DistanceField& field, double least_m, double clearance_m,
                   const Pose& start, const Pose& goal);
  bool searchFinely(const map::DistanceField& field, double least_m, const Pose& start,
                    const Pose& goal);
  void improve(const map::DistanceField& field, double clearance_m, const Pose& start,
               const Pose& goal);

  Options options_;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace otter_nav::topology
