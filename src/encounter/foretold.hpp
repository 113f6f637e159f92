// Where other vessels will be in the next seconds, at even times, and how dangerous it is to be
// somewhere then.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "encounter/habits.hpp"
#include "otter_nav/traffic/track.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::encounter {

// The hull as two discs on its centre line that cover its rectangle, one ahead of its centre and
// one astern: fewer than feasibility::HullCover has, for they are looked at more often.
struct HullDiscs {
  double ahead_m;
  double radius_m;

  explicit HullDiscs(const vessel::Hull& hull)
      : ahead_m(0.25 * hull.length_m),
        radius_m(std::hypot(0.25 * hull.length_m, 0.5 * hull.beam_m)) {}
};

class Foretold {
 public:
  static constexpr double kStepS = 0.2;

  // From `from_s` on, on the tracks' clock, for `horizon_s`. Who can't come within reach of
  // `place` in that time, we at `own_mps`, is left out.
  Foretold(const std::vector<traffic::Track>& tracks, const Habits& habits, double from_s,
           double horizon_s, const Eigen::Vector2d& place, double own_mps, const vessel::Hull& own);

  [[nodiscard]] bool empty() const { return movers_.empty(); }
  [[nodiscard]] int steps() const { return steps_; }

  // Of our hull at step k from her likely outline: the least distance, m (negative: they overlap),
  // and the danger, from 0 to about 1 for each who is near: how probable contact is.
  struct Nearness {
    double gap_m = 1e3;
    double danger = 0.0;
  };
  // Those of `near` alone.
  [[nodiscard]] Nearness at(const Eigen::Vector2d& position, const Eigen::Vector2d& ahead, int k,
                            const std::vector<int>& near) const;
  // Who may be near a hull that is at `position` at step k, within `for_steps` more.
  void whoIsNear(const Eigen::Vector2d& position, int k, int for_steps, double own_mps,
                 std::vector<int>& near) const;
  [[nodiscard]] std::vector<int> all() const;

 private:
  struct Place {
    Eigen::Vector2d middle;
    Eigen::Vector2d ahead;
    double deviation_m = 0.0;
  };
  struct Mover {
    double half_length_m = 0.0;
    double half_beam_m = 0.0;
    double radius_m = 0.0;
    double reach_m = 0.0;
    double mps = 0.0;
    double may_turn = 0.0;
    double probable = 1.0;  // that she takes this way
    double hits_m2 = 0.0;   // places of her middle at which the outlines touch
    std::vector<Place> places;
  };

  int steps_ = 0;
  HullDiscs discs_;
  std::vector<Mover> movers_;
};

}  // namespace otter_nav::encounter
