// One piece of a trajectory under verification: limits of thrust, speed and turning, then the
// clearance along it.
#pragma once

#include <Eigen/Core>

#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/trajectory/motion_along.hpp"
#include "otter_nav/trajectory/piece.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::feasibility {

struct PieceReport {
  Fault fault = Fault::kNone;
  double time_s = 0.0;  // of the fault, from the piece's start
  double thrust_share = 0.0;
  double speed_mps = 0.0;
  double speed_share = 0.0;  // of what is allowed at the time
  double yaw_rate_radps = 0.0;
  double heading_force_n = 0.0;  // least; infinite on straight pieces
  double clearance_m = 0.0;
  double sway_n = 0.0;       // most, of a spin in place that is more than the model's own error
  double sway_most_n = 0.0;  // that is no fault
  double slide_m = 0.0;      // how far the hull may be aside of the piece: more room is asked for
};

class PieceCheck {
 public:
  PieceCheck(const trajectory::Piece& piece, const vessel::Parameters& vessel,
             const SafetyLimits& limits, const Tolerances& tolerances = {});

  [[nodiscard]] bool straight() const { return straight_; }
  // The heading at an end of the piece (`t_s` is 0 or the duration), not wrapped.
  [[nodiscard]] double heading(double t_s) const;
  [[nodiscard]] double yawRate(double t_s) const;

  // Fills all of the report but the clearance. `start_s` as below.
  void checkDynamics(double start_s, PieceReport& report) const;
  // The same by the manoeuvring model: the piece is number `index` of the trajectory `motion` is
  // of.
  void checkDynamics(const trajectory::MotionAlong& motion, std::size_t index,
                     PieceReport& report) const;
  // `start_s`: when the piece begins, from the trajectory's start. Needs the report's yaw rate.
  // With `motion` the heading is that motion's.
  void checkClearance(const Obstacles& obstacles, double start_s, PieceReport& report,
                      const trajectory::MotionAlong* motion = nullptr) const;

 private:
  struct Point;
  class Watch;
  [[nodiscard]] Point at(double t_s) const;
  [[nodiscard]] Point inSpin(double t_s) const;
  void checkSpin(double start_s, PieceReport& report) const;
  // Of a piece of the kind this one is; sets the fault and, in a spin, what sets it aside.
  void checkSway(double sway_n, double allowed_n, PieceReport& report) const;
  [[nodiscard]] Eigen::Vector2d bowAt(double t_s) const;
  // The clearance of the hull as it leans into limits.felt.
  template <typename Bow>
  void checkLeaning(const Obstacles& obstacles, double start_s, const Bow& bow,
                    PieceReport& report) const;

  const trajectory::Piece& piece_;
  const vessel::Parameters& vessel_;
  vessel::InverseDynamics inverse_;
  const SafetyLimits limits_;
  const Tolerances tolerances_;
  bool straight_ = false;
  Eigen::Vector2d direction_ = Eigen::Vector2d::Zero();  // of a straight piece
  Eigen::Matrix<double, 2, 7> velocity_;
  Eigen::Matrix<double, 2, 6> acceleration_;
  Eigen::Matrix<double, 2, 5> jerk_;
  Eigen::Matrix<double, 2, 4> snap_;
};

}  // namespace otter_nav::feasibility
