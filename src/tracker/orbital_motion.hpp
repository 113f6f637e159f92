// The water that waves move to and fro under the hull, as the current that it is for seconds: a
// sum of oscillators that noise drives, x and y of each in the earth frame (Fossen 2021, section
// 10.2). Their states are a filter's; left alone they say how the water goes on.
#pragma once

#include <Eigen/Core>

#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::tracker {

// Of the water, earth frame.
struct WaterMotion {
  Eigen::Vector2d velocity_mps = Eigen::Vector2d::Zero();
  Eigen::Vector2d acceleration_mps2 = Eigen::Vector2d::Zero();
};

// Of the state of a hull that the water takes along: what acts on it goes with the velocity through
// the water, and that velocity changes as the water's does.
vessel::State derivativeInWater(const vessel::State& state, const vessel::Thrusts& thrusts,
                                const vessel::Parameters& vessel,
                                const vessel::Disturbance& disturbance, const WaterMotion& water);

class OrbitalMotion {
 public:
  static constexpr int kBands = 4;
  static constexpr int kSize = 4 * kBands;  // displacement x, y and velocity x, y of each band
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  using Slope = Eigen::Matrix<double, 2, kSize>;

  OrbitalMotion();

  // Still water again; what was learned of the sea stays.
  void reset() { state_.setZero(); }
  void add(const Vector& step) { state_ += step; }
  // `dt_s` on; `variance` is the state's by then, but for what drives it meanwhile.
  void advance(double dt_s, const Vector& variance);

  // In `in_s` from now.
  [[nodiscard]] WaterMotion at(double in_s) const;
  // Of velocity and acceleration now, over the state.
  [[nodiscard]] static Slope velocitySlope();
  [[nodiscard]] static Slope accelerationSlope();
  // Of the state `dt_s` from now over that now.
  [[nodiscard]] static Matrix transition(double dt_s);
  // The state's, of this sea on the whole; and what keeps it up, per second.
  [[nodiscard]] Vector variance() const;
  [[nodiscard]] Vector drive() const;

 private:
  Vector state_ = Vector::Zero();
  Eigen::Matrix<double, kBands, 1> rate_variance_;  // of each axis, m^2/s^2
};

}  // namespace otter_nav::tracker
