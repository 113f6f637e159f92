#include "otter_nav/scenario/report.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "otter_nav/base/text.hpp"

namespace otter_nav::scenario {

std::string toJson(const std::vector<MissionResult>& results) {
  nlohmann::ordered_json missions = nlohmann::ordered_json::array();
  for (const MissionResult& result : results) {
    nlohmann::ordered_json mission = {{"scenario", result.label.scenario},
                                      {"mission", result.label.mission},
                                      {"vessel", result.label.vessel},
                                      {"disturbance", result.label.disturbance},
                                      {"seed", result.label.seed},
                                      {"outcome", name(result.outcome)},
                                      {"duration_s", result.duration_s},
                                      {"distance_m", result.distance_m},
                                      {"min_clearance_m", result.min_clearance_m},
                                      {"tracking_error_mean_m", result.tracking_error_mean_m},
                                      {"tracking_error_max_m", result.tracking_error_max_m},
                                      {"replans", result.replans},
                                      {"replans_for_weather", result.replans_for_weather},
                                      {"planning_ms_median", result.planning_ms_median},
                                      {"planning_ms_max", result.planning_ms_max},
                                      {"tracker_ms_p99", result.tracker_ms_p99},
                                      {"track", result.track}};
    if (!result.vessels.empty()) {
      mission["vessels"] = result.vessels;
    }
    if (result.monitored) {
      mission["monitor"] = {{"steps", result.monitored->steps},
                            {"violations", result.monitored->violations},
                            {"margin_m", result.monitored->margin_m},
                            {"first", result.monitored->first}};
    }
    if (!result.reason.empty()) {
      mission["reason"] = result.reason;
    }
    missions.push_back(std::move(mission));
  }
  return nlohmann::ordered_json{{"missions", std::move(missions)}}.dump(2) + "\n";
}

Status saveJson(const std::string& path, const std::vector<MissionResult>& results) {
  namespace fs = std::filesystem;
  std::error_code error;
  const bool special = fs::exists(path, error) && !fs::is_regular_file(path, error);  // a pipe
  const std::string written = special ? path : path + ".part";
  std::ofstream file(written);
  file << toJson(results);
  file.close();
  if (file && !special) {
    fs::rename(written, path, error);
  }
  if (!file || error) {
    return failure("can't write result " + path);
  }
  return {};
}

TableWriter::TableWriter(std::ofstream file, std::string path)
    : file_(std::move(file)), path_(std::move(path)) {}

Result<TableWriter> TableWriter::open(const std::string& path, const char* columns) {
  std::ofstream file(path);
  file << columns;
  if (!file) {
    return failure("can't write " + path);
  }
  return TableWriter(std::move(file), path);
}

Status TableWriter::close() {
  file_.close();
  if (!file_) {
    return failure("can't write " + path_);
  }
  return {};
}

std::string trackRow(const MotionSample& sample) {
  const vessel::State& x = sample.state;
  const Eigen::Vector3d reference = sample.reference.value_or(x.head<3>());
  return text("%.3f,%.4f,%.4f,%.5f,%.4f,%.4f,%.5f,%.5f,%.5f,%.3f,%.3f,%.4f,%.4f,%.5f\n", sample.t_s,
              x[0], x[1], x[2], x[3], x[4], x[5], sample.roll_rad, sample.pitch_rad,
              sample.thrusts_n[vessel::kLeft], sample.thrusts_n[vessel::kRight], reference.x(),
              reference.y(), reference.z());
}

std::string vesselRow(double t_s, int id, const vessel::ScriptedMotion& motion) {
  return text("%.3f,%d,%.4f,%.4f,%.5f,%.4f\n", t_s, id, motion.pose.position.x(),
              motion.pose.position.y(), motion.pose.psi_rad, motion.speed_mps);
}

std::string progressText(const Progress& progress) {
  return text("t %5.1f s  left %5.1f m  speed %4.2f m/s  clearance %5.2f m  error %4.2f m  ",
              progress.t_s, progress.distance_left_m, progress.speed_mps, progress.clearance_m,
              progress.tracking_error_m) +
         progress.state + (progress.detail.empty() ? "" : ": " + progress.detail);
}

std::string summaryText(const MissionResult& result) {
  const MissionLabel& label = result.label;
  const std::string head = label.scenario + " mission " + std::to_string(label.mission) + ", " +
                           label.vessel + ", disturbance " + label.disturbance + ", seed " +
                           std::to_string(label.seed) + ": " + name(result.outcome) +
                           (result.reason.empty() ? "" : ": " + result.reason) + "\n";
  return head +
         text(
             "  %.1f s, %.1f m sailed, hull never nearer than %.2f m to anything\n"
             "  tracking error %.3f m mean, %.3f m at most; %d replans, %d for the weather\n"
             "  planning %.1f ms median, %.1f ms at most; tracker %.3f ms (99th percentile)\n",
             result.duration_s, result.distance_m, result.min_clearance_m,
             result.tracking_error_mean_m, result.tracking_error_max_m, result.replans,
             result.replans_for_weather, result.planning_ms_median, result.planning_ms_max,
             result.tracker_ms_p99);
}

}  // namespace otter_nav::scenario
