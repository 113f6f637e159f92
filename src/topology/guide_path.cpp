#include "otter_nav/topology/guide_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/text.hpp"
#include "topology/flood.hpp"
#include "topology/lattice_search.hpp"
#include "topology/repair.hpp"
#include "topology/shortcut.hpp"

namespace otter_nav::topology {

struct GuidePathFinder::Workspace {
  LatticeSearch lattice;
  DubinsRepair repair;
  Shortener shortener;
  Flood flood;
  Polyline best, other;
};

namespace {

constexpr int kNoLimit = std::numeric_limits<int>::max();
constexpr double kHair_m = 1e-6;
constexpr double kMarginM = 0.02;      // on top where there is room, for what rounds the path off
constexpr double kCorridorMaxM = 6.0;  // corridor radii end here
constexpr double kLongM = 120.0;       // from this distance on the lattice is twice as wide
constexpr double kGreed = 1.01;      // a search's result may be this much longer than its shortest
constexpr int kMaxRepairs = 2;       // with more colliding stretches the whole is searched at once
constexpr double kGoodRatio = 1.01;  // a repaired path this close to the straight is not improved

std::string describe(const Eigen::Vector2d& p) {
  return text("(%g, %g)", p.x(), p.y());
}

LatticeQuery wholeMap(const map::DistanceField& field, const Options& options, double clearance_m,
                      const Pose& start, const Pose& goal) {
  const map::GridGeometry& g = field.geometry();
  LatticeQuery query;
  query.start = start.position;
  query.goal = goal.position;
  query.clearance_m = clearance_m;
  const bool far = (goal.position - start.position).norm() >= kLongM;
  query.block = blockCells(options, g) * (far ? 2 : 1);
  query.heuristic_weight = kGreed;
  query.low = g.origin;
  query.high = g.origin + g.resolution_m * Eigen::Vector2d(g.width, g.height);
  query.max_expansions = options.max_expansions;
  return query;
}

}  // namespace

std::string whyBlocked(const map::DistanceField& field, const Pose& pose, double clearance_m) {
  if (!pose.position.allFinite() || !std::isfinite(pose.psi_rad)) {
    return "is not a number";
  }
  if (!field.geometry().contains(pose.position)) {
    return describe(pose.position) + " is outside the map";
  }
  if (field.isClear(pose.position, clearance_m)) {
    return "";
  }
  const double clearance = field.clearance(pose.position);
  if (clearance == 0.0) {
    return describe(pose.position) + " is inside an obstacle";
  }
  return describe(pose.position) +
         text(" is %g m from an obstacle, %g m are needed", clearance, clearance_m);
}

GuidePathFinder::GuidePathFinder(const Options& options)
    : options_(options), workspace_(std::make_unique<Workspace>()) {}
GuidePathFinder::~GuidePathFinder() = default;
GuidePathFinder::GuidePathFinder(GuidePathFinder&&) noexcept = default;
GuidePathFinder& GuidePathFinder::operator=(GuidePathFinder&&) noexcept = default;

// From start to goal at once: coarse, and if that leads nowhere, finer, after making sure that
// there is a path.
bool GuidePathFinder::searchWhole(const map::DistanceField& field, double least_m,
                                  double clearance_m, const Pose& start, const Pose& goal) {
  Workspace& ws = *workspace_;
  LatticeQuery query = wholeMap(field, options_, clearance_m, start, goal);
  if (ws.lattice.run(field, query, ws.best) == LatticeSearch::Outcome::kFound) {
    return true;
  }
  if (!ws.flood.connects(field, start.position, goal.position, least_m)) {
    return searchFinely(field, least_m, start, goal);
  }
  query.max_expansions = kNoLimit;
  for (; query.block > 1; query.block /= 2) {
    if (ws.lattice.run(field, query, ws.best) == LatticeSearch::Outcome::kFound) {
      return true;
    }
  }
  ws.flood.collect(ws.best);
  return true;
}

// Where the map's corners lead nowhere a channel may slant across the cells. Only where the map is
// small: elsewhere it would take longer than a plan may.
bool GuidePathFinder::searchFinely(const map::DistanceField& field, double least_m,
                                   const Pose& start, const Pose& goal) {
  constexpr int kParts = 4;
  constexpr double kMostSteps = 1e6;
  Workspace& ws = *workspace_;
  const map::GridGeometry& g = field.geometry();
  if (kParts * kParts * static_cast<double>(g.width) * g.height > kMostSteps ||
      !ws.flood.connects(field, start.position, goal.position, least_m, kParts)) {
    return false;
  }
  ws.flood.collect(ws.best);
  ws.shortener.run(field, least_m, ws.best);
  return true;
}

// Another path may be shorter than the repaired curve: searched for unless the straight line says
// that there is little to gain.
void GuidePathFinder::improve(const map::DistanceField& field, double clearance_m,
                              const Pose& start, const Pose& goal) {
  Workspace& ws = *workspace_;
  const double length = lengthOf(ws.best);
  if (length <= kGoodRatio * (goal.position - start.position).norm()) {
    return;
  }
  LatticeQuery query = wholeMap(field, options_, clearance_m, start, goal);
  query.longest_m = length;
  if (ws.lattice.run(field, query, ws.other) != LatticeSearch::Outcome::kFound) {
    return;
  }
  ws.shortener.run(field, clearance_m, ws.other);
  if (lengthOf(ws.other) < length) {
    ws.best.swap(ws.other);
  }
}

tl::expected<void, FindError> GuidePathFinder::find(const map::DistanceField& field,
                                                    const Pose& start, const Pose& goal,
                                                    GuidePath& path, double clearance_m) {
  if (const std::string why = whyBlocked(field, start, clearance_m); !why.empty()) {
    return tl::unexpected(FindError{Failure::kStartBlocked, "start " + why});
  }
  if (const std::string why = whyBlocked(field, goal, clearance_m); !why.empty()) {
    return tl::unexpected(FindError{Failure::kGoalBlocked, "goal " + why});
  }
  Workspace& ws = *workspace_;
  const double room =
      std::min(field.clearance(start.position), field.clearance(goal.position)) - kHair_m;
  const double clearance = std::max(clearance_m, std::min(clearance_m + kMarginM, room));
  ws.repair.begin(field, options_, clearance, start, goal, path);
  path.repaired_dubins = ws.repair.stretches() <= kMaxRepairs && ws.repair.run(ws.lattice, ws.best);
  if (!path.repaired_dubins && !searchWhole(field, clearance_m, clearance, start, goal)) {
    return tl::unexpected(FindError{Failure::kNoPath, "no way from " + describe(start.position) +
                                                          " to " + describe(goal.position) +
                                                          " keeps the clearance"});
  }
  ws.shortener.run(field, clearance, ws.best);
  if (path.repaired_dubins) {
    improve(field, clearance, start, goal);
  }
  path.points.assign(ws.best.begin(), ws.best.end());
  path.length_m = lengthOf(path.points);
  path.corridor_m.clear();
  for (const Eigen::Vector2d& p : path.points) {
    path.corridor_m.push_back(std::min(kCorridorMaxM, field.clearance(p)));
  }
  return {};
}

Result<GuidePath> GuidePathFinder::find(const map::DistanceField& field, const Pose& start,
                                        const Pose& goal, double clearance_m) {
  GuidePath path;
  if (const auto found = find(field, start, goal, path, clearance_m); !found) {
    return failure(found.error().message);
  }
  return path;
}

}  // namespace otter_nav::topology
