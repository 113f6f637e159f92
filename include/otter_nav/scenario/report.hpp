// What people and programs get to read of a mission: result JSON, track CSV, progress, summary.
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/scenario/recorder.hpp"
#include "otter_nav/vessel/scripted_vessel.hpp"

namespace otter_nav::scenario {

// {"missions": [{"scenario", "mission", "vessel", "disturbance", "seed", "outcome", "duration_s",
// "distance_m", "min_clearance_m", "tracking_error_mean_m", "tracking_error_max_m", "replans",
// "replans_for_weather", "planning_ms_median", "planning_ms_max", "tracker_ms_p99", "track"}]}, and
// "reason" in those that did not arrive, "vessels" where others sailed, and "monitor": {"steps",
// "violations", "margin_m", "first"} where each step was checked.
[[nodiscard]] std::string toJson(const std::vector<MissionResult>& results);
// The file is whole at any time: the old one stands until the new one is written.
[[nodiscard]] Status saveJson(const std::string& path, const std::vector<MissionResult>& results);

// A CSV file, written row by row.
class TableWriter {
 public:
  [[nodiscard]] static Result<TableWriter> open(const std::string& path, const char* columns);
  void write(const std::string& row) { file_ << row; }
  // An error if anything could not be written.
  [[nodiscard]] Status close();

 private:
  TableWriter(std::ofstream file, std::string path);
  std::ofstream file_;
  std::string path_;
};

// The true motion (ENU; SI units). Without a trajectory the reference is the vessel's own pose.
constexpr char kTrackColumns[] = "t,x,y,psi,u,v,r,roll,pitch,f_left,f_right,x_ref,y_ref,psi_ref\n";
[[nodiscard]] std::string trackRow(const MotionSample& sample);
// Other vessels' (ENU; SI units), a row a vessel and instant.
constexpr char kVesselsColumns[] = "t,id,x,y,psi,speed_mps\n";
[[nodiscard]] std::string vesselRow(double t_s, int id, const vessel::ScriptedMotion& motion);

struct Progress {
  double t_s = 0.0;
  double distance_left_m = 0.0;
  double speed_mps = 0.0;
  double clearance_m = 0.0;
  double tracking_error_m = 0.0;
  std::string state;
  std::string detail;  // what there is to tell about the state; may be empty
};
[[nodiscard]] std::string progressText(const Progress& progress);

// A few lines for the end of a mission.
[[nodiscard]] std::string summaryText(const MissionResult& result);

}  // namespace otter_nav::scenario
