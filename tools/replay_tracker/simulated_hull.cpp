#include "replay_tracker/simulated_hull.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/rk4.hpp"
#include "otter_nav/config/share.hpp"
#include "otter_nav/plant/plant_model.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/thrusters.hpp"
#include "plant/environment.hpp"

namespace otter_nav::replay {
namespace {

constexpr double kStepS = 0.01;

template <typename StepOnce>
void inSteps(double dt_s, StepOnce step_once) {
  const int steps = std::max(1, static_cast<int>(std::ceil(dt_s / kStepS - 1e-6)));
  for (int i = 0; i < steps; ++i) {
    step_once(dt_s / steps);
  }
}

class ModelHull : public SimulatedHull {
 public:
  explicit ModelHull(const vessel::Parameters& vessel) : vessel_(vessel) {}

  void place(const vessel::State& state, const vessel::Thrusts& thrusts) override {
    state_ = state;
    acting_ = thrusts;
  }
  void advance(const vessel::Thrusts& command, const vessel::Disturbance& disturbance,
               double dt_s) override {
    const vessel::Thrusts wanted = vessel::clampThrusts(command, vessel_.thrusters);
    const double lag_s = vessel_.thrusters.lag_s;
    inSteps(dt_s, [&](double dt) {
      const vessel::Thrusts before = acting_;
      acting_ = lag_s > 0.0 ? vessel::Thrusts(wanted + std::exp(-dt / lag_s) * (acting_ - wanted))
                            : wanted;
      const vessel::Thrusts mean = lag_s > 0.0 ? vessel::Thrusts(0.5 * (before + acting_)) : wanted;
      state_ = rk4Step(
          [&](double, const vessel::State& x) {
            return vessel::stateDerivative(x, mean, vessel_.manoeuvring, vessel_.thrusters,
                                           disturbance);
          },
          0.0, state_, dt);
    });
  }
  [[nodiscard]] vessel::State state() const override { return state_; }

 private:
  vessel::Parameters vessel_;
  vessel::State state_ = vessel::State::Zero();
  vessel::Thrusts acting_ = vessel::Thrusts::Zero();
};

class PlantHull : public SimulatedHull {
 public:
  explicit PlantHull(std::unique_ptr<plant::PlantModel> model) : model_(std::move(model)) {}

  void place(const vessel::State& state, const vessel::Thrusts& thrusts) override {
    x_ = plant::placed(model_->settled(), state.head<2>(), state[vessel::kPsi]);
    x_[plant::kU] = state[vessel::kSurge];
    x_[plant::kV] = -state[vessel::kSway];
    x_[plant::kR] = -state[vessel::kYawRate];
    x_.tail<2>() = model_->commandFor(thrusts);
  }
  void advance(const vessel::Thrusts& command, const vessel::Disturbance& disturbance,
               double dt_s) override {
    plant::Conditions conditions;
    conditions.wind_mps = disturbance.wind_mps;
    conditions.current_mps = disturbance.current_mps;
    conditions.force_n = disturbance.force_n;
    const Eigen::Vector2d propellers = model_->commandFor(command);
    inSteps(dt_s, [&](double dt) {
      x_ = model_->step(x_, propellers, dt, [&](const plant::PlantState& x) {
        plant::Surroundings around = plant::surroundings(conditions, x, *model_);
        around.force[plant::kR] -= disturbance.moment_nm;
        return around;
      });
    });
  }
  [[nodiscard]] vessel::State state() const override {
    return plant::toTruth(x_, model_->poseRate(x_)).planar;
  }

 private:
  std::unique_ptr<plant::PlantModel> model_;
  plant::PlantState x_ = plant::PlantState::Zero();
};

}  // namespace

Result<std::unique_ptr<SimulatedHull>> SimulatedHull::model(const vessel::Parameters& vessel) {
  return std::unique_ptr<SimulatedHull>(std::make_unique<ModelHull>(vessel));
}

Result<std::unique_ptr<SimulatedHull>> SimulatedHull::plant(const vessel::Parameters& vessel) {
  const auto file = config::findFile("config/plant.yaml");
  auto options = file.and_then(config::load<plant::Options>);
  if (!options) {
    return failure(options.error().message);
  }
  options->vessel = vessel;
  Result<std::unique_ptr<plant::PlantModel>> model = plant::makePlantModel(*options);
  if (!model) {
    return failure(model.error().message);
  }
  return std::unique_ptr<SimulatedHull>(std::make_unique<PlantHull>(std::move(*model)));
}

}  // namespace otter_nav::replay
