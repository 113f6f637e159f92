// A supervisor with a perfect vessel: wherever the sailed trajectory says, or at rest.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "mission/safety.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "waters.hpp"

namespace otter_nav::mission::test {

// Where the tracker expects the vessel, half a second apart, from its place at this velocity.
inline vessel::Foreseen foreseenFrom(double start_s, const vessel::State& state,
                                     const Eigen::Vector2d& velocity) {
  vessel::Foreseen foreseen{start_s, 0.5, {}};
  for (int k = 0; k <= 12; ++k) {
    foreseen.poses.push_back({state.head<2>() + 0.5 * k * velocity, state[vessel::kPsi]});
  }
  return foreseen;
}

// Of a plan from motion, not from rest.
inline bool beginsUnderWay(const PlanRequest& request) {
  return request.query.start.flat.velocity.norm() > 0.0;
}

class ScriptedMission {
 public:
  explicit ScriptedMission(map::OccupancyGrid water = openWater(), SupervisorOptions o = {})
      : grid(std::move(water)),
        field(fieldOf(grid)),
        options(std::move(o)),
        supervisor(Supervisor::create(options, vessel::Parameters{}, 1)) {
    knowWeather();
  }

  // The clearance of the hull's centre at a level of the options' list.
  [[nodiscard]] double clearance(std::size_t level) const {
    return centreClearance(vessel::Hull{}, options.side_clearances_m[level]);
  }
  // What the vessel reports at `now_s`.
  [[nodiscard]] Situation situation() const {
    Situation s;
    s.odometry_stamp_s = now_s;
    s.scanned_s = scanned_s;
    s.disturbance.mean = disturbance;
    s.disturbance.knows_waves = knows_waves;
    s.state = rest;
    s.tracks = tracks;
    s.hears_others = hears_others;
    const trajectory::TimedTrajectory& sailed = supervisor->sailed();
    if (!sailed.trajectory.empty()) {
      s.state = sailed.trajectory.sample(now_s - sailed.start_time_s, vessel::Parameters{}).state;
      if (now_s - sailed.start_time_s > sailed.trajectory.duration()) {
        s.state.tail<3>().setZero();
      }
    }
    return s;
  }
  [[nodiscard]] feasibility::Obstacles obstacles() const {
    feasibility::Obstacles all(field);
    if (known) {
      all.setKnownWater(*known);
    }
    if (layer != nullptr) {
      all.add(*layer);
    }
    return all;
  }
  Result<Orders> goTo(const Eigen::Vector2d& position, double psi_rad = 0.0) {
    return supervisor->setGoal(now_s, {position, psi_rad}, situation(), obstacles());
  }
  Orders update(double later_s) {
    now_s += later_s;
    return supervisor->update(now_s, situation(), obstacles());
  }
  Orders answer(const PlanRequest& request, const trajectory::Trajectory& trajectory) {
    planner::Plan plan;
    plan.outcome = planner::Outcome::kSolved;
    plan.trajectory = trajectory;
    return supervisor->planFinished(now_s, request.id, plan, situation(), obstacles());
  }
  Orders refuse(const PlanRequest& request, const std::string& why) {
    planner::Plan plan;
    plan.reason = why;
    return supervisor->planFinished(now_s, request.id, plan, situation(), obstacles());
  }
  // To x = 40 m, 80 m east, and `after_s` under way.
  void setOut(double after_s) {
    rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
    const auto orders = goTo({40.0, 0.0});
    (void)answer(*orders->plan, eastward({-40.0, 0.0}, 80.0, 4.0));
    (void)update(after_s);
  }
  // The tracker has been running for a while.
  void knowWeather(double for_s = 1.5) {
    for (int k = 0; k < static_cast<int>(std::lround(10.0 * for_s)); ++k) {
      (void)update(0.1);
    }
  }
  void put(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
    block(grid, low, high);
    field = fieldOf(grid);
  }

  map::OccupancyGrid grid;
  map::DistanceField field;
  std::optional<map::DistanceField> known;            // what of the water is; nothing: all
  const feasibility::ObstacleLayer* layer = nullptr;  // besides the field
  std::vector<traffic::Track> tracks;
  bool hears_others = false;
  SupervisorOptions options;
  std::unique_ptr<Supervisor> supervisor;
  vessel::State rest = vessel::State::Zero();
  std::optional<double> scanned_s;
  bool knows_waves = true;
  vessel::Disturbance disturbance;  // as the tracker estimates it
  double now_s = 98.5;              // 100 s once the weather is known
};

}  // namespace otter_nav::mission::test
