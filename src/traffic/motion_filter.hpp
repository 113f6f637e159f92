// One vessel's motion: straight ahead, turning, or going round and round, as an interacting
// multiple model filter (Blom and Bar-Shalom 1988) whose models are updated by weighted
// measurements (probabilistic data association, Bar-Shalom and others 2011, chapters 3 and 11).
// Where it is asked for, a fourth model reckons with a new course taken at once.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace otter_nav::traffic {

// [x m, y m, v_x m/s, v_y m/s, omega rad/s, heading less course rad], map frame.
using MotionState = Eigen::Matrix<double, 6, 1>;
using MotionCovariance = Eigen::Matrix<double, 6, 6>;

// The state's first two (position) or four (and velocity) components, observed.
struct Measurement {
  bool has_velocity = false;
  Eigen::Vector4d value = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
};

// The heading but for quarters of a turn, as the sides of a hull tell it.
struct Sides {
  double direction_rad = 0.0;
  double deviation_rad = 0.0;  // standard deviation
};

class MotionFilter {
 public:
  // Straight ahead, turning, turning steadily, off on any new course.
  static constexpr std::size_t kModels = 4;
  using PerModel = std::array<double, kModels>;

  // Where a first measurement says; a velocity that isn't measured may be anything up to a few m/s.
  MotionFilter(const Measurement& first, double stamp_s);

  [[nodiscard]] double stamp() const { return stamp_s_; }
  // Moves on; times that lie back change nothing. How often she may be off on a new course without
  // any turn, as fast as before: 0, never.
  void predict(double time_s, double anew_per_s = 0.0);

  // Density of the measurement by each model, and by all.
  [[nodiscard]] PerModel likelihoods(const Measurement& measurement) const;
  [[nodiscard]] double likelihood(const PerModel& by_model) const;
  // Squared Mahalanobis distance to the predicted measurement, the models taken together.
  [[nodiscard]] double distance2(const Measurement& measurement) const;
  // The same, or to that on a new course if that is less.
  [[nodiscard]] double gateDistance2(const Measurement& measurement) const;

  // One of `candidates` is the vessel's with its probability, none with what is left to 1.
  struct Candidate {
    Measurement measurement;
    PerModel likelihoods;
    double probability = 1.0;
  };
  void update(const std::vector<Candidate>& candidates);
  // The vessel's for certain.
  void update(const Measurement& measurement);
  // Who turns shows it by her sides before she has moved aside.
  void update(const Sides& sides);

  // Moves the position alone: another point of the same vessel is followed from now on.
  void shift(const Eigen::Vector2d& by);

  // Of all models together.
  [[nodiscard]] MotionState state() const;
  [[nodiscard]] MotionCovariance covariance() const;
  // Without what a new course would have brought, unless it is rather probable: that is for finding
  // the vessel again, not for what is said of her.
  [[nodiscard]] MotionState usualState() const;
  [[nodiscard]] MotionCovariance usualCovariance() const;
  // Likewise of the model that is all but certain, if there is one.
  [[nodiscard]] MotionCovariance likelyCovariance() const;
  [[nodiscard]] double turningProbability() const { return 1.0 - models_[0].weight; }
  // Probability that a turn, if there is one, is steady.
  [[nodiscard]] double steadiness() const { return models_[2].weight / turningProbability(); }

 private:
  struct Model {
    MotionState x = MotionState::Zero();
    MotionCovariance P = MotionCovariance::Zero();
    double weight = 0.5;
  };
  void mix(double dt_s, double anew_per_s);
  void mixAnew(const std::array<Model, kModels>& before, const PerModel& share);
  void normalize();
  [[nodiscard]] bool isUsed(std::size_t model) const;
  // The first so many.
  [[nodiscard]] std::size_t usualModels() const;
  [[nodiscard]] MotionState meanOf(std::size_t models) const;
  [[nodiscard]] MotionCovariance covarianceAround(std::size_t models,
                                                  const MotionState& mean) const;

  std::array<Model, kModels> models_;
  double stamp_s_ = 0.0;
};

}  // namespace otter_nav::traffic
