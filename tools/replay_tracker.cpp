// Feeds a recorded run to today's tracker and compares its commands with those recorded, or sails
// it again in closed loop with other options (docs/replay.md).
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "replay_tracker/recorded_run.hpp"
#include "replay_tracker/retrack.hpp"

namespace {

using namespace otter_nav;
using namespace otter_nav::replay;

struct Arguments {
  std::string bag;
  std::string out;
  std::string vessel;
  std::string hull = "model";
  std::vector<std::string> set;
  std::vector<std::string> tries;
  ReadOptions read;
  Window window;
  bool closed_loop = false;
};

void declare(CLI::App& app, Arguments& a) {
  app.add_option("--bag", a.bag, "recorded by mission.launch record:=... or record.launch")
      ->required();
  app.add_option("--out", a.out, "folder for replay.csv and replay.json")->required();
  app.add_option("--set", a.set, "KEY=VALUE over the recorded options: tracker.horizon_s=4");
  app.add_option("--from", a.window.from_s, "s, of the recording's time: what counts");
  app.add_option("--to", a.window.to_s, "s");
  app.add_option("--run", a.read.run, "which run of the bag, from 1")->capture_default_str();
  app.add_option("--namespace", a.read.name_space, "of the vessel, where the bag holds several");
  app.add_option("--odom-topic", a.read.odometry, "nav_msgs/Odometry")->capture_default_str();
  app.add_option("--vessel", a.vessel,
                 "a name of config/vessels, or a file, instead of the recorded one");
  app.add_flag("--partial", a.read.partial, "use what can be read of a bag that lacks something");
  auto* closed =
      app.add_flag("--closed-loop", a.closed_loop,
                   "sail the recorded trajectories again on a simulated vessel, under the "
                   "disturbance estimated in the recording");
  app.add_option("--on", a.hull, "what sails in closed loop: the vessel's model, or its plant")
      ->check(CLI::IsMember({"model", "plant"}))
      ->needs(closed)
      ->capture_default_str();
  app.add_option("--try", a.tries,
                 "KEY=VALUE[,KEY=VALUE]: another row of the table with these options; repeat it")
      ->needs(closed);
}

// tracker.a.b=value in a node of the tracker's options.
Status assign(YAML::Node options, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string prefix = "tracker.";
  if (equals == std::string::npos || text.rfind(prefix, 0) != 0) {
    return failure("'" + text + "' is not of the form tracker.KEY=VALUE");
  }
  std::string path = text.substr(prefix.size(), equals - prefix.size());
  YAML::Node at = options;
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.')) {
    const std::string key = path.substr(0, dot);
    if (!at.IsMap() || !at[key]) {
      return failure("'" + text + "': the tracker has no options '" + key + "'");
    }
    at.reset(at[key]);
    path = path.substr(dot + 1);
  }
  if (!at.IsMap() || !at[path]) {
    return failure("'" + text + "': the tracker has no option '" + path + "'");
  }
  at[path] = text.substr(equals + 1);
  return {};
}

// Of `from`, what is in `to` as well; what is in one of them alone is named in `differ`.
void overlay(const YAML::Node& from, YAML::Node to, const std::string& where,
             std::vector<std::string>& differ) {
  for (const auto& entry : from) {
    const auto key = entry.first.as<std::string>();
    if (!to[key]) {
      differ.push_back(where + key);
    } else if (entry.second.IsMap()) {
      overlay(entry.second, to[key], where + key + ".", differ);
    } else {
      to[key] = entry.second;
    }
  }
  for (const auto& entry : to) {
    const auto key = entry.first.as<std::string>();
    if (!from[key]) {
      differ.push_back(where + key);
    }
  }
}

