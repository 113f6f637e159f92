#include "encounter/manoeuvre.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/parts.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/stopping/splice.hpp"

namespace otter_nav::encounter {
namespace {

using trajectory::Piece;
using trajectory::Trajectory;
using vessel::FlatPoint;

constexpr double kKnotS = 0.5;
constexpr double kSettleS = 3.0;  // in which the start's acceleration dies out

// From 0 to 1 with three continuous derivatives: 35 x^4 - 84 x^5 + 70 x^6 - 20 x^7, and its first
// two derivatives.
Eigen::Vector3d smoothStep(double x) {
  if (x <= 0.0) {
    return {0.0, 0.0, 0.0};
  }
  if (x >= 1.0) {
    return {1.0, 0.0, 0.0};
  }
  const double x2 = x * x;
  const double x3 = x2 * x;
  return {x2 * x2 * (35.0 + x * (-84.0 + x * (70.0 - 20.0 * x))),
          x3 * (140.0 + x * (-420.0 + x * (420.0 - 140.0 * x))),
          x2 * (420.0 + x * (-1680.0 + x * (2100.0 - 840.0 * x)))};
}

// Course and speed as sums of steps; turns are taken the short way.
class CourseMade {
 public:
  CourseMade(const Eigen::Vector2d& velocity, const std::vector<Change>& changes)
      : course_(angleOf(velocity)), speed_(velocity.norm()) {
    double course = course_;
    double speed = speed_;
    for (const Change& change : changes) {
      const double next_speed = change.velocity.norm();
      const double next = next_speed > 1e-3 ? unwrapNear(angleOf(change.velocity), course) : course;
      steps_.push_back({change.at_s - 0.5 * change.duration_s, change.duration_s, next - course,
                        next_speed - speed});
      course = next;
      speed = next_speed;
    }
  }

  // The velocity at `t` with its first two derivatives.
  void at(double t, Eigen::Vector2d& v, Eigen::Vector2d& a, Eigen::Vector2d& j) const {
    Eigen::Vector3d course(course_, 0.0, 0.0);
    Eigen::Vector3d speed(speed_, 0.0, 0.0);
    for (const Step& step : steps_) {
      Eigen::Vector3d s = smoothStep((t - step.from_s) / step.duration_s);
      s[1] /= step.duration_s;
      s[2] /= step.duration_s * step.duration_s;
      course += step.turn_rad * s;
      speed += step.speed_mps * s;
    }
    const Eigen::Vector2d ahead = unitVector(course[0]);
    const Eigen::Vector2d left = across(ahead);
    const double w = course[1];
    v = speed[0] * ahead;
    a = speed[1] * ahead + speed[0] * w * left;
    j = (speed[2] - speed[0] * w * w) * ahead + (2.0 * speed[1] * w + speed[0] * course[2]) * left;
  }

  [[nodiscard]] bool changesWithin(double from, double to) const {
    return std::any_of(steps_.begin(), steps_.end(), [&](const Step& step) {
      return step.from_s < to && step.from_s + step.duration_s > from;
    });
  }

