// States and thrusts along a whole trajectory, by the model the vessel's plans are made with.
//
// The paper's model gives them at each instant from the path alone (Trajectory::sample). With the
// manoeuvring model the heading has a memory: no thrust acts in sway, so its sway equation is a
// differential equation for the heading, followed here from the trajectory's start to its end
// (vessel::swayHeading, as the tracker's reference does); surge and yaw equations then give the
// thrusts. In a spin the heading is the piece's own. Where the sway equation hardly says where the
// bow should point (at walking pace, braking) the hull keeps the heading and the turn dies away.
#pragma once

#include <optional>
#include <vector>

#include "otter_nav/trajectory/trajectory.hpp"

namespace otter_nav::trajectory {

class MotionAlong {
 public:
  struct Point {
    double t_s = 0.0;      // from the trajectory's start
    double psi_rad = 0.0;  // continuous
    double yaw_rate_radps = 0.0;
    double yaw_acceleration = 0.0;
    vessel::Thrusts thrusts = vessel::Thrusts::Zero();
    double sway_n = 0.0;  // to port, that would be needed and no thruster gives
    double speed_mps = 0.0;
  };

  // `psi_start_rad`: the heading at the start of a trajectory that begins under way; without, that
  // of the path. `trajectory` must outlive this. Allocates.
  MotionAlong(const Trajectory& trajectory, const vessel::Parameters& vessel,
              const vessel::Disturbance& disturbance,
              std::optional<double> psi_start_rad = std::nullopt);

  // At even steps in each piece, both its ends included: a joint is there twice. Empty where the
  // paper's model holds.
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] std::size_t pieces() const { return first_.empty() ? 0 : first_.size() - 1; }
  // Of points(), the first of a piece; `piece` may be the number of pieces.
  [[nodiscard]] std::size_t firstOf(std::size_t piece) const { return first_[piece]; }
  [[nodiscard]] double psi(double t_s) const;

  // As Trajectory::sample, which it is where the paper's model holds.
  [[nodiscard]] Sample sample(double t_s) const;

 private:
  struct Motion {
    Eigen::Vector2d velocity, acceleration;
  };
  void follow(std::optional<double> psi_start_rad);
  void differentiate();
  [[nodiscard]] Point between(double t_s) const;

  const Trajectory& trajectory_;
  vessel::Parameters vessel_;
  vessel::Disturbance disturbance_;
  std::vector<Point> points_;
  std::vector<Motion> motions_;
  std::vector<std::size_t> first_;
};

}  // namespace otter_nav::trajectory
