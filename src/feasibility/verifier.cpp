#include "otter_nav/feasibility/verifier.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/text.hpp"
#include "otter_nav/feasibility/piece_check.hpp"
#include "otter_nav/trajectory/joint.hpp"
#include "otter_nav/trajectory/motion_along.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"

namespace otter_nav::feasibility {
namespace {

// Largest jumps at a joint: what rounding leaves.
constexpr trajectory::Gap kJump = {1e-6, 1e-6, 1e-5, 1e-4};
constexpr double kJumpRad = 1e-3;
constexpr double kJumpRadps = 1e-3;
// A boundary's velocity, acceleration and jerk are met this closely.
constexpr double kEndMps = 2e-3;
// By the manoeuvring model turning sets the hull aside, and no thruster stops that: at rest it is
// within this, and what a load from abeam makes of a hull that turns. Where a spin begins the
// heading that followed the path meets the spin's own.
constexpr double kDriftMps = 0.05;
constexpr double kMeetRad = 0.01;
constexpr double kMeetRadps = 0.03;

class Verifier {
 public:
  Verifier(const trajectory::Trajectory& trajectory, const Obstacles& obstacles,
           const vessel::Parameters& vessel, const SafetyLimits& limits,
           const Tolerances& tolerances, const trajectory::MotionAlong* motion = nullptr)
      : motion_(motion),
        trajectory_(trajectory),
        obstacles_(obstacles),
        vessel_(vessel),
        limits_(limits),
        tolerances_(tolerances) {
    result_.clearance_m = std::numeric_limits<double>::infinity();
    result_.heading_force_n = std::numeric_limits<double>::infinity();
  }

  Verification run(const trajectory::Boundary* start, const trajectory::Boundary* goal) {
    result_.ok = !trajectory_.empty();
    if (!result_.ok) {
      result_.reason = "the trajectory is empty";
      return result_;
    }
    checkFinite();
    // Without ends the heading at the start is not known: then the paper's model has to do.
    if (result_.ok && start != nullptr && motion_ == nullptr && !vessel::paperHolds(vessel_)) {
      own_.emplace(trajectory_, vessel_, limits_.disturbance, start->psi_rad);
      motion_ = &*own_;
    }
    if (result_.ok && start != nullptr) {
      checkEnd(*start, 0, 0.0, "start");
    }
    if (result_.ok && goal != nullptr) {
      const std::size_t last = trajectory_.pieces().size() - 1;
      checkEnd(*goal, last, trajectory_.pieces()[last].duration_s, "goal");
    }
    for (std::size_t i = 0; i < trajectory_.pieces().size() && result_.ok; ++i) {
      checkPiece(i);
    }
    return result_;
  }

 private:
  void fail(double t_s, const std::string& what, double value, double limit) {
    result_.ok = false;
    result_.fault_s = t_s;
    result_.reason = what + text(" at %.2f s: %.3f (limit %.3f)", t_s, value, limit);
  }

  void checkFinite() {
    for (std::size_t i = 0; i < trajectory_.pieces().size(); ++i) {
      const trajectory::Piece& piece = trajectory_.pieces()[i];
      if (!trajectory::isSound(piece)) {
        return fail(trajectory_.startOf(i), "a piece is not finite or has no duration",
                    piece.duration_s, 0.0);
      }
    }
  }

