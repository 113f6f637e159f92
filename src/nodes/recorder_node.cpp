// recorder_node: writes topics to a bag. In lockstep time waits for it, so nothing is lost at any
// speed; what is lost without is an error that says what. The bag is closed and indexed however the
// run ends. Parameters: launch/record.launch.
#include <ros/callback_queue.h>
#include <ros/names.h>
#include <ros/node_handle.h>
#include <ros/ros.h>
#include <std_msgs/Header.h>

#include <algorithm>
#include <csignal>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "otter_nav/config/fields.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/ros/parameters.hpp"
#include "recording.hpp"

namespace otter_nav::nodes {
namespace {

const std::string kScan = "scan";
const std::string kGaps = "recording_gaps";
constexpr double kQuietS = 0.3;  // of wall time without a message: nothing more is on its way
constexpr double kPatienceS = 5.0;

}  // namespace

// All of it is told by launch/record.launch.
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

class RecorderNode {
 public:
  [[nodiscard]] static Result<std::unique_ptr<RecorderNode>> create(config::Section section);
  ~RecorderNode();
  RecorderNode(const RecorderNode&) = delete;
  RecorderNode& operator=(const RecorderNode&) = delete;
  // 0 if the bag is closed and nothing was lost.
  [[nodiscard]] int exitCode() const { return failed_ ? 1 : 0; }
  // Takes what is still on its way, and closes the bag.
  void finish();

 private:
  explicit RecorderNode(RecorderNodeOptions options);

  [[nodiscard]] Status open() { return recording_.open(options_.file); }
  void listen();
  void onMessage(const std::string& topic, const Recording::Event& event);
  void take(const std::string& topic, const Recording::Event& event);
  // Says that it listens, once everything paced has come.
  void announce();
  // In lockstep: time may go on past the scans up to which everything is here.
  void acknowledge();

