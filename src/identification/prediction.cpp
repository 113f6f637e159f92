#include "prediction.hpp"

#include <cmath>

namespace otter_nav::identification {
namespace {

struct Sums {
  double position2 = 0.0;
  double heading2 = 0.0;
  double speed2 = 0.0;
  int count = 0;

  void add(const vessel::State& error) {
    position2 += error.head<2>().squaredNorm();
    heading2 += error[vessel::kPsi] * error[vessel::kPsi];
    speed2 += error.segment<2>(vessel::kSurge).squaredNorm();
    ++count;
  }
};

vessel::State advanceSample(const DataSet& data, std::size_t i, const Model& model,
                            const vessel::State& state) {
  return step(model, data.samples[i].thrusts, data.samples[i + 1].time_s - data.samples[i].time_s,
              state);
}

// Adds the error of the prediction that starts at sample `begin`; false when the block ends before
// the horizon.
bool addPrediction(const DataSet& data, const Stretch& block, std::size_t begin, const Model& model,
                   double horizon_s, Sums& sums) {
  const double end_s = data.samples[begin].time_s + horizon_s - 1e-9;
  if (data.samples[block.end - 1].time_s < end_s) {
    return false;
  }
  vessel::State state = data.samples[begin].state;
  std::size_t i = begin;
  for (; data.samples[i].time_s < end_s; ++i) {
    state = advanceSample(data, i, model, state);
  }
  sums.add(state - data.samples[i].state);
  return true;
}

}  // namespace

PredictionError predictionError(const DataSet& data, const std::vector<Stretch>& blocks,
                                const Model& model, double horizon_s, double spacing_s) {
  Sums sums;
  for (const Stretch& block : blocks) {
    double next_s = data.samples[block.begin].time_s;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      if (data.samples[i].time_s < next_s) {
        continue;
      }
      if (!addPrediction(data, block, i, model, horizon_s, sums)) {
        break;
      }
      next_s += spacing_s;
    }
  }
  const double n = sums.count > 0 ? sums.count : 1.0;
  return {horizon_s, std::sqrt(sums.position2 / n), std::sqrt(sums.heading2 / n),
          std::sqrt(sums.speed2 / n), sums.count};
}

std::vector<vessel::State> predict(const DataSet& data, const Stretch& stretch,
                                   const Model& model) {
  std::vector<vessel::State> states = {data.samples[stretch.begin].state};
  for (std::size_t i = stretch.begin; i + 1 < stretch.end; ++i) {
    states.push_back(advanceSample(data, i, model, states.back()));
  }
  return states;
}

}  // namespace otter_nav::identification
