#include "optimizer/solve/initial_spline.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/parts.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kLeastForceN = 1e-6;  // above rounding
constexpr double kSpacingM = 1.0;
constexpr int kBandSteps = 60;
constexpr double kSlowestBandMps = 0.8;
constexpr int kMostArcPoints = 12;
constexpr double kTurnRadiusM = 2.5;  // of turns at speed next to the ends
constexpr double kArcReachM = 12.0;   // an arc ends heading for the path this far on
constexpr double kEndShare = 0.35;  // of the other parts' duration, the ones next to the ends last
constexpr double kWideTurnRad = 0.9;
constexpr double kRampShare = 0.7;  // of the thrust free at a speed is used to change it

// A path that turns at speed: from `from` along `direction` on a circle until it heads for a point
// of the polyline ahead, which it follows from there.
void appendArc(const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
               const Eigen::Vector2d& towards, std::vector<Eigen::Vector2d>& points) {
  const double step = kSpacingM / kTurnRadiusM;
  Eigen::Vector2d p = from;
  double course = angleOf(direction);
  points.push_back(p);
  for (int i = 0; i < kMostArcPoints; ++i) {
    const Eigen::Vector2d leg = towards - p;
    const double turn = wrapAngle(angleOf(leg) - course);
    if (std::abs(turn) < step) {
      return;
    }
    course += turn > 0.0 ? step : -step;
    p += kSpacingM * unitVector(course);
    points.push_back(p);
  }
}

}  // namespace

// The greatest steady speed in a turn for which the thrust suffices.
double InitialSpline::speedIn(double curvature_per_m) const {
  const vessel::InverseDynamics inverse(vessel_);
  const double force = 2.0 * vessel_.thrusters.ahead_max_n * options.force_share - options.load_n;
  double low = 0.0;
  double high = options.speed_max_mps;
  const double k = std::abs(curvature_per_m);
  for (int i = 0; i < 12; ++i) {
    const double v = 0.5 * (low + high);
    const Eigen::Vector2d velocity(v, 0.0);
    const Eigen::Vector2d turning(0.0, v * v * k);
    const Eigen::Vector2d w = inverse.headingForce(velocity, turning);
    const vessel::Bow bow = inverse.bow(w, velocity, kLeastForceN);
    const vessel::Tau tau = inverse.held(bow.ahead, k * v, 0.0, velocity, turning).tau;
    const double need = tau.surge_n + tau.yaw_nm / vessel_.thrusters.lever_arm_m;
    (need < force ? low : high) = v;
  }
  return std::max(low, kSlowestBandMps);
}

void InitialSpline::setSpeeds(double speed_from, double speed_to) {
  const vessel::PaperModel& m = vessel_.paper;
  const double share = 2.0 * options.force_share;
  const double ahead = share * vessel_.thrusters.ahead_max_n - options.load_n;
  const double astern = share * vessel_.thrusters.astern_max_n - options.load_n;
  line_.setSpeeds(
      [&](double curvature) { return speedIn(curvature); },
      [&](double v) { return std::max(kRampShare * (ahead - m.d1_kgps * v) / m.m1_kg, 0.05); },
      [&](double v) {
        return kRampShare * std::min(m.d2_kgps * v, m.d1_kgps * v + astern) / m.m1_kg;
      },
      std::max(speed_from, options.slowest_mps), std::max(speed_to, options.slowest_mps));
}

Knot InitialSpline::knotAt(double s) const {
  const trajectory::PathLine::Place place = line_.locate(s);
  const trajectory::PathLine::Point at = line_.at(place);
  const double slope =
      (line_.points()[place.index + 1].speed_mps - line_.points()[place.index].speed_mps) /
      line_.spacing();
  const double v = at.speed_mps;
  Knot knot;
  knot.state.col(0) = at.position;
  knot.state.col(1) = v * at.direction;
  knot.state.col(2) = v * slope * at.direction + v * v * at.curvature_per_m * across(at.direction);
  return knot;
}

