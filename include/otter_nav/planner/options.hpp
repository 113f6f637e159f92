// What the planner can be told. Shipped values: config/planner.yaml.
#pragma once

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"

namespace otter_nav::planner {

struct Options {
  double clearance_m = 0.8;    // obstacles grow by this; the hull's outline is kept clear as well
  double speed_max_mps = 4.7;  // over ground; the vessel's own top speed bounds it too
  double speed_share = 0.94;   // of the vessel's steady top speed, what is left is for control
  double sigma = 1.0;          // cost of a second beside the squared jerk
  // Trees.
  double sample_speed_mps = 4.0;   // along the guide path, before the vessel's share is applied
  double uniform_share = 0.1;      // of samples drawn from the whole map, for completeness
  double sample_accel_mps2 = 0.3;  // spread of sampled accelerations
  double corridor_m = 6.0;         // half width at most
  int neighbours = 12;             // tried as parents of a sample
  int max_nodes = 4096;            // of both trees together
  int improve_samples = 0;         // drawn after the first solution, to shorten it
  int max_attempts = 6;            // tree searches until one passes verification
  // The paper's two additions (its table I).
  bool local_optimization = true;
  bool global_optimization = true;
  bool keep_trees = false;  // copy guide path and trees into the plan for display
};

// config/planner.yaml: mapping `planner`.
[[nodiscard]] Result<Options> readOptions(config::Section section);

}  // namespace otter_nav::planner
