// Tracker and plant in a loop of 100 Hz, with odometry to tamper with.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "otter_nav/map/occupancy_grid.hpp"
#include "otter_nav/plant/options.hpp"
#include "otter_nav/plant/simulator.hpp"
#include "otter_nav/tracker/tracker.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::tracker::test {

constexpr double kPeriodS = 0.01;
inline const std::string kSource = OTTER_NAV_SOURCE_DIR;

// What a stretch of the voyage showed.
struct Stretch {
  Command last;
  double max_error_m = 0.0;  // of the true position from the tracker's reference
  double max_thrust_rate_nps = 0.0;
  double max_thrust_step_n = 0.0;  // between two cycles
};

class VesselAtSea {
 public:
  // `odometry` is called with each message before the tracker gets it; false drops it.
  using Tamper = std::function<bool(double& stamp_s, vessel::State& state)>;

  explicit VesselAtSea(const std::string& disturbance, double latency_s = 0.0,
                       const std::string& name = "otter_gazebo",
                       const Eigen::Vector2d& force_n = Eigen::Vector2d::Zero()) {
    const auto vessel = vessel::loadParameters(kSource + "/config/vessels/" + name + ".yaml");
    const auto options = config::load<Options>(kSource + "/config/tracker.yaml");
    auto plant = plant::loadOptions(*vessel, kSource + "/config/plant.yaml",
                                    kSource + "/config/disturbances/" + disturbance + ".yaml");
    EXPECT_TRUE(vessel && options && plant);
    plant->odometry.latency_s = latency_s;
    plant->disturbance.force_n += force_n;
    plant_ = std::make_unique<plant::Simulator>(*plant, map::OccupancyGrid{}, 1);
    tracker_ = Tracker::create(*options, *vessel);
  }

  Tracker& tracker() { return *tracker_; }
  plant::Simulator& plant() { return *plant_; }
  [[nodiscard]] double now() const { return plant_->time(); }
  [[nodiscard]] const vessel::State& truth() const { return plant_->truth().planar; }

  Stretch sail(
      double duration_s, const Tamper& odometry = [](double&, vessel::State&) { return true; }) {
    Stretch stretch;
    const int cycles = static_cast<int>(std::lround(duration_s / kPeriodS));
    for (int i = 0; i < cycles; ++i) {
      double stamp_s = plant_->odometry().stamp_s;
      vessel::State state = plant_->odometry().state;
      if (odometry(stamp_s, state)) {
        tracker_->addOdometry(stamp_s, state);
      }
      stretch.last = tracker_->step(now());
      const vessel::Thrusts& thrusts = stretch.last.thrusts;
      EXPECT_TRUE(thrusts.allFinite());
      const double step_n = (thrusts - last_).cwiseAbs().maxCoeff();
      stretch.max_thrust_step_n = std::max(stretch.max_thrust_step_n, step_n);
      stretch.max_thrust_rate_nps = std::max(stretch.max_thrust_rate_nps, step_n / kPeriodS);
      last_ = thrusts;
      const double error = (truth() - stretch.last.reference).head<2>().norm();
      stretch.max_error_m = std::max(stretch.max_error_m, error);
      plant_->step(thrusts, kPeriodS);
    }
    return stretch;
  }

  // East along y = `north_m` at a constant speed from x = `from_m`, as one piece.
  static trajectory::Trajectory eastward(double from_m, double speed_mps, double duration_s,
                                         double north_m = 0.0) {
    vessel::FlatPoint start;
    vessel::FlatPoint end;
    start.position = {from_m, north_m};
    start.velocity = end.velocity = {speed_mps, 0.0};
    end.position = {from_m + speed_mps * duration_s, north_m};
    return trajectory::Trajectory({trajectory::hermitePiece(start, end, duration_s)});
  }

  // A straight line from rest to rest.
  static trajectory::Trajectory line(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                     double duration_s) {
    vessel::FlatPoint start;
    vessel::FlatPoint end;
    start.position = from;
    end.position = to;
    return trajectory::Trajectory({trajectory::hermitePiece(start, end, duration_s)});
  }

 private:
  std::unique_ptr<plant::Simulator> plant_;
  std::unique_ptr<Tracker> tracker_;
  vessel::Thrusts last_ = vessel::Thrusts::Zero();
};

}  // namespace otter_nav::tracker::test
