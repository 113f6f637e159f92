// A spline and the manoeuvres at its ends as one trajectory, and how much it asks for.
#pragma once

#include <array>
#include <vector>

#include "optimizer/objective/spline_problem.hpp"
#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/optimizer/ends.hpp"
#include "otter_nav/trajectory/motion_along.hpp"
#include "otter_nav/trajectory/polynomial/quadrature.hpp"
#include "otter_nav/trajectory/trajectory.hpp"

namespace otter_nav::optimizer {

[[nodiscard]] trajectory::Trajectory assemble(const ChosenEnds& ends, const Spline& spline);

// The largest share by which a limit of thrust or speed is exceeded in each piece; negative: none
// is. By the paper's model, and by the manoeuvring model.
[[nodiscard]] std::vector<double> excesses(const trajectory::Trajectory& trajectory,
                                           const vessel::Parameters& vessel,
                                           const feasibility::SafetyLimits& safety);
[[nodiscard]] std::vector<double> excesses(const trajectory::MotionAlong& motion,
                                           const vessel::Parameters& vessel,
                                           const feasibility::SafetyLimits& safety);

// At each quadrature point of each span, N: how much more than its share a thruster is asked for up
// to the next points, by the manoeuvring model.
using AtPoints = std::vector<std::array<double, trajectory::kLobattoPoints>>;
[[nodiscard]] AtPoints excessAlong(const trajectory::MotionAlong& motion, std::size_t first_span,
                                   std::size_t spans, const vessel::Parameters& vessel,
                                   const feasibility::SafetyLimits& safety);

// Lets time run slower by a factor at the knots marked, and so between them; the ends' motion is
// their manoeuvres'.
void slowDown(const std::vector<bool>& knots, double factor, Spline& spline);

// The same shape with its time, and its ends' families, stretched by a factor.
void stretch(double factor, Spline& spline);

// At the speed limit in its own time a vessel is the one that is this at full speed.
[[nodiscard]] vessel::Parameters inSlowMotion(const vessel::Parameters& vessel, double slow);
// And what acts on it; loads of the wind depend on the heading alone.
[[nodiscard]] inline vessel::Disturbance inSlowMotion(vessel::Disturbance disturbance,
                                                      double slow) {
  disturbance.current_mps /= slow;
  return disturbance;
}

}  // namespace otter_nav::optimizer