  void checkEnd(const trajectory::Boundary& boundary, std::size_t piece, double t_in_piece,
                const char* name) {
    const double t = trajectory_.startOf(piece) + t_in_piece;
    const std::string label(name);
    const vessel::FlatPoint z = trajectory_.pieces()[piece].flat(t_in_piece);
    const double off = (z.position - boundary.flat.position).norm();
    if (off > tolerances_.position_m) {
      return fail(t, label + " position missed", off, tolerances_.position_m);
    }
    double motion = (z.velocity - boundary.flat.velocity).norm();
    if (!trajectory::atRest(boundary)) {
      motion = std::max({motion, (z.acceleration - boundary.flat.acceleration).norm(),
                         (z.jerk - boundary.flat.jerk).norm()});
    }
    const vessel::InverseDynamics inverse(vessel_, limits_.disturbance);
    const double drift =
        kDriftMps + inverse.greatestLoadAbeam() / vessel_.manoeuvring.sway_drag_kgps;
    const double most = motion_ != nullptr ? drift : kEndMps;
    if (motion > most) {
      return fail(t, label + " motion missed", motion, most);
    }
    if (trajectory::atRest(boundary)) {
      const PieceCheck check(trajectory_.pieces()[piece], vessel_, limits_, tolerances_);
      const double psi = motion_ != nullptr ? motion_->psi(t) : check.heading(t_in_piece);
      const double turn = std::abs(wrapAngle(psi - boundary.psi_rad));
      if (!(turn <= tolerances_.heading_rad)) {
        fail(t, label + " heading missed", turn, tolerances_.heading_rad);
      }
    }
  }

  // The joint before piece `i`.
  void checkJoint(std::size_t i, const PieceCheck& check) {
    const trajectory::Piece& before = trajectory_.pieces()[i - 1];
    const trajectory::Piece& after = trajectory_.pieces()[i];
    const double t = trajectory_.startOf(i);
    const auto jump = [&](const char* what, double off, double limit) {
      if (result_.ok && !(off <= limit)) {
        fail(t, what, off, limit);
      }
    };
    const trajectory::Gap gap = trajectory::gapBetween(before, after);
    jump("position jumps", gap.position_m, kJump.position_m);
    jump("velocity jumps", gap.velocity_mps, kJump.velocity_mps);
    jump("acceleration jumps", gap.acceleration_mps2, kJump.acceleration_mps2);
    jump("jerk jumps", gap.jerk_mps3, kJump.jerk_mps3);
    if (!result_.ok) {
      return;
    }
    if (motion_ != nullptr) {
      checkMeeting(i);
      return;
    }
    const double turn = std::abs(wrapAngle(check.heading(0.0) - heading_));
    if (!(turn <= kJumpRad)) {
      return fail(t, "heading jumps", turn, kJumpRad);
    }
    const bool spins =
        after.kind == trajectory::PieceKind::kSpin || before.kind == trajectory::PieceKind::kSpin;
    const double rate = std::abs(check.yawRate(0.0) - yaw_rate_);
    if (spins && rate > kJumpRadps) {
      fail(t, "yaw rate jumps", rate, kJumpRadps);
    }
  }

  // The heading at the joint before piece `i`, by the manoeuvring model.
  void checkMeeting(std::size_t i) {
    const trajectory::MotionAlong::Point& after = motion_->points()[motion_->firstOf(i)];
    const trajectory::MotionAlong::Point& before = motion_->points()[motion_->firstOf(i) - 1];
    const double turn = std::abs(after.psi_rad - before.psi_rad);
    const double rate = std::abs(after.yaw_rate_radps - before.yaw_rate_radps);
    if (!(turn <= kMeetRad)) {
      fail(after.t_s, "heading jumps", turn, kMeetRad);
    } else if (trajectory_.pieces()[i].kind == trajectory::PieceKind::kSpin && rate > kMeetRadps) {
      fail(after.t_s, "yaw rate jumps", rate, kMeetRadps);
    }
  }

  // What in-place spins, one after another, are set aside by up to the end of this one, which
  // nothing of theirs says: this one needs that much more room. From any other piece on it is none.
  void slide(const trajectory::Piece& piece, const PieceReport& report) {
    if (piece.kind != trajectory::PieceKind::kSpin || report.sway_n <= 0.0) {
      slide_mps_ = slide_m_ = 0.0;
      return;
    }
    const vessel::ManoeuvringModel& m = vessel_.manoeuvring;
    slide_mps_ = std::min(slide_mps_ + report.sway_n / m.sway_inertia_kg * piece.duration_s,
                          report.sway_n / m.sway_drag_kgps);
    slide_m_ += slide_mps_ * piece.duration_s;
  }

