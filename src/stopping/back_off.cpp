#include "otter_nav/stopping/back_off.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/feasibility/hull_cover.hpp"
#include "otter_nav/stopping/watch.hpp"
#include "otter_nav/trajectory/straight_leg.hpp"
#include "otter_nav/vessel/hull.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "stopping/can_follow.hpp"

namespace otter_nav::stopping {
namespace {

using feasibility::Obstacles;
using trajectory::Piece;
using trajectory::Trajectory;

constexpr double kClearM = 0.1;      // of the outline, when it sets off
constexpr double kTightM = 0.04;     // where there is no more than this to begin with
constexpr double kTouchesM = 0.02;   // on the way: half of that
constexpr double kNoNearerM = 5e-3;  // than it lies, where that is nearer than any of these

// With a mean speed of a walk and time to gather way: the water there is the less known.
Piece gentleLeg(const Eigen::Vector2d& start, double psi_rad, double ahead_m) {
  constexpr double kSpeedMps = 0.6;
  constexpr double kGatherS = 2.0;
  return trajectory::straightLeg(start, psi_rad, ahead_m, kGatherS + std::abs(ahead_m) / kSpeedMps);
}

Piece gentleSpin(const Eigen::Vector2d& position, double psi_rad, double turn_rad) {
  constexpr double kRateRadps = 0.3;
  constexpr double kGatherS = 2.0;
  return trajectory::spinPiece(position, psi_rad, psi_rad + turn_rad,
                               kGatherS + std::abs(turn_rad) / kRateRadps);
}

bool outlineKeepsClear(const Trajectory& path, double from_s, const vessel::Parameters& vessel,
                       const Obstacles& obstacles, double least_m, bool edge) {
  return !outlineConflict(path, from_s, path.duration(), obstacles, vessel, least_m, edge).found;
}

// The shortest way of few turns on the spot and straight legs to room to turn, by Dijkstra's search
// over places a leg apart.
class BackingOff {
 public:
  BackingOff(const vessel::State& state, const Obstacles& obstacles,
             const vessel::Parameters& vessel, const vessel::Disturbance& disturbance,
             double reach_m)
      : obstacles_(obstacles),
        vessel_(vessel),
        disturbance_(disturbance),
        room_m_(turningRoom(vessel.hull)) {
    const auto near = [&](const Eigen::Vector2d& p) { return obstacles.clearance(p, 0.0); };
    nodes_.push_back({state.head<2>(), state[vessel::kPsi], 0.0, 0.0, -1, {}});
    const double has_m =
        feasibility::outlineClearance(vessel.hull, nodes_[0].position, nodes_[0].psi_rad, near);
    keep_m_ = std::min(std::clamp(has_m - kTouchesM, kTightM, std::max(kClearM, reach_m)),
                       std::max(0.0, has_m - kNoNearerM));
  }

  std::optional<Trajectory> find() {
    constexpr double kBetterM = 0.1;  // than here, or it isn't worth the way
    constexpr std::size_t kMostNodes = 40;
    int best = 0;
    double best_m = std::min(roomAt(nodes_[0]) + kBetterM, room_m_);
    if (roomAt(nodes_[0]) < room_m_) {
      front_.emplace(0.0, 0);
    }
    for (std::size_t looked = 0; looked < kMostNodes && !front_.empty();) {
      const int k = front_.top().second;
      front_.pop();
      if (!visited_.insert(keyOf(nodes_[static_cast<std::size_t>(k)])).second) {
        continue;
      }
      ++looked;
      const double there_m = roomAt(nodes_[static_cast<std::size_t>(k)]);
      if (k > 0 && there_m >= best_m) {
        best = k;
        best_m = there_m + kBetterM;
        if (there_m >= room_m_) {
          break;
        }
      }
      expand(k);
    }
    if (best == 0) {
      return std::nullopt;
    }
    Trajectory path(piecesTo(best));
    return canFollow(path, obstacles_, vessel_) ? std::optional<Trajectory>(std::move(path))
                                                : std::nullopt;
  }