 private:
  struct Step {
    double from_s, duration_s, turn_rad, speed_mps;
  };
  double course_;
  double speed_;
  std::vector<Step> steps_;
};

}  // namespace

Handling::Handling(const vessel::Parameters& vessel, double cruise_mps) {
  const vessel::PaperModel& model = vessel.paper;
  const vessel::Thrusters& thrusters = vessel.thrusters;
  constexpr double kThrustShare = 0.85;
  constexpr double kTurnShare = 0.45;  // of the steady rate, on the mean
  const double spare = std::max(0.1 * thrusters.ahead_max_n, kThrustShare * thrusters.ahead_max_n -
                                                                 0.5 * model.d1_kgps * cruise_mps);
  turn_rate_radps_ = kTurnShare * 2.0 * thrusters.lever_arm_m * spare / model.d3_kgm2ps;
  turn_least_s_ = 1.5 * (1.0 + model.m2_kgm2 / model.d3_kgm2ps);
}

double Handling::changeDuration(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  constexpr double kSlowingMps2 = 0.3;
  const bool turns = from.norm() > 0.1 && to.norm() > 0.1;
  const double turn = turns ? std::abs(std::atan2(cross(from, to), from.dot(to))) : 0.0;
  const double turning = turn > 1e-3 ? turn_least_s_ + turn / turn_rate_radps_ : 0.0;
  const double speed = std::abs(from.norm() - to.norm());
  const double slowing = speed > 1e-3 ? 1.5 + speed / kSlowingMps2 : 0.0;
  return std::max({1.0, turning, slowing});
}

Trajectory steer(const FlatPoint& start, const std::vector<Change>& changes, double end_s) {
  const CourseMade course(start.velocity, changes);
  // What the start has of acceleration and jerk beyond the course's, led to nothing.
  Eigen::Vector2d v, a, j;
  course.at(0.0, v, a, j);
  FlatPoint beyond;
  beyond.velocity = start.velocity - v;
  beyond.acceleration = start.acceleration - a;
  beyond.jerk = start.jerk - j;
  const double settle = std::min(kSettleS, end_s);
  // Where it ends is free: half of what the acceleration would carry it, so that nothing swings.
  FlatPoint settled;
  settled.position = beyond.acceleration * (settle * settle / 12.0);
  const Piece correction = trajectory::hermitePiece(beyond, settled, settle);

  std::vector<double> knots = {0.0};
  while (knots.back() < end_s - 1e-9) {
    const double t = knots.back();
    double next = t + kKnotS;
    if (t >= settle && !course.changesWithin(t, next)) {
      while (next < end_s && !course.changesWithin(t, next + kKnotS)) {
        next += kKnotS;
      }
    }
    if (end_s - next < 0.5 * kKnotS) {
      next = end_s;
    }
    knots.push_back(std::min(next, end_s));
  }
  const auto pointAt = [&](double t, const Eigen::Vector2d& position) {
    FlatPoint point;
    course.at(t, point.velocity, point.acceleration, point.jerk);
    point.position = position;
    const FlatPoint more = t < settle ? correction.flat(t) : settled;
    point.position += more.position;
    if (t < settle) {
      point.velocity += more.velocity;
      point.acceleration += more.acceleration;
      point.jerk += more.jerk;
    }
    return point;
  };
  std::vector<Piece> pieces;
  Eigen::Vector2d position = start.position;
  FlatPoint before = pointAt(0.0, position);
  for (std::size_t k = 1; k < knots.size(); ++k) {
    // Gauss and Legendre's rule of three points, on tenths of a knot's stretch where it curves.
    const double h = knots[k] - knots[k - 1];
    const int parts = h > 2.0 * kKnotS ? 1 : 4;
    for (int i = 0; i < parts; ++i) {
      const double step = h / parts;
      const double middle = knots[k - 1] + (i + 0.5) * step;
      constexpr double kNode = 0.7745966692414834;
      for (const auto& [node, weight] : {std::pair(-kNode, 5.0 / 18.0), std::pair(0.0, 8.0 / 18.0),
                                         std::pair(kNode, 5.0 / 18.0)}) {
        course.at(middle + 0.5 * step * node, v, a, j);
        position += weight * step * v;
      }
    }
    const FlatPoint after = pointAt(knots[k], position);
    pieces.push_back(trajectory::hermitePiece(before, after, h));
    before = after;
  }
  return Trajectory(std::move(pieces));
}

Trajectory slowDown(const Trajectory& sailed, double at_s, double share, double hold_s,
                    double change_s, double least_mps) {
  // s(t): the sailed trajectory's time; s' goes from 1 to `share` and back.
  const double down = 1.0 - share;
  const double whole = 2.0 * change_s + hold_s;
  const auto rate = [&](double t) {
    Eigen::Vector3d r(1.0, 0.0, 0.0);
    Eigen::Vector3d fall = smoothStep(t / change_s);
    Eigen::Vector3d rise = smoothStep((t - change_s - hold_s) / change_s);
    for (Eigen::Vector3d* step : {&fall, &rise}) {
      (*step)[1] /= change_s;
      (*step)[2] /= change_s * change_s;
    }
    r += down * (rise - fall);
    return r;
  };
  // The integral of the step from 0 to t: x^5 (7 - 14 x + 10 x^2 - 2.5 x^3) times its duration.
  const auto stepIntegral = [&](double t) {
    const double x = std::clamp(t / change_s, 0.0, 1.0);
    const double x5 = x * x * x * x * x;
    return change_s * x5 * (7.0 + x * (-14.0 + x * (10.0 - 2.5 * x))) + std::max(0.0, t - change_s);
  };
  const auto clock = [&](double t) {
    return at_s + t + down * (stepIntegral(t - change_s - hold_s) - stepIntegral(t));
  };
  if (clock(whole) >= sailed.duration() - 1e-6) {
    return {};
  }
  const auto pointAt = [&](double t) {
    const FlatPoint z = sailed.flat(clock(t));
    const Eigen::Vector3d r = rate(t);
    FlatPoint slow;
    slow.position = z.position;
    slow.velocity = z.velocity * r[0];
    slow.acceleration = z.acceleration * (r[0] * r[0]) + z.velocity * r[1];
    slow.jerk =
        z.jerk * (r[0] * r[0] * r[0]) + z.acceleration * (3.0 * r[0] * r[1]) + z.velocity * r[2];
    return slow;
  };
  const int knots = partsOf(whole, kKnotS, 4);
  const double step = whole / knots;
  std::vector<Piece> pieces;
  FlatPoint before = pointAt(0.0);
  double below_s = 0.0;
  for (int k = 1; k <= knots; ++k) {
    if (fallsBelow(sailed.flat(clock(k * step)).velocity, rate(k * step)[0], least_mps)) {
      below_s += step;
    }
    if (below_s > kBelowMostS) {
      return {};
    }
    const FlatPoint after = pointAt(k * step);
    pieces.push_back(trajectory::hermitePiece(before, after, step));
    before = after;
  }
  const Trajectory rest = stopping::remainder(sailed, clock(whole));
  pieces.insert(pieces.end(), rest.pieces().begin(), rest.pieces().end());
  return Trajectory(std::move(pieces));
}

}  // namespace otter_nav::encounter
