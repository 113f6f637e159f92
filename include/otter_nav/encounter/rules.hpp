// The rules of the road (COLREGs 1972, rules 5 to 8 and 13 to 17, power-driven vessels) in figures:
// which one applies between us and another vessel, from positions and courses alone.
//
// Angles in radians. Bearings, aspects and turns are positive to starboard, unlike headings.
#pragma once

#include <Eigen/Core>
#include <string>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/config/fields.hpp"

namespace otter_nav::encounter {

constexpr double kDegree = kPi / 180.0;

// What we are to another vessel (rules 13 to 15, 17).
enum class Role {
  kNone,        // no risk of collision
  kHeadOn,      // both turn to starboard
  kOvertaking,  // we keep out of her way
  kOvertaken,   // she keeps out of ours
  kGiveWay,     // crossing, she bears to starboard
  kStandOn      // crossing, she bears to port
};
[[nodiscard]] const char* name(Role role);
// The rule that says so, for people to read.
[[nodiscard]] const char* rule(Role role);
// Whether it is we who have to act.
[[nodiscard]] inline bool givesWay(Role role) {
  return role == Role::kHeadOn || role == Role::kOvertaking || role == Role::kGiveWay;
}
[[nodiscard]] inline bool standsOn(Role role) {
  return role == Role::kOvertaken || role == Role::kStandOn;
}

// What a user can set (config/mission.yaml, mapping `encounter`).
struct Options {
  bool rules_of_the_road = true;
  double outline_wanted_m = 10.0;
  double outline_least_m = 6.0;
  double early_m = 90.0;
  double early_s = 60.0;
  double apparent_turn_rad = 0.5236;
  double stand_on_until_s = 30.0;
  double stand_on_until_m = 30.0;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("rules_of_the_road", o.rules_of_the_road, "COLREGs 13 to 17; without, distances alone");
    fields("outline_wanted_m", o.outline_wanted_m, {0.5, 1000.0},
           "between our outline and other vessels', where there is room");
    fields("outline_least_m", o.outline_least_m, {0.2, 1000.0},
           "likewise: nearer is a near miss, worth a long way round");
    fields("early_m", o.early_m, {1.0, 1e4},
           "rule 8 a: who gives way acts with this between centres left,");
    fields("early_s", o.early_s, {1.0, 600.0}, "or this long before the nearest approach");
    fields("apparent_turn_rad", o.apparent_turn_rad, {0.0, 1.57},
           "rule 8 b: a turn by this, or half the speed");
    fields("stand_on_until_s", o.stand_on_until_s, {1.0, 600.0},
           "rule 17: who stands on may act this long before the nearest approach,");
    fields("stand_on_until_m", o.stand_on_until_m, {1.0, 1e4}, "or with this between centres left");
  }
};

struct Motion {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // map frame, m
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // over ground, m/s
  [[nodiscard]] double course() const;
  [[nodiscard]] Motion after(double time_s) const {
    return {position + time_s * velocity, velocity};
  }
};

// The nearest approach of the centres if both keep course and speed.
struct Approach {
  double time_s = 0.0;  // from now; negative: they draw apart
  double distance_m = 0.0;
};
[[nodiscard]] Approach nearestApproach(const Motion& own, const Motion& other);

// Rule 7: the centres would pass within 15 m in less than 120 s.
constexpr double kRiskM = 15.0;
constexpr double kRiskS = 120.0;
[[nodiscard]] bool riskOfCollision(const Approach& approach);

// Of the other from our course, and of us from hers; in [-pi, pi], positive to starboard.
[[nodiscard]] double bearing(const Motion& own, const Motion& other);
[[nodiscard]] inline double aspect(const Motion& own, const Motion& other) {
  return bearing(other, own);
}

// The first that fits: overtaking (she sees us more than 22.5 deg abaft her beam, and we are
// faster), being overtaken, head-on (within 12 deg of both bows), crossing.
[[nodiscard]] Role classify(const Motion& own, const Motion& other);

// Between us and one track, as it is now.
struct Encounter {
  int id = 0;
  Role role = Role::kNone;
  double since_s = 0.0;  // when the risk of collision arose
  // Then, positive to starboard.
  double bearing_rad = 0.0;
  double aspect_rad = 0.0;
  // Now.
  double range_m = 0.0;
  Approach approach;
  bool acted = false;
};
// A sentence: to whom which rule applies, and why.
[[nodiscard]] std::string describe(const Encounter& encounter);

}  // namespace otter_nav::encounter
