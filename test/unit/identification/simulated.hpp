// Recordings made with the project's own planar models, for the tests.
#pragma once

#include "identification/sensitivity.hpp"
#include "otter_nav/base/random.hpp"
#include "otter_nav/identification/data_set.hpp"

namespace otter_nav::identification::testing {

struct Noise {
  double position_m = 0.0;
  double heading_rad = 0.0;
  double velocity_mps = 0.0;
  double yaw_rate_radps = 0.0;
};

inline Noise odometryNoise() {
  return {0.02, 0.005, 0.02, 0.01};
}

inline Model paperModel(const vessel::PaperModel& h) {
  Model model;
  model.coefficients = vessel::ManoeuvringModel::fromPaper(h);
  model.thrusters = {0.395, 119.7, 66.7};
  return model;
}

// Thrusts that change every few seconds, ahead more than astern, drawn from `random`.
class RandomSteps {
 public:
  explicit RandomSteps(std::uint64_t seed) : random_(seed) {}
  vessel::Thrusts at(double time_s) {
    if (time_s >= until_s_) {
      until_s_ = time_s + random_.uniform(1.0, 8.0);
      const double ahead_n = random_.uniform(-20.0, 90.0);
      const double turn_n = random_.uniform(-25.0, 25.0);
      thrusts_ = {ahead_n - turn_n, ahead_n + turn_n};
    }
    return thrusts_;
  }

 private:
  Random random_;
  double until_s_ = -1.0;
  vessel::Thrusts thrusts_ = vessel::Thrusts::Zero();
};

// The vessel starts at rest; odometry and commands each `dt` seconds, integrated at dt.
template <typename Input>
Recording record(const Model& model, Input input, double duration_s, double dt, const Noise& noise,
                 std::uint64_t seed) {
  Random random(seed);
  Recording recording;
  recording.odometry_name = "simulated";
  recording.command_name = "simulated";
  vessel::State state = vessel::State::Zero();
  const int count = static_cast<int>(duration_s / dt);
  for (int i = 0; i <= count; ++i) {
    const double time_s = 10.0 + i * dt;
    const vessel::Thrusts thrusts = input(i * dt);
    vessel::State measured = state;
    const vessel::State deviation =
        (vessel::State() << noise.position_m, noise.position_m, noise.heading_rad,
         noise.velocity_mps, noise.velocity_mps, noise.yaw_rate_radps)
            .finished();
    for (int k = 0; k < vessel::kStateSize; ++k) {
      measured[k] += deviation[k] * random.normal();
    }
    measured[vessel::kPsi] = std::remainder(measured[vessel::kPsi], 2.0 * kPi);
    recording.odometry.push_back({time_s, measured});
    recording.commands.push_back({time_s, thrusts});
    state = step(model, thrusts, dt, state);
  }
  return recording;
}

}  // namespace otter_nav::identification::testing