  RecorderNodeOptions options_;
  ros::NodeHandle node_;
  Recording recording_;
  std::map<std::string, ros::Time> paced_;  // last stamps, of what has come
  std::deque<ros::Time> scans_;             // not acknowledged yet
  ros::Publisher recording_publisher_;
  ros::Publisher acknowledgement_;
  std::vector<ros::Subscriber> subscribers_;
  bool announced_ = false;
  bool finished_ = false;
  bool failed_ = false;
};

Result<std::unique_ptr<RecorderNode>> RecorderNode::create(config::Section section) {
  const std::string where = section.where();
  Result<RecorderNodeOptions> options = config::read<RecorderNodeOptions>(std::move(section));
  if (!options) {
    return failure(options.error().message);
  }
  if (options->file.empty()) {
    return failure(where + ": parameter 'file' is empty: there is no bag to write");
  }
  for (const std::string& topic : options->topics) {
    std::string why;
    if (topic.empty() || topic[0] == '~') {
      why = "it is empty or begins with ~";
    }
    if (!why.empty() || !ros::names::validate(topic, why)) {
      return failure(where + ": parameter 'topics': '" + topic + "' is no topic's name: " + why);
    }
  }
  for (const std::string& topic : options->paced) {
    if (std::find(options->topics.begin(), options->topics.end(), topic) == options->topics.end()) {
      return failure(where + ": parameter 'paced': '" + topic + "' is none of 'topics'");
    }
  }
  std::unique_ptr<RecorderNode> node(new RecorderNode(*std::move(options)));
  if (const Status status = node->open(); !status) {
    node->finished_ = true;
    return failure(where + ": parameter 'file': " + status.error().message);
  }
  node->listen();
  return node;
}

RecorderNode::RecorderNode(RecorderNodeOptions options)
    : options_(std::move(options)),
      recording_publisher_(node_.advertise<std_msgs::Header>("recording", 1, true)),
      acknowledgement_(node_.advertise<std_msgs::Header>("lockstep_ack", 100)) {}

RecorderNode::~RecorderNode() {
  finish();
}

void RecorderNode::listen() {
  const ros::TransportHints no_delay = ros::TransportHints().tcpNoDelay();
  for (const std::string& topic : options_.topics) {
    ros::SubscribeOptions options;
    options.initByFullCallbackType<const Recording::Event&>(
        topic, 0, [this, topic](const Recording::Event& event) { onMessage(topic, event); });
    options.transport_hints = no_delay;
    subscribers_.push_back(node_.subscribe(options));
  }
}

void RecorderNode::onMessage(const std::string& topic, const Recording::Event& event) {
  if (failed_) {
    return;
  }
  try {
    take(topic, event);
  } catch (const std::exception& error) {
    failed_ = true;
    ROS_FATAL_STREAM("Recording: " << options_.file << ": " << error.what());
    ros::requestShutdown();
  }
}

void RecorderNode::take(const std::string& topic, const Recording::Event& event) {
  const std::optional<Recording::Stamp> stamp =
      recording_.write(node_.resolveName(topic), event, ros::Time::now());
  if (!stamp) {
    return;
  }
  if (std::find(options_.paced.begin(), options_.paced.end(), topic) != options_.paced.end()) {
    ros::Time& last = paced_[topic];
    last = std::max(last, stamp->time);
    announce();
    acknowledge();
  } else if (topic == kScan) {
    scans_.push_back(stamp->time);
    acknowledge();
  }
}

void RecorderNode::announce() {
  if (announced_ || paced_.size() < options_.paced.size()) {
    return;
  }
  announced_ = true;
  // The hull in rviz is a parameter, no topic.
  const std::string hull = "robot_description";
  std::string key;
  std::string text;
  if (node_.searchParam(hull, key) && node_.getParam(key, text)) {
    recording_.note(node_.resolveName(hull), text);
  }
  std_msgs::Header message;
  message.frame_id = ros_bridge::nodeName();
  recording_publisher_.publish(message);
  ROS_INFO_STREAM("Recording into " << options_.file);
}

void RecorderNode::acknowledge() {
  if (scans_.empty() || paced_.size() < options_.paced.size()) {
    return;
  }
  ros::Time until = ros::TIME_MAX;
  for (const auto& [topic, stamp] : paced_) {
    until = std::min(until, stamp);
  }
  std_msgs::Header message;
  while (!scans_.empty() && scans_.front() <= until) {
    message.stamp = std::max(message.stamp, scans_.front());
    scans_.pop_front();
  }
  if (!message.stamp.isZero()) {
    message.frame_id = ros_bridge::nodeName();
    acknowledgement_.publish(message);
  }
}

void RecorderNode::finish() {
  if (finished_) {
    return;
  }
  finished_ = true;
  // Until it is quiet; where the vessel sails on, until everything of before has come.
  const ros::Time asked = ros::Time::now();
  const ros::WallTime latest = ros::WallTime::now() + ros::WallDuration(kPatienceS);
  const auto whole = [&] {
    return paced_.size() == options_.paced.size() &&
           std::all_of(paced_.begin(), paced_.end(),
                       [&](const auto& last) { return last.second > asked; });
  };
  ros::CallbackQueue& queue = *ros::getGlobalCallbackQueue();
  std::uint64_t before = 0;
  do {
    before = recording_.messages();
    queue.callAvailable(ros::WallDuration(kQuietS));
  } while (!failed_ && recording_.messages() != before && !whole() &&
           ros::WallTime::now() < latest);
  const Status closed = recording_.close(node_.resolveName(kGaps));
  const std::string lost = recording_.lost();
  failed_ = failed_ || !closed || !lost.empty();
  if (!closed) {
    ROS_FATAL_STREAM("Recording: " << closed.error().message);
  } else if (!lost.empty()) {
    ROS_ERROR_STREAM("Recording: " << options_.file << " lacks\n" << lost);
  } else {
    ROS_INFO_STREAM("Recorded " << recording_.messages() << " messages into " << options_.file);
  }
}

}  // namespace otter_nav::nodes

namespace {

volatile std::sig_atomic_t asked_to_end = 0;
void end(int /*signal*/) {
  asked_to_end = 1;
}

}  // namespace

// Not ROS's own handler: that one cuts the connections first, and what is on its way is lost.
int main(int argc, char** argv) {
  ros::init(argc, argv, "record", ros::init_options::NoSigintHandler);
  std::signal(SIGINT, end);
  std::signal(SIGTERM, end);
  const ros::NodeHandle keep_alive;
  const auto node = otter_nav::ros_bridge::readSection(ros::NodeHandle("~"))
                        .and_then(otter_nav::nodes::RecorderNode::create);
  if (!node) {
    ROS_FATAL_STREAM(node.error().message);
    return 1;
  }
  constexpr double kLookS = 0.1;
  while (ros::ok() && asked_to_end == 0) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kLookS));
  }
  (*node)->finish();
  return (*node)->exitCode();
}
