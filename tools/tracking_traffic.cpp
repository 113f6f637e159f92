// Recorded detections of other vessels through the tracker: JSON lines in, tracks as JSON lines
// out. docs/traffic.md has both formats.
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <fstream>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "otter_nav/base/first_failure.hpp"
#include "otter_nav/config/share.hpp"
#include "otter_nav/map/chart.hpp"
#include "otter_nav/traffic/tracker.hpp"
#include "written_over.hpp"

namespace {

using nlohmann::json;
using otter_nav::failure;
using otter_nav::Result;
using otter_nav::Status;
namespace map = otter_nav::map;
namespace traffic = otter_nav::traffic;
namespace vessel = otter_nav::vessel;

struct Arguments {
  std::string input;
  std::string output;
  std::string options;  // empty: as shipped
  std::string chart;
  std::string vessel = "otter_gazebo";
};

vessel::Pose ownOf(const json& line) {
  vessel::Pose own;
  if (line.contains("own")) {
    const json& pose = line.at("own");
    own.position = {pose.at("x").get<double>(), pose.at("y").get<double>()};
    own.psi_rad = pose.value("psi", 0.0);
  }
  return own;
}

std::vector<Eigen::Vector2d> positionsOf(const json& list) {
  std::vector<Eigen::Vector2d> positions;
  for (const json& position : list) {
    positions.emplace_back(position.at(0).get<double>(), position.at(1).get<double>());
  }
  return positions;
}

map::SensorPose sensorOf(const json& pose) {
  map::SensorPose sensor;
  sensor.position = {pose.at("x").get<double>(), pose.at("y").get<double>(), pose.value("z", 0.8)};
  sensor.roll_rad = pose.value("roll", 0.0);
  sensor.pitch_rad = pose.value("pitch", 0.0);
  sensor.yaw_rad = pose.value("yaw", 0.0);
  return sensor;
}

// JSON has no infinity: null is a beam that met nothing.
otter_nav::Scan scanOf(const json& from) {
  otter_nav::Scan scan;
  scan.angle_min_rad = from.at("angle_min");
  scan.angle_increment_rad = from.at("angle_increment");
  scan.range_min_m = from.at("range_min");
  scan.range_max_m = from.at("range_max");
  for (const json& range : from.at("ranges")) {
    scan.ranges_m.push_back(range.is_null() ? std::numeric_limits<float>::infinity()
                                            : range.get<float>());
  }
  return scan;
}

// Throws json::exception for a line that lacks something or holds something else.
Status take(const json& line, traffic::Tracker& tracker) {
  const double t = line.at("t");
  const vessel::Pose own = ownOf(line);
  if (line.contains("ais")) {
    return tracker.addAis(t, line.at("ais").get<std::string>());
  }
  if (line.contains("radar")) {
    tracker.addRadar(t, vessel::toMap(own, positionsOf(line.at("radar"))), own.position);
    return {};
  }
  if (line.contains("detections")) {
    tracker.addRadar(t, positionsOf(line.at("detections")), own.position);
    return {};
  }
  if (line.contains("scan")) {
    const otter_nav::Scan scan = scanOf(line.at("scan"));
    // As the nodes check it.
    if (const std::string unusable = whyUnusable(scan); !unusable.empty()) {
      return failure("scan: " + unusable);
    }
    tracker.addScan(t, sensorOf(line.at("sensor")), own, scan);
    return {};
  }
  return failure("none of 'ais', 'radar', 'detections' and 'scan' is there");
}

json toJson(const traffic::Track& track) {
  json covariance = json::array();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      covariance.push_back(track.covariance(row, column));
    }
  }
  return {{"id", track.id},
          {"mmsi", track.mmsi},
          {"t", track.stamp_s},
          {"x", track.position.x()},
          {"y", track.position.y()},
          {"vx", track.velocity.x()},
          {"vy", track.velocity.y()},
          {"heading", track.heading_rad},
          {"turn_rate", track.turn_rate_radps},
          {"turn_time", track.turn_time_s},
          {"keeps_place", track.keeps_place},
          {"shape", track.shape == traffic::Shape::kBox ? "box" : "disc"},
          {"length_m", track.length_m},
          {"beam_m", track.beam_m},
          {"covariance", covariance},
          {"existence", track.existence},
          {"sources", track.sources}};
}

Status run(std::istream& in, std::ostream& out, traffic::Tracker& tracker) {
  int number = 0;
  double last_s = -std::numeric_limits<double>::infinity();
  for (std::string text; std::getline(in, text);) {
    ++number;
    if (text.find_first_not_of(" \t\r") == std::string::npos) {
      continue;
    }
    Status status;
    double t = 0.0;
    try {
      const json line = json::parse(text);
      t = line.at("t");
      status = t >= last_s ? take(line, tracker) : failure("its time goes back");
    } catch (const json::exception& error) {
      status = failure(error.what());
    }
    if (!status) {
      return failure("line " + std::to_string(number) + ": " + status.error().message);
    }
    last_s = t;
    tracker.forget(t);
    json tracks = json::array();
    for (const traffic::Track& track : tracker.tracks()) {
      tracks.push_back(toJson(track));
    }
    out << json{{"t", t}, {"tracks", tracks}} << '\n';
  }
  return {};
}

Status trackFile(const Arguments& a) {
  const auto options = (a.options.empty() ? otter_nav::config::findFile("config/traffic.yaml")
                                          : Result<std::string>(a.options))
                           .and_then(otter_nav::config::load<traffic::Options>);
  const auto chart =
      a.chart.empty() ? Result<map::OccupancyGrid>(map::OccupancyGrid{}) : map::loadChart(a.chart);
  const auto own = vessel::loadParameters(a.vessel);
  if (const Status status = otter_nav::firstFailure(options, chart, own); !status) {
    return status;
  }
  std::ifstream in(a.input);
  if (!in) {
    return failure("can't read " + a.input);
  }
  std::ofstream file;
  if (!a.output.empty()) {
    if (const Status status = otter_nav::tools::notOver(a.input, a.output); !status) {
      return status;
    }
    file.open(a.output);
    if (!file) {
      return failure("can't write " + a.output);
    }
  }
  std::ostream& out = a.output.empty() ? std::cout : file;
  traffic::Tracker tracker(*options, *chart, own->hull);
  if (Status status = run(in, out, tracker); !status) {
    return failure(a.input + ", " + status.error().message);
  }
  out.flush();
  return out ? Status() : failure("can't write " + a.output);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app{"Tracks other vessels in recorded detections (JSON lines) and prints their tracks"};
  app.add_option("--input", arguments.input, "JSON lines of detections")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--output", arguments.output, "file for the tracks (default: they are printed)");
  app.add_option("--options", arguments.options, "YAML of the tracker (default: as shipped)");
  app.add_option("--chart", arguments.chart, "map_server's YAML: what is charted is no vessel");
  app.add_option("--vessel", arguments.vessel, "own vessel, a name or YAML")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  if (const Status status = trackFile(arguments); !status) {
    std::cerr << "tracking_traffic: " << status.error().message << '\n';
    return 1;
  }
  return 0;
}
