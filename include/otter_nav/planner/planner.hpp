// From a query to a trajectory the hull can follow: guide path, two kinodynamic trees in its
// corridor, local repair of failing edges, global optimisation, verification of the whole (paper,
// sections IV and V). What is returned as solved has passed feasibility::verify; anything else has
// an outcome and a reason.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/planner/options.hpp"
#include "otter_nav/trajectory/boundary.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/pose.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::planner {

struct Query {
  // At rest (all derivatives zero) with any heading, or moving, with position to jerk taken from
  // the trajectory being sailed.
  trajectory::Boundary start;
  trajectory::Boundary goal;  // at rest
  // What the plan must keep to: clearance, hull, shares of thrust, speed; and the wind, current and
  // force it is made with.
  feasibility::SafetyLimits limits;
  std::uint64_t seed = 1;
  // What is being sailed, cut to begin at `start`: tried first, kept where nothing better is
  // found. May be empty.
  trajectory::Trajectory warm_start;
  // Where there is no plan to the goal, one to a place on the way to it will do, for the vessel to
  // see further from there.
  bool may_end_early = false;
  // From rest, and where nothing else leads on, slowly by straight legs ahead and astern with turns
  // on the spot between them, as the hull's rectangle passes.
  bool may_creep = false;
  // Where a way led to nowhere before: a guide path keeps away from there, unless there is no other
  // and the plan may end early.
  std::vector<Eigen::Vector2d> dead_ends;
  // Key points from start to goal found elsewhere (a topology node); empty, or with dead ends:
  // found here.
  std::vector<Eigen::Vector2d> guide_path;

  // What a guide path is looked for from: moving, along the velocity.
  [[nodiscard]] vessel::Pose guideStart() const;
};

// When to stop: at `budget_s` on the caller's clock, or after `max_iterations` samples drawn,
// whichever comes first. Without a clock only the iterations count, and the result is the same
// on every machine.
struct Termination {
  std::function<double()> elapsed_s;
  double budget_s = 0.1;
  int max_iterations = 2000;
};

// The wall clock from now on.
[[nodiscard]] Termination wallClock(double budget_s, int max_iterations = 20000);

enum class Outcome { kSolved, kStartBlocked, kGoalBlocked, kNoPath, kTimeUp };
[[nodiscard]] const char* toString(Outcome outcome);

// The paper's table I for one query, and where the time went. Times by the caller's clock; zero
// without one.
struct Figures {
  double first_solution_ms = 0.0;  // the trees joined: a path, not yet smooth
  double total_ms = 0.0;           // guide path, trees, optimisation and verification
  double guide_ms = 0.0;
  double tree_ms = 0.0;
  double optimize_ms = 0.0;
  double verify_ms = 0.0;
  double length_m = 0.0;
  double duration_s = 0.0;
  double cost = 0.0;              // sigma T + integral of |jerk|^2, the trees' measure
  double tree_cost = 0.0;         // the same before global optimisation
  double node_utilization = 0.0;  // tree nodes over samples drawn
  int samples = 0;
  int nodes = 0;
  int iterations = 0;
  int work = 0;           // of all tries, as optimizer::Budget counts
  int local_repairs = 0;  // failing edges that local optimisation made feasible
  int attempts = 0;       // tree searches until one could be optimised and verified
};

struct Plan {
  Outcome outcome = Outcome::kNoPath;
  std::string reason;  // a sentence; empty when solved
  trajectory::Trajectory trajectory;
  double left_m = 0.0;  // of the guide path, from the trajectory's end on; 0: it leads to the goal
  Figures figures;
  // For people to look at: filled when Options::keep_trees is set.
  std::vector<Eigen::Vector2d> guide_path;
  struct Branch {
    std::vector<Eigen::Vector2d> points;
    bool from_goal = false;
  };
  std::vector<Branch> trees;
};

// Not thread-safe: one planner a thread; its pools are reused from query to query.
class Planner {
 public:
  Planner(const Options& options, const vessel::Parameters& vessel);
  ~Planner();
  Planner(Planner&&) noexcept;
  Planner& operator=(Planner&&) noexcept;

  // Times of moving obstacles count from the plan's start.
  [[nodiscard]] Plan plan(const feasibility::Obstacles& obstacles, const Query& query,
                          const Termination& termination);

 private:
  class Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace otter_nav::planner
