#include "identify/bag_reader.hpp"

#include <nav_msgs/Odometry.h>
#include <otter_nav/ThrusterCommand.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <exception>
#include <vector>

#include "otter_nav/ros/conversions.hpp"

namespace otter_nav::ros_bridge {
namespace {

std::string bare(const std::string& topic) {
  return !topic.empty() && topic.front() == '/' ? topic.substr(1) : topic;
}

double stampOf(const std_msgs::Header& header, const rosbag::MessageInstance& instance) {
  return header.stamp.isZero() ? instance.getTime().toSec() : header.stamp.toSec();
}

// Calls take(message, instance) -> Status for every message of the topic.
template <typename Message, typename Take>
Status readTopic(const rosbag::Bag& bag, const std::string& path, const std::string& topic,
                 Take take) {
  rosbag::View view(bag, rosbag::TopicQuery({bare(topic), "/" + bare(topic)}));
  if (view.size() == 0) {
    std::string known;
    for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections()) {
      known += (known.empty() ? "" : ", ") + connection->topic;
    }
    return failure(path + ": no messages on topic '" + topic + "'; the bag has " +
                   (known.empty() ? "no topics" : known));
  }
  for (const rosbag::MessageInstance& instance : view) {
    const typename Message::ConstPtr message = instance.instantiate<Message>();
    if (!message) {
      return failure(path + ": topic '" + topic + "' holds " + instance.getDataType() + ", not " +
                     ::ros::message_traits::datatype<Message>());
    }
    const Status status = take(*message, instance);
    if (!status) {
      return failure(path + ", " + topic + " at stamp " +
                     std::to_string(stampOf(message->header, instance)) +
                     " s: " + status.error().message);
    }
  }
  return {};
}

Status readBag(const rosbag::Bag& bag, const std::string& path,
               identification::Recording& recording) {
  const Status odometry = readTopic<nav_msgs::Odometry>(
      bag, path, recording.odometry_name,
      [&](const nav_msgs::Odometry& message, const rosbag::MessageInstance& instance) -> Status {
        const Result<OdometrySample> sample =
            odometrySample(message, message.header.frame_id, message.child_frame_id);
        if (!sample) {
          return failure(sample.error().message);
        }
        recording.odometry.push_back({stampOf(message.header, instance), sample->state});
        return {};
      });
  if (!odometry) {
    return odometry;
  }
  return readTopic<otter_nav::ThrusterCommand>(
      bag, path, recording.command_name,
      [&](const otter_nav::ThrusterCommand& message,
          const rosbag::MessageInstance& instance) -> Status {
        recording.commands.push_back(
            {stampOf(message.header, instance), vessel::Thrusts(message.left, message.right)});
        return {};
      });
}

}  // namespace

Result<identification::Recording> loadBag(const std::string& path,
                                          const std::string& odometry_topic,
                                          const std::string& command_topic) {
  identification::Recording recording;
  recording.odometry_name = odometry_topic;
  recording.command_name = command_topic;
  try {
    rosbag::Bag bag(path, rosbag::bagmode::Read);
    const Status status = readBag(bag, path, recording);
    if (!status) {
      return failure(status.error().message);
    }
  } catch (const std::exception& error) {  // rosbag's, or of a message that breaks off
    return failure(path + ": cannot be read as a bag: " + error.what());
  }
  return recording;
}

}  // namespace otter_nav::ros_bridge
