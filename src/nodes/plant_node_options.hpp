// Reading of plant_node's parameters.
#pragma once

#include "otter_nav/plant/options.hpp"
#include "plant_node.hpp"

namespace otter_nav::nodes {

struct PlantNodeSetup {
  PlantNodeOptions node;
  plant::Options plant;
};
// Fills world and start from the scenario if there is one.
[[nodiscard]] Result<PlantNodeSetup> readPlantNodeSetup(config::Section section);

}  // namespace otter_nav::nodes
