// What traffic_node is told: config/traffic_node.yaml. How it tracks is in config/traffic.yaml.
#pragma once

#include <string>

namespace otter_nav::nodes {

struct TrafficNodeOptions {
  std::string vessel = "otter_gazebo";

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("vessel", o.vessel,
           "a name of config/vessels, or a file: echoes of its hull are dropped");
  }
};

}  // namespace otter_nav::nodes
