#include "otter_nav/plant/options.hpp"

namespace otter_nav::plant {
namespace {

constexpr double kMaxPayload = 45.0;

Status readPayload(config::Section section, PayloadOptions& payload) {
  section.read("mass_kg", payload.mass_kg, {0.0, kMaxPayload});
  std::vector<double> position;
  section.read("position_m", position, 3, {-1.0, 1.0});
  if (position.size() == 3) {
    payload.position_m = {position[0], position[1], position[2]};
  }
  return section.finish();
}

Status readOdometry(config::Section section, OdometryOptions& odometry) {
  section.read("position_noise_m", odometry.position_noise_m, {0.0, 10.0});
  section.read("heading_noise_rad", odometry.heading_noise_rad, {0.0, 1.0});
  section.read("velocity_noise_mps", odometry.velocity_noise_mps, {0.0, 5.0});
  section.read("yaw_rate_noise_radps", odometry.yaw_rate_noise_radps, {0.0, 1.0});
  section.read("latency_s", odometry.latency_s, {0.0, 5.0});
  return section.finish();
}

Status readLidar(config::Section section, LidarOptions& lidar) {
  section.read("beams", lidar.beams, {1.0, 100000.0});
  section.read("range_min_m", lidar.range_min_m, {0.0, 10.0});
  section.read("range_max_m", lidar.range_max_m, {0.1, 1000.0});
  section.read("rate_hz", lidar.rate_hz, {0.1, 100.0});
  std::vector<double> position;
  section.read("position_m", position, 3, {-5.0, 5.0});
  if (position.size() == 3) {
    lidar.position_m = {position[0], position[1], position[2]};
  }
  section.read("range_noise_m", lidar.range_noise_m, {0.0, 1.0});
  section.read("dropout_probability", lidar.dropout_probability, {0.0, 1.0});
  return section.finish();
}

Status readHull(config::Section section, vessel::Hull& hull) {
  section.read("length_m", hull.length_m, {0.1, 50.0});
  section.read("beam_m", hull.beam_m, {0.1, 50.0});
  return section.finish();
}

}  // namespace

Result<Options> readOptions(config::Section section) {
  Options options;
  section.read("step_s", options.step_s, {1e-4, 0.02});
  section.read("command_timeout_s", options.command_timeout_s, {0.01, 60.0});
  section.read("propeller_lag", options.propeller_lag);
  Status status = readPayload(section.child("payload"), options.payload);
  if (status) {
    status = readOdometry(section.child("odometry"), options.odometry);
  }
  if (status) {
    status = readLidar(section.child("lidar"), options.lidar);
  }
  if (status) {
    status = readHull(section.child("hull"), options.hull);
  }
  if (status) {
    status = section.finish();
  }
  if (!status) {
    return failure(status.error().message);
  }
  return options;
}

Result<Options> loadOptions(const std::string& vessel, const std::string& plant_yaml,
                            const std::string& disturbance_yaml) {
  if (vessel != "otter" && vessel != "otter_gazebo") {
    return failure("vessel '" + vessel + "' is none of: otter, otter_gazebo");
  }
  const Result<YAML::Node> node = config::loadFile(plant_yaml);
  if (!node) {
    return failure(node.error().message);
  }
  Result<Options> options = readOptions(config::Section(*node, plant_yaml));
  if (!options) {
    return options;
  }
  const Result<EnvironmentOptions> disturbance = loadDisturbance(disturbance_yaml);
  if (!disturbance) {
    return failure(disturbance.error().message);
  }
  options->vessel = vessel;
  options->disturbance = *disturbance;
  return options;
}

}  // namespace otter_nav::plant
