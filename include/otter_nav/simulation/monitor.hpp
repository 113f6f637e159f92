// Looks over the stack's shoulder: whether the vessel keeps clear, and whether the stop that it
// counts on stays in water that was seen to be free. It judges by the world and by sight lines of
// its own, never by the stack's map.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "otter_nav/map/chart.hpp"
#include "otter_nav/plant/lidar.hpp"
#include "otter_nav/plant/other_vessels.hpp"
#include "otter_nav/plant/signals.hpp"
#include "otter_nav/plant/world_map.hpp"
#include "otter_nav/scenario/recorder.hpp"
#include "otter_nav/simulation/closed_loop.hpp"
#include "otter_nav/trajectory/timed_trajectory.hpp"

namespace otter_nav::simulation {

class Monitor {
 public:
  // Water that the chart shows free counts as known if the options trust it, until an obstacle
  // there was seen.
  Monitor(const Waters& waters, const LoopOptions& options);

  // After each step of the loop. A step in which anything is wrong is a violation.
  void watch(const ClosedLoop& loop);
  [[nodiscard]] const scenario::Monitored& result() const { return result_; }

  // What watch() is made of. All that is in sight is known from now on: what a lidar as tilted as
  // the hull meets behind no other vessel, at heights over the water that matter.
  void look(const plant::Truth& truth);
  // What is wrong with a way to rest from `now_s` on; empty if nothing is. Other vessels count that
  // have been in sight on the same course for a while, and count as keeping it, until we rest.
  [[nodiscard]] std::string fault(const trajectory::TimedTrajectory& stop, double now_s) const;

 private:
  [[nodiscard]] std::string faultOf(const ClosedLoop& loop) const;
  [[nodiscard]] std::string faultAt(const Eigen::Vector2d& position, double psi_rad) const;
  [[nodiscard]] bool meets(const vessel::Pose& own, double now_s, double later_s) const;
  void follow(double now_s, const Eigen::Vector2d& eye);

  plant::WorldMap world_;
  plant::OtherVessels others_;
  vessel::Parameters vessel_;
  plant::Lidar lidar_;
  map::HeightBand band_;
  Eigen::Vector3d lidar_in_base_;
  double looked_s_ = -1.0;
  std::vector<bool> seen_;   // of the world's cells: met by a beam of the lidar's
  std::vector<bool> known_;  // in sight, or free by the chart
  // Of each other vessel: how she moves, and since when that and she herself are in sight.
  struct Followed {
    vessel::ScriptedMotion motion;
    double since_s = std::numeric_limits<double>::infinity();
  };
  std::vector<Followed> followed_;
  std::string stop_fault_;  // of the last look
  scenario::Monitored result_;
};

}  // namespace otter_nav::simulation
