// Other vessels, as a mission has to do with them: part of what plans keep clear of, whom the rules
// of the road apply to, and where too many give way to nobody, those whom it evades
// (docs/traffic.md).
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "moment.hpp"
#include "otter_nav/encounter/evasion.hpp"
#include "otter_nav/encounter/lying_off.hpp"
#include "otter_nav/encounter/near_future.hpp"
#include "otter_nav/encounter/pilot.hpp"
#include "otter_nav/encounter/surprise.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/pose.hpp"
#include "safety.hpp"
#include "sailed.hpp"

namespace otter_nav::mission {

// What it is made of outlives it.
class Others {
 public:
  Others(const SupervisorOptions& options, const Safety& safety, const vessel::Parameters& vessel)
      : options_(options),
        safety_(safety),
        vessel_(vessel),
        pilot_(options.encounter, vessel),
        evasion_(vessel) {}

  void newGoal(double now_s);
  // What a decision is made on, with them among the obstacles, until the next call.
  Moment see(double now_s, const Situation& situation, const feasibility::Obstacles& obstacles);
  // Where they go, by the last call; nothing without any.
  [[nodiscard]] const std::optional<encounter::NearFuture>& future() const { return near_; }
  [[nodiscard]] bool areSome() const { return near_ && !near_->empty(); }

  // At each decision: where they go is remembered.
  void observe(const Moment& m) { evasion_.observe(m.situation.tracks); }
  // Likewise, where it is known where the vessel is: who meets it, and by which rule of the road.
  void lookOut(const Moment& m, const Sailed& sailed, const Eigen::Vector2d& goal);
  [[nodiscard]] std::vector<encounter::Encounter> encounters() const { return pilot_.encounters(); }
  // They ask for another way than the one being sailed, which something new can leave at `joint_s`,
  // `begins_mps` fast at least.
  [[nodiscard]] std::optional<encounter::Manoeuvre> makeWay(const Moment& m, const Sailed& sailed,
                                                            const Eigen::Vector2d& goal,
                                                            double joint_s, double begins_mps);
  // One passes near within the next seconds.
  [[nodiscard]] bool passNear(const Moment& m) const;

  // Many near, or one about to come too near: no time for plans to the goal.
  [[nodiscard]] bool crowd(const Moment& m, const Sailed& sailed) const;
  // Few near, and none in the way.
  [[nodiscard]] bool areFew(const Moment& m, const Sailed& sailed) const;
  // For so long, while it evades, that no plan from a moving vessel is to be hoped for. To be asked
  // at each decision.
  [[nodiscard]] bool areFewInVain(const Moment& m, const Sailed& sailed);
  // There was no way among them a moment ago.
  [[nodiscard]] bool leftNoWay(double now_s) const { return now_s - no_way_s_ < kAgainS; }

  // A way of seconds among them.
  struct Evading {
    encounter::Evasion::Way way;  // its path is empty where there is none
    bool from_sailed = false;     // begins on what is sailed, or where the hull is
    double speed_max_mps = 0.0;
  };
  // To be sailed now; nothing where it was decided just now, or what is sailed already so
  // (`evades`) is worth as much, or nearly: a plan that was asked for would be lost.
  [[nodiscard]] std::optional<Evading> evade(const Moment& m, const Sailed& sailed,
                                             const vessel::Pose& goal, bool evades,
                                             bool plan_is_due);
  // It begins to evade.
  void beginEvading(double now_s) { crowded_s_ = now_s; }
  // A plan that leads to the goal: when it evades it keeps to that way.
  void rememberTheWay(const trajectory::Trajectory& plan);

 private:
  static constexpr double kAgainS = 0.25;  // from one decision about them to the next

  // Those who make way.
  [[nodiscard]] static std::vector<traffic::Track> movers(const Moment& m);
  [[nodiscard]] static int moversWithin(const Moment& m, double range_m);
  // A little ahead on what is sailed, or where the hull is if it is off that or lies still.
  [[nodiscard]] encounter::Evasion::Task task(const Moment& m, const Sailed& sailed,
                                              const vessel::Pose& goal) const;

  const SupervisorOptions& options_;
  const Safety& safety_;
  const vessel::Parameters& vessel_;
  std::optional<encounter::NearFuture> near_;
  std::optional<feasibility::Obstacles> seen_;  // they, and what lies still
  encounter::Pilot pilot_;
  encounter::Evasion evasion_;
  encounter::LyingOff lying_off_;
  encounter::Surprise surprise_;
  double evaded_s_ = -std::numeric_limits<double>::infinity();  // when that was decided last
  double no_way_s_ = -std::numeric_limits<double>::infinity();  // and nothing was found
  double crowded_s_ = 0.0;                                      // when they were many or near last
  std::vector<Eigen::Vector2d> way_;                            // to the goal
};

}  // namespace otter_nav::mission
