#include "otter_nav/encounter/rules.hpp"

#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/text.hpp"

namespace otter_nav::encounter {
namespace {

constexpr double kAbaftTheBeam = 112.5 * kDegree;
constexpr double kHeadOn = 12.0 * kDegree;

}  // namespace

const char* name(Role role) {
  constexpr const char* kNames[] = {
      "clear", "head-on", "overtaking", "overtaken", "crossing, give way", "crossing, stand on"};
  return kNames[static_cast<std::size_t>(role)];
}

const char* rule(Role role) {
  constexpr const char* kRules[] = {"", "14", "13", "13, 17", "15, 16", "15, 17"};
  return kRules[static_cast<std::size_t>(role)];
}

double Motion::course() const {
  return angleOf(velocity);
}

Approach nearestApproach(const Motion& own, const Motion& other) {
  const Eigen::Vector2d offset = other.position - own.position;
  const Eigen::Vector2d closing = other.velocity - own.velocity;
  const double speed2 = closing.squaredNorm();
  const double time = speed2 > 1e-9 ? -offset.dot(closing) / speed2 : 0.0;
  return {time, (offset + time * closing).norm()};
}

bool riskOfCollision(const Approach& approach) {
  return approach.time_s > 0.0 && approach.time_s < kRiskS && approach.distance_m < kRiskM;
}

double bearing(const Motion& own, const Motion& other) {
  const Eigen::Vector2d to = other.position - own.position;
  return wrapAngle(own.course() - angleOf(to));
}

Role classify(const Motion& own, const Motion& other) {
  const double she_bears = std::abs(bearing(own, other));
  const double we_bear = std::abs(aspect(own, other));
  const double own_speed = own.velocity.norm();
  const double her_speed = other.velocity.norm();
  if (we_bear > kAbaftTheBeam && own_speed > her_speed) {
    return Role::kOvertaking;
  }
  if (she_bears > kAbaftTheBeam && her_speed > own_speed) {
    return Role::kOvertaken;
  }
  if (she_bears <= kHeadOn && we_bear <= kHeadOn) {
    return Role::kHeadOn;
  }
  return bearing(own, other) >= 0.0 ? Role::kGiveWay : Role::kStandOn;
}

std::string describe(const Encounter& e) {
  return text(
      "vessel %d: %s (rule %s), since %.0f s, when she bore %.0f deg and saw us at %.0f "
      "deg; %.0f m off, nearest %.0f m in %.0f s%s",
      e.id, name(e.role), rule(e.role), e.since_s, e.bearing_rad / kDegree, e.aspect_rad / kDegree,
      e.range_m, e.approach.distance_m, e.approach.time_s, e.acted ? ", acted" : "");
}

}  // namespace otter_nav::encounter
