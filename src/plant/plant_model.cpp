#include "otter_nav/plant/plant_model.hpp"

#include "gazebo_otter_model.hpp"
#include "kinematics.hpp"
#include "otter_model.hpp"
#include "planar_model.hpp"

namespace otter_nav::plant {

Vector6 PlantModel::poseRate(const PlantState& x) const {
  return levelPoseRate(x);
}

Result<std::unique_ptr<PlantModel>> makePlantModel(const Options& options) {
  const std::string& name = options.vessel.plant_model;
  if (name == "planar") {
    return std::make_unique<PlanarModel>(options.vessel);
  }
  if (name == "otter") {
    return std::make_unique<OtterModel>(options.payload, options.propeller_lag);
  }
  if (name == "otter_gazebo") {
    return std::make_unique<GazeboOtterModel>();
  }
  return failure("plant_model '" + name + "' is none of: planar, otter, otter_gazebo");
}

}  // namespace otter_nav::plant
