// What every plant model keeps, whatever sails: driven through the base class alone.
#include <gtest/gtest.h>

#include <cmath>

#include "../vessel_of.hpp"
#include "otter_nav/plant/plant_model.hpp"
#include "otter_nav/vessel/model.hpp"
#include "plant/environment.hpp"

namespace otter_nav::plant {
namespace {

struct Case {
  const char* name;
  const char* vessel;
  const char* plant_model;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

Surroundings stillWater(const PlantState& /*x*/) {
  return {};
}

std::unique_ptr<PlantModel> modelOf(const vessel::Parameters& vessel,
                                    const std::string& plant_model) {
  Options options;
  options.vessel = vessel;
  options.vessel.plant_model = plant_model;
  return makePlantModel(options).value();
}

class EveryModel : public testing::TestWithParam<Case> {
 protected:
  vessel::Parameters vessel_ = vessel::test::vesselOf(GetParam().vessel);
  std::unique_ptr<PlantModel> model_ = modelOf(vessel_, GetParam().plant_model);
};

TEST_P(EveryModel, StaysWhereItIsSettled) {
  PlantState x = model_->settled();
  for (int i = 0; i < 500; ++i)
    x = model_->step(x, model_->commandFor({0.0, 0.0}), 0.01, stillWater);
  EXPECT_LT((x - model_->settled()).norm(), 1e-9);
}

TEST_P(EveryModel, ReachesItsFilesTopSpeed) {
  PlantState x = model_->settled();
  const Eigen::Vector2d full = model_->commandFor({1e4, 1e4});
  for (int i = 0; i < 3000; ++i) x = model_->step(x, full, 0.01, stillWater);
  EXPECT_NEAR(x[kU], vessel_.top_speed_mps, 0.01 * vessel_.top_speed_mps);
}

TEST_P(EveryModel, SaturatesThrustsAndInvertsItsCommand) {
  const vessel::Thrusters& limits = vessel_.thrusters;
  PlantState x = model_->settled();
  x.tail<2>() = model_->commandFor({1e4, -1e4});
  EXPECT_NEAR(model_->thrusts(x)[0], limits.ahead_max_n, 0.1);
  EXPECT_NEAR(model_->thrusts(x)[1], -limits.astern_max_n, 0.1);
  EXPECT_EQ(model_->saturate(2.0 * x.tail<2>()), x.tail<2>());
  for (const double share : {-0.9, -0.01, 0.0, 0.005, 0.9}) {
    const double thrust = share * limits.astern_max_n;
    x.tail<2>() = model_->commandFor({thrust, -0.5 * thrust});
    EXPECT_NEAR(model_->thrusts(x)[0], thrust, 1e-9);
    EXPECT_NEAR(model_->thrusts(x)[1], -0.5 * thrust, 1e-9);
  }
}

TEST_P(EveryModel, ItsPropellersLagAsTheFileSays) {
  const Eigen::Vector2d command =
      model_->commandFor({vessel_.thrusters.astern_max_n, -0.5 * vessel_.thrusters.astern_max_n});
  PlantState x = model_->settled();
  for (int i = 0; i < 10; ++i) x = model_->step(x, command, 0.01, stillWater);
  const double lag_s = vessel_.thrusters.lag_s;
  const double share = lag_s > 0.0 ? 1.0 - std::exp(-0.1 / lag_s) : 1.0;
  EXPECT_NEAR(x[kPropeller], share * command[0], 1e-5 * std::abs(command[0]));
  EXPECT_NEAR(x[kPropeller + 1], share * command[1], 1e-5 * std::abs(command[1]));
}

// Without thrust a current carries the hull along, whatever way it points.
TEST_P(EveryModel, DriftsWithTheCurrentInTheEnd) {
  PlantState x = model_->settled();
  x[kYaw] = 0.7;
  Conditions conditions;
  conditions.current_mps = {0.0, 0.5};  // towards north
  for (int i = 0; i < 8000; ++i) {
    x = model_->step(x, {0.0, 0.0}, 0.01, [&](const PlantState& state) {
      return surroundings(conditions, state, *model_);
    });
  }
  const Vector6 rate = model_->poseRate(x);
  EXPECT_NEAR(rate[0], 0.5, 0.01);
  EXPECT_NEAR(rate[1], 0.0, 0.01);
}

TEST_P(EveryModel, RidesALongWave) {
  PlantState x = model_->settled();
  for (int i = 0; i < 1500; ++i) {
    x = model_->step(x, {0.0, 0.0}, 0.01, [](const PlantState& /*state*/) {
      Surroundings around;
      around.surface = {-0.05, 0.02, 0.03};
      return around;
    });
  }
  const Eigen::Vector3d moved = (x - model_->settled()).segment<3>(kDown);
  EXPECT_LT((moved - Eigen::Vector3d(-0.05, 0.02, 0.03)).norm(), 6e-3);
}

TEST_P(EveryModel, StepsAlongItsDerivative) {
  PlantState x = model_->settled();
  x.head<6>() << 0.8, -0.2, 0.01, 0.02, -0.01, 0.3;
  const Eigen::Vector2d command = model_->commandFor({10.0, 30.0});
  x.tail<2>() = command;
  constexpr double kStep = 1e-6;
  const PlantState rate = (model_->step(x, command, kStep, stillWater) - x) / kStep;
  EXPECT_LT((rate - model_->derivative(x, command, {})).norm(), 1e-3);
  EXPECT_LT((rate.segment<6>(kNorth) - model_->poseRate(x)).norm(), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Plant, EveryModel,
                         testing::Values(Case{"otter", "otter", "otter"},
                                         Case{"otter_gazebo", "otter_gazebo", "otter_gazebo"},
                                         Case{"planar_otter", "otter", "planar"},
                                         Case{"planar_wam_v", "wam_v", "planar"}));

// The planar plant is the file's model, disturbances included, whatever the heading; and the file
// of otter_gazebo is that plant's plane.
TEST(PlanarModel, IsTheVesselsOwnModel) {
  for (const auto& [name, plant_model] :
       {std::pair("wam_v", "planar"), std::pair("otter", "planar"),
        std::pair("otter_gazebo", "planar"), std::pair("otter_gazebo", "otter_gazebo")}) {
    vessel::Parameters vessel = vessel::test::vesselOf(name);
    if (!vessel.manoeuvring.feelsWind()) {
      vessel.manoeuvring.wind_surge_kgpm = 0.4;
      vessel.manoeuvring.wind_sway_kgpm = 0.9;
      vessel.manoeuvring.wind_yaw_kg = -0.3;
    }
    vessel.thrusters.lag_s = 0.0;
    const std::unique_ptr<PlantModel> model = modelOf(vessel, plant_model);
    PlantState x = placed(model->settled(), {3.0, -1.0}, 0.4);
    x[kU] = 2.0;
    x[kV] = -0.3;
    x[kR] = -0.5;
    x.tail<2>() << 20.0, 35.0;
    Conditions conditions;
    conditions.wind_mps = {-4.0, 3.0};
    conditions.current_mps = {0.3, -0.2};
    conditions.force_n = {5.0, 10.0};
    const PlantState dx = model->derivative(x, {20.0, 35.0}, surroundings(conditions, x, *model));

    vessel::Disturbance disturbance;
    disturbance.wind_mps = conditions.wind_mps;
    disturbance.current_mps = conditions.current_mps;
    disturbance.force_n = conditions.force_n;
    const vessel::State expected =
        vessel::stateDerivative(toTruth(x, model->poseRate(x)).planar, {20.0, 35.0},
                                vessel.manoeuvring, vessel.thrusters, disturbance);
    EXPECT_NEAR(dx[kEast], expected[vessel::kX], 1e-12) << name << plant_model;
    EXPECT_NEAR(dx[kNorth], expected[vessel::kY], 1e-12) << name << plant_model;
    EXPECT_NEAR(-dx[kYaw], expected[vessel::kPsi], 1e-12) << name << plant_model;
    EXPECT_NEAR(dx[kU], expected[vessel::kSurge], 1e-12) << name << plant_model;
    EXPECT_NEAR(-dx[kV], expected[vessel::kSway], 1e-12) << name << plant_model;
    EXPECT_NEAR(-dx[kR], expected[vessel::kYawRate], 1e-12) << name << plant_model;
  }
}

}  // namespace
}  // namespace otter_nav::plant
