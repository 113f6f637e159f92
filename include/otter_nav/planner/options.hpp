// What the planner can be told. Shipped values: config/planner.yaml.
#pragma once

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/optimizer/global_optimizer.hpp"
#include "otter_nav/optimizer/local_optimizer.hpp"
#include "otter_nav/topology/guide_path.hpp"

namespace otter_nav::planner {

struct Options {
  double clearance_m = 0.8;         // obstacles grow by this; the hull's outline is kept clear too
  double clearance_margin_m = 0.1;  // beyond it in the trees, where there is room
  double sigma = 10.0;              // cost of a second beside the squared jerk
  // Trees. Speeds are shares of the vessel's steady top speed, forces of both thrusters together.
  double speed_share = 0.96;         // of an edge, at most
  double force_share = 0.97;         // of an edge, at most
  double sample_speed_share = 0.85;  // along the guide path, at most
  double sample_accel_mps2 = 0.3;    // spread of sampled accelerations
  double key_spacing_m = 9.0;        // between the guide path's key states, sampled first
  double uniform_share = 0.1;        // of the samples after them, drawn from the whole map
  double corridor_m = 6.0;           // half width at most
  double edge_max_m = 30.0;          // between two states
  int neighbours = 10;               // tried as parents of a sample
  int max_nodes = 2048;              // of each tree
  int improve_samples = 0;           // drawn after the first solution, to shorten it
  int attempt_samples = 400;         // drawn before the search begins anew with another seed
  int max_attempts = 4;              // searches until one can be made sound
  int improve_attempts = 0;          // searches after that, in what is left of the time
  // The paper's two additions (its table I).
  bool local_optimization = true;
  bool global_optimization = true;
  bool keep_trees = false;  // copy guide path and trees into the plan for display

  // Read from their own files.
  topology::Options topology;
  optimizer::LocalOptions local;
  optimizer::GlobalOptions global;
};

// config/planner.yaml's root. The other rooms' options keep their defaults.
[[nodiscard]] Result<Options> readOptions(config::Section section);

// planner.yaml, optimizer.yaml and topology.yaml of a folder.
[[nodiscard]] Result<Options> loadOptions(const std::string& folder);

}  // namespace otter_nav::planner