 private:
  struct Node {
    Eigen::Vector2d position;
    double psi_rad;
    double cost_s;
    double time_s;  // when it is reached
    int from;
    std::vector<Piece> pieces;  // that lead here
  };
  using Key = std::array<int, 3>;

  [[nodiscard]] static Key keyOf(const Node& node) {
    constexpr double kCellM = 0.2;
    constexpr double kCellRad = 0.2;
    return {static_cast<int>(std::floor(node.position.x() / kCellM)),
            static_cast<int>(std::floor(node.position.y() / kCellM)),
            static_cast<int>(std::floor(wrapAngle(node.psi_rad) / kCellRad))};
  }
  [[nodiscard]] double roomAt(const Node& node) const {
    return std::min(room_m_, obstacles_.clearance(node.position, node.time_s));
  }

  // Each leg after a turn on the spot if need be, the longer ones as far as the shorter are clear.
  void expand(int k) {
    constexpr std::array<double, 5> kTurnsRad = {0.0, 0.4, -0.4, 0.8, -0.8};
    for (const double turn : kTurnsRad) {
      Node turned = nodes_[static_cast<std::size_t>(k)];
      turned.from = k;
      turned.pieces.clear();
      if (turn != 0.0 && !append(turned, gentleSpin(turned.position, turned.psi_rad, turn))) {
        continue;
      }
      turned.psi_rad += turn;
      for (const double side : {-1.0, 1.0}) {
        for (const double lengths : {0.25, 0.5, 1.0}) {
          Node to = turned;
          const double ahead_m = side * lengths * vessel_.hull.length_m;
          if (!append(to, gentleLeg(to.position, to.psi_rad, ahead_m))) {
            break;  // nor does it further on
          }
          if (visited_.count(keyOf(to)) == 0) {
            front_.emplace(-to.cost_s, static_cast<int>(nodes_.size()));
            nodes_.push_back(std::move(to));
          }
        }
      }
    }
  }

  // False where it isn't clear or leads too far.
  bool append(Node& node, const Piece& piece) const {
    constexpr double kPieceS = 1.0;  // what one more is worth
    constexpr double kMostLengths = 4.0;
    constexpr double kMostS = 40.0;
    const double end = piece.duration_s;
    // As it is meant, and as wind and current carry the hull meanwhile: not for long where it is
    // slow, for then the tracker holds the hull there.
    constexpr double kHoldsAfterS = 1.0;
    const double psi = piece.spinHeading(end)[0];
    const double carries_s =
        vessel::canLie(vessel_.manoeuvring, disturbance_, psi) ? std::min(end, kHoldsAfterS) : end;
    Piece carried = piece;
    carried.position.col(1) += carries_s / end *
                               vessel::driftAbeam(vessel_.manoeuvring, disturbance_, psi) *
                               across(unitVector(psi));
    const Obstacles obstacles = obstacles_.startingAt(node.time_s);
    if (!outlineKeepsClear(Trajectory({piece}), 0.0, vessel_, obstacles, keep_m_, true) ||
        !outlineKeepsClear(Trajectory({carried}), 0.0, vessel_, obstacles,
                           std::min(keep_m_, kTightM), true)) {
      return false;
    }
    node.position = piece.flat(end).position;
    node.time_s += end;
    node.cost_s += end + kPieceS;
    node.pieces.push_back(piece);
    return node.cost_s < kMostS &&
           (node.position - nodes_[0].position).norm() < kMostLengths * vessel_.hull.length_m;
  }

  [[nodiscard]] std::vector<Piece> piecesTo(int node) const {
    std::vector<Piece> pieces;
    for (int k = node; k > 0; k = nodes_[static_cast<std::size_t>(k)].from) {
      const std::vector<Piece>& leg = nodes_[static_cast<std::size_t>(k)].pieces;
      pieces.insert(pieces.begin(), leg.begin(), leg.end());
    }
    return pieces;
  }

