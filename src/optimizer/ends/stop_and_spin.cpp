#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/optimizer/ends.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kSamePointM = 0.02;
constexpr double kStandstillS = 0.1;  // a trajectory that has nothing to do lasts this long
constexpr double kLeastLegS = 1.2;    // a shorter leg would jerk the hull for nothing
constexpr double kSameHeadingRad = 1e-9;
constexpr int kTurns = 64;                 // in half a circle, whose times are compared
constexpr double kAsideM[] = {0.15, 0.4};  // a stop may stand so much farther off than the path

// Peaks over [0, 1] of the degree-7 step s(x) = 35 x^4 - 84 x^5 + 70 x^6 - 20 x^7 (rest to rest,
// no acceleration or jerk at the ends): s' and s''.
constexpr double kPeakSpeed = 35.0 / 16.0;
constexpr double kPeakAcceleration = 7.5132;

}  // namespace

// As slow as speed and thrust ask for: d1 v + m1 a is bounded by the sum of both peaks.
double StopAndSpin::legDuration(double length_m) const {
  const vessel::PaperModel& m = vessel_.paper;
  const double force = 0.95 * safety_.thrust_share * 2.0 *
                       std::min(vessel_.thrusters.ahead_max_n, vessel_.thrusters.astern_max_n);
  const double least = std::max(kLeastLegS, kPeakSpeed * length_m / (0.95 * safety_.speed_max_mps));
  // d1 peak_v / T + m1 peak_a / T^2 <= force
  const double b = m.d1_kgps * kPeakSpeed * length_m;
  const double c = m.m1_kg * kPeakAcceleration * length_m;
  return std::max(least, (b + std::sqrt(b * b + 4.0 * force * c)) / (2.0 * force));
}

// A piece of degree 7, rest to rest.
void StopAndSpin::appendStraight(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                 std::vector<trajectory::Piece>& pieces) const {
  const double length = (to - from).norm();
  const Eigen::Vector2d direction = (to - from) / length;
  vessel::FlatPoint start;
  vessel::FlatPoint end;
  end.position.x() = length;
  trajectory::Piece piece = trajectory::hermitePiece(start, end, legDuration(length));
  const Eigen::Matrix<double, 1, trajectory::kCoefficients> s = piece.position.row(0);
  piece.position = direction * s;
  piece.position.col(0) = from;
  pieces.push_back(piece);
}

std::vector<Eigen::Vector2d> StopAndSpin::quickestStops(const map::DistanceField& field,
                                                        const std::vector<Eigen::Vector2d>& path,
                                                        const trajectory::Boundary& start,
                                                        const trajectory::Boundary& goal) const {
  struct Place {
    Eigen::Vector2d position;
    std::size_t order;  // along the path
    double reached_s = std::numeric_limits<double>::infinity();
    double psi_rad = 0.0;  // of the leg that leads there
    std::size_t from = 0;
  };
  std::vector<Place> places = {{start.flat.position, 0, 0.0, start.psi_rad}};
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    places.push_back({path[i], i});
    const Eigen::Vector2d away = field.smooth(path[i]).gradient;
    for (const double aside : kAsideM) {
      if (away.norm() > 0.0) {
        places.push_back({path[i] + aside * away.normalized(), i});
      }
    }
  }
  places.push_back({goal.flat.position, path.size()});
  std::array<double, kTurns + 1> turns_s{};
  for (int k = 1; k <= kTurns; ++k) {
    turns_s[static_cast<std::size_t>(k)] = spinDuration(kPi / kTurns * k, vessel_, spin_);
  }
  const auto spins_s = [&](double turn_rad) {
    return turns_s[static_cast<std::size_t>(std::abs(wrapAngle(turn_rad)) / kPi * kTurns + 0.5)];
  };
  for (std::size_t a = 0; a + 1 < places.size(); ++a) {
    const Place from = places[a];
    for (std::size_t b = a + 1; b < places.size() && std::isfinite(from.reached_s); ++b) {
      Place& to = places[b];
      const Eigen::Vector2d leg = to.position - from.position;
      if (to.order == from.order || leg.norm() < kSamePointM) {
        continue;
      }
      double reached = from.reached_s + legDuration(leg.norm());
      if (reached >= to.reached_s) {
        continue;
      }
      const double psi = angleOf(leg);
      reached += spins_s(psi - from.psi_rad);
      if (b + 1 == places.size()) {
        reached += spins_s(goal.psi_rad - psi);
      }
      if (reached < to.reached_s &&
          map::segmentIsClear(field, from.position, to.position, safety_.clearance_m)) {
        to.reached_s = reached;
        to.psi_rad = psi;
        to.from = a;
      }
    }
  }
  if (!std::isfinite(places.back().reached_s)) {
    return path;
  }
  std::vector<Eigen::Vector2d> stops;
  for (std::size_t k = places.size() - 1; k > 0; k = places[k].from) {
    stops.push_back(places[k].position);
  }
  stops.push_back(start.flat.position);
  return {stops.rbegin(), stops.rend()};
}

trajectory::Trajectory StopAndSpin::follow(const std::vector<Eigen::Vector2d>& path,
                                           const trajectory::Boundary& start,
                                           const trajectory::Boundary& goal) const {
  std::vector<trajectory::Piece> pieces;
  double psi = start.psi_rad;
  Eigen::Vector2d at = start.flat.position;
  const auto turnTo = [&](double psi_next) {
    const double turn = wrapAngle(psi_next - psi);
    if (std::abs(turn) > kSameHeadingRad) {
      appendSpin(at, psi, turn, vessel_, spin_, pieces);
    }
    psi += turn;
  };
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d& next = i + 1 < path.size() ? path[i] : goal.flat.position;
    const Eigen::Vector2d leg = next - at;
    if (leg.norm() < kSamePointM && i + 1 < path.size()) {
      continue;
    }
    if (leg.norm() > 1e-6) {
      turnTo(angleOf(leg));
      appendStraight(at, next, pieces);
      at = next;
    }
  }
  turnTo(goal.psi_rad);
  if (pieces.empty()) {
    pieces.push_back(trajectory::spinPiece(at, psi, psi, kStandstillS));
  }
  return trajectory::Trajectory(std::move(pieces));
}

}  // namespace otter_nav::optimizer
