#include "otter_nav/trajectory/motion_along.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/parts.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::trajectory {
namespace {

constexpr double kStepS = 0.04;
constexpr int kFewestSteps = 4;     // a piece
constexpr double kTurnDiesS = 0.3;  // where the path says nothing of the heading
constexpr double kNearlyOneRad = 0.02;

// The rate of a heading at a step's end by the two before it (the backward differentiation formula
// of second order), as that of one step of another length from another heading.
struct Backward {
  double from_rad, step_s;

  Backward(double h, double h_before, double psi, double psi_before) {
    const double ratio = h / h_before;
    const double share = (1.0 + ratio) / (1.0 + 2.0 * ratio);
    step_s = share * h;
    from_rad = psi + share * ratio * ratio / (1.0 + ratio) * (psi - psi_before);
  }
};

}  // namespace

MotionAlong::MotionAlong(const Trajectory& trajectory, const vessel::Parameters& vessel,
                         const vessel::Disturbance& disturbance,
                         std::optional<double> psi_start_rad)
    : trajectory_(trajectory), vessel_(vessel), disturbance_(disturbance) {
  if (!trajectory.empty() && !vessel::paperHolds(vessel)) {
    follow(psi_start_rad);
    differentiate();
  }
}

void MotionAlong::follow(std::optional<double> psi_start_rad) {
  const std::vector<Piece>& pieces = trajectory_.pieces();
  const auto room = static_cast<std::size_t>(trajectory_.duration() / kStepS) +
                    (kFewestSteps + 2) * pieces.size();
  points_.reserve(room);
  motions_.reserve(room);
  double psi = psi_start_rad ? *psi_start_rad
                             : trajectory_.sample(0.0, vessel_, disturbance_).state[vessel::kPsi];
  double rate = 0.0;
  double psi_before = psi;  // a step ago, and how long that was; 0: there was none
  double h_before = 0.0;
  const auto step = [&](const vessel::FlatPoint& to, double from_rad, double kept_rad, double h) {
    return vessel::swayHeading(vessel_, disturbance_, to.velocity, to.acceleration, from_rad,
                               kept_rad, h)
        .psi_rad;
  };
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    const int steps = partsOf(piece.duration_s, kStepS, kFewestSteps);
    const double h = piece.duration_s / steps;
    const double keeps_s = kTurnDiesS * (1.0 - std::exp(-h / kTurnDiesS));
    first_.push_back(points_.size());
    for (int k = 0; k <= steps; ++k) {
      const vessel::FlatPoint z = piece.flat(h * k);
      const double psi_now = psi;
      if (piece.kind == PieceKind::kSpin) {
        const Eigen::Vector3d turn = piece.spinHeading(h * k);
        psi = unwrapNear(turn[0], psi);
        rate = turn[1];
      } else if (k > 0 && h_before > 0.0) {
        const Backward backward(h, h_before, psi, psi_before);
        psi = step(z, backward.from_rad, psi + keeps_s * rate, backward.step_s);
        rate = (psi - backward.from_rad) / backward.step_s;
      } else if (k > 0) {
        // Euler's step and two of half the length tell what both leave out.
        const double kept = psi + keeps_s * rate;
        const double once = step(z, psi, kept, h);
        const double half = step(piece.flat(h * (k - 0.5)), psi, 0.5 * (psi + kept), 0.5 * h);
        const double twice = step(z, half, kept, 0.5 * h);
        const double off = twice - once;
        psi = std::abs(off) < kNearlyOneRad ? twice + off : twice;
        rate = (psi - psi_now) / h;
      }
      if (k > 0) {
        psi_before = psi_now;
        h_before = piece.kind == PieceKind::kSpin ? 0.0 : h;
      }
      Point point;
      point.t_s = trajectory_.startOf(i) + h * k;
      point.psi_rad = psi;
      point.speed_mps = z.velocity.norm();
      points_.push_back(point);
      motions_.push_back({z.velocity, z.acceleration});
    }
  }
  first_.push_back(points_.size());
}

// Yaw rate and acceleration of sailing pieces by central differences, across joints; then what the
// thrusters do.
void MotionAlong::differentiate() {
  const std::vector<Piece>& pieces = trajectory_.pieces();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    const bool spins = piece.kind == PieceKind::kSpin;
    const double start = trajectory_.startOf(i);
    const std::size_t from = first_[i];
    const std::size_t last = first_[i + 1] - 1;
    for (std::size_t k = from; k <= last; ++k) {
      Point& point = points_[k];
      if (spins) {
        const Eigen::Vector3d turn = piece.spinHeading(point.t_s - start);
        point.yaw_rate_radps = turn[1];
        point.yaw_acceleration = turn[2];
      } else {
        const std::size_t centre = std::clamp(k, from + 1, last - 1);
        const double h = points_[centre + 1].t_s - points_[centre].t_s;
        const double ahead = points_[centre + 1].psi_rad - points_[centre].psi_rad;
        const double astern = points_[centre].psi_rad - points_[centre - 1].psi_rad;
        point.yaw_acceleration = (ahead - astern) / (h * h);
        point.yaw_rate_radps = (ahead + astern) / (2.0 * h) +
                               (point.t_s - points_[centre].t_s) * point.yaw_acceleration;
      }
      const vessel::Demand demand =
          vessel::demandOf(vessel_.manoeuvring, disturbance_, point.psi_rad, point.yaw_rate_radps,
                           point.yaw_acceleration, motions_[k].velocity, motions_[k].acceleration);
      point.thrusts = vessel::thrustsFromTau(demand.tau, vessel_.thrusters);
      point.sway_n = demand.sway_n;
    }
  }
}

// Cubic in the heading, linear in its derivatives.
MotionAlong::Point MotionAlong::between(double t_s) const {
  const auto after = std::upper_bound(points_.begin() + 1, points_.end() - 1, t_s,
                                      [](double t, const Point& p) { return t < p.t_s; });
  const Point& b = *after;
  const Point& a = *(after - 1);
  const double h = b.t_s - a.t_s;
  if (!(h > 0.0)) {
    return b;
  }
  const double x = std::clamp((t_s - a.t_s) / h, 0.0, 1.0);
  Point p = a;
  p.t_s = t_s;
  p.psi_rad = a.psi_rad + x * x * (3.0 - 2.0 * x) * (b.psi_rad - a.psi_rad) +
              h * x * (1.0 - x) * ((1.0 - x) * a.yaw_rate_radps - x * b.yaw_rate_radps);
  p.yaw_rate_radps = a.yaw_rate_radps + x * (b.yaw_rate_radps - a.yaw_rate_radps);
  p.yaw_acceleration = a.yaw_acceleration + x * (b.yaw_acceleration - a.yaw_acceleration);
  return p;
}

double MotionAlong::psi(double t_s) const {
  return between(t_s).psi_rad;
}

Sample MotionAlong::sample(double t_s) const {
  Sample s = trajectory_.sample(t_s, vessel_, disturbance_);
  if (points_.empty()) {
    return s;
  }
  const Point p = between(s.t_s);
  const vessel::Demand demand =
      vessel::demandOf(vessel_.manoeuvring, disturbance_, p.psi_rad, p.yaw_rate_radps,
                       p.yaw_acceleration, s.flat.velocity, s.flat.acceleration);
  s.state << s.flat.position, wrapAngle(p.psi_rad), demand.surge_mps, demand.sway_mps,
      p.yaw_rate_radps;
  s.tau = demand.tau;
  s.thrusts = vessel::thrustsFromTau(s.tau, vessel_.thrusters);
  return s;
}

}  // namespace otter_nav::trajectory
