// Extended Kalman filter for the vessel's state and what pushes it: a force fixed in the earth
// frame, a yaw moment, the wind if the vessel's model knows wind loads, and a current.
//
// Force and current are told apart only by how they change with heading and speed. A hull with
// about the same drag ahead and abeam shows no difference, so for such a one the force carries
// both: over a prediction of seconds they act alike. In waves the model leaves more open than in
// calm water; how much is learned from how the filter has to correct the velocities
// (docs/tracker.md).
//
// Waves are either a motion on top of the hull's own, which is how a hull at rest is best left to
// swing with them, or one of the water that takes the hull along, which can be foreseen.
#pragma once

#include <Eigen/Core>

#include "otter_nav/tracker/options.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "tracker/orbital_motion.hpp"
#include "tracker/wave_frequency.hpp"

namespace otter_nav::tracker {

enum class Waves { kOnTop, kInTheWater };

// Whether a hull's drags ahead and abeam tell a current from a force.
[[nodiscard]] bool tellsCurrent(const vessel::ManoeuvringModel& model);

class Estimator {
 public:
  Estimator(const EstimatorOptions& options, const vessel::Parameters& vessel,
            Waves waves = Waves::kOnTop);

  // Starts at a measured state; keeps what is known of the disturbance.
  void reset(const vessel::State& measured);
  // `dt_s` of motion under thrusts that act (not commands).
  void predict(const vessel::Thrusts& thrusts, double dt_s);
  // psi of `measured` is taken modulo a turn.
  void update(const vessel::State& measured);

  // Without the motion with the waves.
  [[nodiscard]] const vessel::State& state() const { return state_; }
  // What to steer by: at crawling pace where it would be abeam without the waves, against which a
  // hull without a side thruster could only swing; with them at speed, where a small turn makes up
  // for what they do. Along the heading, which has thrusters, and in the heading with them always.
  [[nodiscard]] vessel::State steered() const;
  [[nodiscard]] const vessel::Disturbance& disturbance() const { return disturbance_; }
  // The same with its covariance; that of the wind, whose state is another, to first order.
  [[nodiscard]] vessel::DisturbanceEstimate disturbanceEstimate() const;
  // Beside the current; nothing unless waves are in the water.
  [[nodiscard]] const OrbitalMotion& water() const { return water_; }
  // Current and force are told apart.
  [[nodiscard]] bool estimatesCurrent() const { return current_fade_per_s_ > 0.0; }
  // From 0 at crawling pace to 1 at speed.
  [[nodiscard]] double sailingShare() const;
  // measured minus estimate, heading in [-pi, pi].
  [[nodiscard]] vessel::State innovation(const vessel::State& measured) const;

 private:
  // The state, then force x, y, moment, current x, y, wind x, y. The wind's state is q = |w| w:
  // the loads are of the first degree in it, so it has no dead spot in calm air.
  static constexpr int kForce = 6, kMoment = 8, kCurrent = 9, kWind = 11;
  // Motion with the waves, x, y, psi, and its rates: an oscillator each, driven by noise (Fossen
  // 2021, section 13.3).
  static constexpr int kWave = 13, kWaveRate = 16;
  static constexpr int kWater = 19, kSize = kWater + OrbitalMotion::kSize;
  using Covariance = Eigen::Matrix<double, kSize, kSize>;

  // What odometry shows of the state vector.
  [[nodiscard]] Eigen::Matrix<double, 6, kSize> measurement() const;
  [[nodiscard]] Covariance transition(const vessel::Thrusts& thrusts, double dt_s) const;
  // Of the state vector, from its start: the water's part is nothing with waves on top.
  [[nodiscard]] int usedSize() const {
    return waves_ == Waves::kInTheWater ? kSize : static_cast<int>(kWater);
  }
  // The covariance over a step.
  void spread(const Covariance& f);
  // Of surge, sway and yaw acceleration over q.
  [[nodiscard]] Eigen::Matrix<double, 3, 2> fromWind() const;
  // What drives the waves' oscillators, per second, at the frequency known now.
  [[nodiscard]] Eigen::Vector3d waveDrive() const;
  // Of surge, sway and yaw rate, by what an update changed them by.
  void learnWalk(const Eigen::Vector3d& step);
  void limit();

  EstimatorOptions options_;
  Waves waves_;
  vessel::Parameters vessel_;
  vessel::State state_ = vessel::State::Zero();
  vessel::Disturbance disturbance_;
  Eigen::Vector2d wind_pressure_ = Eigen::Vector2d::Zero();  // q, m^2/s^2
  Eigen::Vector3d wave_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d wave_rate_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d wave_rate_variance_;
  WaveFrequency wave_frequency_;
  OrbitalMotion water_;
  Covariance covariance_ = Covariance::Zero();
  vessel::State measurement_variance_;
  double force_most_n_;
  double moment_fade_per_s_ = 0.0;
  double force_fade_per_s_ = 0.0;  // now
  double turning_radps_ = 0.0;     // on the whole
  double current_fade_per_s_ = 0.0;
  double moment_most_nm_;
  Eigen::Matrix<double, kSize, 1> walk_variance_;         // per second
  Eigen::Vector3d least_walk_variance_;                   // of surge, sway and yaw rate
  Eigen::Vector3d correction_ = Eigen::Vector3d::Zero();  // of these, a second, lately
  Eigen::Vector3d correction_intensity_ = Eigen::Vector3d::Zero();
  double predicted_s_ = 0.0;  // since the last update
};

}  // namespace otter_nav::tracker
