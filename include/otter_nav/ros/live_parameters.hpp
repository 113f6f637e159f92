// A node's parameters while it runs: what may change then does, by dynamic_reconfigure
// (rqt_reconfigure, dynparam) or on the parameter server, after the strict reading of the start;
// for what may not, the log says that the change has no effect.
#pragma once

#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/field_list.hpp"
#include "otter_nav/config/section.hpp"

namespace otter_nav::ros_bridge {

class LiveParameters {
 public:
  // Reads all the node's parameters and takes over what may change; an error leaves all as it was.
  using Apply = std::function<Status(config::Section)>;

  // `live`: what may change, by its path below the node's name. It is known by its last key (and
  // index), which has to be its own. `in_force`, a latched std_msgs/String, is told all parameters
  // as YAML, now and after each change.
  LiveParameters(std::vector<config::NumberField> live, Apply apply,
                 const ros::Publisher& in_force);

 private:
  struct Change {
    std::string path;
    double value;
  };

  void advertise();
  bool onRequest(dynamic_reconfigure::ReconfigureRequest& request,
                 dynamic_reconfigure::ReconfigureResponse& response);
  // What somebody set on the parameter server meanwhile.
  void poll();
  void change(const std::vector<Change>& changes);
  void warnOf(const std::string& path) const;
  // Once for each: it has no parameter there.
  void warnOfUnknown(const std::string& path);
  void tell();
  [[nodiscard]] dynamic_reconfigure::Config values() const;

  ros::NodeHandle node_{"~"};
  std::vector<config::NumberField> live_;
  Apply apply_;
  XmlRpc::XmlRpcValue seen_;       // as the server had them when last looked at, and warned of
  XmlRpc::XmlRpcValue in_force_;   // as the node has them
  std::set<std::string> unknown_;  // set by somebody, and said
  ros::Publisher told_;
  ros::Publisher description_publisher_;
  ros::Publisher update_publisher_;
  ros::ServiceServer service_;
  ros::WallTimer timer_;
};

}  // namespace otter_nav::ros_bridge
