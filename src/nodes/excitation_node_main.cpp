#include "excitation_node.hpp"
#include "otter_nav/ros/run_node.hpp"

int main(int argc, char** argv) {
  return otter_nav::ros_bridge::runNode<otter_nav::nodes::ExcitationNode>(argc, argv,
                                                                          "excitation_node");
}
