// Decides what a mission does next: plan, sail, replan, stop, or say why it can't. A deterministic
// state machine without threads and without a clock: time, odometry, map and results are passed
// in, and what has to be done comes back as Orders. The planner node and the closed loop without
// ROS run the same one (docs/mission.md has the picture of its states).
//
// Rules: a plan is kept while the way ahead stays clear. When something comes up in the way, a new
// plan is asked for that starts on the sailed trajectory a little ahead of the vessel. If none
// comes before the vessel must brake, it stops in a controlled way and plans again from rest. Every
// retry is counted, and the last reason is told.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/mission/margins.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::mission {

enum class Phase {
  kIdle,        // no goal
  kPlanning,    // at rest, waiting for the first plan
  kSailing,     // on a plan that is clear as far as is known
  kReplanning,  // on a plan that is not clear any more, waiting for a better one
  kStopping,    // braking
  kStopped,     // at rest on the way, waiting for a plan
  kBackingOff,  // from where there is no room to turn
  kArrived,     // within the tolerances of the goal and slow
  kFailed       // given up; reason() says why, and the vessel lies still or is braking
};
[[nodiscard]] const char* name(Phase phase);

struct Goal {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // map frame, m
  double psi_rad = 0.0;
};

struct SupervisorOptions {
  MarginOptions margins;
  // A sailed plan is replaced when its clearance shrinks by more than this, m: sensed outlines
  // wander by about a cell.
  double clearance_slack_m = 0.3;
  // The vessel brakes for less than this on the way, m. Below the narrowest plan's clearance, for
  // the same reason: to stop in a gap that is a cell narrower than it seemed is worse than to go
  // through.
  double critical_clearance_m = 0.65;
  // From a planning request to the start of its trajectory when the vessel moves, s.
  double planning_latency_s = 0.3;
  // Time without an answer after which a plan counts as failed, s.
  double planning_timeout_s = 5.0;
  // Pause between rounds of attempts from rest, s: the map may still change.
  double retry_pause_s = 0.5;
  // Rounds of attempts from rest (each tries all clearances), and stops on the way, before the
  // mission gives up.
  int rounds_from_rest = 3;
  int stops_max = 8;
  // The vessel brakes when waiting this much longer would leave no room to do so, s; and never
  // for anything further ahead than `brake_horizon_s`.
  double stop_reserve_s = 0.3;
  double brake_horizon_s = 8.0;
  double brake_thrust_share = 0.9;  // of the limits, astern
  // Tracking error from which the plan starts at the vessel itself again, m.
  double tracking_error_max_m = 1.2;
  // Odometry older than this is no ground for sailing on, s.
  double odometry_timeout_s = 1.0;
  // Arrived within these of the goal.
  double arrival_distance_m = 0.9;
  double arrival_heading_rad = 0.15;
  double arrival_speed_mps = 0.25;
  // The time given to settle at the end of a trajectory, s.
  double settle_s = 10.0;
  // Period of plans asked for only to be faster, s; 0 for none. One is taken if it saves
  // `improve_share` of the time left.
  double improve_period_s = 0.0;
  double improve_share = 0.05;
};

// config/mission.yaml: mapping `supervisor`.
[[nodiscard]] Result<SupervisorOptions> readSupervisorOptions(config::Section section);
[[nodiscard]] Result<SupervisorOptions> loadSupervisorOptions(const std::string& path);

// What is known of the vessel at a decision.
struct Situation {
  vessel::State state = vessel::State::Zero();  // latest odometry, map frame
  double odometry_stamp_s = 0.0;
  double tracking_error_m = 0.0;  // as the tracker reports it
  double disturbance_n = 0.0;     // magnitude of the force that wind and current exert, estimated
  bool tracker_fault = false;     // the tracker can't follow and brakes by itself
  std::string tracker_reason;
};

struct PlanRequest {
  int id = 0;
  vessel::FlatPoint start;
  double start_psi_rad = 0.0;
  Goal goal;
  bool moving = false;        // false: from rest, whenever the answer comes
  double start_time_s = 0.0;  // moving: when the vessel passes `start`
  double clearance_m = 0.0;
  double thrust_share = 1.0;  // of the vessel's limits, for the plan
  std::uint64_t seed = 0;
  // What is left of the sailed trajectory from `start` on; empty if there is none.
  trajectory::Trajectory warm_start;
};

struct PlanReply {
  int id = 0;  // of the request
  bool solved = false;
  std::string reason;  // if not solved
  trajectory::Trajectory trajectory;
};

// For the tracker: sail `trajectory` as if begun at `start_time_s`.
struct SailOrder {
  trajectory::Trajectory trajectory;
  double start_time_s = 0.0;
};

struct Orders {
  std::optional<PlanRequest> plan;  // replaces a request still under way
  std::optional<SailOrder> sail;
  bool stop = false;  // the tracker shall brake by itself: there is no trajectory to do so on
};

class Supervisor {
 public:
  Supervisor(SupervisorOptions options, vessel::Parameters vessel, std::uint64_t seed);

