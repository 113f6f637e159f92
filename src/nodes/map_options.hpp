// How nodes with a copy of the map keep its distance field: config/planner_node.yaml and
// config/topology_node.yaml.
#pragma once

#include "otter_nav/config/fields.hpp"
#include "otter_nav/map/distance_field.hpp"

namespace otter_nav::nodes {

struct DistanceFieldSettings : map::DistanceFieldOptions {
  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("max_distance_m", o.max_distance_m, {1.0, 100.0},
           "distances to obstacles saturate here");
    fields("unknown_is_occupied", o.unknown_is_occupied, "what was never seen is an obstacle");
  }
};

// All of topology_node's wiring; the search is in config/topology.yaml.
struct TopologyNodeOptions {
  DistanceFieldSettings distance_field;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields.group("distance_field", o.distance_field, "");
  }
};

}  // namespace otter_nav::nodes
