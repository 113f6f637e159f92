// The objective F of the global optimisation over a spline of degree 7, and its quadratic model.
//
//   F = sum over pieces of costs (travel_costs.hpp, the paper's f_s and f_o) and of penalties on
//       limits (limit_costs.hpp, f_d) and clearance (clearance_cost.hpp, f_c)
//
// Unknowns: each knot's position, velocity, acceleration and jerk, and each piece's duration. The
// model is convex, and block-tridiagonal: a block is a knot and the piece after.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "optimizer/objective/cost.hpp"
#include "optimizer/objective/spline.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::optimizer {

class SplineProblem {
 public:
  explicit SplineProblem(const vessel::Parameters& vessel);

  Targets targets;

  // What the vessel works against from now on.
  void setDisturbance(const vessel::Disturbance& disturbance) {
    dynamics_ = vessel::InverseDynamics(vessel_, disturbance);
  }

  // F; with `system`, also its quadratic model: diagonal and below hold the Hessian, right the
  // negative gradient, with what is not free pinned to zero.
  double evaluate(const Spline& spline, System* system) const;

  // Adds a step to the unknowns.
  static void apply(const std::vector<System::Vector>& step, double scale, Spline& spline);

 private:
  static constexpr int kBetweenPoints = 12;
  static constexpr int kDensePoints = 24;  // where something that moves may be near

  void addPiece(PieceModel& piece) const;
  [[nodiscard]] bool mayMeetMoving(const PieceModel& piece) const;

  vessel::Parameters vessel_;
  vessel::InverseDynamics dynamics_;
  double force_floor_n_;
  std::array<trajectory::SepticBasis, trajectory::kLobattoPoints> lobatto_;
  std::array<trajectory::SepticBasis, kBetweenPoints> between_;
  std::array<trajectory::SepticBasis, kDensePoints> dense_;
  std::vector<std::unique_ptr<Cost>> costs_;          // summed at each piece's Lobatto points
  std::vector<std::unique_ptr<Cost>> between_costs_;  // at even distances inside, which are denser
};

}  // namespace otter_nav::optimizer