  // Takes a goal and asks for a plan, or refuses it with the reason: not finite, outside the map,
  // too near something occupied. A refused goal leaves the mission under way untouched; an
  // accepted one replaces it, in motion if need be.
  [[nodiscard]] Result<Orders> setGoal(double now_s, const Goal& goal, const Situation& situation,
                                       const map::DistanceField& field);
  // Gives the mission up: brakes if moving, and is idle then.
  [[nodiscard]] Orders cancel(double now_s, const Situation& situation,
                              const map::DistanceField& field);
  // To be called regularly (10 Hz or more) and after each change of the map.
  [[nodiscard]] Orders update(double now_s, const Situation& situation,
                              const map::DistanceField& field);
  // Replies to requests that were replaced are ignored.
  [[nodiscard]] Orders planFinished(double now_s, const PlanReply& reply,
                                    const Situation& situation, const map::DistanceField& field);

  [[nodiscard]] Phase phase() const { return phase_; }
  // Why the phase is what it is; empty if there is nothing to explain.
  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] const Goal& goal() const { return goal_; }
  // The trajectory being sailed and when it began; empty before the first plan.
  [[nodiscard]] const SailOrder& sailed() const { return sailed_; }
  // Plans taken while under way, after the first.
  [[nodiscard]] int replans() const { return replans_; }
  [[nodiscard]] int stops() const { return stops_; }

 private:
  // Where a plan starts from.
  enum class From { kRest, kSailed, kVessel };
  struct Pending {
    PlanRequest request;
    From from = From::kRest;
    double since_s = 0.0;
    bool improves = false;
  };

  [[nodiscard]] Orders requestFromRest(double now_s, const Situation& situation,
                                       const map::DistanceField& field);
  [[nodiscard]] Orders requestFromSailed(double now_s, const map::DistanceField& field);
  [[nodiscard]] Orders requestFromVessel(double now_s, const Situation& situation,
                                         const map::DistanceField& field);
  [[nodiscard]] Orders post(double now_s, PlanRequest request, From from,
                            const map::DistanceField& field);
  [[nodiscard]] double chooseClearance(const PlanRequest& request, const map::DistanceField& field);
  [[nodiscard]] double freeThrustShare() const;

  [[nodiscard]] Orders watchTheWay(double now_s, const Situation& situation,
                                   const map::DistanceField& field);
  [[nodiscard]] Orders watchBackingOff(double now_s, const Situation& situation,
                                       const map::DistanceField& field);
  [[nodiscard]] Orders watchTheStop(double now_s, const Situation& situation);
  [[nodiscard]] Orders waitForPlan(double now_s, const Situation& situation,
                                   const map::DistanceField& field);
  [[nodiscard]] Orders replanIfNeeded(double now_s, const Situation& situation,
                                      const map::DistanceField& field);
  [[nodiscard]] std::string faultOf(double now_s, const Situation& situation) const;
  [[nodiscard]] bool mustBrake(double now_s, const map::DistanceField& field) const;
  [[nodiscard]] Orders brake(double now_s, const map::DistanceField& field, std::string reason);
  [[nodiscard]] Orders stopByItself(double now_s, std::string reason);
  [[nodiscard]] Orders settle(double now_s, const Situation& situation);
  [[nodiscard]] bool arrived(const Situation& situation) const;

  [[nodiscard]] Orders takeFromRest(double now_s, const PlanReply& reply, const Pending& asked,
                                    const Situation& situation, const map::DistanceField& field);
  [[nodiscard]] Orders takeMoving(double now_s, const PlanReply& reply, const Pending& asked,
                                  const map::DistanceField& field);
  [[nodiscard]] Orders planFailed(double now_s, const std::string& why, const Pending& asked,
                                  const Situation& situation, const map::DistanceField& field);
  [[nodiscard]] Orders tryBackingOff(double now_s, const std::string& why,
                                     const Situation& situation, const map::DistanceField& field);
  [[nodiscard]] double timeLeft(double now_s) const;
  void sail(SailOrder order, const PlanRequest& request, double now_s);
  void enter(Phase phase, std::string reason = {});

  SupervisorOptions options_;
  vessel::Parameters vessel_;
  std::uint64_t seed_;

  Phase phase_ = Phase::kIdle;
  std::string reason_;
  Goal goal_;
  SailOrder sailed_;
  double sailed_clearance_m_ = 0.0;   // what the sailed trajectory was planned for
  double sailed_thrust_share_ = 1.0;  // and with
  double disturbance_share_ = 0.0;    // of the thrust ahead, as last reported
  int times_refused_ = 0;      // no plan was found from where the vessel is, one after the other
  int times_left_behind_ = 0;  // the vessel couldn't follow, on the way to this goal

  std::optional<Pending> pending_;
  double latency_s_ = 0.0;  // grows when answers come late
  int next_id_ = 1;
  std::size_t rung_ = 0;  // of the clearances
  int rounds_ = 0;        // of attempts from rest
  double not_before_s_ = 0.0;
  double plan_time_s_ = 0.0;         // when the sailed trajectory was taken
  double phase_time_s_ = 0.0;        // when the vessel began to stop
  std::optional<Phase> after_stop_;  // kIdle or kFailed: the mission ends with the stop
  bool for_clearance_ = false;       // replanning because of the way's clearance, nothing else
  int replans_ = 0;
  int stops_ = 0;
};

}  // namespace otter_nav::mission
