#include "otter_nav/ros/run_node.hpp"
#include "plant_node.hpp"

int main(int argc, char** argv) {
  return otter_nav::ros_bridge::runNode<otter_nav::nodes::PlantNode>(argc, argv, "plant_node");
}
