#include "motion_filter.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::traffic {
namespace {

// Densities of white acceleration, m^2/s^3, and of the turn rate's change, rad^2/s^3.
constexpr double kStraightAcceleration = 0.0002;
constexpr double kTurningAcceleration = 0.2;
constexpr double kTurnChange = 0.002;
constexpr double kTurnDecayS = 20.0;  // a turn rate dies out
// How long a model holds on average.
constexpr double kStraightHoldsS = 120.0;
constexpr double kTurningHoldsS = 2.0;

constexpr double kAnySpeedMps = 2.5;  // standard deviation of an unknown velocity, each axis
constexpr double kAnyTurnRadps = 0.2;
constexpr double kNoTurnRadps = 1e-3;
constexpr double kLeastWeight = 1e-4;

MotionCovariance noise(double acceleration, double turn_change, double dt) {
  MotionCovariance q = MotionCovariance::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    q(axis, axis) = acceleration * dt * dt * dt / 3.0;
    q(axis, axis + 2) = q(axis + 2, axis) = acceleration * dt * dt / 2.0;
    q(axis + 2, axis + 2) = acceleration * dt;
  }
  q(4, 4) = turn_change * dt;
  return q;
}

// Coordinated turn: the velocity turns with omega, the position is its integral; with its Jacobian.
MotionState turned(const MotionState& x, double dt, MotionCovariance& f) {
  const double w = x[4];
  const double angle = w * dt;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const bool straight = std::abs(angle) < 1e-4;
  // sin(a) / w, (1 - cos(a)) / w and their slopes in w.
  const double a = straight ? dt : s / w;
  const double b = straight ? 0.5 * angle * dt : (1.0 - c) / w;
  const double da = straight ? -dt * dt * angle / 3.0 : (dt * c - a) / w;
  const double db = straight ? 0.5 * dt * dt : (dt * s - b) / w;
  const double vx = x[2];
  const double vy = x[3];
  const double kept = std::exp(-dt / kTurnDecayS);
  MotionState y;
  y << x[0] + a * vx - b * vy, x[1] + b * vx + a * vy, c * vx - s * vy, s * vx + c * vy, kept * w;
  f.setIdentity();
  f.block<2, 2>(0, 2) << a, -b, b, a;
  f.block<2, 2>(2, 2) << c, -s, s, c;
  f.col(4) << da * vx - db * vy, db * vx + da * vy, -dt * (s * vx + c * vy), dt * (c * vx - s * vy),
      kept;
  return y;
}

template <int N>
double distance2Of(const Measurement& m, const MotionState& x, const MotionCovariance& p,
                   double& determinant) {
  const Eigen::Matrix<double, N, N> s =
      p.topLeftCorner<N, N>() + m.covariance.topLeftCorner<N, N>();
  const Eigen::Matrix<double, N, 1> off = m.value.head<N>() - x.head<N>();
  determinant = s.determinant();
  return off.dot(s.inverse() * off);
}
double distance2Of(const Measurement& m, const MotionState& x, const MotionCovariance& p,
                   double& determinant) {
  return m.has_velocity ? distance2Of<4>(m, x, p, determinant)
                        : distance2Of<2>(m, x, p, determinant);
}

double density(const Measurement& m, const MotionState& x, const MotionCovariance& p) {
  double determinant = 1.0;
  const double distance2 = distance2Of(m, x, p, determinant);
  const double turns = m.has_velocity ? 4.0 * kPi * kPi : 2.0 * kPi;
  return std::exp(-0.5 * distance2) / (turns * std::sqrt(determinant));
}

// One Kalman update of state and covariance.
template <int N>
void correct(const Measurement& m, MotionState& x, MotionCovariance& p) {
  const Eigen::Matrix<double, N, N> s =
      p.topLeftCorner<N, N>() + m.covariance.topLeftCorner<N, N>();
  const Eigen::Matrix<double, 5, N> gain = p.leftCols<N>() * s.inverse();
  x += gain * (m.value.head<N>() - x.head<N>());
  const Eigen::Matrix<double, N, 5> rows = p.topRows<N>();
  p -= gain * rows;
}

}  // namespace

MotionFilter::MotionFilter(const Measurement& first, double stamp_s) : stamp_s_(stamp_s) {
  for (Model& model : models_) {
    model.x.head<4>() = first.value;
    model.P.topLeftCorner<4, 4>() = first.covariance;
    if (!first.has_velocity) {
      model.P.block<2, 2>(2, 2).diagonal().setConstant(kAnySpeedMps * kAnySpeedMps);
    }
  }
  models_[0].weight = 0.9;
  models_[1].weight = 0.1;
  models_[0].P(4, 4) = kNoTurnRadps * kNoTurnRadps;
  models_[1].P(4, 4) = kAnyTurnRadps * kAnyTurnRadps;
}

