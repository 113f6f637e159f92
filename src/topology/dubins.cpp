#include "otter_nav/topology/dubins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::topology {
namespace {

using Turn = DubinsCurve::Turn;

struct Word {
  std::array<Turn, 3> turns;
  std::array<double, 3> arcs;
  bool exists;
};

constexpr Turn kL = Turn::kLeft;
constexpr Turn kS = Turn::kStraight;
constexpr Turn kR = Turn::kRight;

// In [0, 2 pi); what rounding left just short of a full turn is none.
double turnOf(double angle) {
  const double turn = angle - 2.0 * kPi * std::floor(angle / (2.0 * kPi));
  return turn > 2.0 * kPi - 1e-9 ? 0.0 : turn;
}

// Both turns alike: the straight is parallel to the line between the circles' centres.
Word sameSides(Turn side, double alpha, double beta, const Eigen::Vector2d& between) {
  const double sign = side == kL ? 1.0 : -1.0;
  const double p = between.norm();
  const double course = p > 1e-12 ? angleOf(between) : alpha;
  return {
      {side, kS, side}, {turnOf(sign * (course - alpha)), p, turnOf(sign * (beta - course))}, true};
}

// Turns to opposite sides: the straight crosses between the circles, which lie a distance of at
// least 2 apart.
Word crossing(Turn side, double alpha, double beta, const Eigen::Vector2d& between) {
  const double sign = side == kL ? 1.0 : -1.0;
  const double squared = between.squaredNorm() - 4.0;
  if (squared < 0.0) {
    return {{}, {}, false};
  }
  const double p = std::sqrt(squared);
  const double course = angleOf(between) + sign * std::atan2(2.0, p);
  return {{side, kS, side == kL ? kR : kL},
          {turnOf(sign * (course - alpha)), p, turnOf(sign * (course - beta))},
          true};
}

// Three turns: the middle circle touches both outer ones, whose centres are less than 4 apart. Of
// its two places the one with the longer middle turn is the shorter curve.
Word threeTurns(Turn side, double alpha, double beta, const Eigen::Vector2d& between) {
  const double sign = side == kL ? 1.0 : -1.0;
  const double distance = between.norm();
  if (distance > 4.0 || distance < 1e-12) {
    return {{}, {}, false};
  }
  const double base = std::acos(std::min(1.0, distance / 4.0));
  const double middle = kPi + 2.0 * base;
  // The middle centre lies at `base` off the line between the centres, on the inner side.
  const double towards = angleOf(between) + sign * base;
  const double first = turnOf(sign * (towards - alpha) + 0.5 * kPi);
  const double heading = alpha + sign * (first - middle);
  return {
      {side, side == kL ? kR : kL, side}, {first, middle, turnOf(sign * (beta - heading))}, true};
}

Eigen::Vector2d centre(Turn side, const Eigen::Vector2d& p, double psi) {
  const double sign = side == kL ? 1.0 : -1.0;
  return p + sign * across(unitVector(psi));
}

// The pose after a stretch of unit radius.
Pose advance(const Pose& from, Turn turn, double arc) {
  Pose to = from;
  if (turn == kS) {
    to.position += arc * unitVector(from.psi_rad);
    return to;
  }
  const double sign = turn == kL ? 1.0 : -1.0;
  to.psi_rad = from.psi_rad + sign * arc;
  to.position = centre(turn, from.position, from.psi_rad) +
                sign * Eigen::Vector2d(std::sin(to.psi_rad), -std::cos(to.psi_rad));
  return to;
}

}  // namespace

// Distances below are in turning radii, seen from the start.
DubinsCurve::DubinsCurve(const Pose& start, const Pose& goal, double radius_m)
    : start_(start), radius_m_(radius_m) {
  const Eigen::Vector2d end = (goal.position - start.position) / radius_m;
  const double alpha = start.psi_rad;
  const double beta = goal.psi_rad;
  const auto from = [&](Turn side) { return centre(side, Eigen::Vector2d::Zero(), alpha); };
  const auto to = [&](Turn side) { return centre(side, end, beta); };
  const std::array<Word, 6> words = {sameSides(kL, alpha, beta, to(kL) - from(kL)),
                                     sameSides(kR, alpha, beta, to(kR) - from(kR)),
                                     crossing(kL, alpha, beta, to(kR) - from(kL)),
                                     crossing(kR, alpha, beta, to(kL) - from(kR)),
                                     threeTurns(kL, alpha, beta, to(kL) - from(kL)),
                                     threeTurns(kR, alpha, beta, to(kR) - from(kR))};
  double best = std::numeric_limits<double>::infinity();
  for (const Word& word : words) {
    const double total = word.arcs[0] + word.arcs[1] + word.arcs[2];
    if (word.exists && total < best) {
      best = total;
      turns_ = word.turns;
      arcs_ = word.arcs;
    }
  }
}

double DubinsCurve::length() const {
  return radius_m_ * (arcs_[0] + arcs_[1] + arcs_[2]);
}

Pose DubinsCurve::at(double s_m) const {
  Pose pose{Eigen::Vector2d::Zero(), start_.psi_rad};
  double left = std::max(0.0, s_m / radius_m_);
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    const double arc = std::min(left, arcs_[i]);
    pose = advance(pose, turns_[i], arc);
    left -= arc;
  }
  return {start_.position + radius_m_ * pose.position, pose.psi_rad};
}

}  // namespace otter_nav::topology
