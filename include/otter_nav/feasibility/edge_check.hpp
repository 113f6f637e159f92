// FeasibilityCheck of the paper's algorithm 2: whether a tree's edge can be sailed. Cheap tests
// first: speed and thrust at a few instants, then along the edge, then collision by jumps as long
// as the distance field and the edge's greatest speed allow, so that no corner is stepped over.
#pragma once

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/trajectory/piece.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::feasibility {

enum class EdgeFault { kNone, kSpeed, kThrust, kCollision };

struct EdgeLimits {
  double clearance_m = 0.8;    // of the hull's centre
  double speed_max_mps = 4.7;  // over ground
  double force_ahead_n = 95.0;
  double force_astern_n = 95.0;
};

class EdgeCheck {
 public:
  EdgeCheck(const EdgeLimits& limits, const vessel::Parameters& vessel);

  // The map of the present query; it must outlive the checks.
  void setField(const map::DistanceField& field) { field_ = &field; }
  void setLimits(const EdgeLimits& limits) { limits_ = limits; }
  [[nodiscard]] const EdgeLimits& limits() const { return limits_; }

  // Sail pieces only. The heading is taken along w (vessel/inverse_dynamics.hpp), so a drifting
  // hull's ends are tested where they are. Between instants tested, bow and stern may pass an
  // obstacle by up to kHullSlack nearer than stated: what leaves the planner is verified exactly.
  [[nodiscard]] EdgeFault check(const trajectory::Piece& piece) const;
  [[nodiscard]] bool isClear(const trajectory::Piece& piece) const;
  // Whether a state is within limits by itself, at rest or moving.
  [[nodiscard]] bool isFree(const Eigen::Vector2d& position) const;

 private:
  struct Motion {
    Eigen::Vector2d position, velocity, acceleration;
  };
  [[nodiscard]] static Motion motionAt(const trajectory::Piece& piece, double t_s);
  [[nodiscard]] EdgeFault checkMotion(const Motion& motion) const;
  [[nodiscard]] double slack(const Motion& motion) const;

  EdgeLimits limits_;
  vessel::InverseDynamics inverse_;
  double end_offset_m_;   // the hull as two discs: their centres from its centre
  double disc_radius_m_;  // and their radius
  double circumscribed_m_;
  const map::DistanceField* field_ = nullptr;
};

}  // namespace otter_nav::feasibility
