// FeasibilityCheck of the paper's algorithm 2: whether a tree's edge can be sailed. Cheap tests
// first, at a few instants: speed and the thrusters' joint force, a necessary condition of the
// exact one (piece_check.hpp) that needs no jerk. Then the clearance, by the one walk.
#pragma once

#include <optional>

#include "otter_nav/feasibility/clearance_walk.hpp"
#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/trajectory/piece.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::feasibility {

enum class EdgeFault { kNone, kClearance, kSpeed, kForce, kYawRate, kHeading };

class EdgeCheck {
 public:
  explicit EdgeCheck(const vessel::Parameters& vessel);

  // Begins a query: field and layers of `obstacles` must outlive it.
  void begin(const Obstacles& obstacles, const SafetyLimits& limits);
  [[nodiscard]] const Obstacles& obstacles() const { return *obstacles_; }
  [[nodiscard]] const vessel::InverseDynamics& inverse() const { return inverse_; }
  [[nodiscard]] double clearance() const { return limits_.clearance_m; }
  // What edges may ask for: a little less than the whole trajectory.
  [[nodiscard]] double speedMax(double time_s) const {
    return kSpeedShare * limits_.speedMaxAt(time_s);
  }
  [[nodiscard]] double speedMaxEver() const { return kSpeedShare * limits_.speedMaxEver(); }
  [[nodiscard]] double forceMax() const { return force_ahead_n_; }  // both thrusters ahead, N

  // Sail pieces only. The heading is taken along w (vessel/inverse_dynamics.hpp), so a drifting
  // hull's ends are tested where they are; what its turning adds to their speed is left to the
  // verifier. `start_s`: when the edge begins, on the obstacles' clock.
  [[nodiscard]] EdgeFault check(const trajectory::Piece& piece, double start_s = 0.0) const;
  // The same with closer instants, where the yaw rate and the heading against the course count
  // too: for edges that were bent.
  [[nodiscard]] EdgeFault checkBent(const trajectory::Piece& piece, double start_s = 0.0) const;
  // Whether a state is within limits by itself, at rest or moving.
  [[nodiscard]] bool isFree(const Eigen::Vector2d& position, double time_s = 0.0) const;

 private:
  static constexpr double kSpeedShare = 0.98;  // of the speed limit, on an edge
  struct Motion {
    Eigen::Vector2d position, velocity, acceleration;
  };
  [[nodiscard]] static Motion motionAt(const trajectory::Piece& piece, double t_s);
  [[nodiscard]] EdgeFault checkMotion(const Motion& motion, double time_s) const;
  [[nodiscard]] EdgeFault checkTurning(const vessel::FlatPoint& z) const;
  [[nodiscard]] bool isClear(const trajectory::Piece& piece, double start_s) const;

  vessel::Parameters vessel_;
  vessel::InverseDynamics inverse_;
  SafetyLimits limits_;
  PieceWalk walk_;
  double least_force_n_ = 0.0;
  double force_ahead_n_ = 0.0;
  double force_astern_n_ = 0.0;
  std::optional<Obstacles> obstacles_;
};

}  // namespace otter_nav::feasibility
