// A turn of m2 r' = tau - d3 r under moments that are constant for a while each, averaged over a
// short ramp so that the moment is continuous. Everything in closed form.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace otter_nav::optimizer {

class TurnProfile {
 public:
  // `lag_s` = m2 / d3.
  TurnProfile(double lag_s, double ramp_s) : lag_s_(lag_s), ramp_s_(ramp_s) {}

  // For `duration_s` the yaw rate goes from `r_from` (what the phase before ended with) towards
  // `r_target`, the moment over d3.
  void append(double r_from, double r_target, double duration_s);
  // What comes after: rest, or the yaw rate dies away from `r_from` without a moment.
  void finish(double r_from);

  // [psi, r, r', r''] at `t_s` by the equations in force at `within_s`, a time in the same phase:
  // both sides of a joint. At rest at zero before the start.
  [[nodiscard]] Eigen::Vector4d at(double t_s, double within_s) const;
  // Where the equations change, in order; the first is 0, the last end().
  [[nodiscard]] std::vector<double> joints() const;
  [[nodiscard]] double end() const { return end_s_ + ramp_s_; }

 private:
  // What the turn that is not averaged has reached, with the heading's integral.
  struct Reached {
    double integral = 0.0;
    double psi = 0.0;
    double r = 0.0;
    double r1 = 0.0;
  };
  struct Phase {
    double start_s = 0.0;
    Reached reached;
    double r_target = 0.0;
  };
  [[nodiscard]] Reached after(const Phase& phase, double t_s) const;
  [[nodiscard]] Reached reachedAt(double t_s, double within_s) const;

  double lag_s_;
  double ramp_s_;
  std::vector<Phase> phases_;
  Reached reached_;
  double end_s_ = 0.0;
};

// A time-optimal turn by `turn_rad` > 0 from rest to rest: full moment up to the yaw rate's limit,
// steady, full moment back. `r_full` is the full moment over d3.
[[nodiscard]] TurnProfile turnToRest(double turn_rad, double r_full, double r_max, double lag_s,
                                     double ramp_s);
// A turn by `turn_rad` > 0 whose last `left(r)` is made while the yaw rate dies away: full moment,
// steady at the limit, none. Gives the time at which the moment ends.
struct LooseTurn {
  TurnProfile profile;
  double moment_ends_s;
};
[[nodiscard]] LooseTurn turnLoose(double turn_rad, double r_full, double r_max, double lag_s,
                                  double ramp_s, double brake_radps2);

}  // namespace otter_nav::optimizer
