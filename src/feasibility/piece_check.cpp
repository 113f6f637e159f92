#include "otter_nav/feasibility/piece_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "otter_nav/base/parts.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/feasibility/clearance_walk.hpp"
#include "otter_nav/feasibility/lean.hpp"
#include "otter_nav/trajectory/polynomial/piece_polynomials.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::feasibility {
namespace {

using trajectory::evaluate;

constexpr double kSlowMps = 1e-3;  // below it a course says nothing of the heading
constexpr double kSwayN = 0.1;     // what pieces of degree 7 leave, next to the model
// By the manoeuvring model, whose heading is followed in steps: a centimetre aside in a second.
constexpr double kSwayMps2 = 0.02;
constexpr double kThrustSlack = 1.01;  // yaw accelerations are differences of the heading's steps
constexpr double kLeastHeadingForceN = 1e-6;  // above rounding
constexpr double kAcrossCosine = 0.02;        // heading and course nearer to a right angle: a jump

// Watches a quantity sampled at equal steps: its bound includes what a parabola through three
// neighbours (twice its height, to be sure) rises to between them.
class Sampled {
 public:
  double bound(double value) {
    double widening = 0.0;
    if (count_ >= 2) {
      widening = 0.25 * std::abs(value - 2.0 * last_ + before_);
    }
    const double result = std::max(value, last_) + widening;
    before_ = last_;
    last_ = value;
    ++count_;
    return count_ == 1 ? value : result;
  }

 private:
  int count_ = 0;
  double last_ = -std::numeric_limits<double>::infinity();
  double before_ = 0.0;
};

}  // namespace

// What a piece asks for at its samples, one after the other, against the limits.
class PieceCheck::Watch {
 public:
  Watch(const PieceCheck& check, PieceReport& report) : check_(check), report_(report) {}

  // `time_s` from the trajectory's start.
  void note(const vessel::Thrusts& thrusts, double speed_mps, double yaw_rate_radps,
            double time_s) {
    const vessel::Thrusters& thrusters = check_.vessel_.thrusters;
    report_.thrust_share = std::max(
        {report_.thrust_share, left_.bound(vessel::shareOfLimit(thrusts[vessel::kLeft], thrusters)),
         right_.bound(vessel::shareOfLimit(thrusts[vessel::kRight], thrusters))});
    report_.speed_mps = std::max(report_.speed_mps, speed_mps);
    report_.speed_share =
        std::max(report_.speed_share, speed_mps / check_.limits_.speedMaxAt(time_s));
    report_.yaw_rate_radps = std::max(report_.yaw_rate_radps, std::abs(yaw_rate_radps));
  }
  void judge(double thrust_slack = 1.0) {
    if (report_.thrust_share > thrust_slack * check_.limits_.thrust_share) {
      report_.fault = Fault::kThrust;
    } else if (report_.speed_share > 1.0) {
      report_.fault = Fault::kSpeed;
    } else if (report_.yaw_rate_radps > check_.limits_.yaw_rate_max_radps) {
      report_.fault = Fault::kYawRate;
    }
  }

 private:
  const PieceCheck& check_;
  PieceReport& report_;
  Sampled left_, right_;
};

struct PieceCheck::Point {
  Eigen::Vector2d velocity;
  vessel::Thrusts thrusts;
  Eigen::Vector2d bow = Eigen::Vector2d::Zero();
  double yaw_rate_radps = 0.0;
  double heading_force_n = 0.0;  // against the course: negative
  double sway_n = 0.0;           // a force to port that no thruster gives
};

PieceCheck::PieceCheck(const trajectory::Piece& piece, const vessel::Parameters& vessel,
                       const SafetyLimits& limits, const Tolerances& tolerances)
    : piece_(piece),
      vessel_(vessel),
      inverse_(vessel, limits.disturbance),
      limits_(limits),
      tolerances_(tolerances) {
  velocity_ = trajectory::differentiate<8>(piece.position);
  acceleration_ = trajectory::differentiate<7>(velocity_);
  jerk_ = trajectory::differentiate<6>(acceleration_);
  snap_ = trajectory::differentiate<5>(jerk_);
  if (piece.kind == trajectory::PieceKind::kSail) {
    direction_ = trajectory::lineOf(piece);
    // With a load from abeam the hull goes crabwise.
    straight_ =
        direction_.squaredNorm() > 0.5 && std::abs(inverse_.loadAbeam(direction_)) <= kSwayN;
  }
}

