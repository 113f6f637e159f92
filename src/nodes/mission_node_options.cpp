// What mission_node needs to begin: its parameters, and the files they name.
#include <utility>

#include "mission_node.hpp"
#include "otter_nav/config/share.hpp"

namespace otter_nav::nodes {
namespace {

std::string trackPath(const std::string& result) {
  const std::size_t dot = result.rfind('.');
  const std::size_t slash = result.rfind('/');
  const bool has_ending = dot != std::string::npos && (slash == std::string::npos || dot > slash);
  return (has_ending ? result.substr(0, dot) : result) + ".csv";
}

MissionNodeOptions readNodeOptions(config::Section& section) {
  MissionNodeOptions options;
  int seed = 0;
  section.read("scenario", options.label.scenario);
  section.read("mission", options.label.mission, {0.0, 1e6});
  section.read("vessel", options.label.vessel);
  section.read("disturbance", options.label.disturbance);
  section.read("seed", seed, {0.0, 2147483647.0});
  section.read("result", options.result);
  section.read("timeout_s", options.timeout_s, {1.0, 1e6});
  section.read("silence_s", options.silence_s, {1.0, 3600.0});
  section.read("track_rate_hz", options.track_rate_hz, {0.1, 100.0});
  options.track = trackPath(options.result);
  options.label.seed = static_cast<std::uint64_t>(seed);
  return options;
}

}  // namespace

Result<std::unique_ptr<MissionNode>> MissionNode::create(config::Section section) {
  MissionNodeOptions options = readNodeOptions(section);
  if (const Status status = section.finish(); !status) {
    return failure(status.error().message);
  }
  const Result<scenario::Scenario> scenario = scenario::loadScenario(options.label.scenario);
  if (!scenario) {
    return failure(scenario.error().message);
  }
  const Result<scenario::Mission> mission = scenario::missionOf(*scenario, options.label.mission);
  if (!mission) {
    return failure(mission.error().message);
  }
  const Result<vessel::Parameters> vessel =
      config::vesselFile(options.label.vessel).and_then([](const std::string& path) {
        return vessel::loadParameters(path);
      });
  if (!vessel) {
    return failure(vessel.error().message);
  }
  std::optional<scenario::TrackWriter> track;
  if (!options.result.empty()) {
    Result<scenario::TrackWriter> opened = scenario::TrackWriter::open(options.track);
    if (!opened) {
      return failure(opened.error().message);
    }
    track.emplace(std::move(*opened));
  }
  return std::unique_ptr<MissionNode>(
      new MissionNode(std::move(options), *scenario, *mission, *vessel, std::move(track)));
}

}  // namespace otter_nav::nodes
