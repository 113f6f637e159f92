// A trajectory: polynomial pieces in sequence, sampled into the vessel's states and inputs.
#pragma once

#include <vector>

#include "otter_nav/trajectory/piece.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::trajectory {

struct Sample {
  double t_s = 0.0;  // from the trajectory's start
  vessel::FlatPoint flat;
  vessel::State state = vessel::State::Zero();  // psi wrapped to [-pi, pi]
  vessel::Tau tau;
  vessel::Thrusts thrusts = vessel::Thrusts::Zero();
  double heading_force_n = 0.0;  // |D| of vessel/inverse_dynamics.hpp; infinite in a spin
};

class Trajectory {
 public:
  Trajectory() = default;
  // `pieces` of positive duration; an empty trajectory has no samples.
  explicit Trajectory(std::vector<Piece> pieces);

  [[nodiscard]] bool empty() const { return pieces_.empty(); }
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] double duration() const { return starts_.empty() ? 0.0 : starts_.back(); }
  // Time at which piece `i` starts; i may be pieces().size() (the end).
  [[nodiscard]] double startOf(std::size_t i) const { return starts_[i]; }
  // The piece in force at `t_s`, clamped to the trajectory; a joint belongs to the later piece.
  [[nodiscard]] std::size_t pieceAt(double t_s) const;

  // Samples clamp `t_s` to [0, duration]. Constant time but for the search of the piece; nothing
  // is allocated. At rest the heading is the limit from within the piece.
  [[nodiscard]] vessel::FlatPoint flat(double t_s) const;
  [[nodiscard]] Sample sample(double t_s, const vessel::Parameters& vessel,
                              const vessel::Disturbance& disturbance = {}) const;
  // The same within one piece, `t_in_piece_s` from its start, not clamped: both sides of a joint.
  [[nodiscard]] Sample sampleIn(std::size_t piece, double t_in_piece_s,
                                const vessel::Parameters& vessel,
                                const vessel::Disturbance& disturbance = {}) const;

 private:
  std::vector<Piece> pieces_;
  std::vector<double> starts_;  // one more than pieces
};

// Length of the way over ground, m (Gauss quadrature on each piece).
[[nodiscard]] double length(const Trajectory& trajectory);

}  // namespace otter_nav::trajectory
