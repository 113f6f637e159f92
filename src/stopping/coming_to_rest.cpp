#include "coming_to_rest.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/rk4.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::stopping {
namespace {

using trajectory::Piece;
using vessel::State;
using vessel::Thrusts;

Piece spin(const State& from, const State& to, double duration_s) {
  Piece piece;
  piece.kind = trajectory::PieceKind::kSpin;
  piece.duration_s = duration_s;
  const auto cubic = [&](auto row, double a, double a_rate, double b, double b_rate) {
    const double t = duration_s;
    row[0] = a;
    row[1] = a_rate;
    row[2] = (3.0 * (b - a) / t - 2.0 * a_rate - b_rate) / t;
    row[3] = (2.0 * (a - b) / t + a_rate + b_rate) / (t * t);
  };
  const Eigen::Vector2d v = vessel::velocityOverGround(from);
  const Eigen::Vector2d w = vessel::velocityOverGround(to);
  cubic(piece.position.row(0), from.x(), v.x(), to.x(), w.x());
  cubic(piece.position.row(1), from.y(), v.y(), to.y(), w.y());
  cubic(piece.heading.row(0), from[vessel::kPsi], from[vessel::kYawRate], to[vessel::kPsi],
        to[vessel::kYawRate]);
  return piece;
}

}  // namespace

double ComingToRest::off(const State& x) const {
  const double psi = x[vessel::kPsi];
  const double to_bow = wrapAngle(vessel::headingIntoLoad(vessel_.manoeuvring, load_, psi) - psi);
  return std::abs(to_bow) > 0.5 * kPi ? wrapAngle(to_bow + kPi) : to_bow;
}

bool ComingToRest::hasCome(const State& x) const {
  constexpr double kSlowMps = 0.3;
  constexpr double kIntoRad = 0.4;
  return vessel::speedOf(x) <= kSlowMps && std::abs(off(x)) <= kIntoRad;
}

Thrusts ComingToRest::thrusts(const State& x) const {
  constexpr double kTurnsS = 0.5;  // time constant of heading and rate
  constexpr double kBrakesS = 0.5;
  const vessel::Thrusters& t = vessel_.thrusters;
  const vessel::ManoeuvringModel& m = vessel_.manoeuvring;
  const double most_nm = kCarriedShare * vessel::greatestMoment(t);
  const double wanted_nm =
      m.yaw_inertia_kgm2 / kTurnsS * (off(x) / kTurnsS - 2.0 * x[vessel::kYawRate]) -
      vessel::outsideLoad(x[vessel::kPsi], m, load_).yaw_nm;
  const double yaw_nm = std::clamp(wanted_nm, -most_nm, most_nm);
  const double surge_n = vessel::surgeAtRest(m, load_, x[vessel::kPsi]) -
                         m.surge_inertia_kg * x[vessel::kSurge] / kBrakesS;
  const double turning_n = 0.5 * std::abs(yaw_nm) / t.lever_arm_m;
  const double ahead_n = std::max(0.0, kCarriedShare * t.ahead_max_n - turning_n);
  const double astern_n = std::max(0.0, kCarriedShare * t.astern_max_n - turning_n);
  return vessel::thrustsFromTau({std::clamp(surge_n, -2.0 * astern_n, 2.0 * ahead_n), yaw_nm}, t);
}

State ComingToRest::after(const State& x, const Thrusts& thrusts) const {
  const auto rate = [&](double, const State& now) {
    return vessel::stateDerivative(now, thrusts, vessel_.manoeuvring, vessel_.thrusters, load_);
  };
  return rk4Step(rate, 0.0, x, kCarriedStepS);
}

Piece carriedPiece(const State& from, const State& to) {
  return spin(from, to, kCarriedStepS);
}

Piece stillPiece(const State& state) {
  constexpr double kLastS = 1.0;
  State still = state;
  still.head<2>() += 0.5 * kLastS * vessel::velocityOverGround(state);
  still[vessel::kPsi] += 0.5 * kLastS * state[vessel::kYawRate];
  still.tail<3>().setZero();
  return spin(state, still, kLastS);
}

trajectory::Trajectory carriedToRest(const State& state, const vessel::Parameters& vessel,
                                     const vessel::Disturbance& load) {
  constexpr int kMostSteps = 120;
  const ComingToRest rest(vessel, load);
  std::vector<Piece> pieces;
  State x = state;
  while (!rest.hasCome(x)) {
    if (pieces.size() == kMostSteps) {
      return {};
    }
    const State next = rest.after(x, rest.thrusts(x));
    pieces.push_back(carriedPiece(x, next));
    x = next;
  }
  pieces.push_back(stillPiece(x));
  return trajectory::Trajectory(std::move(pieces));
}

}  // namespace otter_nav::stopping
