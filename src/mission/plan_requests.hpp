// Plans asked for, from wherever the vessel is, with what they must keep to; and how long the
// answers take.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "otter_nav/mission/supervisor.hpp"
#include "safety.hpp"

namespace otter_nav::mission {

// Where a plan starts from.
enum class From { kRest, kSailed, kVessel };

// What a plan is asked for though the one being sailed is sound: to be there sooner, to leave the
// waves what they take, more room for how the vessel wanders, as much as wide water has, or more
// beside the hull in narrow water.
enum class Gain { kTime, kThrust, kRoom, kClearance, kBeside };

// A hull at rest that is off the load by less lies bow to it.
constexpr double kIntoLoadRad = 0.35;

// From a request to the start of its trajectory when the vessel moves: grows when answers come
// late.
class PlanningLatency {
 public:
  explicit PlanningLatency(double usual_s) : usual_s_(usual_s), now_s_(usual_s) {}
  [[nodiscard]] double seconds() const { return now_s_; }
  void onTime() { now_s_ = usual_s_; }
  void late(double by_s) {
    constexpr double kMaxS = 2.0;
    now_s_ = std::min(kMaxS, 1.5 * now_s_ + by_s);
  }

 private:
  double usual_s_;
  double now_s_;
};

class PlanRequests {
 public:
  struct Asked {
    PlanRequest request;
    From from = From::kRest;
    std::optional<Gain> gain;  // asked for only to be better than what is sailed
    double since_s = 0.0;
    double speed_max_mps = 0.0;  // the mission's, when it was asked for
    double catch_up_mps = 0.0;   // what a vessel that fell behind may go
    bool slow = false;           // asked for because there was none at the usual speed
    std::size_t level = 0;       // of the clearances
    int steps_wider = 0;         // than that (ClearanceLevels)
    double pace_share = 1.0;     // of the usual speed, where it wanders too much for that
    bool in_unknown_water = false;
    double left_m = 0.0;  // what the answer leaves of the way to the goal
    // What the plan continues, from the sailed trajectory on; empty: that itself.
    trajectory::TimedTrajectory lead;
    double ends_by_s = std::numeric_limits<double>::infinity();  // later it is no gain
  };

  PlanRequests(const SupervisorOptions& options, const vessel::Parameters& vessel,
               std::uint64_t seed);

  // Each replaces the request under way.
  PlanRequest fromRest(double now_s, const vessel::State& state, const vessel::Pose& goal,
                       const feasibility::Obstacles& obstacles);
  // From where it is under way soon; or where it next rests on its way, if that is `rests_by_s` at
  // the latest. Nothing where it is about to come to rest for good, or too fast for the level and
  // not about to slow down.
  std::optional<PlanRequest> fromSailed(double now_s, const trajectory::TimedTrajectory& sailed,
                                        double thrust_share, const vessel::Pose& goal,
                                        const feasibility::Obstacles& obstacles, double rests_by_s);
  // From the end of a way that itself begins on the sailed one, planned for `sailed_mps` at most.
  PlanRequest onward(double now_s, trajectory::TimedTrajectory lead, double thrust_share,
                     double sailed_mps, const vessel::Pose& goal,
                     const feasibility::Obstacles& obstacles);
  // When something new can begin on the sailed trajectory, and at which speed at least.
  [[nodiscard]] std::optional<double> joint(double now_s,
                                            const trajectory::TimedTrajectory& sailed) const;
  [[nodiscard]] static double joiningSpeed(const trajectory::TimedTrajectory& sailed);
  // When a plan from the sailed trajectory would begin, s from that one's start, at no more than
  // `fastest_mps`; see `fromSailed`.
  [[nodiscard]] std::optional<double> beginning(
      double now_s, const trajectory::TimedTrajectory& sailed, double rests_by_s,
      double fastest_mps = std::numeric_limits<double>::infinity()) const;
  // Whether what is known of the water round the vessel, and of how it wanders, lets plans on a
  // level be markedly faster than at that share of the usual speed.
  [[nodiscard]] bool mayBeFaster(std::size_t level, double pace_share, const vessel::State& state,
                                 const feasibility::Obstacles& obstacles);
  PlanRequest fromVessel(double now_s, const vessel::State& state, const vessel::Pose& goal,
                         const feasibility::Obstacles& obstacles);

  [[nodiscard]] bool waits() const { return asked_.has_value(); }
  [[nodiscard]] bool overdue(double now_s) const {
    constexpr double kPatienceS = 5.0;
    return asked_ && now_s - asked_->since_s > kPatienceS;
  }
  void markAsImprovement(Gain gain) { asked_->gain = gain; }
  void markAsWorthless(double from_s) { asked_->ends_by_s = from_s; }
  void drop() { asked_.reset(); }
  [[nodiscard]] Asked take() { return *std::exchange(asked_, std::nullopt); }
  // Nothing if the answer is to a request that was replaced.
  [[nodiscard]] std::optional<Asked> take(int id) {
    return asked_ && asked_->request.id == id ? std::exchange(asked_, std::nullopt) : std::nullopt;
  }

  // No way on was found there: for this goal, guide paths lead elsewhere where they can.
  void addDeadEnd(const Eigen::Vector2d& place) { dead_ends_.push_back(place); }
  // Within a hull's length.
  [[nodiscard]] bool knowsDeadEndAt(const Eigen::Vector2d& place) const;
  void forgetDeadEnds() { dead_ends_.clear(); }

  Safety safety;
  PlanningLatency latency;

 private:
  [[nodiscard]] double paceShare(std::size_t level) const;
  PlanRequest ask(double now_s, PlanRequest request, const vessel::Pose& goal, double thrust_share,
                  From from, const feasibility::Obstacles& obstacles);

  vessel::Parameters vessel_;
  std::uint64_t seed_;
  std::optional<Asked> asked_;
  std::vector<Eigen::Vector2d> dead_ends_;
  int next_id_ = 1;
};

}  // namespace otter_nav::mission
