// What recorder_node is told, all of it by launch/record.launch.
#pragma once

#include <string>
#include <vector>

#include "otter_nav/config/fields.hpp"

namespace otter_nav::nodes {

struct RecorderNodeOptions {
  std::string file;
  std::vector<std::string> topics;
  std::vector<std::string> paced = {"odom", "tracker_cycle"};

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("file", o.file, "bag to write");
    fields.texts("topics", o.topics, "to record");
    fields.texts("paced", o.paced,
                 "of these: what has to be there before it says that it listens, and what it must "
                 "have up to a scan's stamp before it acknowledges the scan in lockstep");
  }
};

}  // namespace otter_nav::nodes