  void checkPiece(std::size_t i) {
    const trajectory::Piece& piece = trajectory_.pieces()[i];
    const PieceCheck check(piece, vessel_, limits_, tolerances_);
    if (i > 0) {
      checkJoint(i, check);
    }
    if (!result_.ok) {
      return;
    }
    PieceReport report;
    if (motion_ != nullptr) {
      check.checkDynamics(*motion_, i, report);
    } else {
      check.checkDynamics(trajectory_.startOf(i), report);
    }
    slide(piece, report);
    if (report.fault == Fault::kNone) {
      report.slide_m = slide_m_;
      check.checkClearance(obstacles_, trajectory_.startOf(i), report, motion_);
      result_.clearance_m = std::min(result_.clearance_m, report.clearance_m);
    }
    result_.thrust_share = std::max(result_.thrust_share, report.thrust_share);
    result_.speed_mps = std::max(result_.speed_mps, report.speed_mps);
    result_.yaw_rate_radps = std::max(result_.yaw_rate_radps, report.yaw_rate_radps);
    result_.heading_force_n = std::min(result_.heading_force_n, report.heading_force_n);
    if (report.fault != Fault::kNone) {
      explain(report, trajectory_.startOf(i) + report.time_s);
      return;
    }
    heading_ = check.heading(piece.duration_s);
    yaw_rate_ = check.yawRate(piece.duration_s);
  }

  void explain(const PieceReport& r, double t) {
    const SafetyLimits& o = limits_;
    result_.fault = r.fault;
    switch (r.fault) {
      case Fault::kThrust:
        return fail(t, "thrust share too large", r.thrust_share, o.thrust_share);
      case Fault::kSpeed:
        return fail(t, "too fast, m/s", r.speed_mps, o.speedMaxAt(t));
      case Fault::kYawRate:
        return fail(t, "turns too fast, rad/s", r.yaw_rate_radps, o.yaw_rate_max_radps);
      case Fault::kHeadingUndefined:
        return fail(t, "turns without a force to turn by, N", r.heading_force_n,
                    leastHeadingForce(vessel_, o, tolerances_.heading_force_share));
      case Fault::kHeadingJump:
        return fail(t, "heading swings across the course", 0.0, 0.0);
      case Fault::kAstern:
        return fail(t, "sails astern", 0.0, 0.0);
      case Fault::kSway:
        return fail(t, "slides without a force, N", r.sway_n, r.sway_most_n);
      case Fault::kClearance:
        return fail(t, "too near an obstacle, m", r.clearance_m, o.clearance_m + r.slide_m);
      case Fault::kHull:
        return fail(t, "the hull touches an obstacle", r.clearance_m, o.clearance_m);
      case Fault::kNone:
        break;
    }
  }

  // Where the paper's model does not hold: the caller's, or made here.
  const trajectory::MotionAlong* motion_;
  std::optional<trajectory::MotionAlong> own_;
  const trajectory::Trajectory& trajectory_;
  const Obstacles& obstacles_;
  const vessel::Parameters& vessel_;
  const SafetyLimits& limits_;
  const Tolerances& tolerances_;
  Verification result_;
  double slide_mps_ = 0.0;
  double slide_m_ = 0.0;
  double heading_ = 0.0;  // at the end of the piece before
  double yaw_rate_ = 0.0;
};

}  // namespace

Verification verify(const trajectory::Trajectory& trajectory, const Obstacles& obstacles,
                    const vessel::Parameters& vessel, const trajectory::Boundary& start,
                    const trajectory::Boundary& goal, const SafetyLimits& limits,
                    const Tolerances& tolerances, const trajectory::MotionAlong* motion) {
  const SafetyLimits from_start = limits.startingAt(start.flat.velocity.norm(), vessel);
  return Verifier(trajectory, obstacles, vessel, from_start, tolerances, motion).run(&start, &goal);
}

Verification verify(const trajectory::Trajectory& trajectory, const Obstacles& obstacles,
                    const vessel::Parameters& vessel, const SafetyLimits& limits,
                    const Tolerances& tolerances) {
  return Verifier(trajectory, obstacles, vessel, limits, tolerances).run(nullptr, nullptr);
}

}  // namespace otter_nav::feasibility
