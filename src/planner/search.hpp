// The bidirectional kinodynamic RRT* of the paper's algorithms 1 and 2: two trees grown towards
// the same samples, each with its best parent, rewired; a sample in both trees is a path.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "otter_nav/feasibility/edge_check.hpp"
#include "otter_nav/optimizer/local_optimizer.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "planner/tree.hpp"

namespace otter_nav::planner {

struct SearchOptions {
  double sigma = 10.0;
  int max_nodes = 2048;      // a tree
  bool repair_edges = true;  // the paper's local optimisation
};

struct SearchCounts {
  int samples = 0;
  int joined = 0;   // samples that became nodes of one tree or both
  int repairs = 0;  // edges bent into feasibility
  int tried = 0;    // and those tried
};

class Search {
 public:
  Search(const SearchOptions& options, const vessel::Parameters& vessel);

  // Begins a query: field and layers of `obstacles` must outlive it.
  void reset(const feasibility::Obstacles& obstacles, const feasibility::SafetyLimits& limits,
             const KinoState& start, const KinoState& goal);
  // Tries to join the trees by one edge from root to root, without a sample.
  bool joinRoots();
  // Grows both trees towards one sample. True if a path, or a cheaper one, is known thereafter.
  bool extend(const KinoState& sample);

  [[nodiscard]] bool solved() const { return !meetings_.empty(); }
  // Cost of the cheapest path; infinite without one.
  [[nodiscard]] double bestCost() const;
  // Recall: the cheapest path's edges, start to goal. Empty without one.
  [[nodiscard]] std::vector<trajectory::Piece> recall() const;

  [[nodiscard]] const SearchCounts& counts() const { return counts_; }
  [[nodiscard]] const Tree& fromStart() const { return from_start_; }
  [[nodiscard]] const Tree& toGoal() const { return to_goal_; }
  // The pieces of a node's edge, in sailing order.
  void appendEdge(const Tree& tree, int node, std::vector<trajectory::Piece>& pieces) const;

 private:
  static constexpr int kNeighbours = 10;  // tried as parents, and for rewiring
  struct Candidate {
    int node = kNone;
    double bound = 0.0;  // of the path's cost through it; after steering, the cost
    Steer steer;
  };
  struct Meeting {
    int in_start = kNone;
    int in_goal = kNone;
  };

  // By which check an edge is judged, and when it begins. In the start's tree obstacles are where
  // they will be by then; what leads to the goal is sailed at a time not known yet, so there only
  // the map counts, and the verifier judges the whole.
  struct Occasion {
    const feasibility::EdgeCheck& check;
    double start_s;
  };
  [[nodiscard]] Occasion occasionOf(const Tree& tree, int parent) const;

  int findNeighbours(const Tree& tree, const KinoState& sample);
  int steerNeighbours(const Tree& tree, const KinoState& sample, int found);
  int grow(Tree& tree, const KinoState& sample);
  std::optional<Edge> feasibleEdge(const KinoState& from, const KinoState& to, const Steer& steer,
                                   const Occasion& occasion);
  std::optional<Edge> repairedEdge(const KinoState& from, const KinoState& to, const Steer& steer,
                                   const Occasion& occasion);
  std::optional<Edge> slowerEdge(const KinoState& from, const KinoState& to, const Steer& steer,
                                 const Occasion& occasion);
  void rewire(Tree& tree, int added);

  SearchOptions options_;
  vessel::Parameters vessel_;
  double sigma_ = 0.0;  // of the query's speed limit
  feasibility::EdgeCheck check_;
  feasibility::EdgeCheck still_;  // the map alone
  optimizer::LocalOptimizer local_;
  Tree from_start_;
  Tree to_goal_;
  std::vector<trajectory::Piece> pieces_;  // of repaired edges
  std::vector<Meeting> meetings_;
  std::optional<Edge> direct_;  // root to root
  std::array<Candidate, kNeighbours> candidates_;
  optimizer::RepairedEdge repaired_;
  SearchCounts counts_;
};

}  // namespace otter_nav::planner