// The models' estimates as each model's start, by how probable it is to have come from there.
void MotionFilter::mix(double dt_s) {
  const double leave[kModels] = {1.0 - std::exp(-dt_s / kStraightHoldsS),
                                 1.0 - std::exp(-dt_s / kTurningHoldsS)};
  const std::array<Model, kModels> before = models_;
  // Who begins to turn may do so at any rate.
  const double any_turn[kModels] = {0.0, kAnyTurnRadps * kAnyTurnRadps};
  for (std::size_t to = 0; to < kModels; ++to) {
    const std::size_t other = 1 - to;
    const double stays = (1.0 - leave[to]) * before[to].weight;
    const double comes = leave[other] * before[other].weight;
    Model& model = models_[to];
    model.weight = stays + comes;
    const double share = comes / model.weight;
    const MotionState between = before[other].x - before[to].x;
    model.x = before[to].x + share * between;
    model.P = (1.0 - share) * before[to].P + share * before[other].P +
              share * (1.0 - share) * between * between.transpose();
    model.P(4, 4) += share * any_turn[to];
  }
}

void MotionFilter::predict(double time_s) {
  const double dt = time_s - stamp_s_;
  if (!(dt > 0.0)) {
    return;
  }
  stamp_s_ = time_s;
  mix(dt);
  Model& straight = models_[0];
  MotionCovariance f = MotionCovariance::Identity();
  f(0, 2) = f(1, 3) = dt;
  f(4, 4) = 0.0;
  straight.x = f * straight.x;
  straight.P = f * straight.P * f.transpose() + noise(kStraightAcceleration, 0.0, dt);
  straight.P(4, 4) = kNoTurnRadps * kNoTurnRadps;
  Model& turning = models_[1];
  turning.x = turned(turning.x, dt, f);
  turning.P = f * turning.P * f.transpose() + noise(kTurningAcceleration, kTurnChange, dt);
}

MotionFilter::PerModel MotionFilter::likelihoods(const Measurement& measurement) const {
  PerModel by_model{};
  for (std::size_t m = 0; m < kModels; ++m) {
    by_model[m] = density(measurement, models_[m].x, models_[m].P);
  }
  return by_model;
}

double MotionFilter::likelihood(const PerModel& by_model) const {
  return models_[0].weight * by_model[0] + models_[1].weight * by_model[1];
}

double MotionFilter::distance2(const Measurement& measurement) const {
  double determinant = 1.0;
  return distance2Of(measurement, state(), covariance(), determinant);
}

void MotionFilter::update(const std::vector<Candidate>& candidates) {
  double none = 1.0;
  for (const Candidate& candidate : candidates) {
    none -= candidate.probability;
  }
  none = std::max(0.0, none);
  double sum = 0.0;
  for (std::size_t m = 0; m < kModels; ++m) {
    Model& model = models_[m];
    // How much more probable this model makes what was seen than all models together do.
    double evidence = none;
    for (const Candidate& candidate : candidates) {
      evidence += candidate.probability * candidate.likelihoods[m] /
                  std::max(likelihood(candidate.likelihoods), 1e-300);
    }
    evidence = std::max(evidence, 1e-12);
    const Model before = model;
    MotionState x = none / evidence * before.x;
    MotionCovariance p = none / evidence * (before.P + before.x * before.x.transpose());
    for (const Candidate& candidate : candidates) {
      const double share = candidate.probability * candidate.likelihoods[m] /
                           std::max(likelihood(candidate.likelihoods), 1e-300) / evidence;
      MotionState one = before.x;
      MotionCovariance its = before.P;
      if (candidate.measurement.has_velocity) {
        correct<4>(candidate.measurement, one, its);
      } else {
        correct<2>(candidate.measurement, one, its);
      }
      x += share * one;
      p += share * (its + one * one.transpose());
    }
    p -= x * x.transpose();
    model.x = x;
    model.P = 0.5 * (p + p.transpose());
    model.weight *= evidence;
    sum += model.weight;
  }
  for (Model& model : models_) {
    model.weight = std::clamp(model.weight / sum, kLeastWeight, 1.0 - kLeastWeight);
  }
}

void MotionFilter::update(const Measurement& measurement) {
  update({{measurement, likelihoods(measurement), 1.0}});
}

void MotionFilter::shift(const Eigen::Vector2d& by) {
  for (Model& model : models_) {
    model.x.head<2>() += by;
  }
}

MotionState MotionFilter::state() const {
  return models_[0].weight * models_[0].x + models_[1].weight * models_[1].x;
}

MotionCovariance MotionFilter::likelyCovariance() const {
  constexpr double kCertain = 0.985;
  for (const Model& model : models_) {
    if (model.weight > kCertain) {
      return model.P;
    }
  }
  return covariance();
}

MotionCovariance MotionFilter::covariance() const {
  const MotionState between = models_[1].x - models_[0].x;
  return models_[0].weight * models_[0].P + models_[1].weight * models_[1].P +
         models_[0].weight * models_[1].weight * between * between.transpose();
}

}  // namespace otter_nav::traffic
