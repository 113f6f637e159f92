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

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/feasibility/edge_check.hpp"
#include "otter_nav/trajectory/piece.hpp"
#include "otter_nav/trajectory/polynomial/hermite.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::optimizer {

struct LocalOptions {
  double clearance_margin_m = 0.2;  // guidance points stand this much further off
  double push_max_m = 6.0;          // farther from the edge than this no guidance point is sought
  // The paper's weights.
  double weight_smooth = 0.02;
  double weight_clearance = 10.0;
  double weight_dynamics = 2.0;
  double weight_original = 0.05;
  double weight_growth = 4.0;
  int segments = 6;  // at most kMaxSegments
  int attempts = 4;  // solutions with raised weights
};
constexpr int kMaxSegments = 12;

// config/optimizer.yaml: mapping `local`.
[[nodiscard]] Result<LocalOptions> readLocalOptions(config::Section section);

// An edge after repair: pieces (quintics in time), twice continuously differentiable inside and
// at the two fixed states. Its price is the search's to say.
struct RepairedEdge {
  std::array<trajectory::Piece, kMaxSegments> pieces;
  int count = 0;
  double duration_s = 0.0;
};

// Allocation-free; const and thread-safe.
class LocalOptimizer {
 public:
  LocalOptimizer(const LocalOptions& options, const vessel::Parameters& vessel);

  [[nodiscard]] const LocalOptions& options() const { return options_; }

  // Bends the failing edge `edge` (degree 5 or less), which begins at `start_s`, between its own
  // end states. True, with the result in `repaired`, if it passes checkBent().
  [[nodiscard]] bool repair(const feasibility::EdgeCheck& check, const trajectory::Piece& edge,
                            double start_s, RepairedEdge& repaired) const;

 private:
  static constexpr int kPoints = 5;  // a segment, where terms are summed
  static constexpr int kKnots = kMaxSegments + 1;
  using Knots = std::array<Eigen::Matrix<double, 2, 3>, kKnots>;  // p, v, a
  // Where the edge is drawn to at each point: position, velocity and acceleration, with weights.
  struct Pull {
    Eigen::Matrix<double, 2, 3> target;
    Eigen::Vector3d weight;
  };
  using Pulls = std::array<std::array<Pull, kPoints>, kMaxSegments>;

  using States = std::array<Eigen::Matrix<double, 2, 3>, kMaxSegments * kPoints>;  // p, v, a

  void guideStretch(const feasibility::EdgeCheck& check, const States& states, int first, int last,
                    double weight, Pulls& pulls) const;
  void pullTowards(const feasibility::EdgeCheck& check, const Knots& knots, double step_s,
                   double growth, Pulls& pulls) const;
  void solve(const Pulls& pulls, double step_s, Knots& knots) const;
  [[nodiscard]] feasibility::EdgeFault join(const feasibility::EdgeCheck& check, const Knots& knots,
                                            double start_s, double step_s,
                                            RepairedEdge& repaired) const;

  LocalOptions options_;
  vessel::Parameters vessel_;
  // Quintic Hermite basis at each point: rows are derivatives, columns p, v, a at both ends.
  std::array<trajectory::QuinticBasis, kPoints> basis_;
  Eigen::Matrix<double, 6, 6> jerk_;  // integral of the squared third derivative, unit time
};

}  // namespace otter_nav::optimizer
