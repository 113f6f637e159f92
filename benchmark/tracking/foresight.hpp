// The best that thrusters can do against a wind and a current known exactly: a plan over a moving
// horizon by differential dynamic programming with box constraints (Tassa, Mansard and Todorov
// 2014), line search included. A yardstick for the tracker, far too slow to steer by.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::benchmark {

class ForesightPlanner {
 public:
  struct Options {
    double step_s = 0.05;
    int stages = 120;
    int iterations = 6;
    double position_weight = 100.0;  // per m^2 and s; the end counts as terminal_gain stages
    double yaw_rate_weight = 0.1;
    double thrust_weight = 1e-4;
    double terminal_gain = 20.0;
  };

  ForesightPlanner(const Options& options, const vessel::Parameters& vessel);

  // The first thrusts of the plan from `start`. Of `positions` and `disturbances`, each stage has
  // one (positions one more). Starts from the last plan moved on by one stage.
  vessel::Thrusts plan(const vessel::State& start, const std::vector<Eigen::Vector2d>& positions,
                       const std::vector<vessel::Disturbance>& disturbances);
  [[nodiscard]] vessel::State advance(const vessel::State& x, const vessel::Thrusts& thrusts,
                                      const vessel::Disturbance& disturbance) const;

 private:
  struct Stage {
    vessel::StateJacobian by_state;
    vessel::InputJacobian by_thrusts;
    Eigen::Matrix<double, 2, 6> gain;
    vessel::Thrusts change;
  };
  struct Plan {
    std::vector<vessel::State> states;
    std::vector<vessel::Thrusts> thrusts;
    double cost = 0.0;
  };

  [[nodiscard]] vessel::State stateSlope(const vessel::State& x, int k) const;
  [[nodiscard]] vessel::State stateWeight(int k) const;
  void linearize();
  void sweepBack(double damping);
  // Rolls out with `share` of the change.
  [[nodiscard]] Plan rollOut(const vessel::State& start, double share) const;
  [[nodiscard]] bool improve(const vessel::State& start);

  Options options_;
  vessel::Parameters vessel_;
  const std::vector<Eigen::Vector2d>* positions_ = nullptr;
  const std::vector<vessel::Disturbance>* disturbances_ = nullptr;
  std::vector<Stage> stages_;
  Plan plan_;
};

}  // namespace otter_nav::benchmark