// Distances along the line that cut its time into equal parts, with shorter ones next to the ends.
void InitialSpline::cutTime(double part_s) {
  const std::vector<trajectory::PathLine::Point>& points = line_.points();
  const double spacing = line_.spacing();
  const std::size_t n = points.size();
  time_.assign(n, 0.0);
  for (std::size_t i = 1; i < n; ++i) {
    time_[i] = time_[i - 1] + 2.0 * spacing / (points[i - 1].speed_mps + points[i].speed_mps);
  }
  const int parts = partsOf(time_.back(), part_s, 2);
  const double even_s = time_.back() / parts;
  times_ = {0.0, kEndShare * even_s};
  for (int k = 1; k < parts; ++k) {
    times_.push_back(even_s * k);
  }
  times_.push_back(time_.back() - kEndShare * even_s);
  times_.push_back(time_.back());
  cuts_.clear();
  std::size_t i = 0;
  for (const double t : times_) {
    while (i + 2 < n && time_[i + 1] < t) {
      ++i;
    }
    const double f = std::clamp((t - time_[i]) / (time_[i + 1] - time_[i]), 0.0, 1.0);
    cuts_.push_back(spacing * (static_cast<double>(i) + f));
  }
}

// The polyline between both ends, with arcs where it leaves their directions.
void InitialSpline::turnAtEnds(const std::vector<Eigen::Vector2d>& polyline,
                               const SplineEnds& ends) {
  const Eigen::Vector2d& from = ends.start.position;
  const Eigen::Vector2d& to = ends.goal.position;
  const double length = lengthOf(polyline);
  const double reach = std::min(kArcReachM, 0.3 * length);
  std::vector<Eigen::Vector2d> tail;
  held_head_ = held_tail_ = 0;
  turned_.clear();
  const auto wide = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.dot(b) < std::cos(kWideTurnRad) * a.norm() * b.norm();
  };
  const double lead = (from - polyline.front()).norm();
  const double trail = (to - polyline.back()).norm();
  const Eigen::Vector2d ahead = trajectory::pointAlong(polyline, lead + reach);
  const Eigen::Vector2d behind = trajectory::pointAlong(polyline, -trail - reach);
  const bool head = wide(ends.leave, ahead - from);
  if (head) {
    appendArc(from, ends.leave, ahead, turned_);
    held_head_ = turned_.size() - 1;
  } else {
    turned_.push_back(from);
  }
  if (wide(ends.arrive, to - behind)) {
    appendArc(to, -ends.arrive, behind, tail);
    held_tail_ = tail.size() - 1;
  } else {
    tail.push_back(to);
  }
  double s = 0.0;
  for (std::size_t i = 1; i + 1 < polyline.size(); ++i) {
    s += (polyline[i] - polyline[i - 1]).norm();
    if (s > lead + (head ? reach : kSpacingM) &&
        s < length - trail - (held_tail_ > 0 ? reach : kSpacingM)) {
      turned_.push_back(polyline[i]);
    }
  }
  turned_.insert(turned_.end(), tail.rbegin(), tail.rend());
}

void InitialSpline::build(const feasibility::Obstacles& obstacles,
                          const std::vector<Eigen::Vector2d>& polyline, const SplineEnds& ends,
                          Spline& spline) {
  const auto fixedKnot = [](const vessel::FlatPoint& z) {
    Knot knot;
    knot.state << z.position, z.velocity, z.acceleration, z.jerk;
    knot.free = false;
    return knot;
  };
  turnAtEnds(polyline, ends);
  line_.resample(turned_, kSpacingM, 4);
  const double pace_mps =
      0.5 * (std::max(ends.start.velocity.norm(), options.slowest_mps) + options.speed_max_mps);
  const auto when = [&](const Eigen::Vector2d& p) {
    return options.start_s + options.clock * (p - ends.start.position).norm() / pace_mps;
  };
  line_.relax([&](const Eigen::Vector2d& p) { return obstacles.smooth(p, when(p)); },
              options.clearance_m, kBandSteps, held_head_, held_tail_);
  line_.setDirections();
  setSpeeds(ends.start.velocity.norm(), ends.goal.velocity.norm());
  cutTime(options.piece_length_m / options.speed_max_mps);
  spline.knots = {fixedKnot(ends.start)};
  spline.spans.clear();
  for (std::size_t i = 1; i < cuts_.size(); ++i) {
    spline.spans.push_back({times_[i] - times_[i - 1]});
    spline.knots.push_back(knotAt(cuts_[i]));
  }
  spline.knots.back() = fixedKnot(ends.goal);
}

}  // namespace otter_nav::optimizer
