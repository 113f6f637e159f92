#include "other_vessels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::plant {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A rectangle with its axes at hand.
struct Box {
  Eigen::Vector2d centre;
  Eigen::Vector2d ahead;
  Eigen::Vector2d half;
  std::array<Eigen::Vector2d, 4> corners;

  Box(const vessel::Hull& hull, const Eigen::Vector2d& position, double psi_rad)
      : centre(position),
        ahead(std::cos(psi_rad), std::sin(psi_rad)),
        half(0.5 * hull.length_m, 0.5 * hull.beam_m),
        corners(vessel::outline(hull, position, psi_rad)) {}

  [[nodiscard]] Eigen::Vector2d local(const Eigen::Vector2d& v) const {
    return {ahead.dot(v), cross(ahead, v)};
  }
};

// Whether one of `a`'s axes separates it from `b`.
bool separates(const Box& a, const Box& b) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(kInfinity);
  Eigen::Vector2d high = -low;
  for (const Eigen::Vector2d& corner : b.corners) {
    const Eigen::Vector2d p = a.local(corner - a.centre);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (low.array() > a.half.array()).any() || (high.array() < -a.half.array()).any();
}

double cornersToBox(const Box& corners_of, const Box& box) {
  double least = kInfinity;
  for (const Eigen::Vector2d& corner : corners_of.corners) {
    const Eigen::Vector2d p = box.local(corner - box.centre);
    least = std::min(least, (p.cwiseAbs() - box.half).cwiseMax(0.0).norm());
  }
  return least;
}

// Convex shapes apart are nearest at a corner of one of them; rectangles that overlap have no
// separating axis among their sides' normals.
double distanceBetween(const Box& a, const Box& b) {
  if (!separates(a, b) && !separates(b, a)) {
    return 0.0;
  }
  return std::min(cornersToBox(a, b), cornersToBox(b, a));
}

// Slab by slab in the box's axes.
double rayToBox(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, const Box& box) {
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
    const Box box(other.hull, other.motion.pose.position, other.motion.pose.psi_rad);
    least = std::min(least, rayToBox(from, direction, box));
  }
  return least <= range_m ? least : kInfinity;
}

std::optional<OtherVessels::Nearest> OtherVessels::nearest(const vessel::Hull& hull,
                                                           const Eigen::Vector2d& position,
                                                           double psi_rad) const {
  std::optional<Nearest> nearest;
  const Box own(hull, position, psi_rad);
  for (std::size_t k = 0; k < now_.size(); ++k) {
    const OtherVessel& other = now_[k];
    const double circles = (other.motion.pose.position - position).norm() -
                           vessel::circumscribedRadius(hull) -
                           vessel::circumscribedRadius(other.hull);
    if (nearest && circles >= nearest->distance_m) {
      continue;
    }
    const double distance = distanceBetween(
        own, Box(other.hull, other.motion.pose.position, other.motion.pose.psi_rad));
    if (!nearest || distance < nearest->distance_m) {
      nearest = Nearest{k, distance};
    }
  }
  return nearest;
}

}  // namespace otter_nav::plant
