// Decides what a mission does next: plan, sail, replan, stop, or say why it can't. A deterministic
// state machine without threads and without a clock: time, odometry, map and results are passed
// in, and what has to be done comes back as Orders. The planner node and the closed loop without
// ROS run the same one (docs/mission.md has the picture of its states).
//
// Rules: a plan is kept while the way ahead stays clear. When something comes up in the way, a new
// plan is asked for that starts on the sailed trajectory a little ahead of the vessel. At every
// decision a stop that begins a little later is verified in known water and kept; a plan is taken
// only with such a stop. Where none is left the last one is sailed, and given up for a plan as soon
// as there is one. Every retry is counted, and the last reason is told.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/encounter/near_future.hpp"
#include "otter_nav/encounter/pilot.hpp"
#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/planner/planner.hpp"
#include "otter_nav/traffic/track.hpp"
#include "otter_nav/trajectory/timed_trajectory.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::mission {

enum class Phase {
  kIdle,        // no goal
  kPlanning,    // at rest, waiting for the first plan
  kSailing,     // on a plan that is clear as far as is known
  kReplanning,  // on a plan that is not clear any more, waiting for a better one
  kStopping,    // braking
  kStopped,     // at rest on the way, waiting for a plan
  kBackingOff,  // from where there is no room to turn
  kEvading,     // among others who give way to nobody, on a way of seconds that is always made anew
  kTurningBack,  // into the map, over whose edge the vessel went
  kPaused,       // at rest by the operator's wish, with its mission kept
  kHolding,      // likewise, with or without a mission
  kArrived,      // within the tolerances of the goal and slow
  kFailed        // given up; reason() says why, and the vessel lies still or is braking
};
[[nodiscard]] const char* name(Phase phase);

// What a user can set (config/mission.yaml, mapping `supervisor`); the other figures of the rules
// stand beside them.
struct SupervisorOptions {
  std::vector<double> side_clearances_m = {1.06, 0.46, 0.2, 0.1};
  double critical_side_clearance_m = 0.03;
  double thrust_share = 0.95;
  double speed_max_mps = 0.0;
  double planning_latency_s = 0.3;
  int rounds_from_rest = 10;
  int stops_max = 8;
  double tracking_error_max_m = 1.2;
  double odometry_timeout_s = 1.0;
  double arrival_distance_m = 0.9;
  double arrival_heading_rad = 0.15;
  double improve_period_s = 0.0;
  bool plan_with_weather = true;
  encounter::Options encounter;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields.list("side_clearances_m", o.side_clearances_m, 4, {0.0, 10.0},
                "beyond half the beam from anything occupied, m: a plan is tried from the widest "
                "to the narrowest");
    fields("critical_side_clearance_m", o.critical_side_clearance_m, {0.0, 10.0},
           "of the hull's outline, m: with less on the way another plan is looked for");
    fields("thrust_share", o.thrust_share, {0.4, 1.0},
           "of the thrusters' limits in plans; in gusts less by what they take");
    fields("speed_max_mps", o.speed_max_mps, {0.0, 100.0},
           "over ground; a mission may say otherwise; 0: the vessel's");
    fields("planning_latency_s", o.planning_latency_s, {0.0, 2.0},
           "from a request under way to the start of the new trajectory");
    fields("rounds_from_rest", o.rounds_from_rest, {1, 1000},
           "of attempts, each with all clearances; then the mission gives up");
    fields("stops_max", o.stops_max, {0, 1000}, "on the way; then the mission gives up");
    fields(
        "tracking_error_max_m", o.tracking_error_max_m, {0.1, 100.0},
        "further off the trajectory, the plan starts at the vessel again; in strong wind with room "
        "up to 1.25 times the hull's length");
    fields("odometry_timeout_s", o.odometry_timeout_s, {0.05, 60.0},
           "older odometry stops the vessel");
    fields("arrival_distance_m", o.arrival_distance_m, {0.01, 100.0},
           "arrived: within this of the goal,");
    fields("arrival_heading_rad", o.arrival_heading_rad, {0.01, 3.2}, "this heading, and slow");
    fields("improve_period_s", o.improve_period_s, {0.0, 600.0},
           "of plans asked for only to be faster; 0: none");
    fields("plan_with_weather", o.plan_with_weather,
           "plans are made with the estimate of wind and current where that is a firm load that "
           "does not turn with the heading; else for still water with thrust and room left for it");
    fields.group("encounter", o.encounter, "other vessels, and the rules of the road");
  }
};
[[nodiscard]] Status checkSpeedMax(double speed_mps);
[[nodiscard]] Result<SupervisorOptions> readSupervisorOptions(config::Section section);
[[nodiscard]] Result<SupervisorOptions> loadSupervisorOptions(const std::string& path);

// What is known of the vessel at a decision.
struct Situation {
  vessel::State state = vessel::State::Zero();  // latest odometry, map frame
  double odometry_stamp_s = 0.0;
  std::optional<double> scanned_s;          // when a scan came into the map last; none ever did
  double tracking_error_m = 0.0;            // off what is sailed, of the centre
  vessel::DisturbanceEstimate disturbance;  // wind, current and force as the tracker has them
  bool tracker_fault = false;               // the tracker can't follow and brakes by itself
  std::string tracker_reason;
  vessel::Foreseen foreseen;           // where the tracker expects the vessel, on the same clock
  std::vector<traffic::Track> tracks;  // of other vessels, on the clock of `now_s`
  bool hears_others = false;           // whoever makes the tracks does so, be there any or not
};

