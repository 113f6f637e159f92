#include "otter_nav/stopping/back_off.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "otter_nav/feasibility/verifier.hpp"

namespace otter_nav::stopping {
namespace {

using trajectory::Piece;
using trajectory::Trajectory;

// A mean speed of a walk and time to gather way: gentle, for the water behind is the less known.
constexpr double kSpeedMps = 0.6;
constexpr double kGatherS = 2.0;

Trajectory straight(const vessel::State& state, double way_m) {
  const double psi = state[vessel::kPsi];
  vessel::FlatPoint from;
  from.position = state.head<2>();
  vessel::FlatPoint to;
  to.position = from.position + way_m * Eigen::Vector2d(std::cos(psi), std::sin(psi));
  const double duration = kGatherS + std::abs(way_m) / kSpeedMps;
  Piece piece = trajectory::hermitePiece(from, to, duration);
  piece.kind = trajectory::PieceKind::kSpin;  // the heading is its own: astern it can't follow
  piece.heading.setZero();
  piece.heading[0] = psi;
  return Trajectory({piece});
}

// Of the hull's outline, looked at in steps of a few centimeters; the verification's circles around
// bow and stern are too wide for a place this tight.
double outlineClearance(const Eigen::Vector2d& position, double psi_rad, const vessel::Hull& hull,
                        const map::DistanceField& field) {
  constexpr int kSteps = 20;
  const Eigen::Vector2d ahead(std::cos(psi_rad), std::sin(psi_rad));
  const Eigen::Vector2d port(-ahead.y(), ahead.x());
  double least = std::numeric_limits<double>::infinity();
  for (int k = -kSteps; k <= kSteps; ++k) {
    const Eigen::Vector2d along = 0.5 * hull.length_m * k / kSteps * ahead;
    const Eigen::Vector2d across = 0.5 * hull.beam_m * k / kSteps * port;
    for (const double side : {-0.5, 0.5}) {
      least = std::min({least, field.clearance(position + along + side * hull.beam_m * port),
                        field.clearance(position + across + side * hull.length_m * ahead)});
    }
  }
  return least;
}

}  // namespace

bool outlineKeepsClear(const Trajectory& way, double from_s, const vessel::Parameters& vessel,
                       const map::DistanceField& field, double least_m) {
  constexpr double kStepS = 0.05;
  const double psi = way.sample(from_s, vessel).state[vessel::kPsi];
  for (double t = from_s; t < way.duration() + kStepS; t += kStepS) {
    const Eigen::Vector2d position = way.flat(std::min(t, way.duration())).position;
    if (outlineClearance(position, psi, vessel.hull, field) < least_m) {
      return false;
    }
  }
  return true;
}

double turningRoom(const vessel::Hull& hull) {
  constexpr double kMarginM = 0.3;
  return 0.5 * std::hypot(hull.length_m, hull.beam_m) + kMarginM;
}

std::optional<Trajectory> backOff(const vessel::State& state, const map::DistanceField& field,
                                  const vessel::Parameters& vessel, double disturbance_n) {
  constexpr double kClearM = 0.1;
  const double drift_mps = disturbance_n / vessel.manoeuvring.sway_drag_kgps;
  const double room = turningRoom(vessel.hull);
  if (field.clearance(state.head<2>()) >= room) {
    return std::nullopt;
  }
  feasibility::CheckOptions check;
  check.clearance_m = 0.0;
  check.check_hull = false;
  check.speed_max_mps = vessel.top_speed_mps;
  for (const double lengths : {0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0}) {
    for (const double side : {-1.0, 1.0}) {
      Trajectory way = straight(state, side * lengths * vessel.hull.length_m);
      if (field.clearance(way.flat(way.duration()).position) >= room &&
          outlineKeepsClear(way, 0.0, vessel, field, kClearM + drift_mps * way.duration()) &&
          feasibility::verify(way, field, vessel, check).ok) {
        return way;
      }
    }
  }
  return std::nullopt;
}

}  // namespace otter_nav::stopping
