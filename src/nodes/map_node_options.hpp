// What map_node is told: config/map_node.yaml. What the map believes is in config/map.yaml.
#pragma once

#include <string>

namespace otter_nav::nodes {

struct MapNodeOptions {
  std::string chart;
  std::string scenario;
  std::string vessel = "otter_gazebo";

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("chart", o.chart, "map_server's YAML, or an OctoMap (.bt, .ot); empty: the scenario's");
    fields("scenario", o.scenario, "file, whose chart it is; empty: the chart above");
    fields("vessel", o.vessel,
           "a name of config/vessels, or a file: echoes of its hull are dropped");
  }
};

}  // namespace otter_nav::nodes
