// One call of a service.
#pragma once

#include <ros/node_handle.h>

#include <string>

namespace otter_nav::ros_bridge {

// Whether it was answered. The connection outlasts the answer: a server closes one for a single
// call as soon as it has sent it, and roscpp, where it hears of that first, says that nobody
// answered.
template <typename Service>
[[nodiscard]] bool callService(const std::string& name, Service& call) {
  constexpr bool kPersistent = true;
  return ros::NodeHandle().serviceClient<Service>(name, kPersistent).call(call);
}

}  // namespace otter_nav::ros_bridge
