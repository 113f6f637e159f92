// The bag a recording goes to, and what of it was lost on the way: every topic whose messages carry
// a header is counted by the sender's sequence numbers.
#pragma once

#include <ros/message_event.h>
#include <rosbag/bag.h>
#include <topic_tools/shape_shifter.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"

namespace otter_nav::nodes {

class Recording {
 public:
  using Event = ros::MessageEvent<topic_tools::ShapeShifter const>;
  struct Stamp {
    std::uint32_t sequence = 0;
    ros::Time time;
  };

  // Writes to FILE.active, which becomes FILE when it is closed. An error says why it can't; one
  // that is there already may be all that is left of an earlier recording.
  [[nodiscard]] Status open(const std::string& file);
  // The message's stamp, if its type has one. What comes before there is a time (a simulator's
  // clock stands still yet) waits for it. Throws rosbag::BagException where the disk refuses.
  std::optional<Stamp> write(const std::string& topic, const Event& event, const ros::Time& now);
  // A latched text that nobody publishes. Throws as write().
  void note(const std::string& topic, const std::string& text);
  // Writes the index; what was lost is a last message on `recording_gaps`.
  [[nodiscard]] Status close(const std::string& gaps_topic);

  [[nodiscard]] std::uint64_t messages() const { return messages_; }
  // One line a topic and sender; empty if nothing was lost.
  [[nodiscard]] std::string lost() const;

 private:
  struct Held {
    std::string topic;
    Event event;
  };
  struct Line {  // of one sender on one topic
    Stamp last;
    std::uint64_t lost = 0;
    std::uint64_t gaps = 0;
    ros::Time first_gap_from;
    ros::Time first_gap_to;
  };
  [[nodiscard]] std::optional<Stamp> stampOf(const topic_tools::ShapeShifter& message);
  void count(const std::string& topic, const std::string& sender, const Stamp& stamp);
  void put(const std::string& topic, const Event& event, const ros::Time& time);

  std::string file_;
  rosbag::Bag bag_;
  std::vector<Held> held_;
  std::vector<std::uint8_t> buffer_;
  std::map<std::string, bool> has_header_;  // by type
  std::map<std::pair<std::string, std::string>, Line> lines_;
  std::uint64_t messages_ = 0;
  ros::Time last_time_;
};

}  // namespace otter_nav::nodes
