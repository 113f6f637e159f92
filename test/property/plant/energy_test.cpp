// Calm water takes energy and never gives any.
#include <gtest/gtest.h>

#include "otter_nav/base/random.hpp"
#include "plant/gazebo_otter_model.hpp"
#include "plant/otter_model.hpp"

namespace otter_nav::plant {
namespace {

constexpr int kStates = 200;
constexpr int kSteps = 300;
constexpr double kStep = 0.01;

PlantState coast(const PlantModel& model, const PlantState& x) {
  return model.step(x, model.commandFor({0.0, 0.0}), kStep,
                    [](const PlantState& /*x*/) { return Surroundings(); });
}

void disturb(PlantState& x, Random& random) {
  x[kU] = random.uniform(-3.0, 3.0);
  x[kV] = random.uniform(-1.5, 1.5);
  x[kR] = random.uniform(-1.5, 1.5);
  x[kW] = random.uniform(-0.3, 0.3);
  x[kP] = random.uniform(-0.4, 0.4);
  x[kQ] = random.uniform(-0.4, 0.4);
  x[kDown] += random.uniform(-0.05, 0.05);
  x[kRoll] += random.uniform(-0.08, 0.08);
  x[kPitch] += random.uniform(-0.08, 0.08);
  x[kYaw] = random.uniform(-3.0, 3.0);
}

// Kinetic energy with added mass, and the hydrostatic spring's.
double energy(const OtterModel& model, const PlantState& x) {
  const Vector6 nu = velocityOf(x);
  const Eigen::Vector3d displaced = x.segment<3>(kDown) - model.trim(x[kRoll], x[kPitch]);
  return 0.5 * nu.dot(model.inertia() * nu) +
         0.5 * displaced.dot(model.stiffness().block<3, 3>(kW, kW) * displaced);
}

TEST(Energy, OfTheOtterNeverGrows) {
  Random random(11);
  for (int trial = 0; trial < kStates; ++trial) {
    const OtterModel model({random.uniform(0.0, 45.0), {0.05, 0.0, -0.35}}, true);
    PlantState x = model.settled();
    disturb(x, random);
    double before = energy(model, x);
    for (int i = 0; i < kSteps; ++i) {
      x = coast(model, x);
      const double now = energy(model, x);
      ASSERT_LE(now, before) << "trial " << trial << ", step " << i;
      before = now;
    }
  }
}

TEST(Energy, OfTheGazeboOtterInThePlaneNeverGrows) {
  const GazeboOtterModel model;
  const auto energy_of = [](const PlantState& x) {
    return 0.5 * (35.0 * (x[kU] * x[kU] + x[kV] * x[kV]) + 11.0 * x[kR] * x[kR]);
  };
  Random random(12);
  for (int trial = 0; trial < kStates; ++trial) {
    PlantState x = model.settled();
    disturb(x, random);
    double before = energy_of(x);
    for (int i = 0; i < kSteps; ++i) {
      x = coast(model, x);
      ASSERT_LE(energy_of(x), before) << "trial " << trial << ", step " << i;
      before = energy_of(x);
    }
  }
}

TEST(Energy, TheGazeboOtterSettlesFromAnyTilt) {
  const GazeboOtterModel model;
  Random random(13);
  for (int trial = 0; trial < 20; ++trial) {
    PlantState x = model.settled();
    disturb(x, random);
    for (int i = 0; i < 2000; ++i) x = coast(model, x);
    EXPECT_LT((x.segment<3>(kDown) - model.settled().segment<3>(kDown)).norm(), 1e-4);
  }
}

}  // namespace
}  // namespace otter_nav::plant