// A question to the planner. What it must keep to comes with it.
struct PlanRequest {
  int id = 0;
  planner::Query query;
  double thrust_share = 1.0;  // the query's limits, of what plans may usually take
  // Other vessels, to be added to the planner's obstacles; may be empty.
  encounter::NearFuture others = {};
  // When the vessel passes the query's start, where the planner's obstacles start too; from rest
  // about then.
  double start_time_s = 0.0;
};

// Plans taken on the way to a goal, after the first.
struct Replans {
  int all = 0;
  // Of these: since wind, waves or current had the vessel off its way, asked for more thrust or
  // room than the plan left, or for another heading at the goal; not for the map, other vessels, or
  // time.
  int for_weather = 0;
};

struct Orders {
  std::optional<PlanRequest> plan;  // replaces a request still under way
  std::optional<trajectory::TimedTrajectory> sail;
  bool stop = false;  // the tracker shall brake by itself: there is no trajectory to do so on
};

// Obstacles' times are on the clock of `now_s`. They are what lies still: the situation's tracks
// are added here.
class Supervisor {
 public:
  [[nodiscard]] static std::unique_ptr<Supervisor> create(const SupervisorOptions& options,
                                                          const vessel::Parameters& vessel,
                                                          std::uint64_t seed);
  virtual ~Supervisor() = default;

  // Takes a goal and asks for a plan, or refuses it with the reason: not finite, outside the map,
  // too near something occupied. A refused goal leaves the mission under way untouched; an
  // accepted one replaces it, in motion if need be.
  [[nodiscard]] virtual Result<Orders> setGoal(double now_s, const vessel::Pose& goal,
                                               const Situation& situation,
                                               const feasibility::Obstacles& obstacles) = 0;
  // Gives the mission up: brakes if moving, and is idle then.
  [[nodiscard]] virtual Orders cancel(double now_s, const Situation& situation,
                                      const feasibility::Obstacles& obstacles,
                                      std::string why = "cancelled") = 0;
  // Brakes if moving and keeps the place where it comes to rest, and the mission, until resume() or
  // a new goal. Refused without a mission.
  [[nodiscard]] virtual Result<Orders> pause(double now_s, const Situation& situation,
                                             const feasibility::Obstacles& obstacles) = 0;
  // The same for any vessel: one that drifts without a goal keeps its place from now on.
  [[nodiscard]] virtual Orders hold(double now_s, const Situation& situation,
                                    const feasibility::Obstacles& obstacles) = 0;
  // Plans from rest to the goal kept; a vessel that had none is idle. Refused if nothing is paused.
  [[nodiscard]] virtual Result<Orders> resume(double now_s, const Situation& situation,
                                              const feasibility::Obstacles& obstacles) = 0;
  // To be called regularly (10 Hz or more) and after each change of the map.
  [[nodiscard]] virtual Orders update(double now_s, const Situation& situation,
                                      const feasibility::Obstacles& obstacles) = 0;
  // The planner's answer to request `id`; answers to requests that were replaced are ignored.
  [[nodiscard]] virtual Orders planFinished(double now_s, int id, const planner::Plan& plan,
                                            const Situation& situation,
                                            const feasibility::Obstacles& obstacles) = 0;

  // Of all plans from now on; what is sailed is planned anew. 0: the vessel's alone. An error if it
  // is less than a vessel can steer by.
  [[nodiscard]] virtual Status setSpeedMax(double speed_mps) = 0;
  // What of the options rules decisions and plans from now on; the counts of retries, the latency
  // and what is asked of encounters stay as they were.
  virtual void setOptions(const SupervisorOptions& options) = 0;
  [[nodiscard]] virtual double speedMax() const = 0;

  [[nodiscard]] virtual Phase phase() const = 0;
  // Why the phase is what it is; empty if there is nothing to explain.
  [[nodiscard]] virtual const std::string& reason() const = 0;
  [[nodiscard]] virtual const vessel::Pose& goal() const = 0;
  // What is being sailed; empty before the first plan.
  [[nodiscard]] virtual const trajectory::TimedTrajectory& sailed() const = 0;
  // The way to rest that was verified last, from what was sailed then; none but under way.
  [[nodiscard]] virtual const std::optional<trajectory::TimedTrajectory>& lastStop() const = 0;
  // What it was planned to keep from the hull's centre, m; 0 for a manoeuvre without a plan.
  [[nodiscard]] virtual double plannedClearance() const = 0;
  // Other vessels with risk of collision, and which rule of the road applies to each.
  [[nodiscard]] virtual std::vector<encounter::Encounter> encounters() const = 0;
  [[nodiscard]] virtual Replans replans() const = 0;
  [[nodiscard]] virtual int stops() const = 0;
};

}  // namespace otter_nav::mission
