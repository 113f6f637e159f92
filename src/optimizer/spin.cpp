#include "otter_nav/optimizer/spin.hpp"

#include <algorithm>
#include <array>
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

// What the turn has reached: heading, yaw rate, its derivative, and the heading's integral.
struct Reached {
  double integral = 0.0;
  double psi = 0.0;
  double r = 0.0;
  double r1 = 0.0;
};

// The time-optimal turn to the left as a function of time, phase by phase:
// r = r_end + (r_0 - r_end) exp(-t / lag). Before its start it is at rest at zero.
class OptimalTurn {
 public:
  explicit OptimalTurn(const Phases& p) : lag_s_(p.lag_s) {
    append(0.0, p.r_end, p.up_s);
    append(p.r_top, p.r_top, p.steady_s);
    append(p.r_top, -p.r_end, p.down_s);
    starts_[3] = {end_s_, reached_, 0.0};
  }

  // Starts of the phases, and the end.
  [[nodiscard]] double joint(std::size_t k) const { return starts_[k].time_s; }

  // At `t`, by the equations in force at `within` (of the same phase: both sides of a joint).
  [[nodiscard]] Reached at(double t, double within) const {
    if (within < 0.0) {
      return {};
    }
    std::size_t k = 3;
    while (k > 0 && starts_[k].time_s > within) {
      --k;
    }
    return after(starts_[k], t - starts_[k].time_s);
  }

 private:
  struct Start {
    double time_s = 0.0;
    Reached reached;
    double r_end = 0.0;
  };

  [[nodiscard]] Reached after(const Start& start, double t) const {
    const double excess = start.reached.r - start.r_end;
    const double decay = std::exp(-t / lag_s_);
    const double gone = lag_s_ * (1.0 - decay);
    Reached now;
    now.r = start.r_end + excess * decay;
    now.r1 = -excess * decay / lag_s_;
    now.psi = start.reached.psi + start.r_end * t + excess * gone;
    now.integral = start.reached.integral + start.reached.psi * t + 0.5 * start.r_end * t * t +
                   excess * lag_s_ * (t - gone);
    return now;
  }

  void append(double r_0, double r_end, double duration_s) {
    reached_.r = r_0;
    starts_[count_] = {end_s_, reached_, r_end};
    reached_ = after(starts_[count_], duration_s);
    reached_.r1 = 0.0;
    end_s_ += duration_s;
    ++count_;
    if (count_ == 3) {
      reached_.r = 0.0;
    }
  }

  double lag_s_;
  std::array<Start, 4> starts_;
  std::size_t count_ = 0;
  double end_s_ = 0.0;
  Reached reached_;
};

// The optimal turn's mean over the last `ramp` seconds: the same turn (the equation of motion is
// linear), with a moment that ramps where the optimal one jumps.
class SmoothTurn {
 public:
  SmoothTurn(const OptimalTurn& turn, double ramp_s) : turn_(turn), ramp_s_(ramp_s) {}

  // [psi, r, r', r''] at `t` on the side of `within`.
  [[nodiscard]] Eigen::Vector4d at(double t, double within) const {
    const Reached now = turn_.at(t, within);
    const Reached before = turn_.at(t - ramp_s_, within - ramp_s_);
    return Eigen::Vector4d(now.integral - before.integral, now.psi - before.psi, now.r - before.r,
                           now.r1 - before.r1) /
           ramp_s_;
  }

  // Where the equations change, in order, from start to end.
  [[nodiscard]] std::array<double, 8> joints() const {
    std::array<double, 8> times{};
    for (std::size_t k = 0; k < 4; ++k) {
      times[2 * k] = turn_.joint(k);
      times[2 * k + 1] = turn_.joint(k) + ramp_s_;
    }
    std::sort(times.begin(), times.end());
    return times;
  }

 private:
  const OptimalTurn& turn_;
  double ramp_s_;
};

vessel::FlatPoint headingPoint(const Eigen::Vector4d& turned, double psi_start_rad, double sign) {
  vessel::FlatPoint z;
  z.position.x() = psi_start_rad + sign * turned[0];
  z.velocity.x() = sign * turned[1];
  z.acceleration.x() = sign * turned[2];
  z.jerk.x() = sign * turned[3];
  return z;
}

}  // namespace

double spinDuration(double turn_rad, const vessel::Parameters& vessel, const SpinLimits& limits) {
  const Phases p = phasesOf(turn_rad, vessel, limits);
  return p.up_s + p.steady_s + p.down_s + limits.ramp_s;
}

void appendSpin(const Eigen::Vector2d& position, double psi_start_rad, double turn_rad,
                const vessel::Parameters& vessel, const SpinLimits& limits,
                std::vector<trajectory::Piece>& pieces) {
  constexpr double kShortestS = 1e-6;
  const Phases p = phasesOf(turn_rad, vessel, limits);
  const double sign = turn_rad < 0.0 ? -1.0 : 1.0;
  const OptimalTurn optimal(p);
  const SmoothTurn smooth(optimal, limits.ramp_s);
  const std::array<double, 8> joints = smooth.joints();
  for (std::size_t k = 0; k + 1 < joints.size(); ++k) {
    const double length_s = joints[k + 1] - joints[k];
    const int count = std::max(1, static_cast<int>(std::ceil(length_s / p.lag_s)));
    const double step = length_s / count;
    for (int i = 0; i < count && length_s > kShortestS; ++i) {
      const double from = joints[k] + step * i;
      const double within = from + 0.5 * step;
      trajectory::Piece spin;
      spin.kind = trajectory::PieceKind::kSpin;
      spin.duration_s = step;
      spin.position.col(0) = position;
      spin.heading = trajectory::hermitePiece(
                         headingPoint(smooth.at(from, within), psi_start_rad, sign),
                         headingPoint(smooth.at(from + step, within), psi_start_rad, sign), step)
                         .position.row(0);
      pieces.push_back(spin);
    }
  }
}

}  // namespace otter_nav::optimizer
