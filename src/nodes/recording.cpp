#include "recording.hpp"

#include <ros/console.h>
#include <rosbag/exceptions.h>
#include <std_msgs/Header.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace otter_nav::nodes {
namespace {

constexpr std::size_t kStampBytes = 12;  // sequence, seconds, nanoseconds

// Whether a message begins with a header, by its definition's first field.
bool beginsWithHeader(const std::string& definition) {
  std::istringstream lines(definition);
  std::string line;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string type;
    if (words >> type && type[0] != '#' && line.find('=') == std::string::npos) {
      return type == "Header" || type == "std_msgs/Header";
    }
  }
  return false;
}

}  // namespace

Status Recording::open(const std::string& file) {
  file_ = file;
  std::error_code error;
  if (std::filesystem::exists(file + ".active", error)) {
    return failure(file +
                   ".active: is there, perhaps of a recording that was cut off: move it away");
  }
  try {
    bag_.open(file + ".active", rosbag::bagmode::Write);
    bag_.setCompression(rosbag::compression::LZ4);
  } catch (const rosbag::BagException& refused) {
    return failure(file + ": cannot be written: " + refused.what());
  }
  return {};
}

std::optional<Recording::Stamp> Recording::stampOf(const topic_tools::ShapeShifter& message) {
  const std::string& type = message.getDataType();
  const auto known = has_header_.find(type);
  const bool has = known != has_header_.end()
                       ? known->second
                       : (has_header_[type] = beginsWithHeader(message.getMessageDefinition()));
  if (!has || message.size() < kStampBytes) {
    return std::nullopt;
  }
  buffer_.resize(message.size());
  ros::serialization::OStream out(buffer_.data(), message.size());
  message.write(out);
  ros::serialization::IStream in(buffer_.data(), kStampBytes);
  Stamp stamp;
  ros::serialization::deserialize(in, stamp.sequence);
  ros::serialization::deserialize(in, stamp.time);
  return stamp;
}

void Recording::count(const std::string& topic, const std::string& sender, const Stamp& stamp) {
  // Its first one, or one to a new subscriber alone, which bears no number of the row.
  if (stamp.sequence == 0) {
    return;
  }
  const auto [entry, first] = lines_.try_emplace({topic, sender});
  Line& line = entry->second;
  // A sender that begins anew counts from the beginning.
  const std::uint32_t step = stamp.sequence - line.last.sequence;
  if (!first && stamp.sequence > line.last.sequence && step > 1) {
    line.lost += step - 1;
    if (line.gaps++ == 0) {
      line.first_gap_from = line.last.time;
      line.first_gap_to = stamp.time;
      ROS_ERROR_STREAM("Recording: " << step - 1 << " messages of " << topic << " lost between "
                                     << line.last.time << " s and " << stamp.time << " s");
    }
  }
  line.last = stamp;
}

void Recording::put(const std::string& topic, const Event& event, const ros::Time& time) {
  bag_.write(topic, time, *event.getMessage(), event.getConnectionHeaderPtr());
  ++messages_;
}

std::optional<Recording::Stamp> Recording::write(const std::string& topic, const Event& event,
                                                 const ros::Time& now) {
  const std::optional<Stamp> stamp = stampOf(*event.getMessage());
  if (stamp) {
    count(topic, event.getPublisherName(), *stamp);
  }
  if (now.isZero()) {
    held_.push_back({topic, event});
    return stamp;
  }
  last_time_ = now;
  for (const Held& held : held_) {
    put(held.topic, held.event, now);
  }
  held_.clear();
  put(topic, event, now);
  return stamp;
}

void Recording::note(const std::string& topic, const std::string& text) {
  namespace traits = ros::message_traits;
  std_msgs::String message;
  message.data = text;
  const auto header = boost::make_shared<ros::M_string>();
  *header = {{"latching", "1"},
             {"type", traits::datatype(message)},
             {"md5sum", traits::md5sum(message)},
             {"message_definition", traits::definition(message)}};
  bag_.write(topic, std::max(last_time_, ros::TIME_MIN), message, header);
}

std::string Recording::lost() const {
  std::ostringstream out;
  for (const auto& [key, line] : lines_) {
    if (line.lost > 0) {
      out << line.lost << " messages of " << key.first << " from " << key.second << " in "
          << line.gaps << " gaps, the first between " << line.first_gap_from << " s and "
          << line.first_gap_to << " s\n";
    }
  }
  return out.str();
}

Status Recording::close(const std::string& gaps_topic) {
  try {
    const ros::Time end = std::max(last_time_, ros::TIME_MIN);
    for (const Held& held : held_) {
      put(held.topic, held.event, end);
    }
    held_.clear();
    if (const std::string text = lost(); !text.empty()) {
      std_msgs::String message;
      message.data = text;
      bag_.write(gaps_topic, end, message);
    }
    bag_.close();
    std::filesystem::rename(file_ + ".active", file_);
  } catch (const std::exception& error) {
    return failure(file_ + ": " + error.what());
  }
  return {};
}

}  // namespace otter_nav::nodes
