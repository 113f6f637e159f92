// A way among many who move and give way to nobody, where there is no time for plans to the goal:
// a search in space and time (src/encounter/space_time_search.hpp), decided again several times a
// second. Without threads and without a clock; the same inputs give the same way.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/traffic/track.hpp"
#include "otter_nav/trajectory/timed_trajectory.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/pose.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::encounter {

class Habits;

// How near others come, as far as their tracks tell.
struct Danger {
  double gap_m = 1e3;  // the least between the outlines; negative: contact
};

class Evasion {
 public:
  explicit Evasion(const vessel::Parameters& vessel);
  ~Evasion();
  Evasion(Evasion&&) noexcept;
  Evasion& operator=(Evasion&&) noexcept;

  // Whom there is, several times a second: where they go is remembered, for they may go so again.
  void observe(const std::vector<traffic::Track>& tracks);

  // Map frame, SI; times on the mission's clock.
  struct Task {
    double start_s = 0.0;      // when the way begins
    vessel::FlatPoint start;   // its motion there
    vessel::State state = {};  // the same with heading and yaw rate; body velocities
    vessel::Thrusts thrusts = vessel::Thrusts::Zero();
    vessel::Disturbance disturbance;
    double speed_max_mps = 0.0;
    std::vector<Eigen::Vector2d> way;  // to the goal, from near here on; may be empty
    vessel::Pose goal;
    // At rest within these of the goal's place and heading the mission is over; 0: it goes on.
    double arrival_m = 0.0;
    double arrival_rad = 0.0;
  };
  struct Way {
    trajectory::TimedTrajectory path;  // empty: there is none
    double price = 0.0;                // s
    Danger danger;
  };
  // `still`: what does not move; its outline is touched nowhere.
  [[nodiscard]] Way find(const Task& task, const std::vector<traffic::Track>& tracks,
                         const map::DistanceField& still) const;
  // What a trajectory is worth from the task's start on, with what is left to the goal at the
  // search's horizon: to be compared with find()'s. What ends before goes on as it ended.
  [[nodiscard]] Way judge(const Task& task, const trajectory::TimedTrajectory& path,
                          const std::vector<traffic::Track>& tracks,
                          const map::DistanceField& still) const;
  // Of a trajectory within `ahead_s` from `from_s` on; at rest after its end.
  [[nodiscard]] Danger danger(const trajectory::TimedTrajectory& path, double from_s,
                              double ahead_s, const std::vector<traffic::Track>& tracks) const;
  // Of a hull that lies still.
  [[nodiscard]] Danger danger(const vessel::Pose& lies, double from_s, double ahead_s,
                              const std::vector<traffic::Track>& tracks) const;

  // Of those who make way: the share of whom it is known how they will go on, as they have done so
  // before or go round.
  [[nodiscard]] double shareKnown(const std::vector<traffic::Track>& tracks) const;
  // Near `from` and clear of what lies still: where fewest come, by all that was seen of them.
  [[nodiscard]] Eigen::Vector2d quietPlace(const Eigen::Vector2d& from, double now_s,
                                           const std::vector<traffic::Track>& tracks,
                                           const map::DistanceField& still) const;

 private:
  vessel::Parameters vessel_;
  std::unique_ptr<Habits> habits_;
};

}  // namespace otter_nav::encounter
