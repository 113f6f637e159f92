// The hull as a helmsman moves it: told a speed ahead and a rate of turn, he works the thrusters by
// the manoeuvring model. What he can do is what the hull can do, from rest, astern and in turns.
#pragma once

#include <Eigen/Core>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::encounter {

// Speed through the water, negative astern, and yaw rate, counter-clockwise.
struct Helm {
  double surge_mps = 0.0;
  double turn_radps = 0.0;
};

// A hull under way, over ground, with what its thrusters give at the moment.
struct Hull {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double psi_rad = 0.0;                              // not wrapped
  Eigen::Vector2d ahead = Eigen::Vector2d::UnitX();  // along it
  double surge_mps = 0.0;
  double sway_mps = 0.0;
  double yaw_rate_radps = 0.0;
  vessel::Tau tau;

  void headTo(double to_rad) {
    psi_rad = to_rad;
    ahead = unitVector(to_rad);
  }
  [[nodiscard]] Eigen::Vector2d velocity() const {
    return surge_mps * ahead + sway_mps * across(ahead);
  }
};

class Helmsman {
 public:
  // `disturbance` stays as it is; no faster than `speed_max_mps` over ground.
  Helmsman(const vessel::Parameters& vessel, const vessel::Disturbance& disturbance,
           double speed_max_mps);

  // The speed and rate of turn that he can be told.
  [[nodiscard]] double speedMost() const { return speed_most_mps_; }
  [[nodiscard]] double turnMost() const { return turn_most_radps_; }
  // In which a speed grows to two thirds.
  [[nodiscard]] double speedLag() const { return speed_lag_s_; }

  // `dt_s` later; steps of up to 0.1 s will do.
  void step(Hull& hull, const Helm& helm, double dt_s) const;
  // d velocity / dt in the earth frame, and the yaw acceleration.
  struct Acceleration {
    Eigen::Vector2d linear;
    double yaw_radps2;
  };
  [[nodiscard]] Acceleration acceleration(const Hull& hull) const;

 private:
  [[nodiscard]] vessel::Tau order(const Hull& hull, const Helm& helm, double cosine,
                                  double sine) const;

  vessel::ManoeuvringModel model_;
  vessel::Mobility<double> mobility_;
  vessel::Thrusters thrusters_;
  vessel::Disturbance disturbance_;
  double speed_most_mps_ = 0.0;
  double turn_most_radps_ = 0.0;
  double speed_lag_s_ = 0.0;
};

}  // namespace otter_nav::encounter
