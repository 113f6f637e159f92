#include <nav_msgs/Odometry.h>
#include <otter_nav/NearObstacles.h>
#include <otter_nav/ThrusterCommand.h>
#include <otter_nav/TrackerCycle.h>
#include <otter_nav/Trajectory.h>
#include <std_msgs/String.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/near_obstacles.hpp"
#include "otter_nav/ros/trajectories.hpp"
#include "replay_tracker/bag_file.hpp"
#include "replay_tracker/recorded_run.hpp"

namespace otter_nav::replay {
namespace {

using ros_bridge::BagMessage;

constexpr double kJumpBackS = 1.0;  // a clock set back by more begins another run
constexpr double kRunsDownS = 1.0;  // the nodes of a run that is ended go down within this

std::string lastName(const std::string& topic) {
  return topic.substr(topic.rfind('/') + 1);
}
// What is before a relative name; "" for none.
std::string prefixOf(const std::string& topic, const std::string& name) {
  return topic.size() > name.size() ? topic.substr(0, topic.size() - name.size() - 1) : "";
}
bool endsWith(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

template <typename Message>
bool isA(const BagMessage& message) {
  return message.type == ros::message_traits::datatype<Message>();
}

// The message, or why it can't be read: another version's definition, or damage.
template <typename Message>
Result<Message> decode(const BagMessage& from) {
  if (from.md5 != ros::message_traits::md5sum<Message>()) {
    return failure(from.topic + " holds " + from.type +
                   " of another version, whose fields differ from this one's");
  }
  Message message;
  try {
    ros::serialization::IStream in(const_cast<std::uint8_t*>(from.data), from.size);
    ros::serialization::deserialize(in, message);
  } catch (const std::exception& error) {
    return failure(from.topic + ": a message is damaged: " + error.what());
  }
  return message;
}

// One vessel's messages, cut into runs.
class Vessel {
 public:
  Vessel() { begin(); }

  Status take(const BagMessage& from, const std::string& name, std::size_t position) {
    if (isA<std_msgs::String>(from)) {
      return decode<std_msgs::String>(from).map([&](const std_msgs::String& message) {
        (name == "vessel" ? vessel_ : parameters_) = message.data;
      });
    }
    if (isA<Trajectory>(from)) {
      return decode<Trajectory>(from).and_then(
          [&](const Trajectory& message) { return takeOrder(message, position); });
    }
    if (isA<NearObstacles>(from)) {
      return decode<NearObstacles>(from).map(
          [&](const NearObstacles& message) { takeNearObstacles(message, position); });
    }
    if (isA<TrackerCycle>(from)) {
      return decode<TrackerCycle>(from).map(
          [&](const TrackerCycle& message) { takeCycle(message, position); });
    }
    if (isA<ThrusterCommand>(from)) {
      return decode<ThrusterCommand>(from).map(
          [&](const ThrusterCommand& message) { takeCommand(message, position); });
    }
    return decode<nav_msgs::Odometry>(from).map(
        [&](const nav_msgs::Odometry& message) { takeOdometry(message); });
  }

  [[nodiscard]] std::vector<RecordedRun> finish() && {
    std::vector<RecordedRun> full;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      RecordedRun& run = runs_[i];
      if (run.cycles.empty()) {
        run.cycles = std::move(commands_[i]);
        run.from_commands = true;
      }
      if (run.parameters.empty()) {
        run.parameters = parameters_;
      }
      if (run.vessel.empty()) {
        run.vessel = vessel_;
      }
      if (!run.odometry.empty() || !run.cycles.empty()) {
        full.push_back(std::move(run));
      }
    }
    return full;
  }

 private:
  RecordedRun& run() { return runs_.back(); }
  // What lies near goes on being so for another tracker.
  void begin() {
    RecordedRun next;
    if (!runs_.empty() && !run().near.empty()) {
      next.near.push_back(run().near.back());
    }
    runs_.push_back(std::move(next));
    commands_.emplace_back();
  }

  void takeOdometry(const nav_msgs::Odometry& message) {
    const auto sample =
        ros_bridge::odometrySample(message, message.header.frame_id, message.child_frame_id);
    if (!sample) {
      return;  // the node refuses it as well
    }
    if (!run().odometry.empty() && sample->stamp_s < run().odometry.back().stamp_s - kJumpBackS) {
      begin();
    }
    if (run().odometry.empty() || sample->stamp_s >= run().odometry.back().stamp_s) {
      run().odometry.push_back({sample->stamp_s, sample->state, -sample->pitch_rad});
    }
  }

  Status takeOrder(const Trajectory& message, std::size_t position) {
    if (const auto timed = ros_bridge::toTrajectory(message, message.header.frame_id)) {
      run().orders.push_back({message.id, position, *timed});
    }
    return {};  // the node refuses what is none
  }

  void takeNearObstacles(const NearObstacles& message, std::size_t position) {
    if (const auto near = ros_bridge::toNearObstacles(message, message.header.frame_id)) {
      run().near.push_back({message.id, position, *near});
    }
  }

  void takeCycle(const TrackerCycle& message, std::size_t position) {
    if (message.cycle == 0) {
      return;  // says only that it is there
    }
    RecordedCycle cycle;
    cycle.time_s = message.time;
    cycle.number = message.cycle;
    cycle.odometry_taken = message.odometry_taken;
    cycle.odometry_stamp_s = message.odometry_time;
    cycle.order_taken = message.trajectory_taken;
    cycle.near_taken = message.near_obstacles_taken;
    const auto& w = message.weights;
    cycle.weights = {w[0], w[1], w[2], w[3], w[4], w[5]};
    cycle.position = position;
    cycle.thrusts_n = {message.left, message.right};
    cycle.reference = Eigen::Map<const vessel::State>(message.reference.data());
    cycle.estimate = Eigen::Map<const vessel::State>(message.estimate.data());
    cycle.disturbance.force_n = {message.force[0], message.force[1]};
    cycle.disturbance.moment_nm = message.force[2];
    cycle.disturbance.wind_mps = {message.wind[0], message.wind[1]};
    cycle.disturbance.current_mps = {message.current[0], message.current[1]};
    cycle.tracking = message.state == "tracking" || message.state == "holding";
    const std::vector<RecordedCycle>& cycles = run().cycles;
    if (!cycles.empty() && cycle.number <= cycles.back().number) {
      const double later_s = cycle.time_s - cycles.back().time_s;
      if (later_s <= 0.0 && later_s >= -kJumpBackS) {
        return;  // sent again
      }
      // Another tracker. Where its clock goes on, it may have had the last odometry already.
      std::vector<RecordedOdometry> shared;
      if (later_s > 0.0) {
        constexpr std::ptrdiff_t kShared = 1000;
        const std::vector<RecordedOdometry>& before = run().odometry;
        shared.assign(before.end() - std::min(kShared, std::ptrdiff_t(before.size())),
                      before.end());
      }
      begin();
      run().odometry = std::move(shared);
    }
    if (run().cycles.empty()) {
      run().parameters = parameters_;
      run().vessel = vessel_;
    }
    run().cycles.push_back(cycle);
  }

  // Stands in for cycles where there are none.
  void takeCommand(const ThrusterCommand& message, std::size_t position) {
    RecordedCycle cycle;
    cycle.time_s = message.header.stamp.toSec();
    cycle.position = position;
    cycle.thrusts_n = {message.left, message.right};
    if (!commands_.back().empty() && cycle.time_s <= commands_.back().back().time_s) {
      if (cycle.time_s >= commands_.back().back().time_s - kJumpBackS) {
        return;
      }
      if (!run().odometry.empty() && run().odometry.back().stamp_s > cycle.time_s + kJumpBackS) {
        begin();
      }
    }
    cycle.odometry_stamp_s = run().odometry.empty() ? 0.0 : run().odometry.back().stamp_s;
    cycle.order_taken = run().orders.empty() ? 0 : run().orders.back().id;
    cycle.near_taken = run().near.empty() ? 0 : run().near.back().id;
    cycle.odometry_taken = run().odometry.size();
    commands_.back().push_back(cycle);
  }

  std::vector<RecordedRun> runs_;
  std::vector<std::vector<RecordedCycle>> commands_;  // of each run
  std::string parameters_;
  std::string vessel_;
};

// The relative name of what is of use; empty for the rest.
std::string usefulName(const BagMessage& message, const std::string& odometry) {
  if (isA<TrackerCycle>(message) || isA<Trajectory>(message) || isA<NearObstacles>(message) ||
      isA<ThrusterCommand>(message)) {
    return lastName(message.topic);
  }
  if (isA<nav_msgs::Odometry>(message)) {
    return endsWith("/" + message.topic, "/" + odometry) ? odometry : "";
  }
  if (isA<std_msgs::String>(message)) {
    const std::string parameters = "tracker_node/parameters";
    return endsWith(message.topic, "/" + parameters) ? parameters
           : lastName(message.topic) == "vessel"     ? "vessel"
                                                     : "";
  }
  return {};
}

std::string list(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text.empty() ? "nothing" : text;
}

// Whether one has that number; zero is none.
template <typename Recorded>
bool has(const std::vector<Recorded>& all, std::uint32_t id) {
  return id == 0 || std::any_of(all.begin(), all.end(),
                                [&](const Recorded& recorded) { return recorded.id == id; });
}

// The recorder may have had a step before what the step was made with; where the recording ends in
// between, the step has nothing to be made with. A run that is ended does so as well: a node that
// goes down may have served the tracker and not the recorder. Longer than `longest_s` it is a hole.
void endWithWhatIsThere(RecordedRun& run, double longest_s) {
  const double end_s = run.odometry.empty() ? 0.0 : run.odometry.back().stamp_s;
  const auto isThere = [&](const RecordedCycle& cycle) {
    return cycle.odometry_stamp_s <= end_s && has(run.orders, cycle.order_taken) &&
           has(run.near, cycle.near_taken);
  };
  const auto last = std::find_if(run.cycles.rbegin(), run.cycles.rend(), isThere);
  const auto left_out = std::distance(run.cycles.rbegin(), last);
  if (left_out > 0 && last != run.cycles.rend() &&
      run.cycles.back().time_s - last->time_s <= longest_s) {
    run.notes.push_back("the last " + std::to_string(left_out) +
                        " steps are left out: what they were made with is not in the recording");
    run.cycles.erase(last.base(), run.cycles.end());
  }
}

Status check(const RecordedRun& run, const std::string& path, bool partial,
             std::vector<std::string>& notes) {
  const auto missing = [&](const std::string& what) -> Status {
    if (!partial) {
      return failure(path + ": " + what);
    }
    notes.push_back(what);
    return {};
  };
  if (run.odometry.empty()) {
    return failure(path + ": no nav_msgs/Odometry that is a pose and a twist");
  }
  if (run.cycles.empty()) {
    return failure(path +
                   ": neither otter_nav/TrackerCycle nor otter_nav/ThrusterCommand: there is "
                   "nothing to compare with");
  }
  if (run.orders.empty()) {
    return failure(path + ": no otter_nav/Trajectory: there was nothing to track");
  }
  if (run.from_commands) {
    return missing(
        "no otter_nav/TrackerCycle: which odometry and trajectory each step was made with is not "
        "known; --partial goes by the order of recording");
  }
  if (run.cycles.front().number != 1) {
    return missing("the recording begins with step " + std::to_string(run.cycles.front().number) +
                   " of the tracker: what it knew by then is missing (mission.launch record:=... "
                   "waits for the recorder); --partial begins cold");
  }
  return {};
}

}  // namespace

Result<RecordedRun> readRun(const std::string& path, const ReadOptions& options) {
  std::map<std::string, Vessel> vessels;  // by prefix
  std::set<std::string> all;
  std::size_t position = 0;
  const Result<std::string> note =
      ros_bridge::readBagFile(path, options.partial, [&](const BagMessage& message) -> Status {
        ++position;
        all.insert(message.topic + " (" + message.type + ")");
        const std::string name = usefulName(message, options.odometry);
        if (name.empty()) {
          return {};
        }
        const Status status = vessels[prefixOf(message.topic, name)].take(message, name, position);
        if (!status && !options.partial) {
          return failure(path + ": " + status.error().message);
        }
        return {};
      });
  if (!note) {
    return failure(note.error().message);
  }
  if (all.empty()) {
    return failure(path + ": holds no messages");
  }
  const std::string wanted = options.name_space.empty() || options.name_space.front() == '/'
                                 ? options.name_space
                                 : "/" + options.name_space;
  std::map<std::string, std::vector<RecordedRun>> found;
  std::set<std::string> names;
  for (auto& [prefix, vessel] : vessels) {
    std::vector<RecordedRun> runs = std::move(vessel).finish();
    const bool moves = std::any_of(runs.begin(), runs.end(),
                                   [](const RecordedRun& run) { return !run.odometry.empty(); });
    if (moves && (wanted.empty() || prefix == wanted)) {
      found[prefix] = std::move(runs);
      names.insert("'" + prefix + "'");
    }
  }
  if (found.empty()) {
    return failure(path + ": no nav_msgs/Odometry on '" + options.odometry + "'" +
                   (wanted.empty() ? std::string() : " under '" + wanted + "'") + "; it holds " +
                   list(all));
  }
  if (found.size() > 1) {
    return failure(path + ": holds several vessels; choose one by --namespace: " + list(names));
  }
  std::vector<RecordedRun>& runs = found.begin()->second;
  if (options.run < 1 || options.run > static_cast<int>(runs.size())) {
    return failure(path + ": holds " + std::to_string(runs.size()) + " runs, none with number " +
                   std::to_string(options.run));
  }
  RecordedRun run = std::move(runs[static_cast<std::size_t>(options.run - 1)]);
  if (!note->empty()) {
    run.notes.push_back(*note);
  }
  endWithWhatIsThere(run, note->empty() ? kRunsDownS : std::numeric_limits<double>::infinity());
  if (runs.size() > 1) {
    run.notes.push_back("it holds " + std::to_string(runs.size()) + " runs; this is number " +
                        std::to_string(options.run));
  }
  if (const Status status = check(run, path, options.partial, run.notes); !status) {
    return failure(status.error().message + "; it holds " + list(all));
  }
  if (!run.parameters.empty()) {
    try {
      const YAML::Node node = YAML::Load(run.parameters);
      run.lockstep = !node["lockstep"] || node["lockstep"].as<bool>();
    } catch (const YAML::Exception& error) {
      return failure(path + ": tracker_node/parameters is no YAML: " + error.what());
    }
  }
  return run;
}

}  // namespace otter_nav::replay
