// How far a model's predictions are off on motion it was not fitted to.
#pragma once

#include <vector>

#include "otter_nav/identification/identify.hpp"
#include "sensitivity.hpp"

namespace otter_nav::identification {

// Root mean squares of what is predicted `horizon_s` ahead from measured states.
struct PredictionError {
  double horizon_s = 0.0;
  double position_m = 0.0;
  double heading_rad = 0.0;
  double speed_mps = 0.0;
  int count = 0;
};

// Predictions start each `spacing_s` within the blocks that can hold them.
[[nodiscard]] PredictionError predictionError(const DataSet& data,
                                              const std::vector<Stretch>& blocks,
                                              const Model& model, double horizon_s,
                                              double spacing_s);

// The model's states from the measured one at `begin` on, one per sample of the stretch.
[[nodiscard]] std::vector<vessel::State> predict(const DataSet& data, const Stretch& stretch,
                                                 const Model& model);

}  // namespace otter_nav::identification
