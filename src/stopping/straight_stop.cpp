#include "straight_stop.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "otter_nav/base/parts.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::stopping {
namespace {

using vessel::FlatPoint;

// A value with its first two derivatives.
struct Jet {
  double value = 0.0;
  double rate = 0.0;
  double rate2 = 0.0;
};

// The quintic between two jets.
class Quintic {
 public:
  Quintic(const Jet& start, const Jet& end, double duration_s)
      : duration_s_(duration_s), c_{start.value, start.rate, 0.5 * start.rate2, 0.0, 0.0, 0.0} {
    const double T = duration_s;
    const double d = end.value - (c_[0] + T * (c_[1] + T * c_[2]));
    const double dr = (end.rate - (c_[1] + 2.0 * T * c_[2])) * T;
    const double dr2 = (end.rate2 - 2.0 * c_[2]) * T * T;
    c_[3] = (10.0 * d - 4.0 * dr + 0.5 * dr2) / (T * T * T);
    c_[4] = (-15.0 * d + 7.0 * dr - dr2) / (T * T * T * T);
    c_[5] = (6.0 * d - 3.0 * dr + 0.5 * dr2) / (T * T * T * T * T);
  }
  // At the end's value beyond the duration.
  [[nodiscard]] Jet at(double t_s) const {
    const double t = std::min(t_s, duration_s_);
    Jet jet;
    jet.value = c_[0] + t * (c_[1] + t * (c_[2] + t * (c_[3] + t * (c_[4] + t * c_[5]))));
    jet.rate = c_[1] + t * (2 * c_[2] + t * (3 * c_[3] + t * (4 * c_[4] + t * 5 * c_[5])));
    jet.rate2 = 2 * c_[2] + t * (6 * c_[3] + t * (12 * c_[4] + t * 20 * c_[5]));
    return jet;
  }
  [[nodiscard]] double integral(double t_s) const {
    const double t = std::min(t_s, duration_s_);
    return t * (c_[0] + t * (c_[1] / 2 +
                             t * (c_[2] / 3 + t * (c_[3] / 4 + t * (c_[4] / 5 + t * c_[5] / 6)))));
  }

 private:
  double duration_s_;
  double c_[6];
};

// Speed and course rate of a flat point, with their derivatives: the components of acceleration,
// jerk and snap along and across the course, solved for them.
struct Course {
  double angle_rad = 0.0;
  Jet speed;
  Jet turn;
};
Course courseOf(const FlatPoint& z) {
  const double v = z.velocity.norm();
  const Eigen::Vector2d along = z.velocity / v;
  const Eigen::Vector2d port = across(along);
  Course course;
  course.angle_rad = angleOf(along);
  const double w = z.acceleration.dot(port) / v;
  course.speed = {v, z.acceleration.dot(along), z.jerk.dot(along) + v * w * w};
  const double w1 = (z.jerk.dot(port) - 2.0 * course.speed.rate * w) / v;
  const double w2 = (z.snap.dot(port) - 3.0 * course.speed.rate2 * w -
                     3.0 * course.speed.rate * w1 + v * w * w * w) /
                    v;
  course.turn = {w, w1, w2};
  return course;
}

class Profile {
 public:
  Profile(const FlatPoint& from, const StraightStop& stop)
      : course_(courseOf(from)),
        straighten_s_(stop.straighten_s),
        turn_(course_.turn, {}, stop.straighten_s),
        straight_speed_(
            std::max(0.1, course_.speed.value + 0.5 * stop.straighten_s * course_.speed.rate)),
        slow_(course_.speed, {straight_speed_, 0.0, 0.0}, stop.straighten_s),
        brake_({straight_speed_, 0.0, 0.0}, {}, stop.brake_s) {}

  // All but the position.
  [[nodiscard]] FlatPoint at(double t) const {
    const Jet v = t < straighten_s_ ? slow_.at(t) : brake_.at(t - straighten_s_);
    const Jet w = t < straighten_s_ ? turn_.at(t) : Jet{};
    const double angle = course_.angle_rad + turn_.integral(t);
    const Eigen::Vector2d along = unitVector(angle);
    const Eigen::Vector2d port = across(along);
    FlatPoint z;
    z.velocity = v.value * along;
    z.acceleration = v.rate * along + v.value * w.value * port;
    z.jerk = (v.rate2 - v.value * w.value * w.value) * along +
             (2.0 * v.rate * w.value + v.value * w.rate) * port;
    return z;
  }

 private:
  Course course_;
  double straighten_s_;
  Quintic turn_;
  double straight_speed_;
  Quintic slow_;
  Quintic brake_;
};

}  // namespace

trajectory::Trajectory straightStop(const FlatPoint& from, const StraightStop& stop) {
  constexpr double kPieceMostS = 0.2;
  const Profile profile(from, stop);
  std::vector<trajectory::Piece> pieces;
  FlatPoint previous = from;
  const auto append = [&](double begin_s, double duration_s) {
    const int knots = partsOf(duration_s, kPieceMostS, 0);
    const double step = duration_s / knots;
    for (int k = 1; k <= knots; ++k) {
      const double end = begin_s + k * step;
      FlatPoint next = profile.at(end);
      // Simpson's rule on the velocity; the pieces are short.
      next.position =
          previous.position +
          step / 6.0 *
              (previous.velocity + 4.0 * profile.at(end - 0.5 * step).velocity + next.velocity);
      pieces.push_back(trajectory::hermitePiece(previous, next, step));
      previous = next;
    }
  };
  append(0.0, stop.straighten_s);
  append(stop.straighten_s, stop.brake_s);
  return trajectory::Trajectory(std::move(pieces));
}

}  // namespace otter_nav::stopping
