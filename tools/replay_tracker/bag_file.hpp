// A bag's messages in the order in which they were written. rosbag::View sorts by time, which mixes
// the runs of a bag whose clock was set back, and reads nothing of a bag without an index.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"

namespace otter_nav::ros_bridge {

struct BagMessage {
  const std::string& topic;
  const std::string& type;
  const std::string& md5;
  double received_s;
  const std::uint8_t* data;
  std::uint32_t size;
};

// Calls `take` for each message, until it fails. Errors name the file and what is wrong with it: no
// such file, empty, no bag, without an index, damaged or cut off. With `partial` what is before the
// cut is read, and the result is a note about it; empty for a whole bag. Format: bag 2.0.
[[nodiscard]] Result<std::string> readBagFile(const std::string& path, bool partial,
                                              const std::function<Status(const BagMessage&)>& take);

}  // namespace otter_nav::ros_bridge