  const Obstacles& obstacles_;
  const vessel::Parameters& vessel_;
  const vessel::Disturbance& disturbance_;
  double room_m_;
  double keep_m_ = 0.0;
  std::vector<Node> nodes_;
  std::priority_queue<std::pair<double, int>> front_;  // the cheapest first
  std::set<Key> visited_;
};

// Places inside the map's edge with room to turn, the nearest first.
std::vector<Eigen::Vector2d> placesInside(const Eigen::Vector2d& position,
                                          const Obstacles& obstacles, const vessel::Hull& hull) {
  constexpr int kLengths = 4;  // to all sides of the nearest
  const double room = turningRoom(hull);
  const map::GridGeometry& map = obstacles.field().geometry();
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(room + map.resolution_m);
  const Eigen::Vector2d low = map.origin + margin;
  const Eigen::Vector2d high =
      map.origin + map.resolution_m * Eigen::Vector2d(map.width, map.height) - margin;
  const Eigen::Vector2d nearest = position.cwiseMax(low).cwiseMin(high);
  std::vector<Eigen::Vector2d> places;
  for (int i = -kLengths; i <= kLengths; ++i) {
    for (int j = -kLengths; j <= kLengths; ++j) {
      const Eigen::Vector2d place = nearest + hull.length_m * Eigen::Vector2d(i, j);
      if (obstacles.clearance(place, 0.0) >= room) {
        places.push_back(place);
      }
    }
  }
  std::sort(places.begin(), places.end(), [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return (a - position).squaredNorm() < (b - position).squaredNorm();
  });
  return places;
}

}  // namespace

double insideMap(const map::GridGeometry& map, const Eigen::Vector2d& p) {
  const Eigen::Vector2d low = p - map.origin;
  const Eigen::Vector2d high = map.resolution_m * Eigen::Vector2d(map.width, map.height) - low;
  return std::min(low.minCoeff(), high.minCoeff());
}

double turningRoom(const vessel::Hull& hull) {
  constexpr double kMarginM = 0.3;
  return vessel::circumscribedRadius(hull) + kMarginM;
}

std::optional<Trajectory> backOff(const vessel::State& state, const Obstacles& obstacles,
                                  const vessel::Parameters& vessel,
                                  const vessel::Disturbance& disturbance, double reach_m) {
  return BackingOff(state, obstacles, vessel, disturbance, reach_m).find();
}

std::optional<Trajectory> turnBack(const vessel::State& state, const Obstacles& obstacles,
                                   const vessel::Parameters& vessel) {
  constexpr double kAlignedRad = 0.01;
  const Eigen::Vector2d position = state.head<2>();
  const double psi = state[vessel::kPsi];
  for (const Eigen::Vector2d& place : placesInside(position, obstacles, vessel.hull)) {
    const Eigen::Vector2d there = place - position;
    const double bearing = wrapAngle(angleOf(there) - psi);
    const bool astern = std::abs(bearing) > 0.5 * kPi;
    const double turn = astern ? wrapAngle(bearing + kPi) : bearing;
    std::vector<Piece> pieces;
    if (std::abs(turn) > kAlignedRad) {
      pieces.push_back(gentleSpin(position, psi, turn));
    }
    pieces.push_back(gentleLeg(position, psi + (pieces.empty() ? 0.0 : turn),
                               astern ? -there.norm() : there.norm()));
    Trajectory path(std::move(pieces));
    if (outlineKeepsClear(path, 0.0, vessel, obstacles, kClearM, false) &&
        canFollow(path, obstacles, vessel)) {
      return path;
    }
  }
  return std::nullopt;
}

bool backOffIsClear(const Trajectory& path, double from_s, const Obstacles& obstacles,
                    const vessel::Parameters& vessel) {
  const vessel::State here = path.sample(from_s, vessel).state;
  const double has_m = feasibility::outlineClearance(
      vessel.hull, here.head<2>(), here[vessel::kPsi],
      [&](const Eigen::Vector2d& p) { return obstacles.clearance(p, from_s); });
  return outlineKeepsClear(path, from_s, vessel, obstacles,
                           std::min(kTouchesM, std::max(0.0, has_m - kNoNearerM)), true);
}

bool turnBackIsClear(const Trajectory& path, double from_s, const Obstacles& obstacles,
                     const vessel::Parameters& vessel) {
  return outlineKeepsClear(path, from_s, vessel, obstacles, kTouchesM, false);
}

}  // namespace otter_nav::stopping
