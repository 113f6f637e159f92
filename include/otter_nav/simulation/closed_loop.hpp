// A whole mission without ROS: plant, lidar into the map, planner, tracker and supervisor in one
// loop of simulated time. Planning takes a fixed time of the mission's clock and is bounded by
// iterations, so a run is the same every time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/map/occupancy_map.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/planner/planner.hpp"
#include "otter_nav/plant/simulator.hpp"
#include "otter_nav/scenario/recorder.hpp"
#include "otter_nav/scenario/report.hpp"
#include "otter_nav/scenario/scenario.hpp"
#include "otter_nav/tracker/tracker.hpp"
#include "otter_nav/traffic/tracker.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/scripted_vessel.hpp"

namespace otter_nav::simulation {

// Everything the parts are built from.
struct LoopOptions {
  vessel::Parameters vessel;
  plant::Options plant;
  map::OccupancyMapOptions map;
  planner::Options planner;
  tracker::Options tracker;
  mission::SupervisorOptions supervisor;
  traffic::Options traffic;
  int planning_iterations = 1200;  // bound of one planning request
  double control_period_s = 0.01;  // of the tracker and the plant
  double record_period_s = 0.05;   // of the track
  double field_distance_m = 12.0;  // distances saturate here
  double timeout_s = 900.0;        // of the mission's clock
};

// The shipped files for a vessel and a disturbance preset, by name.
[[nodiscard]] Result<LoopOptions> loadLoopOptions(const std::string& vessel,
                                                  const std::string& disturbance);

// The water a mission is sailed in.
struct Waters {
  map::OccupancyGrid chart;
  map::OccupancyGrid world;
  std::vector<vessel::ScriptedVessel> vessels = {};  // others that sail there
};
[[nodiscard]] Result<Waters> loadWaters(const scenario::Scenario& scenario);

class Sensing;

class ClosedLoop {
 public:
  // The vessel lies at rest at the mission's start.
  [[nodiscard]] static Result<ClosedLoop> create(const LoopOptions& options, Waters waters,
                                                 const scenario::Mission& mission,
                                                 std::uint64_t seed);
  ~ClosedLoop();
  ClosedLoop(ClosedLoop&&) noexcept;
  ClosedLoop& operator=(ClosedLoop&&) noexcept;

  // One control period; false when the mission is over.
  bool step();
  // From now on; at first it is the mission's.
  [[nodiscard]] Status setSpeedMax(double speed_mps);

  [[nodiscard]] double time() const { return plant_.time(); }
  [[nodiscard]] const mission::Supervisor& supervisor() const { return *supervisor_; }
  // The true motion and the reference now.
  [[nodiscard]] scenario::MotionSample motion() const;
  // How the hull lay when the lidar looked last.
  [[nodiscard]] const plant::Truth& scannedFrom() const { return scanned_from_; }
  // Other vessels as they are known, and as they truly are.
  [[nodiscard]] const std::vector<traffic::Track>& tracks() const;
  [[nodiscard]] const std::vector<plant::OtherVessel>& others() const { return plant_.others(); }
  [[nodiscard]] scenario::Progress progress() const;
  [[nodiscard]] scenario::MissionResult result(const scenario::MissionLabel& label) const;

 private:
  ClosedLoop(const LoopOptions& options, plant::Simulator plant, map::OccupancyGrid chart,
             const scenario::Mission& mission, std::uint64_t seed);

  void sense();
  void lookAround();  // for the tracker
  void start();
  void control();
  void judge();
  [[nodiscard]] std::string touched() const;
  void carryOut(const mission::Orders& orders);
  [[nodiscard]] mission::Situation situation() const;
  [[nodiscard]] feasibility::Obstacles obstacles() const;  // on the clock of time()
  void finish(scenario::Outcome outcome, std::string reason);

  LoopOptions options_;
  plant::Simulator plant_;
  std::unique_ptr<Sensing> sensing_;
  planner::Planner planner_;
  std::unique_ptr<tracker::Tracker> tracker_;
  std::unique_ptr<mission::Supervisor> supervisor_;
  vessel::Pose goal_;
  scenario::Recorder recorder_;
  tracker::Command command_;
  plant::Truth scanned_from_;
  std::optional<double> scanned_s_;
  bool started_ = false;
  bool stop_ordered_ = false;
  // The answer to the last request, and when the vessel gets it.
  struct Reply {
    int id = 0;
    planner::Plan plan;
  };
  std::optional<Reply> reply_;
  double reply_time_s_ = 0.0;
  double last_record_s_ = -1e9;
  std::optional<scenario::Outcome> outcome_;
  std::string reason_;
};

class Monitor;

// step() to the end, each watched by `monitor` if there is one; the track goes to `track`, the
// other vessels' to `vessels` and the progress to `progress` if they are given.
[[nodiscard]] scenario::MissionResult run(
    ClosedLoop& loop, const scenario::MissionLabel& label, double record_period_s,
    scenario::TableWriter* track, const std::function<void(const scenario::Progress&)>& progress,
    scenario::TableWriter* vessels = nullptr, Monitor* monitor = nullptr);

}  // namespace otter_nav::simulation
