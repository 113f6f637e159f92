// What becomes of a course of ours among other vessels that keep theirs: how near they come, and
// which rules it keeps. Courses are polylines in time; times are in s from now on.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "otter_nav/encounter/rules.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::encounter {

// An action (rule 8): a change of course by more than 5 deg, or of speed by more than 10 %.
constexpr double kActionRad = 0.0873;
constexpr double kActionShare = 0.1;
// Who gives way acts by so much sooner than the rules ask.
constexpr double kEarlyMoreM = 3.0;
constexpr double kEarlyMoreS = 4.0;

// A stretch of constant course and speed, up to the next leg or the course's end.
struct Leg {
  double from_s = 0.0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  // What the change to it takes, of which the leg's beginning is the middle.
  double change_s = 0.0;
};
struct Course {
  std::vector<Leg> legs;
  double end_s = 0.0;
  // From then on it comes to rest at the goal: slowing down there is no action, and brings no risk
  // that the mission could still decide about.
  double arrives_s = std::numeric_limits<double>::infinity();
  // What coming to rest takes longer than going on to there: it would have to be done on any
  // course.
  double rests_s = 0.0;

  [[nodiscard]] double endOf(std::size_t leg) const {
    return leg + 1 < legs.size() ? legs[leg + 1].from_s : end_s;
  }
};

// What has been between us and another vessel since the risk of collision arose.
struct Record {
  Role role = Role::kNone;
  double since_s = 0.0;  // when the risk arose: negative, before now
  // Ours when it arose: what an action is measured against.
  Eigen::Vector2d kept_velocity = Eigen::Vector2d::Zero();
  double bearing_rad = 0.0;  // of her then
  bool doubtful = false;     // by what is known now there was none
  bool acted = false;
  int first_turn = 0;          // 1: to starboard, -1: to port, 0: none yet
  bool slowed_first = false;   // before any turn
  double turn_max_rad = 0.0;   // the largest so far, either side
  double slowest_share = 1.0;  // of the speed kept
};

struct Other {
  int id = 0;
  Motion motion;  // now
  double length_m = 0.0;
  double beam_m = 0.0;
  double heading_rad = 0.0;
  double position_deviation_m = 0.0;  // standard deviations, now
  double velocity_deviation_mps = 0.0;
  double known_s = 0.0;  // how long she is believed to keep course and speed
  // Her way up to known_s, where she goes round: what distances are taken from. Else empty.
  std::vector<Leg> round;
  Record record;
};

// A course is priced among no more of them.
constexpr std::size_t kMostOthers = 32;

// Rules that a course breaks, bits.
enum Broken : unsigned {
  kLate = 1U,         // 8 a, 16
  kNotApparent = 2U,  // 8 b
  kIntoHerLane = 4U,  // 13, 15
  kWrongTurn = 8U,    // 14, 15
  kWrongSide = 16U,   // 14: not port to port
  kActedEarly = 32U,  // 17 a
  kToPort = 64U       // 17 c
};

struct Outlook {
  Role role = Role::kNone;
  double outlines_m = 0.0;  // the least between the outlines
  double nearest_s = 0.0;   // when the centres are nearest
  unsigned broken = 0;
  double lane_s = 0.0;  // when her lane is entered first, if it is
  // While it is we who give way to her.
  double from_s = 0.0;
  double to_s = 0.0;
  double acted_s = -1.0;  // our first action on this course; negative: none
};

class Prospect {
 public:
  Prospect(const Options& options, const vessel::Hull& hull) : options_(options), hull_(hull) {}

  // How fast waves move the hull to the side, m/s.
  void feel(double swing_mps) { swing_mps_ = swing_mps; }
  // So slow that waves swing the course by what counts as an action.
  [[nodiscard]] bool swingsAt(double speed_mps) const {
    return swing_mps_ > std::tan(kActionRad) * speed_mps;
  }
  [[nodiscard]] Outlook look(const Course& own, const Other& other) const;
  // The price of a course, in seconds that it would be worth sailing longer to avoid it.
  // Of at most kMostOthers.
  [[nodiscard]] double price(const Course& own, const std::vector<Other>& others,
                             double give_up_above) const;

 private:
  Options options_;
  vessel::Hull hull_;
  double swing_mps_ = 0.0;
};

}  // namespace otter_nav::encounter