// The recorded options; the shipped ones where none are recorded. Those of another version are an
// error, or with `partial` the shipped ones stand where the two differ.
Result<YAML::Node> optionsOf(const RecordedRun& run, bool partial,
                             std::vector<std::string>& notes) {
  const YAML::Node shipped = YAML::Load(config::toYaml(tracker::Options{}));
  if (run.parameters.empty()) {
    return shipped;
  }
  const YAML::Node recorded = YAML::Load(run.parameters)["tracker"];
  if (!recorded || !recorded.IsMap()) {
    return failure("tracker_node/parameters has no options of the tracker");
  }
  YAML::Node both = YAML::Clone(shipped);
  std::vector<std::string> differ;
  overlay(recorded, both, "tracker.", differ);
  std::string names;
  for (const std::string& name : differ) {
    names += (names.empty() ? "" : ", ") + name;
  }
  if (!differ.empty()) {
    const std::string what =
        "recorded by another version, whose tracker has other options: " + names;
    if (!partial) {
      return failure(what + "; --partial takes the shipped ones for these");
    }
    notes.push_back(what);
  }
  return both;
}

const std::map<std::string, double tracker::Weights::*> kWeights = {
    {"position", &tracker::Weights::position}, {"heading", &tracker::Weights::heading},
    {"surge", &tracker::Weights::surge},       {"sway", &tracker::Weights::sway},
    {"yaw_rate", &tracker::Weights::yaw_rate}, {"thrust", &tracker::Weights::thrust}};

Result<Settings> settingsWith(const YAML::Node& recorded, const std::vector<std::string>& changes) {
  const std::string weights = "tracker.flatness.";
  YAML::Node node = YAML::Clone(recorded);
  std::vector<double tracker::Weights::*> pinned;
  for (const std::string& change : changes) {
    if (const Status status = assign(node, change); !status) {
      return failure(status.error().message);
    }
    if (change.rfind(weights, 0) == 0) {
      pinned.push_back(
          kWeights.at(change.substr(weights.size(), change.find('=') - weights.size())));
    }
  }
  return config::read<tracker::Options>(config::Section(node, "the tracker's options"))
      .map([&](const tracker::Options& options) {
        return Settings{options, pinned};
      });
}

Result<vessel::Parameters> vesselOf(const RecordedRun& run, const std::string& given) {
  if (!given.empty()) {
    return vessel::loadParameters(given);
  }
  if (run.vessel.empty()) {
    return failure("the recording does not say which vessel it is; give --vessel");
  }
  return vessel::readParameters(config::Section(YAML::Load(run.vessel), "the recorded vessel"));
}

Status writeCsv(const std::string& path, const std::vector<Step>& steps) {
  std::ofstream out(path);
  out << "t,left_recorded_n,right_recorded_n,left_recomputed_n,right_recomputed_n,"
         "x_ref,y_ref,psi_ref,u_ref,v_ref,r_ref,x,y,psi,u,v,r,x_true,y_true,psi_true,error_m,"
         "force_x_n,force_y_n,moment_nm,wind_x_mps,wind_y_mps,current_x_mps,current_y_mps,state,"
         "solver\n"
      << std::setprecision(17);
  for (const Step& s : steps) {
    const tracker::Command& c = s.command;
    out << s.recorded.time_s << ',' << s.recorded.thrusts_n[0] << ',' << s.recorded.thrusts_n[1]
        << ',' << c.thrusts[0] << ',' << c.thrusts[1];
    for (const vessel::State* state : {&c.reference, &c.estimate}) {
      for (int i = 0; i < vessel::kStateSize; ++i) {
        out << ',' << (*state)[i];
      }
    }
    out << ',' << s.truth[0] << ',' << s.truth[1] << ',' << s.truth[2] << ',' << c.tracking_error_m
        << ',' << c.outside_force_n.x() << ',' << c.outside_force_n.y() << ','
        << c.outside_moment_nm << ',' << c.disturbance.mean.wind_mps.x() << ','
        << c.disturbance.mean.wind_mps.y() << ',' << c.disturbance.mean.current_mps.x() << ','
        << c.disturbance.mean.current_mps.y() << ',' << tracker::name(c.mode) << ','
        << tracker::name(c.solver) << '\n';
  }
  out.close();
  return out ? Status{} : failure(path + ": cannot be written");
}

