#include "otter_nav/optimizer/spin.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::optimizer {
namespace {

// The three phases of the time-optimal turn. With r_end = tau / d3 and lag = m2 / d3, speeding up
// is r_end (1 - exp(-t / lag)); the integral of the equation of motion gives the turn of both
// moment phases together as r_end (t_up - t_down).
struct Phases {
  double up_s = 0.0;
  double steady_s = 0.0;
  double down_s = 0.0;
  double r_end = 0.0;
  double lag_s = 0.0;
  double r_top = 0.0;
};

double slowDown(double up_s, double lag_s) {
  return lag_s * std::log(2.0 - std::exp(-up_s / lag_s));
}

Phases phasesOf(double turn_rad, const vessel::Parameters& vessel, const SpinLimits& limits) {
  const vessel::Thrusters& t = vessel.thrusters;
  const double moment =
      2.0 * t.lever_arm_m * limits.thrust_share * std::min(t.ahead_max_n, t.astern_max_n);
  Phases p;
  p.r_end = moment / vessel.paper.d3_kgm2ps;
  p.lag_s = vessel.paper.m2_kgm2 / vessel.paper.d3_kgm2ps;
  const double turn = std::abs(turn_rad);
  const double cap = std::min(limits.yaw_rate_max_radps, 0.999 * p.r_end);
  const double up_to_cap = -p.lag_s * std::log1p(-cap / p.r_end);
  const double turn_to_cap = p.r_end * (up_to_cap - slowDown(up_to_cap, p.lag_s));
  if (turn >= turn_to_cap) {
    p.up_s = up_to_cap;
    p.steady_s = (turn - turn_to_cap) / cap;
  } else {
    double low = 0.0;
    double high = up_to_cap;
    for (int i = 0; i < 60; ++i) {
      p.up_s = 0.5 * (low + high);
      (p.r_end * (p.up_s - slowDown(p.up_s, p.lag_s)) < turn ? low : high) = p.up_s;
    }
  }
  p.r_top = p.r_end * (1.0 - std::exp(-p.up_s / p.lag_s));
  p.down_s = slowDown(p.up_s, p.lag_s);
  return p;
}

// One phase: r(t) = r_end + (r_0 - r_end) exp(-t / lag), in pieces no longer than the lag.
class PhaseWriter {
 public:
  PhaseWriter(const Eigen::Vector2d& position, double psi_start_rad, double sign, double lag_s,
              std::vector<trajectory::Piece>& pieces)
      : position_(position), psi_(psi_start_rad), sign_(sign), lag_s_(lag_s), pieces_(pieces) {}

  void append(double r_0, double r_end, double duration_s) {
    if (duration_s < 1e-9) {
      return;
    }
    const int count = std::max(1, static_cast<int>(std::ceil(duration_s / lag_s_)));
    const double step = duration_s / count;
    double turned = 0.0;
    for (int i = 0; i < count; ++i) {
      const double end = turnAt(r_0, r_end, step * (i + 1));
      pieces_.push_back(piece(r_0, r_end, step * i, turned, end, step));
      turned = end;
    }
    psi_ += sign_ * turned;
  }

 private:
  [[nodiscard]] double turnAt(double r_0, double r_end, double t) const {
    return r_end * t + (r_0 - r_end) * lag_s_ * (1.0 - std::exp(-t / lag_s_));
  }

  [[nodiscard]] trajectory::Piece piece(double r_0, double r_end, double t, double turn_0,
                                        double turn_1, double step) const {
    vessel::FlatPoint start;
    vessel::FlatPoint end;
    const auto set = [&](vessel::FlatPoint& z, double time, double turn) {
      const double decay = (r_0 - r_end) * std::exp(-time / lag_s_);
      z.position.x() = psi_ + sign_ * turn;
      z.velocity.x() = sign_ * (r_end + decay);
      z.acceleration.x() = -sign_ * decay / lag_s_;
      z.jerk.x() = sign_ * decay / (lag_s_ * lag_s_);
    };
    set(start, t, turn_0);
    set(end, t + step, turn_1);
    trajectory::Piece spin;
    spin.kind = trajectory::PieceKind::kSpin;
    spin.duration_s = step;
    spin.heading = trajectory::hermitePiece(start, end, step).position.row(0);
    spin.position.col(0) = position_;
    return spin;
  }

  Eigen::Vector2d position_;
  double psi_;
  double sign_;
  double lag_s_;
  std::vector<trajectory::Piece>& pieces_;
};

}  // namespace

double spinDuration(double turn_rad, const vessel::Parameters& vessel, const SpinLimits& limits) {
  const Phases p = phasesOf(turn_rad, vessel, limits);
  return p.up_s + p.steady_s + p.down_s;
}

void appendSpin(const Eigen::Vector2d& position, double psi_start_rad, double turn_rad,
                const vessel::Parameters& vessel, const SpinLimits& limits,
                std::vector<trajectory::Piece>& pieces) {
  const Phases p = phasesOf(turn_rad, vessel, limits);
  const double sign = turn_rad < 0.0 ? -1.0 : 1.0;
  PhaseWriter writer(position, psi_start_rad, sign, p.lag_s, pieces);
  writer.append(0.0, p.r_end, p.up_s);
  writer.append(p.r_top, p.r_top, p.steady_s);
  writer.append(p.r_top, -p.r_end, p.down_s);
}

}  // namespace otter_nav::optimizer