inline PieceCheck::Point PieceCheck::at(double t_s) const {
  vessel::FlatPoint z;
  z.velocity = evaluate<7>(velocity_, t_s);
  z.acceleration = evaluate<6>(acceleration_, t_s);
  Point p;
  p.velocity = z.velocity;
  if (straight_) {
    const auto held = inverse_.held(direction_, 0.0, 0.0, z.velocity, z.acceleration);
    p.thrusts = vessel::thrustsFromTau(held.tau, vessel_.thrusters);
    return p;
  }
  z.jerk = evaluate<5>(jerk_, t_s);
  z.snap = evaluate<4>(snap_, t_s);
  const vessel::Sailing sailing =
      inverse_.sailing(z, inverse_.throughWater(z.velocity), kLeastHeadingForceN);
  p.yaw_rate_radps = sailing.yaw_rate_radps;
  p.heading_force_n = sailing.bow.firmness_n;
  p.bow = sailing.bow.ahead;
  p.thrusts = vessel::thrustsFromTau(sailing.tau, vessel_.thrusters);
  return p;
}

double PieceCheck::heading(double t_s) const {
  if (piece_.kind == trajectory::PieceKind::kSpin) {
    return piece_.spinHeading(t_s)[0];
  }
  const Eigen::Vector2d bow = bowAt(t_s);
  return angleOf(bow);
}

double PieceCheck::yawRate(double t_s) const {
  return piece_.kind == trajectory::PieceKind::kSpin ? piece_.spinHeading(t_s)[1]
                                                     : at(t_s).yaw_rate_radps;
}

Eigen::Vector2d PieceCheck::bowAt(double t_s) const {
  if (piece_.kind == trajectory::PieceKind::kSpin) {
    const double psi = piece_.spinHeading(t_s)[0];
    return unitVector(psi);
  }
  if (straight_) {
    return direction_;
  }
  const Eigen::Vector2d velocity = evaluate<7>(velocity_, t_s);
  Eigen::Vector2d ahead = inverse_.throughWater(velocity);
  if (ahead.norm() < kSlowMps) {
    const double inward = std::min(1e-2, 0.25 * piece_.duration_s);
    ahead = inverse_.throughWater(
        evaluate<7>(velocity_, t_s < 0.5 * piece_.duration_s ? t_s + inward : t_s - inward));
  }
  const Eigen::Vector2d w = inverse_.headingForce(velocity, evaluate<6>(acceleration_, t_s));
  return inverse_.bow(w, ahead, kLeastHeadingForceN).ahead;
}

PieceCheck::Point PieceCheck::inSpin(double t_s) const {
  const Eigen::Vector3d psi = piece_.spinHeading(t_s);
  Point p;
  p.velocity = evaluate<7>(velocity_, t_s);
  p.bow = unitVector(psi[0]);
  const vessel::HeldDemand held =
      inverse_.held(p.bow, psi[1], psi[2], p.velocity, evaluate<6>(acceleration_, t_s));
  p.sway_n = held.sway_n;
  p.yaw_rate_radps = psi[1];
  p.thrusts = vessel::thrustsFromTau(held.tau, vessel_.thrusters);
  return p;
}

// A spin in place is set aside by what pushes abeam, and by its own turning: that is no fault, but
// asks for room.
void PieceCheck::checkSway(double sway_n, double allowed_n, PieceReport& report) const {
  const double size = std::abs(sway_n);
  if (size <= allowed_n) {
    return;
  }
  const bool in_place = piece_.kind == trajectory::PieceKind::kSpin &&
                        piece_.position.rightCols<trajectory::kCoefficients - 1>().isZero(0.0);
  const double turning =
      vessel::paperHolds(vessel_)
          ? 0.0
          : std::abs(vessel_.manoeuvring.sway_from_yaw_kgmps) * limits_.yaw_rate_max_radps;
  report.sway_n = std::max(report.sway_n, size);
  report.sway_most_n = in_place ? allowed_n + turning + inverse_.greatestLoadAbeam() : allowed_n;
  if (size > report.sway_most_n) {
    report.fault = Fault::kSway;
  }
}

void PieceCheck::checkDynamics(const trajectory::MotionAlong& motion, std::size_t index,
                               PieceReport& report) const {
  const double allowed_n = kSwayMps2 * vessel_.manoeuvring.sway_inertia_kg;
  report.heading_force_n = std::numeric_limits<double>::infinity();
  const double start = motion.points()[motion.firstOf(index)].t_s;
  Watch watch(*this, report);
  for (std::size_t k = motion.firstOf(index); k < motion.firstOf(index + 1); ++k) {
    const trajectory::MotionAlong::Point& p = motion.points()[k];
    watch.note(p.thrusts, p.speed_mps, p.yaw_rate_radps, p.t_s);
    if (report.fault == Fault::kNone) {
      checkSway(p.sway_n, allowed_n, report);
      const Eigen::Vector2d through = inverse_.throughWater(evaluate<7>(velocity_, p.t_s - start));
      const Eigen::Vector2d bow = unitVector(p.psi_rad);
      if (piece_.kind == trajectory::PieceKind::kSail && through.norm() > vessel::kWalkingMps &&
          bow.dot(through) < kAcrossCosine * through.norm()) {
        report.fault = Fault::kHeadingJump;
      } else {
        watch.judge(kThrustSlack);
      }
      report.time_s = p.t_s - start;
    }
  }
}