nlohmann::json toJson(const Figures& f, const std::string& setting) {
  return {{"setting", setting},
          {"steps", f.steps},
          {"difference_max_n", f.difference_max_n},
          {"difference_max_time_s", f.difference_max_time_s},
          {"difference_rms_n", f.difference_rms_n},
          {"tracking_error_mean_m", f.error_mean_m},
          {"tracking_error_max_m", f.error_max_m},
          {"thrust_rms_n", f.thrust_rms_n},
          {"thrust_rate_rms_nps", f.thrust_rate_rms_nps},
          {"thrust_saturated_share", f.saturated_share},
          {"yaw_rate_rms_radps", f.yaw_rate_rms_radps}};
}

Status writeJson(const std::string& path, const nlohmann::json& json) {
  std::ofstream out(path);
  out << json.dump(2) << '\n';
  out.close();
  return out ? Status{} : failure(path + ": cannot be written");
}

void printEstimate(const std::vector<Step>& steps) {
  const tracker::Command& c = steps.back().command;
  std::printf(
      "Estimate at the end: force %.2f %.2f N (wind's included), moment %.2f N m, "
      "wind %.2f %.2f m/s, current %.3f %.3f m/s\n",
      c.outside_force_n.x(), c.outside_force_n.y(), c.outside_moment_nm,
      c.disturbance.mean.wind_mps.x(), c.disturbance.mean.wind_mps.y(),
      c.disturbance.mean.current_mps.x(), c.disturbance.mean.current_mps.y());
  Eigen::Vector3d worst = Eigen::Vector3d::Zero();
  double off_m = 0.0;
  for (const Step& s : steps) {
    off_m = std::max(off_m, (s.command.estimate - s.recorded.estimate).head<2>().norm());
    const Eigen::Vector3d d(
        (s.command.disturbance.mean.force_n - s.recorded.disturbance.force_n).norm(),
        std::abs(s.command.disturbance.mean.moment_nm - s.recorded.disturbance.moment_nm),
        (s.command.disturbance.mean.wind_mps - s.recorded.disturbance.wind_mps).norm());
    worst = worst.cwiseMax(d);
  }
  std::printf("Estimates differ from the recorded by at most %.3g m, %.3g N, %.3g N m, %.3g m/s\n",
              off_m, worst[0], worst[1], worst[2]);
}

Status compare(const Arguments& a, const RecordedRun& run, const vessel::Parameters& vessel,
               const Settings& settings, std::vector<std::string>& notes) {
  const bool as_it_was = a.set.empty() && a.vessel.empty() && !a.read.partial;
  const auto steps = retrack(run, settings, vessel, a.window,
                             as_it_was ? Sent::kOwn : Sent::kRecorded, a.read.partial, notes);
  if (!steps) {
    return failure(a.bag + ": " + steps.error().message);
  }
  const Figures f = figures(*steps, vessel.thrusters);
  std::printf(
      "%zu steps, %.3f s to %.3f s, %s, %s%s\n", f.steps, steps->front().recorded.time_s,
      steps->back().recorded.time_s, vessel.name.c_str(), run.lockstep ? "lockstep" : "real time",
      a.set.empty() ? ""
                    : ", options changed: what they ask for where the vessel was, not where it "
                      "would have gone");
  std::printf("Commands differ from the recorded by at most %.3g N (at %.3f s), rms %.3g N\n",
              f.difference_max_n, f.difference_max_time_s, f.difference_rms_n);
  if (!run.from_commands) {
    printEstimate(*steps);
  }
  std::printf("Saturated: %.2f %% of the commands\n", 100.0 * f.saturated_share);
  nlohmann::json json = toJson(f, "recorded motion");
  json["notes"] = notes;
  const Status status = writeJson(a.out + "/replay.json", json);
  return status ? writeCsv(a.out + "/replay.csv", *steps) : status;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    parts.push_back(part);
  }
  return parts;
}

