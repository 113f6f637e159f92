#include "otter_nav/ros/run_node.hpp"
#include "traffic_node.hpp"

int main(int argc, char** argv) {
  return otter_nav::ros_bridge::runNode<otter_nav::nodes::TrafficNode>(argc, argv, "traffic_node");
}
