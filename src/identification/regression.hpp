// A start for the paper's model that needs no guess.
#pragma once

#include <vector>

#include "otter_nav/identification/data_set.hpp"
#include "parameter_set.hpp"

namespace otter_nav::identification {

// Least squares on the equations of motion integrated over `interval_s`, linear in h:
//   m1 (du - int v r) + d1 int u = int tau_u,   m1 (dv + int u r) + d2 int v = 0,
//   m2 dr + d3 int r = int tau_r.
// Biased by noise in the velocities, so only a start. Clamped into the bounds.
[[nodiscard]] vessel::PaperModel regress(const DataSet& data, const std::vector<Stretch>& windows,
                                         const vessel::Thrusters& thrusters, double interval_s,
                                         const PaperBounds& bounds);

}  // namespace otter_nav::identification
