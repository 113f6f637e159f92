#include "tracker/ocp/hull_room.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::tracker {

HullRoom::HullRoom(double length_m, double beam_m) : half_(0.5 * length_m, 0.5 * beam_m) {}

Gap HullRoom::gapTo(const Eigen::Vector2d& point, const vessel::State& state) const {
  return gapAt(point - state.head<2>(), unitVector(state[vessel::kPsi]));
}

Gap HullRoom::gapAt(const Eigen::Vector2d& off, const Eigen::Vector2d& ahead) const {
  const Eigen::Vector2d port = across(ahead);
  const Eigen::Vector2d body(off.dot(ahead), off.dot(port));
  const Eigen::Vector2d beyond = body.cwiseAbs() - half_;
  Gap gap;
  Eigen::Vector2d outward = Eigen::Vector2d::Zero();  // in the body's frame
  if (beyond.maxCoeff() > 0.0) {
    outward = beyond.cwiseMax(0.0);
    gap.distance_m = outward.norm();
    outward /= gap.distance_m;
  } else {
    Eigen::Index side = 0;
    gap.distance_m = beyond.maxCoeff(&side);
    outward[side] = 1.0;
  }
  outward.x() = std::copysign(outward.x(), body.x());
  outward.y() = std::copysign(outward.y(), body.y());
  // Turning to port moves what lies ahead to starboard, and what lies to port ahead.
  gap.slope << -(outward.x() * ahead + outward.y() * port),
      outward.x() * body.y() - outward.y() * body.x();
  return gap;
}

Lacks HullRoom::lacks(const NearObstacles& near, const vessel::State& state,
                      const vessel::State& reference, double room_m) const {
  const double reach_m = half_.norm() + room_m;
  const Eigen::Vector2d ahead = unitVector(state[vessel::kPsi]);
  const Eigen::Vector2d meant_ahead = unitVector(reference[vessel::kPsi]);
  Lacks lacks;
  for (const Eigen::Vector2d& point : near.points) {
    const Eigen::Vector2d off = point - state.head<2>();
    if (off.squaredNorm() >= reach_m * reach_m) {
      continue;
    }
    const Gap gap = gapAt(off, ahead);
    if (gap.distance_m >= room_m) {
      continue;
    }
    const double meant_m = gapAt(point - reference.head<2>(), meant_ahead).distance_m;
    const double missing_m = std::min(meant_m, room_m) - gap.distance_m;
    Lack& most = lacks[(off.dot(ahead) > 0.0 ? 2 : 0) + (cross(ahead, off) > 0.0 ? 1 : 0)];
    if (meant_m >= 0.0 && missing_m > most.missing_m) {
      most = {missing_m, gap.slope};
    }
  }
  return lacks;
}

}  // namespace otter_nav::tracker
