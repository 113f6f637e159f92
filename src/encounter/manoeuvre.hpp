// From what was decided to a trajectory the hull can follow: turns and changes of speed without a
// jump up to the third derivative, or the sailed way taken more slowly.
#pragma once

#include <vector>

#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::encounter {

// How long a turn and a change of speed take that leave the thrusters some room.
class Handling {
 public:
  Handling(const vessel::Parameters& vessel, double cruise_mps);
  // Between two velocities, s.
  [[nodiscard]] double changeDuration(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

 private:
  double turn_rate_radps_;
  double turn_least_s_;
};

// A change to `velocity`, half done at `at_s`.
struct Change {
  double at_s = 0.0;
  double duration_s = 0.0;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
};

// From `start` (moving; its acceleration dies out in the first seconds) through the changes in
// order up to `end_s`.
[[nodiscard]] trajectory::Trajectory steer(const vessel::FlatPoint& start,
                                           const std::vector<Change>& changes, double end_s);

// `sailed` from `at_s` on, its time running at `share` for about `hold_s`, then as before. Nothing
// where that falls below `least_mps` for long, or lasts beyond the end.
[[nodiscard]] trajectory::Trajectory slowDown(const trajectory::Trajectory& sailed, double at_s,
                                              double share, double hold_s, double change_s,
                                              double least_mps);
constexpr double kBelowMostS = 2.0;  // longer than that is long
// Whether a velocity falls below `least_mps` at `share` of it, and not by itself.
[[nodiscard]] inline bool fallsBelow(const Eigen::Vector2d& velocity, double share,
                                     double least_mps) {
  return share * velocity.norm() < least_mps && velocity.norm() >= least_mps;
}

}  // namespace otter_nav::encounter
