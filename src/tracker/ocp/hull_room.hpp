// The room beside the hull's outline: what the plan of the next seconds pays for.
#pragma once

#include <Eigen/Core>
#include <array>

#include "otter_nav/tracker/near_obstacles.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::tracker {

// From the outline to a point, m, negative within it, and how that grows with x, y and psi.
struct Gap {
  double distance_m = 0.0;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
};

// By how much a gap is narrower than it is meant to be, and the gap's slope.
struct Lack {
  double missing_m = 0.0;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
};
// By quarter: starboard quarter, port quarter, starboard bow, port bow. The one at the bow and the
// one at the stern together say which way to turn beside a wall.
using Lacks = std::array<Lack, 4>;

// Of a rectangle centred on the state's position.
class HullRoom {
 public:
  HullRoom(double length_m, double beam_m);

  [[nodiscard]] Gap gapTo(const Eigen::Vector2d& point, const vessel::State& state) const;
  // The most that is missing to what the hull at `reference` has, as far as `room_m` counts. Points
  // that lie within that hull count for nothing.
  [[nodiscard]] Lacks lacks(const NearObstacles& near, const vessel::State& state,
                            const vessel::State& reference, double room_m) const;

 private:
  // To a point `off` from the centre of a hull that lies along `ahead`.
  [[nodiscard]] Gap gapAt(const Eigen::Vector2d& off, const Eigen::Vector2d& ahead) const;

  Eigen::Vector2d half_;  // length and beam
};

}  // namespace otter_nav::tracker
