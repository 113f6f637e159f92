// The courses a decision chooses from, and the search for the cheapest.
#pragma once

#include <limits>
#include <vector>

#include "encounter/manoeuvre.hpp"
#include "encounter/prospect.hpp"
#include "otter_nav/map/distance_field.hpp"

namespace otter_nav::encounter {

// Hold on for `wait_s`; then turn off the way's direction, or only slow down along the way, for
// `hold_s`; then another leg, if any; then back to the way.
struct Intent {
  double wait_s = 0.0;
  double turn_rad = 0.0;  // to starboard
  double share = 1.0;     // of the cruising speed
  double hold_s = 0.0;
  double then_s = 0.0;
  double then_turn_rad = 0.0;  // off the way's direction, not off the first leg's

  [[nodiscard]] bool alongThePath() const { return turn_rad == 0.0; }
};

// What all courses of a decision have in common.
struct Water {
  const map::DistanceField& field;
  double clearance_m = 0.0;  // of the hull's centre from what lies still
  // What is being sailed, from the joint on: legs' times from now.
  Course sailed;
  // Points of it to come back to, the last is the goal.
  std::vector<Eigen::Vector2d> path;
  double cruise_mps = 0.0;
  double least_mps = 0.0;  // no course is slower, before it arrives
};

struct Choice {
  Intent intent;
  Course course;
  std::size_t tail = 0;                                    // the leg that leads back to the way
  double price = std::numeric_limits<double>::infinity();  // with the time it takes
};

class Chooser {
 public:
  Chooser(const Options& options, const vessel::Parameters& vessel)
      : vessel_(vessel), prospect_(options, vessel.hull), options_(options) {}

  void feel(double swing_mps) { prospect_.feel(swing_mps); }

  // The cheapest, from cheapest on, at most `count` that differ; of those that begin at once
  // unless one `may_wait`, and first to starboard unless one `may_turn_to_port`.
  [[nodiscard]] std::vector<Choice> choose(const Water& water, const std::vector<Other>& others,
                                           std::size_t count, bool may_wait,
                                           bool may_turn_to_port) const;
  // False where what lies still is in the way.
  [[nodiscard]] bool build(const Water& water, const Handling& handling, const Intent& intent,
                           Course& course, std::size_t& tail) const;
  // Risks and rules, and the time.
  [[nodiscard]] double price(const Course& course, const std::vector<Other>& others,
                             double give_up_above) const;
  // Before we may for somebody whom we stand on for.
  [[nodiscard]] bool actsEarly(const Course& course, const std::vector<Other>& others) const;

 private:
  vessel::Parameters vessel_;
  Prospect prospect_;
  Options options_;
};

}  // namespace otter_nav::encounter