Status sail(const Arguments& a, const RecordedRun& run, const vessel::Parameters& vessel,
            const YAML::Node& recorded, const std::vector<std::string>& notes) {
  if (run.from_commands) {
    return failure(a.bag +
                   ": closed loop needs otter_nav/TrackerCycle: without it no disturbance "
                   "was estimated");
  }
  struct Row {
    std::string setting;
    std::vector<std::string> changes;
  };
  std::vector<Row> rows = {{a.set.empty() ? "as recorded" : "", a.set}};
  for (const std::string& change : a.set) {
    rows[0].setting += (rows[0].setting.empty() ? "" : ",") + change;
  }
  for (const std::string& text : a.tries) {
    rows.push_back({text, a.set});
    for (std::string& change : split(text)) {
      rows.back().changes.push_back(std::move(change));
    }
  }
  const Hull hull = a.hull == "plant" ? Hull::kPlant : Hull::kModel;
  std::printf(
      "Simulated, not what the vessel did: the recorded trajectories on %s of %s, under the "
      "disturbance estimated in the recording\n",
      a.hull == "plant" ? "the plant" : "the model", vessel.name.c_str());
  std::printf("%11s %10s %10s %14s %10s %12s  %s\n", "mean err m", "max err m", "thrust N",
              "thrust N/s", "saturated", "yaw rad/s", "setting");
  nlohmann::json json = {{"simulated", true}, {"hull", a.hull}, {"notes", notes}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto settings = settingsWith(recorded, rows[i].changes);
    if (!settings) {
      return failure(settings.error().message);
    }
    const auto steps = sailAgain(run, *settings, vessel, hull, a.window);
    if (!steps) {
      return failure(a.bag + ": " + steps.error().message);
    }
    const Figures f = figures(*steps, vessel.thrusters);
    std::printf("%11.4f %10.4f %10.2f %14.2f %9.2f%% %12.4f  %s\n", f.error_mean_m, f.error_max_m,
                f.thrust_rms_n, f.thrust_rate_rms_nps, 100.0 * f.saturated_share,
                f.yaw_rate_rms_radps, rows[i].setting.c_str());
    json["settings"].push_back(toJson(f, rows[i].setting));
    const std::string name = i == 0 ? "/replay.csv" : "/replay_" + std::to_string(i + 1) + ".csv";
    if (const Status status = writeCsv(a.out + name, *steps); !status) {
      return status;
    }
  }
  return writeJson(a.out + "/replay.json", json);
}

Status run(const Arguments& a) {
  const Result<RecordedRun> recorded = readRun(a.bag, a.read);
  if (!recorded) {
    return failure(recorded.error().message);
  }
  std::vector<std::string> notes = recorded->notes;
  if (recorded->parameters.empty()) {
    const std::string what = "tracker_node/parameters is missing: the options are the shipped ones";
    if (!a.read.partial) {
      return failure(a.bag + ": " + what + "; --partial goes on with these");
    }
    notes.push_back(what);
  }
  const Result<vessel::Parameters> vessel = vesselOf(*recorded, a.vessel);
  const Result<YAML::Node> told = optionsOf(*recorded, a.read.partial, notes);
  if (!vessel || !told) {
    return failure(a.bag + ": " + (vessel ? told.error() : vessel.error()).message);
  }
  const Result<Settings> settings = settingsWith(*told, a.set);
  if (!settings) {
    return failure(settings.error().message);
  }
  std::error_code error;
  std::filesystem::create_directories(a.out, error);
  if (error) {
    return failure(a.out + ": " + error.message());
  }
  const Status status = a.closed_loop ? sail(a, *recorded, *vessel, *told, notes)
                                      : compare(a, *recorded, *vessel, *settings, notes);
  for (const std::string& note : notes) {
    std::printf("Note: %s\n", note.c_str());
  }
  return status;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Replays the tracking of a recorded run");
  Arguments arguments;
  declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  if (const Status status = run(arguments); !status) {
    std::fflush(stdout);
    std::cerr << "replay_tracker: " << status.error().message << '\n';
    return 1;
  }
  return 0;
} catch (const std::exception& e) {
  std::cerr << "replay_tracker: " << e.what() << '\n';
  return 1;
}
