#include "paths.hpp"

#include <cmath>
#include <functional>
#include <vector>

#include "csv_path.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::benchmark {
namespace {

using Eigen::Vector2d;
using vessel::FlatPoint;

trajectory::Trajectory fromKnots(const std::vector<FlatPoint>& knots, double step_s) {
  std::vector<trajectory::Piece> pieces;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    pieces.push_back(trajectory::hermitePiece(knots[i], knots[i + 1], step_s));
  }
  return trajectory::Trajectory(std::move(pieces));
}

FlatPoint eightAt(double w, double t) {
  FlatPoint z;
  const double s1 = std::sin(w * t), c1 = std::cos(w * t);
  const double s2 = std::sin(2 * w * t), c2 = std::cos(2 * w * t);
  z.position = {50 * s1, 25 * s2};
  z.velocity = w * Vector2d(50 * c1, 50 * c2);
  z.acceleration = w * w * Vector2d(-50 * s1, -100 * s2);
  z.jerk = w * w * w * Vector2d(-50 * c1, -200 * c2);
  return z;
}

constexpr double kInner = 8.0;
constexpr double kOuter = 60.0;
constexpr double kTurns = 3.0;
constexpr double kRadiusPerRad = (kOuter - kInner) / (kTurns * 2.0 * kPi);

// The rate of the spiral's angle at an angle: speed over the arc length per radian.
double spiralRate(double angle, double top_speed) {
  const double radius = kInner + kRadiusPerRad * angle;
  const double speed = top_speed * (0.6 + 0.4 * (radius - kInner) / (kOuter - kInner));
  return speed / std::hypot(radius, kRadiusPerRad);
}

FlatPoint spiralAt(double angle, double top_speed) {
  // The angle's derivatives in time from its rate's derivatives in angle.
  constexpr double kStep = 1e-3;
  const double g = spiralRate(angle, top_speed);
  const double above = spiralRate(angle + kStep, top_speed);
  const double below = spiralRate(angle - kStep, top_speed);
  const double g1 = (above - below) / (2 * kStep);
  const double g2 = (above - 2 * g + below) / (kStep * kStep);
  const double a1 = g;
  const double a2 = g * g1;
  const double a3 = g * (g1 * g1 + g * g2);
  // z = radius(angle) e(angle); with k = d radius / d angle and n = e':
  const double radius = kInner + kRadiusPerRad * angle;
  const double k = kRadiusPerRad;
  const Vector2d e = unitVector(angle);
  const Vector2d n = across(e);
  const Vector2d d1 = k * e + radius * n;
  const Vector2d d2 = 2 * k * n - radius * e;
  const Vector2d d3 = -3 * k * e - radius * n;
  FlatPoint z;
  z.position = radius * e;
  z.velocity = d1 * a1;
  z.acceleration = d2 * a1 * a1 + d1 * a2;
  z.jerk = d3 * a1 * a1 * a1 + 3.0 * d2 * a1 * a2 + d1 * a3;
  return z;
}

}  // namespace

trajectory::Trajectory eight(double top_speed_mps) {
  const double w = top_speed_mps / std::hypot(50.0, 50.0);
  constexpr int kPieces = 128;
  const double step = 2.0 * kPi / w / kPieces;
  std::vector<FlatPoint> knots;
  const int pieces = kPieces + static_cast<int>(std::ceil(kRunOutS / step));
  for (int i = 0; i <= pieces; ++i) {
    knots.push_back(eightAt(w, i * step));
  }
  return fromKnots(knots, step);
}

trajectory::Trajectory spiral(double top_speed_mps) {
  constexpr double kStepS = 0.5;
  constexpr int kSubsteps = 20;
  const double dt = kStepS / kSubsteps;
  std::vector<FlatPoint> knots;
  double angle = 0.0;
  int beyond = 0;  // knots past the last turn
  while (beyond * kStepS <= kRunOutS) {
    beyond += angle >= kTurns * 2.0 * kPi ? 1 : 0;
    knots.push_back(spiralAt(angle, top_speed_mps));
    for (int i = 0; i < kSubsteps; ++i) {
      const double k1 = spiralRate(angle, top_speed_mps);
      const double k2 = spiralRate(angle + 0.5 * dt * k1, top_speed_mps);
      const double k3 = spiralRate(angle + 0.5 * dt * k2, top_speed_mps);
      const double k4 = spiralRate(angle + dt * k3, top_speed_mps);
      angle += dt / 6.0 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
  }
  return fromKnots(knots, kStepS);
}

Result<trajectory::Trajectory> fromCsv(const std::string& path) {
  const Result<std::vector<TimedPoint>> points = readTimedPoints(path);
  if (!points) {
    return failure(points.error().message);
  }
  constexpr double kStepS = 0.5;
  std::vector<FlatPoint> knots;
  const double first = points->front().t_s;
  const double last = points->back().t_s;
  const int pieces = std::max(1, static_cast<int>((last - first) / kStepS));
  const double step = (last - first) / pieces;
  for (int i = 0; i <= pieces; ++i) {
    knots.push_back(fitAt(*points, first + i * step));
  }
  return fromKnots(knots, step);
}

}  // namespace otter_nav::benchmark
