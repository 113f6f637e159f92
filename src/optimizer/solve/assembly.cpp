#include "optimizer/solve/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "otter_nav/feasibility/piece_check.hpp"
#include "otter_nav/trajectory/motion_along.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::optimizer {
namespace {

vessel::FlatPoint pointOf(const Knot& knot) {
  vessel::FlatPoint z;
  z.position = knot.state.col(0);
  z.velocity = knot.state.col(1);
  z.acceleration = knot.state.col(2);
  z.jerk = knot.state.col(3);
  return z;
}

}  // namespace

trajectory::Trajectory assemble(const ChosenEnds& ends, const Spline& spline) {
  const std::vector<trajectory::Piece>& before = ends.start.manoeuvre.pieces;
  const std::vector<trajectory::Piece>& after = ends.goal.manoeuvre.pieces;
  std::vector<trajectory::Piece> pieces;
  pieces.reserve(before.size() + spline.spans.size() + after.size());
  pieces.insert(pieces.end(), before.begin(), before.end());
  for (std::size_t i = 0; i < spline.spans.size(); ++i) {
    pieces.push_back(trajectory::hermitePiece(
        pointOf(spline.knots[i]), pointOf(spline.knots[i + 1]), spline.spans[i].duration_s));
  }
  pieces.insert(pieces.end(), after.begin(), after.end());
  return trajectory::Trajectory(std::move(pieces));
}

std::vector<double> excesses(const trajectory::MotionAlong& motion,
                             const vessel::Parameters& vessel,
                             const feasibility::SafetyLimits& safety) {
  std::vector<double> excess(motion.pieces(), -1.0);
  for (std::size_t i = 0; i < excess.size(); ++i) {
    for (std::size_t k = motion.firstOf(i); k < motion.firstOf(i + 1); ++k) {
      const trajectory::MotionAlong::Point& p = motion.points()[k];
      const double thrust = vessel::shareOfLimit(p.thrusts, vessel.thrusters);
      excess[i] = std::max({excess[i], thrust / safety.thrust_share - 1.0,
                            p.speed_mps / safety.speedMaxAt(p.t_s) - 1.0});
    }
  }
  return excess;
}

std::vector<double> excesses(const trajectory::Trajectory& trajectory,
                             const vessel::Parameters& vessel,
                             const feasibility::SafetyLimits& safety) {
  const std::size_t pieces = trajectory.pieces().size();
  std::vector<double> excess(pieces, -1.0);
  constexpr double kOpen = 1e3;
  feasibility::SafetyLimits open = safety;
  open.thrust_share *= kOpen;
  open.speed_max_mps *= kOpen;
  open.slowing.start_mps *= kOpen;
  open.yaw_rate_max_radps *= kOpen;
  feasibility::Tolerances tolerances;
  tolerances.heading_force_share = 0.0;
  for (std::size_t i = 0; i < pieces; ++i) {
    feasibility::PieceReport report;
    feasibility::PieceCheck(trajectory.pieces()[i], vessel, open, tolerances)
        .checkDynamics(trajectory.startOf(i), report);
    excess[i] =
        std::max(report.thrust_share / safety.thrust_share, kOpen * report.speed_share) - 1.0;
  }
  return excess;
}

void stretch(double factor, Spline& spline) {
  for (Span& span : spline.spans) {
    span.duration_s *= factor;
  }
  for (Knot& knot : spline.knots) {
    double scale = 1.0;
    for (int m = 1; m < 4; ++m) {
      scale /= factor;
      knot.state.col(m) *= scale;
      if (knot.family) {
        knot.family->state.middleRows<2>(2 * m) *= scale;
      }
    }
    if (knot.family) {
      knot.family->duration_s *= factor;
    }
  }
}

vessel::Parameters inSlowMotion(const vessel::Parameters& vessel, double slow) {
  vessel::Parameters other = vessel;
  other.paper.m1_kg *= slow * slow;
  other.paper.m2_kgm2 *= slow * slow;
  other.paper.d1_kgps *= slow;
  other.paper.d2_kgps *= slow;
  other.paper.d3_kgm2ps *= slow;
  return other;
}

AtPoints excessAlong(const trajectory::MotionAlong& motion, std::size_t first_span,
                     std::size_t spans, const vessel::Parameters& vessel,
                     const feasibility::SafetyLimits& safety) {
  const auto& at = trajectory::kLobatto.at;
  AtPoints excess_n(spans);
  for (std::size_t i = 0; i < spans; ++i) {
    excess_n[i].fill(0.0);
    const std::size_t from = motion.firstOf(first_span + i);
    const std::size_t to = motion.firstOf(first_span + i + 1);
    std::size_t after = 1;
    for (std::size_t k = from; k < to; ++k) {
      const double where = static_cast<double>(k - from) / static_cast<double>(to - from - 1);
      while (after + 1 < at.size() && at[after] < where) {
        ++after;
      }
      for (const double thrust_n : motion.points()[k].thrusts) {
        const double share = vessel::shareOfLimit(thrust_n, vessel.thrusters);
        if (share > safety.thrust_share) {
          const double more_n = std::abs(thrust_n) * (1.0 - safety.thrust_share / share);
          excess_n[i][after - 1] = std::max(excess_n[i][after - 1], more_n);
          excess_n[i][after] = std::max(excess_n[i][after], more_n);
        }
      }
    }
  }
  return excess_n;
}

void slowDown(const std::vector<bool>& knots, double factor, Spline& spline) {
  for (std::size_t k = 0; k < spline.spans.size(); ++k) {
    const int slow = (knots[k] ? 1 : 0) + (knots[k + 1] ? 1 : 0);
    spline.spans[k].duration_s *= slow == 2 ? factor : slow == 1 ? std::sqrt(factor) : 1.0;
  }
  double scale = 1.0;
  for (int m = 1; m < 4; ++m) {
    scale /= factor;
    for (std::size_t k = 0; k < knots.size(); ++k) {
      if (knots[k]) {
        spline.knots[k].state.col(m) *= scale;
      }
    }
  }
}

}  // namespace otter_nav::optimizer
