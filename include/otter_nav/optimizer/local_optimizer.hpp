// The paper's local optimisation (section V-A, TrajectoryOptimize in TreeGrow): an edge of the
// tree that fails between two fixed states is bent until it is feasible, instead of discarded.
//
// The edge's quintic is cut into segments of equal time with free states (p, v, a) between them.
// Guidance points stand where the colliding part, pushed along the distance field's gradient, is
// safe. F = ls fs + lc fc + ld fd + lo fo is quadratic in the free states, its minimum a
// block-tridiagonal system solved in closed form; weights of what still fails are raised.
#pragma once

#include <Eigen/Core>
#include <array>

#include "otter_nav/feasibility/edge_check.hpp"
#include "otter_nav/trajectory/piece.hpp"
#include "otter_nav/trajectory/polynomial/hermite.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::optimizer {

// An edge after repair: pieces (quintics in time), twice continuously differentiable inside and
// at the two fixed states. Its price is the search's to say.
struct RepairedEdge {
  static constexpr int kPieces = 6;
  std::array<trajectory::Piece, kPieces> pieces;
  double duration_s = 0.0;
};

// Allocation-free; const and thread-safe.
class LocalOptimizer {
 public:
  LocalOptimizer();

  // Bends the failing edge `edge` (degree 5 or less), which begins at `start_s`, between its own
  // end states. True, with the result in `repaired`, if it passes checkBent().
  [[nodiscard]] bool repair(const feasibility::EdgeCheck& check, const trajectory::Piece& edge,
                            double start_s, RepairedEdge& repaired) const;

 private:
  static constexpr int kSegments = RepairedEdge::kPieces;
  static constexpr int kPoints = 5;  // a segment, where terms are summed
  static constexpr int kKnots = kSegments + 1;
  using Knots = std::array<Eigen::Matrix<double, 2, 3>, kKnots>;  // p, v, a
  // Where the edge is drawn to at each point: position, velocity and acceleration, with weights.
  struct Pull {
    Eigen::Matrix<double, 2, 3> target;
    Eigen::Vector3d weight;
  };
  using Pulls = std::array<std::array<Pull, kPoints>, kSegments>;

  using States = std::array<Eigen::Matrix<double, 2, 3>, kSegments * kPoints>;  // p, v, a

  void guideStretch(const feasibility::EdgeCheck& check, const States& states, int first, int last,
                    double weight, Pulls& pulls) const;
  void pullTowards(const feasibility::EdgeCheck& check, const Knots& knots, double step_s,
                   double growth, Pulls& pulls) const;
  void solve(const Pulls& pulls, double step_s, Knots& knots) const;
  [[nodiscard]] feasibility::EdgeFault join(const feasibility::EdgeCheck& check, const Knots& knots,
                                            double start_s, double step_s,
                                            RepairedEdge& repaired) const;

  // Quintic Hermite basis at each point: rows are derivatives, columns p, v, a at both ends.
  std::array<trajectory::QuinticBasis, kPoints> basis_;
  Eigen::Matrix<double, 6, 6> jerk_;  // integral of the squared third derivative, unit time
};

}  // namespace otter_nav::optimizer
