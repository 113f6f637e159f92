// What the planner can be told. Shipped values: config/planner.yaml.
#pragma once

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/optimizer/global_optimizer.hpp"
#include "otter_nav/topology/guide_path.hpp"

namespace otter_nav::planner {

struct Options {
  double sigma = 10.0;         // J = sigma T + integral of |jerk|^2, the price of every edge
  double corridor_m = 6.0;     // half width at most
  double uniform_share = 0.1;  // of samples drawn from the whole map
  int max_nodes = 2048;        // of each tree
  int improve_samples = 0;     // drawn after the first solution, to shorten it
  int attempt_samples = 400;   // drawn before the search begins anew with another seed
  int max_attempts = 4;        // searches until one can be made feasible
  int improve_attempts = 0;    // searches after that, in what is left of the time
  // The paper's two additions (its table I).
  bool local_optimization = true;
  bool global_optimization = true;
  bool keep_trees = false;  // copy guide path and trees into the plan for display

  optimizer::GlobalOptions optimizer;

  // Read from a file of its own.
  topology::Options topology;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("sigma", o.sigma, {1e-3, 1e3}, "price of a second beside the squared jerk");
    fields("corridor_m", o.corridor_m, {0.5, 50.0}, "half width around the guide path at most");
    fields("uniform_share", o.uniform_share, {0.0, 1.0}, "of samples, drawn from the whole map");
    fields("max_nodes", o.max_nodes, {16, 100000}, "of each tree");
    fields("improve_samples", o.improve_samples, {0, 100000}, "drawn after the first solution");
    fields("attempt_samples", o.attempt_samples, {10, 100000}, "before the search begins anew");
    fields("max_attempts", o.max_attempts, {1, 100}, "searches until one can be made feasible");
    fields("improve_attempts", o.improve_attempts, {0, 1000}, "searches after that, in time left");
    fields("local_optimization", o.local_optimization, "bend failing edges, not discard them");
    fields("global_optimization", o.global_optimization, "smooth and speed up the whole");
    fields.group("optimizer", o.optimizer, "what a trajectory is worth beside its seconds");
  }
};

// planner.yaml and topology.yaml of a folder.
[[nodiscard]] Result<Options> loadOptions(const std::string& folder);

}  // namespace otter_nav::planner
