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
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/planner/options.hpp"
#include "otter_nav/plant/options.hpp"
#include "otter_nav/scenario/recorder.hpp"
#include "otter_nav/scenario/report.hpp"
#include "otter_nav/scenario/scenario.hpp"
#include "otter_nav/tracker/options.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::simulation {

// Everything the parts are built from.
struct LoopOptions {
  vessel::Parameters vessel;
  plant::Options plant;
  map::OccupancyMapOptions map;
  planner::Options planner;
  tracker::Options tracker;
  mission::SupervisorOptions supervisor;
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
[[nodiscard]] Result<Waters> loadWaters(const scenario::Scenario& scenario);

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

  [[nodiscard]] double time() const;
  [[nodiscard]] const mission::Supervisor& supervisor() const;
  // The true motion and the reference now.
  [[nodiscard]] scenario::MotionSample motion() const;
  [[nodiscard]] scenario::Progress progress() const;
  [[nodiscard]] scenario::MissionResult result(const scenario::MissionLabel& label) const;

 private:
  class Impl;
  explicit ClosedLoop(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// step() to the end; the track goes to `track` and the progress to `progress` if they are given.
[[nodiscard]] scenario::MissionResult run(
    ClosedLoop& loop, const scenario::MissionLabel& label, double record_period_s,
    scenario::TrackWriter* track, const std::function<void(const scenario::Progress&)>& progress);

}  // namespace otter_nav::simulation
