#include "otter_nav/plant/plant_model.hpp"

#include "otter_nav/plant/gazebo_otter_model.hpp"
#include "otter_nav/plant/otter_model.hpp"

namespace otter_nav::plant {

Result<std::unique_ptr<PlantModel>> makePlantModel(const Options& options) {
  if (options.vessel == "otter") {
    return std::make_unique<OtterModel>(options.payload, options.propeller_lag);
  }
  if (options.vessel == "otter_gazebo") {
    return std::make_unique<GazeboOtterModel>();
  }
  return failure("vessel '" + options.vessel + "' is none of: otter, otter_gazebo");
}

}  // namespace otter_nav::plant
