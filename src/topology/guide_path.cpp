#include "otter_nav/topology/guide_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "flood.hpp"
#include "lattice_search.hpp"
#include "repair.hpp"
#include "taut.hpp"

namespace otter_nav::topology {

struct GuidePathFinder::Workspace {
  LatticeSearch lattice;
  DubinsRepair repair;
  Tautener tautener;
  Flood flood;
  Polyline best, other;
};

namespace {

constexpr int kNoLimit = std::numeric_limits<int>::max();
constexpr double kHair_m = 1e-6;

std::string describe(const Eigen::Vector2d& p) {
  std::ostringstream out;
  out << '(' << p.x() << ", " << p.y() << ')';
  return out.str();
}

// Why a vessel cannot be there, or nothing.
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
  std::ostringstream out;
  out << describe(pose.position) << " is " << clearance << " m from an obstacle, " << clearance_m
      << " m are needed";
  return out.str();
}

LatticeQuery wholeMap(const map::DistanceField& field, const Options& options, double clearance_m,
                      const Pose& start, const Pose& goal) {
  const map::GridGeometry& g = field.geometry();
  LatticeQuery query;
  query.start = start.position;
  query.goal = goal.position;
  query.clearance_m = clearance_m;
  const bool long_way = (goal.position - start.position).norm() >= options.long_way_m;
  query.block = blockCells(options, g) * (long_way ? 2 : 1);
  query.greed = options.greed;
  query.low = g.origin;
  query.high = g.origin + g.resolution_m * Eigen::Vector2d(g.width, g.height);
  query.max_expansions = options.max_expansions;
  return query;
}

}  // namespace

GuidePathFinder::GuidePathFinder(const Options& options)
    : options_(options), workspace_(std::make_unique<Workspace>()) {}
GuidePathFinder::~GuidePathFinder() = default;
GuidePathFinder::GuidePathFinder(GuidePathFinder&&) noexcept = default;
GuidePathFinder& GuidePathFinder::operator=(GuidePathFinder&&) noexcept = default;

// From start to goal at once: coarse, and if that leads nowhere, finer, after making sure that
// there is a way.
bool GuidePathFinder::searchWhole(const map::DistanceField& field, double clearance_m,
                                  const Pose& start, const Pose& goal) {
  Workspace& ws = *workspace_;
  LatticeQuery query = wholeMap(field, options_, clearance_m, start, goal);
  if (ws.lattice.run(field, query, ws.best) == LatticeSearch::Outcome::kFound) {
    return true;
  }
  if (!ws.flood.connects(field, start.position, goal.position, options_.clearance_m)) {
    return false;
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

// Another way may be shorter than the repaired curve: searched for unless the straight line says
// that there is little to gain.
void GuidePathFinder::improve(const map::DistanceField& field, double clearance_m,
                              const Pose& start, const Pose& goal) {
  Workspace& ws = *workspace_;
  const double length = lengthOf(ws.best);
  if (length <= options_.good_ratio * (goal.position - start.position).norm()) {
    return;
  }
  LatticeQuery query = wholeMap(field, options_, clearance_m, start, goal);
  query.longest_m = length;
  if (ws.lattice.run(field, query, ws.other) != LatticeSearch::Outcome::kFound) {
    return;
  }
  ws.tautener.run(field, clearance_m, ws.other);
  if (lengthOf(ws.other) < length) {
    ws.best.swap(ws.other);
  }
}

tl::expected<void, FindError> GuidePathFinder::find(const map::DistanceField& field,
                                                    const Pose& start, const Pose& goal,
                                                    GuidePath& path) {
  if (const std::string why = whyBlocked(field, start, options_.clearance_m); !why.empty()) {
    return tl::unexpected(FindError{Failure::kStartBlocked, "start " + why});
  }
  if (const std::string why = whyBlocked(field, goal, options_.clearance_m); !why.empty()) {
    return tl::unexpected(FindError{Failure::kGoalBlocked, "goal " + why});
  }
  Workspace& ws = *workspace_;
  const double room =
      std::min(field.clearance(start.position), field.clearance(goal.position)) - kHair_m;
  const double clearance = std::max(
      options_.clearance_m, std::min(options_.clearance_m + options_.clearance_margin_m, room));
  ws.repair.begin(field, options_, clearance, start, goal, path);
  path.repaired_dubins =
      ws.repair.stretches() <= options_.max_repairs && ws.repair.run(ws.lattice, ws.best);
  if (!path.repaired_dubins && !searchWhole(field, clearance, start, goal)) {
    return tl::unexpected(FindError{Failure::kNoWay, "no way from " + describe(start.position) +
                                                         " to " + describe(goal.position) +
                                                         " keeps the clearance"});
  }
  ws.tautener.run(field, clearance, ws.best);
  if (path.repaired_dubins) {
    improve(field, clearance, start, goal);
  }
  path.points.assign(ws.best.begin(), ws.best.end());
  path.length_m = lengthOf(path.points);
  path.corridor_m.clear();
  for (const Eigen::Vector2d& p : path.points) {
    path.corridor_m.push_back(std::min(options_.corridor_max_m, field.clearance(p)));
  }
  return {};
}

Result<GuidePath> GuidePathFinder::find(const map::DistanceField& field, const Pose& start,
                                        const Pose& goal) {
  GuidePath path;
  if (const auto found = find(field, start, goal, path); !found) {
    return failure(found.error().message);
  }
  return path;
}

}  // namespace otter_nav::topology
