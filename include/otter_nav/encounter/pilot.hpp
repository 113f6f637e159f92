// What to do about other vessels: which rule of the road applies to each, and which way of ours
// keeps clear of all of them and keeps the rules at the least loss of time. Without threads and
// without a clock; the same inputs give the same decisions (docs/traffic.md).
//
// Each decision looks at a few thousand courses (hold on for a while; turn to either side by so
// much, or slow down, for so long; then back to the way) against all tracks carried on straight.
// What is cheapest becomes a trajectory of its own, verified like a plan, from a point of the
// sailed trajectory just ahead; the planner leads on from its end.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "otter_nav/encounter/rules.hpp"
#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/traffic/track.hpp"
#include "otter_nav/trajectory/timed_trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::encounter {

struct Manoeuvre {
  // Begins on the sailed trajectory.
  trajectory::TimedTrajectory path;
  bool to_the_goal = false;  // otherwise a plan has to lead on from its end
  // In which that has to be at the goal, from the decision on: with more the way being sailed is
  // better as it is.
  double worth_s = 0.0;
};

// What a decision is made on.
struct Outset {
  double now_s = 0.0;
  const trajectory::TimedTrajectory& sailed;
  Eigen::Vector2d goal = Eigen::Vector2d::Zero();
  double joint_s = 0.0;  // the earliest start of something new, on the clock of `now_s`
  const feasibility::SafetyLimits& limits;
  const feasibility::Obstacles& obstacles;  // on the clock of `now_s`
  // Slower than this nothing new can begin: she would be bound to what she does until it ends.
  double begins_mps = 0.0;
};

class Pilot {
 public:
  Pilot(const Options& options, const vessel::Parameters& vessel);
  ~Pilot();
  Pilot(Pilot&&) noexcept;
  Pilot& operator=(Pilot&&) noexcept;

  // Reports of others come in, by now; without being told, from the first way on.
  void listen(double now_s);
  // A new way: its first seconds count as getting under way.
  void newGoal(double now_s);
  // Positions and courses as they are now; several times a second. What we do is told from where
  // the hull is steered to be, `steered`: waves swing it about that.
  void observe(double now_s, const Motion& own, const Eigen::Vector2d& steered,
               const std::vector<traffic::Track>& tracks, const Eigen::Vector2d& goal,
               double cruise_mps);
  // Something better than what is being sailed, if there is.
  [[nodiscard]] std::optional<Manoeuvre> decide(const Outset& outset);
  // Those with risk of collision.
  [[nodiscard]] std::vector<Encounter> encounters() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace otter_nav::encounter
