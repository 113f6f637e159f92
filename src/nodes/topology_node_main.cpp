#include "otter_nav/ros/run_node.hpp"
#include "topology_node.hpp"

int main(int argc, char** argv) {
  return otter_nav::ros_bridge::runNode<otter_nav::nodes::TopologyNode>(argc, argv,
                                                                        "topology_node");
}
