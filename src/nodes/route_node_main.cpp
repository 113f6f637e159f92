#include <ros/ros.h>

#include "route_node.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "route_node");
  const otter_nav::nodes::RouteNode node;
  ros::spin();
  return 0;
}
