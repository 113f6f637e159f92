#include "otter_nav/plant/other_vessels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/hull.hpp"
#include "rectangle.hpp"

namespace otter_nav::plant {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Slab by slab in the box's axes.
double rayToBox(const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
                const Rectangle& box) {
  const Eigen::Vector2d p = box.local(from - box.centre);
  const Eigen::Vector2d d = box.local(direction);
  double enters = 0.0;
  double leaves = kInfinity;
  for (int axis = 0; axis < 2; ++axis) {
    if (d[axis] == 0.0) {
      if (std::abs(p[axis]) > box.half[axis]) {
        return kInfinity;
      }
      continue;
    }
    const double a = (-box.half[axis] - p[axis]) / d[axis];
    const double b = (box.half[axis] - p[axis]) / d[axis];
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return enters <= leaves ? enters : kInfinity;
}

}  // namespace

void OtherVessels::set(std::vector<vessel::ScriptedVessel> vessels, double time_s) {
  scripts_ = std::move(vessels);
  now_.clear();
  for (const vessel::ScriptedVessel& script : scripts_) {
    now_.push_back({script.id, script.hull, {}});
  }
  advance(time_s);
}

void OtherVessels::advance(double time_s) {
  for (std::size_t k = 0; k < scripts_.size(); ++k) {
    now_[k].motion = vessel::motionAt(scripts_[k], time_s);
  }
}

double OtherVessels::castRay(const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
                             double range_m) const {
  double least = kInfinity;
  for (const OtherVessel& other : now_) {
    const Eigen::Vector2d off = other.motion.pose.position - from;
    const double radius = vessel::circumscribedRadius(other.hull);
    if (off.norm() - radius > range_m || std::abs(cross(direction, off)) > radius) {
      continue;
    }
    const Rectangle box(other.hull, other.motion.pose.position, other.motion.pose.psi_rad);
    least = std::min(least, rayToBox(from, direction, box));
  }
  return least <= range_m ? least : kInfinity;
}

std::optional<OtherVessels::Nearest> OtherVessels::nearest(const vessel::Hull& hull,
                                                           const Eigen::Vector2d& position,
                                                           double psi_rad) const {
  std::optional<Nearest> nearest;
  const Rectangle own(hull, position, psi_rad);
  for (std::size_t k = 0; k < now_.size(); ++k) {
    const OtherVessel& other = now_[k];
    const double circles = (other.motion.pose.position - position).norm() -
                           vessel::circumscribedRadius(hull) -
                           vessel::circumscribedRadius(other.hull);
    if (nearest && circles >= nearest->distance_m) {
      continue;
    }
    const double distance =
        own.distance(Rectangle(other.hull, other.motion.pose.position, other.motion.pose.psi_rad));
    if (!nearest || distance < nearest->distance_m) {
      nearest = Nearest{k, distance};
    }
  }
  return nearest;
}

double OtherVessels::distance(const vessel::Hull& a, const vessel::Pose& at, const vessel::Hull& b,
                              const vessel::Pose& there) {
  return Rectangle(a, at.position, at.psi_rad)
      .distance(Rectangle(b, there.position, there.psi_rad));
}

}  // namespace otter_nav::plant
