// A whole mission without ROS: plant, lidar into the map, planner, tracker and supervisor in one
// loop of simulated time. Planning takes a fixed time of the mission's clock and is bounded by
// iterations, so a run is the same every time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/map/occupancy_map.hpp"
#include "otter_nav/mission/recorder.hpp"
#include "otter_nav/mission/report.hpp"
#include "otter_nav/mission/scenario.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/planner/options.hpp"
#include "otter_nav/plant/options.hpp"
#include "otter_nav/tracker/options.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::mission {

// Everything the parts are built from.
struct LoopOptions {
  vessel::Parameters vessel;
  plant::Options plant;
  map::OccupancyMapOptions map;
  planner::Options planner;
  tracker::Options tracker;
  SupervisorOptions supervisor;
  int planning_iterations = 4000;  // bound of one planning request
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
};
[[nodiscard]] Result<Waters> loadWaters(const Scenario& scenario);

class ClosedLoop {
 public:
  // The vessel lies at rest at the mission's start.
  [[nodiscard]] static Result<ClosedLoop> create(const LoopOptions& options, Waters waters,
                                                 const Mission& mission, std::uint64_t seed);
  ~ClosedLoop();
  ClosedLoop(ClosedLoop&&) noexcept;
  ClosedLoop& operator=(ClosedLoop&&) noexcept;

  // One control period; false when the mission is over.
  bool step();

  [[nodiscard]] double time() const;
  [[nodiscard]] const Supervisor& supervisor() const;
  // The true motion and the reference now.
  [[nodiscard]] MotionSample motion() const;
  [[nodiscard]] Progress progress() const;
  [[nodiscard]] MissionResult result(const MissionLabel& label) const;

 private:
  class Impl;
  explicit ClosedLoop(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// step() to the end; the track goes to `track` and the progress to `progress` if they are given.
[[nodiscard]] MissionResult run(ClosedLoop& loop, const MissionLabel& label, double record_period_s,
                                TrackWriter* track,
                                const std::function<void(const Progress&)>& progress);

}  // namespace otter_nav::mission