void PieceCheck::checkSpin(double start_s, PieceReport& report) const {
  const int steps = partsOf(piece_.duration_s, tolerances_.step_s, 2);
  Watch watch(*this, report);
  for (int i = 0; i <= steps && report.fault == Fault::kNone; ++i) {
    report.time_s = piece_.duration_s * i / steps;
    const Point p = inSpin(report.time_s);
    watch.note(p.thrusts, p.velocity.norm(), p.yaw_rate_radps, start_s + report.time_s);
    checkSway(p.sway_n, kSwayN, report);
    if (report.fault == Fault::kNone) {
      watch.judge();
    }
  }
}

void PieceCheck::checkDynamics(double start_s, PieceReport& report) const {
  report.heading_force_n = std::numeric_limits<double>::infinity();
  if (piece_.kind == trajectory::PieceKind::kSpin) {
    checkSpin(start_s, report);
    return;
  }
  const int steps = partsOf(piece_.duration_s, tolerances_.step_s, 4);
  Watch watch(*this, report);
  const double least_force = leastHeadingForce(vessel_, limits_, tolerances_.heading_force_share);
  double branch = 0.0;  // sign of w . v
  for (int i = 0; i <= steps; ++i) {
    report.time_s = piece_.duration_s * i / steps;
    const Point p = at(report.time_s);
    watch.note(p.thrusts, p.velocity.norm(), p.yaw_rate_radps, start_s + report.time_s);
    if (!straight_) {
      const double norm = std::abs(p.heading_force_n);
      report.heading_force_n = std::min(report.heading_force_n, norm);
      const double side = p.heading_force_n >= 0.0 ? 1.0 : -1.0;
      const Eigen::Vector2d through = inverse_.throughWater(p.velocity);
      const double flow = through.norm();
      const double cosine = side * p.bow.dot(through) / std::max(flow, 1e-12);
      if (flow > kSlowMps && (std::abs(cosine) < kAcrossCosine || cosine * branch < 0.0)) {
        report.fault = Fault::kHeadingJump;
      }
      branch = flow > kSlowMps ? cosine : 0.0;
      if (norm < least_force) {
        report.fault = Fault::kHeadingUndefined;
      }
    } else if (direction_.dot(p.velocity) < -kSlowMps) {
      report.fault = Fault::kAstern;
    }
    watch.judge();
    if (report.fault != Fault::kNone) {
      return;
    }
  }
}

// 1.1 and 0.01 for what the yaw rate's samples may have missed.
void PieceCheck::checkClearance(const Obstacles& obstacles, double start_s, PieceReport& report,
                                const trajectory::MotionAlong* motion) const {
  SafetyLimits limits = limits_;
  limits.clearance_m += report.slide_m;
  const auto bow = [&](double t) -> Eigen::Vector2d {
    if (motion == nullptr) {
      return bowAt(t);
    }
    const double psi = motion->psi(start_s + t);
    return unitVector(psi);
  };
  const PieceWalk walk(limits, tolerances_.keep_hull_clear);
  const Walked walked =
      walk.along(piece_, 0.0, obstacles, start_s, 1.1 * report.yaw_rate_radps + 0.01, bow);
  report.clearance_m = walked.least_m;
  if (walked.conflict_s) {
    report.time_s = *walked.conflict_s;
    report.fault =
        walked.centre_m - limits.clearance_m < kLeastSlackM ? Fault::kClearance : Fault::kHull;
  } else if (piece_.kind == trajectory::PieceKind::kSail && tolerances_.keep_hull_clear &&
             leansInto(vessel_, limits_.felt)) {
    checkLeaning(obstacles, start_s, bow, report);
  }
}

// Where the hull touches at the piece's start already, what leads away is no worse.
template <typename Bow>
void PieceCheck::checkLeaning(const Obstacles& obstacles, double start_s, const Bow& bow,
                              PieceReport& report) const {
  constexpr double kStepS = 0.05;
  const HullCover hull(limits_.hull, std::min(kLeaningMarginM, limits_.hull_margin_m));
  const int steps = partsOf(piece_.duration_s, kStepS, 2);
  double least_m = 0.0;
  for (int k = 0; k <= steps; ++k) {
    const double t = piece_.duration_s * k / steps;
    double centre_m = 0.0;
    const double slack = hull.slack(
        obstacles, evaluate<8>(piece_.position, t), start_s + t, 0.0,
        [&] {
          return leaningBow(vessel_, limits_.felt, evaluate<7>(velocity_, t),
                            evaluate<6>(acceleration_, t), bow(t));
        },
        centre_m);
    if (k == 0) {
      least_m = std::min(least_m, slack - kLeastSlackM);
    }
    if (slack < least_m) {
      report.time_s = t;
      report.fault = Fault::kHull;
      return;
    }
  }
}

}  // namespace otter_nav::feasibility
