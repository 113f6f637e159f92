#include "tracker/estimator.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/rk4.hpp"
#include "otter_nav/vessel/crawl.hpp"

namespace otter_nav::tracker {

namespace {

// What the model leaves open, and how it wanders: standard deviations per square root of a second.
// Of the velocities at least; in waves it is more, by what the corrections of the last seconds say.
constexpr double kVelocityWalkMps = 0.02;
constexpr double kYawRateWalkRadps = 0.02;
constexpr double kCorrectionsS = 0.3;  // waves push longer than that one way, noise doesn't
constexpr double kMemoryS = 10.0;
constexpr double kWalkShare = 0.25;  // of their intensity: most is faster than a force that lasts
// A force fixed in the earth frame and a moment about the yaw axis. Wind and waves push a hull by
// its area, so walks and what is not known at the start go with length times beam, the moment's
// with the length again. The walk of the force is slow on purpose: waves taken for a force would be
// thrown at the propellers.
constexpr double kForceWalkNpm2 = 0.5 / 2.16;
constexpr double kForceSigmaNpm2 = 10.0 / 2.16;
constexpr double kForceSigmaBesideCurrentNpm2 = 5.0 / 2.16;
constexpr double kMomentWalkNpm2 = 10.0 / 4.32;
constexpr double kMomentWalkInWindNpm2 = 2.0 / 4.32;  // what the wind's own moment leaves
// Of the moment's walk, where the water that turns the hull is known.
constexpr double kMomentWalkInWater = 0.3;
constexpr double kMomentSigmaNpm2 = 5.0 / 4.32;
constexpr double kForceMostNpm2 = 80.0 / 2.16;  // more is not believed
constexpr double kMomentMostNpm2 = 60.0 / 4.32;
constexpr double kCurrentSigmaMps = 0.3;
constexpr double kCurrentMostMps = 1.5;
// On a steady course the two aren't told apart: both fade, or they would walk away from each other.
// The force soon: gusts come and go, and while a current turns, a force that lasted would make up
// for what it was minutes ago. In a turn it shows, and lasts.
constexpr double kForceFadesS = 20.0;
constexpr double kTurningRadps = 0.1;
constexpr double kTurningMemoryS = 5.0;  // longer than waves swing the bow one way
constexpr double kCurrentFadesS = 200.0;
// A hull that lies still on its heading doesn't tell a moment from one of the wind, whose loads
// also say what turning will bring: what lasts is the wind's.
constexpr double kMomentFadesInWindS = 3.0;
constexpr double kDragRatio = 1.25;  // abeam to ahead or the reverse, that tells current from force
// Of q = |w| w, for vessels whose model knows wind loads.
constexpr double kWindWalkM2ps2 = 10.0;
constexpr double kWindSigmaM2ps2 = 30.0;
constexpr double kWindMostMps = 20.0;
constexpr double kWaveDamping = 0.1;  // of the waves' oscillators, relative
// Hull's lengths a second, at which waves from abeam are steered against altogether; beyond a crawl
// it begins.
constexpr double kSailingPerS = 0.6;

}  // namespace

// Under one drag ahead and abeam a current is a force.
bool tellsCurrent(const vessel::ManoeuvringModel& model) {
  constexpr double kThroughMps = 0.5;
  const double ahead = model.surge_drag_kgps + kThroughMps * model.surge_drag_quadratic_kgpm;
  const double abeam = model.sway_drag_kgps + kThroughMps * model.sway_drag_quadratic_kgpm;
  return std::max(ahead, abeam) > kDragRatio * std::min(ahead, abeam);
}

using vessel::kPsi;
using vessel::kSurge;
using vessel::kSway;
using vessel::kYawRate;

Estimator::Estimator(const EstimatorOptions& options, const vessel::Parameters& vessel, Waves waves)
    : options_(options), waves_(waves), vessel_(vessel) {
  const auto& o = options_;
  measurement_variance_ << o.position_sigma_m, o.position_sigma_m, o.heading_sigma_rad,
      o.velocity_sigma_mps, o.velocity_sigma_mps, o.yaw_rate_sigma_radps;
  measurement_variance_ = measurement_variance_.cwiseAbs2();
  const vessel::Hull& hull = vessel.hull;
  const double area_m2 = hull.length_m * hull.beam_m;
  const double area_moment_m3 = area_m2 * hull.length_m;
  force_most_n_ = kForceMostNpm2 * area_m2;
  moment_most_nm_ = kMomentMostNpm2 * area_moment_m3;
  const double force_walk = kForceWalkNpm2 * area_m2;
  const bool in_water = waves_ == Waves::kInTheWater;
  const double moment_walk =
      (in_water ? kMomentWalkInWater : 1.0) *
      (vessel_.manoeuvring.feelsWind() ? kMomentWalkInWindNpm2 : kMomentWalkNpm2) * area_moment_m3;
  if (vessel_.manoeuvring.feelsWind()) {
    moment_fade_per_s_ = 1.0 / kMomentFadesInWindS;
  }
  const double current_walk = tellsCurrent(vessel_.manoeuvring) ? o.current_walk_mps : 0.0;
  const double current_sigma = current_walk > 0.0 ? kCurrentSigmaMps : 0.0;
  if (current_walk > 0.0) {
    current_fade_per_s_ = 1.0 / kCurrentFadesS;
  }
  walk_variance_.setZero();
  walk_variance_.head<kWave>() << 0.0, 0.0, 0.0, kVelocityWalkMps, kVelocityWalkMps,
      kYawRateWalkRadps, force_walk, force_walk, moment_walk, current_walk, current_walk,
      kWindWalkM2ps2, kWindWalkM2ps2;
  walk_variance_ = walk_variance_.cwiseAbs2().eval();
  least_walk_variance_ = walk_variance_.segment<3>(kSurge);
  wave_rate_variance_ =
      Eigen::Vector3d(o.wave_velocity_mps, o.wave_velocity_mps, o.wave_yaw_rate_radps).cwiseAbs2();
  if (in_water) {
    wave_rate_variance_.head<2>().setZero();
  }
  const double force_sigma =
      (current_walk > 0.0 ? kForceSigmaBesideCurrentNpm2 : kForceSigmaNpm2) * area_m2;
  if (o.enabled) {
    covariance_.diagonal().segment<7>(kForce) << force_sigma, force_sigma,
        kMomentSigmaNpm2 * area_moment_m3, current_sigma, current_sigma, kWindSigmaM2ps2,
        kWindSigmaM2ps2;
    covariance_ = covariance_.cwiseAbs2().eval();
  } else {
    walk_variance_.segment<7>(kForce).setZero();
  }
  if (!vessel_.manoeuvring.feelsWind()) {
    walk_variance_.segment<2>(kWind).setZero();
    covariance_.diagonal().segment<2>(kWind).setZero();
  }
}

void Estimator::reset(const vessel::State& measured) {
  state_ = measured;
  covariance_.topRows<6>().setZero();
  covariance_.leftCols<6>().setZero();
  covariance_.diagonal().head<6>() = measurement_variance_;
  constexpr int kOfWaves = kSize - kWave;
  covariance_.bottomRows<kOfWaves>().setZero();
  covariance_.rightCols<kOfWaves>().setZero();
  correction_.setZero();
  wave_.setZero();
  wave_rate_.setZero();
  const double w = wave_frequency_.radps();
  covariance_.diagonal().segment<3>(kWaveRate) = wave_rate_variance_;
  covariance_.diagonal().segment<3>(kWave) = wave_rate_variance_ / (w * w);
  water_.reset();
  if (waves_ == Waves::kInTheWater) {
    covariance_.diagonal().segment<OrbitalMotion::kSize>(kWater) = water_.variance();
  }
}

// A driven oscillator's velocity has the variance intensity / (4 damping frequency).
Eigen::Vector3d Estimator::waveDrive() const {
  return 4.0 * kWaveDamping * wave_frequency_.radps() * wave_rate_variance_;
}

Eigen::Matrix<double, 6, Estimator::kSize> Estimator::measurement() const {
  Eigen::Matrix<double, 6, kSize> h = Eigen::Matrix<double, 6, kSize>::Zero();
  h.leftCols<6>().setIdentity();
  h.block<3, 3>(0, kWave).setIdentity();
  const double c = std::cos(state_[kPsi]);
  const double s = std::sin(state_[kPsi]);
  h.block<2, 2>(kSurge, kWaveRate) << c, s, -s, c;
  h(kYawRate, kWaveRate + 2) = 1.0;
  return h;
}

vessel::State Estimator::innovation(const vessel::State& measured) const {
  vessel::State difference = measured - state_;
  difference.head<3>() -= wave_;
  const double c = std::cos(state_[kPsi]);
  const double s = std::sin(state_[kPsi]);
  difference[kSurge] -= c * wave_rate_[0] + s * wave_rate_[1];
  difference[kSway] -= -s * wave_rate_[0] + c * wave_rate_[1];
  difference[kYawRate] -= wave_rate_[2];
  difference[kPsi] = wrapAngle(difference[kPsi]);
  return difference;
}

double Estimator::sailingShare() const {
  const double pace = std::abs(state_[kSurge]) / vessel_.hull.length_m;
  const double x =
      std::clamp((pace - vessel::kCrawlPerS) / (kSailingPerS - vessel::kCrawlPerS), 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

vessel::State Estimator::steered() const {
  const double share = sailingShare();
  const Eigen::Vector2d ahead = unitVector(state_[kPsi]);
  const Eigen::Vector2d port = across(ahead);
  vessel::State steered = state_;
  steered.head<2>() +=
      ahead.dot(wave_.head<2>()) * ahead + share * port.dot(wave_.head<2>()) * port;
  steered[kPsi] += wave_[2];
  steered[kSurge] += ahead.dot(wave_rate_.head<2>());
  steered[kSway] += share * port.dot(wave_rate_.head<2>());
  steered[kYawRate] += wave_rate_[2];
  return steered;
}

// Loads k |q_i| q_i / |q| and k q_x q_y / |q| over q, seen from the body.
Eigen::Matrix<double, 3, 2> Estimator::fromWind() const {
  constexpr double kCalm = 1.0;  // m^2/s^2: below, the loads count as k q_i
  const vessel::ManoeuvringModel& m = vessel_.manoeuvring;
  const double c = std::cos(state_[kPsi]);
  const double s = std::sin(state_[kPsi]);
  Eigen::Matrix2d body_from_earth;
  body_from_earth << c, s, -s, c;
  const double size = wind_pressure_.norm();
  Eigen::Matrix<double, 3, 2> d;
  if (size < kCalm) {
    d << m.wind_surge_kgpm, 0.0, 0.0, m.wind_sway_kgpm, 0.0, 0.0;
  } else {
    const Eigen::Vector2d n = body_from_earth * wind_pressure_ / size;
    const double along = m.wind_surge_kgpm * std::abs(n.x());
    const double across = m.wind_sway_kgpm * std::abs(n.y());
    d << along * (2.0 - n.x() * n.x()), -along * n.x() * n.y(),  //
        -across * n.x() * n.y(), across * (2.0 - n.y() * n.y()),
        m.wind_yaw_kg * n.y() * (1.0 - n.x() * n.x()),
        m.wind_yaw_kg * n.x() * (1.0 - n.y() * n.y());
  }
  d.row(0) /= m.surge_inertia_kg;
  d.row(1) /= m.sway_inertia_kg;
  d.row(2) /= m.yaw_inertia_kgm2;
  return d * body_from_earth;
}

// I + dt * Jacobian: over 10 ms the next order is below the noise.
Estimator::Covariance Estimator::transition(const vessel::Thrusts& thrusts, double dt_s) const {
  const bool in_water = waves_ == Waves::kInTheWater;
  vessel::Disturbance with_water = disturbance_;
  if (in_water) {
    with_water.current_mps += water_.at(0.0).velocity_mps;
  }
  const vessel::Linearization l =
      vessel::linearize(state_, thrusts, vessel_.manoeuvring, vessel_.thrusters, with_water);
  Eigen::Matrix2d body_from_earth;
  const double c = std::cos(state_[kPsi]);
  const double s = std::sin(state_[kPsi]);
  body_from_earth << c, s, -s, c;

  Covariance f = Covariance::Identity();
  f.topLeftCorner<6, 6>() += dt_s * l.state_jacobian;
  f.block<1, 2>(kSurge, kForce) =
      dt_s / vessel_.manoeuvring.surge_inertia_kg * body_from_earth.row(0);
  f.block<1, 2>(kSway, kForce) =
      dt_s / vessel_.manoeuvring.sway_inertia_kg * body_from_earth.row(1);
  f(kYawRate, kMoment) = dt_s / vessel_.manoeuvring.yaw_inertia_kgm2;
  f.block<3, 2>(kSurge, kCurrent) = dt_s * l.current_jacobian;
  f.block<3, 2>(kSurge, kWind) = dt_s * fromWind();
  f.block<2, 2>(kForce, kForce).diagonal().array() -= dt_s * force_fade_per_s_;
  f(kMoment, kMoment) -= dt_s * moment_fade_per_s_;
  f.block<2, 2>(kCurrent, kCurrent).diagonal().array() -= dt_s * current_fade_per_s_;
  const double w = wave_frequency_.radps();
  f.block<3, 3>(kWave, kWaveRate).diagonal().setConstant(dt_s);
  f.block<3, 3>(kWaveRate, kWave).diagonal().setConstant(-dt_s * w * w);
  f.block<3, 3>(kWaveRate, kWaveRate).diagonal().array() -= 2.0 * dt_s * kWaveDamping * w;
  if (in_water) {
    constexpr int kOfWater = OrbitalMotion::kSize;
    f.block<3, kOfWater>(kSurge, kWater) =
        dt_s * l.current_jacobian * OrbitalMotion::velocitySlope();
    f.block<2, kOfWater>(kSurge, kWater) +=
        dt_s * body_from_earth * OrbitalMotion::accelerationSlope();
    f.block<kOfWater, kOfWater>(kWater, kWater) = OrbitalMotion::transition(dt_s);
  }
  return f;
}

// f P f^T. What follows the hull's own rows goes on by itself, but for an oscillator's other half:
// whole products are six times as many multiplications.
void Estimator::spread(const Covariance& f) {
  constexpr int kHull = 6;
  const auto otherHalf = [](int row) {
    if (row < kWave) {
      return row;
    }
    if (row < kWater) {
      return row < kWaveRate ? row + 3 : row - 3;
    }
    return (row - kWater) % 4 < 2 ? row + 2 : row - 2;
  };
  const int used = usedSize();
  const auto half = [&](const Covariance& p) {
    Covariance moved = Covariance::Zero();
    moved.topLeftCorner(kHull, used).noalias() =
        f.topLeftCorner(kHull, used) * p.topLeftCorner(used, used);
    for (int row = kHull; row < used; ++row) {
      const int other = otherHalf(row);
      moved.row(row).head(used) = f(row, row) * p.row(row).head(used);
      if (other != row) {
        moved.row(row).head(used) += f(row, other) * p.row(other).head(used);
      }
    }
    return moved;
  };
  const Covariance moved = half(covariance_).transpose();
  covariance_ = half(moved);
}

void Estimator::predict(const vessel::Thrusts& thrusts, double dt_s) {
  predicted_s_ += dt_s;
  turning_radps_ += std::min(1.0, dt_s / kTurningMemoryS) * (state_[kYawRate] - turning_radps_);
  if (current_fade_per_s_ > 0.0) {
    force_fade_per_s_ =
        std::max(0.0, 1.0 - std::abs(turning_radps_) / kTurningRadps) / kForceFadesS;
  }
  spread(transition(thrusts, dt_s));
  covariance_.diagonal() += dt_s * walk_variance_;
  // At speed nothing is taken for waves: told apart from the vessel's own motion they would only
  // come late to what is steered against.
  covariance_.diagonal().segment<3>(kWaveRate) += dt_s * (1.0 - sailingShare()) * waveDrive();
  WaterMotion water;
  if (waves_ == Waves::kInTheWater) {
    water = water_.at(0.5 * dt_s);
    auto variance = covariance_.diagonal().segment<OrbitalMotion::kSize>(kWater);
    water_.advance(dt_s, variance);
    variance += dt_s * water_.drive();
  }
  disturbance_.force_n *= 1.0 - dt_s * force_fade_per_s_;
  disturbance_.moment_nm *= 1.0 - dt_s * moment_fade_per_s_;
  disturbance_.current_mps *= 1.0 - dt_s * current_fade_per_s_;
  // Semi-implicit, so that the oscillator keeps its energy.
  const double w = wave_frequency_.radps();
  wave_rate_ -= dt_s * (w * w * wave_ + 2.0 * kWaveDamping * w * wave_rate_);
  wave_ += dt_s * wave_rate_;
  state_ = rk4Step(
      [&](double, const vessel::State& x) {
        return derivativeInWater(x, thrusts, vessel_, disturbance_, water);
      },
      0.0, state_, dt_s);
}

void Estimator::update(const vessel::State& measured) {
  wave_frequency_.add(measured[kSway], state_[kYawRate], 1.0 - sailingShare(), predicted_s_);
  const Eigen::Matrix<double, 6, kSize> h = measurement();
  const int used = usedSize();
  Eigen::Matrix<double, 6, kSize> seen = Eigen::Matrix<double, 6, kSize>::Zero();
  seen.leftCols(used).noalias() = h.leftCols(used) * covariance_.topLeftCorner(used, used);
  Eigen::Matrix<double, 6, 6> innovation_covariance =
      seen.leftCols<kWater>() * h.leftCols<kWater>().transpose();
  innovation_covariance.diagonal() += measurement_variance_;
  const Eigen::LLT<Eigen::Matrix<double, 6, 6>> factor(innovation_covariance);
  const Eigen::Matrix<double, 6, kSize> gain = factor.solve(seen);
  const Eigen::Matrix<double, kSize, 1> step = gain.transpose() * innovation(measured);
  Covariance explained = Covariance::Zero();
  explained.topLeftCorner(used, used).noalias() =
      gain.leftCols(used).transpose() * seen.leftCols(used);
  covariance_ -= explained;
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
  wave_ += step.segment<3>(kWave);
  wave_rate_ += step.segment<3>(kWaveRate);
  if (waves_ == Waves::kInTheWater) {
    water_.add(step.segment<OrbitalMotion::kSize>(kWater));
  }
  state_ += step.head<6>();
  learnWalk(step.segment<3>(kSurge));
  if (options_.enabled) {
    disturbance_.force_n += step.segment<2>(kForce);
    disturbance_.moment_nm += step[kMoment];
    disturbance_.current_mps += step.segment<2>(kCurrent);
    wind_pressure_ += step.segment<2>(kWind);
    limit();
  }
}

// A filter whose noise is right corrects by white noise of that intensity (Mehra 1970); what pushes
// the hull to and fro beyond it comes in corrections of one sign for a while. Seen through a low
// pass, white noise of intensity q has the variance q / (2 kCorrectionsS).
void Estimator::learnWalk(const Eigen::Vector3d& step) {
  if (predicted_s_ <= 0.0) {
    return;
  }
  correction_ += std::min(1.0, predicted_s_ / kCorrectionsS) * (step / predicted_s_ - correction_);
  Eigen::Vector3d intensity = 2.0 * kCorrectionsS * correction_.cwiseAbs2();
  intensity.head<2>().setConstant(intensity.head<2>().mean());  // as the hull turns
  correction_intensity_ +=
      std::min(1.0, predicted_s_ / kMemoryS) * (intensity - correction_intensity_);
  // At crawling pace the waves have states of their own.
  const double share = waves_ == Waves::kInTheWater ? 1.0 : sailingShare();
  walk_variance_.segment<3>(kSurge) =
      (share * kWalkShare * correction_intensity_).cwiseMax(least_walk_variance_);
  predicted_s_ = 0.0;
}

vessel::DisturbanceEstimate Estimator::disturbanceEstimate() const {
  using Estimate = vessel::DisturbanceEstimate;
  constexpr double kCalmM2ps2 = 1.0;  // below it the wind's slope over q is bounded
  Estimate estimate;
  estimate.mean = disturbance_;
  estimate.knows_waves = wave_frequency_.isKnown();
  // w = q / sqrt|q|
  const double size = std::max(wind_pressure_.norm(), kCalmM2ps2);
  const Eigen::Vector2d n = wind_pressure_ / size;
  Eigen::Matrix<double, Estimate::kSize, Estimate::kSize> by_state;
  by_state.setIdentity();
  by_state.block<2, 2>(Estimate::kWind, Estimate::kWind) =
      (Eigen::Matrix2d::Identity() - 0.5 * n * n.transpose()) / std::sqrt(size);
  estimate.covariance = by_state *
                        covariance_.block<Estimate::kSize, Estimate::kSize>(kForce, kForce) *
                        by_state.transpose();
  return estimate;
}

void Estimator::limit() {
  const auto clampNorm = [](Eigen::Vector2d& v, double limit) {
    const double norm = v.norm();
    if (norm > limit) {
      v *= limit / norm;
    }
  };
  clampNorm(disturbance_.force_n, force_most_n_);
  clampNorm(disturbance_.current_mps, kCurrentMostMps);
  clampNorm(wind_pressure_, kWindMostMps * kWindMostMps);
  const double size = wind_pressure_.norm();
  disturbance_.wind_mps = size > 0.0 ? (wind_pressure_ / std::sqrt(size)).eval() : wind_pressure_;
  disturbance_.moment_nm = std::clamp(disturbance_.moment_nm, -moment_most_nm_, moment_most_nm_);
}

}  // namespace otter_nav::tracker
