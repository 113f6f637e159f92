#include "tracker/orbital_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "otter_nav/vessel/motion_law.hpp"

namespace otter_nav::tracker {
namespace {

using vessel::kPsi;

// From the swell that is felt as a current for a while to the chop of a small lake.
constexpr std::array<double, OrbitalMotion::kBands> kBandsRadps = {1.0, 1.5, 2.2, 3.2};
constexpr double kBandDamping = 0.05;  // relative: a wave is followed for a few of its lengths
// Small at first: waves that aren't known yet are not to hide a current.
constexpr double kBandSigmaMps = 0.025;
constexpr double kBandLeastMps = 0.01;
constexpr double kSeaMemoryS = 30.0;

// Of displacement and velocity after `s` over those before.
Eigen::Matrix2d swing(double radps, double s) {
  const double fading = kBandDamping * radps;
  const double damped = radps * std::sqrt(1.0 - kBandDamping * kBandDamping);
  const double c = std::exp(-fading * s) * std::cos(damped * s);
  const double n = std::exp(-fading * s) * std::sin(damped * s) / damped;
  Eigen::Matrix2d m;
  m << c + fading * n, n, -radps * radps * n, c - fading * n;
  return m;
}

}  // namespace

vessel::State derivativeInWater(const vessel::State& state, const vessel::Thrusts& thrusts,
                                const vessel::Parameters& vessel,
                                const vessel::Disturbance& disturbance, const WaterMotion& water) {
  vessel::Disturbance with = disturbance;
  with.current_mps += water.velocity_mps;
  vessel::State rate =
      vessel::stateDerivative(state, thrusts, vessel.manoeuvring, vessel.thrusters, with);
  const double c = std::cos(state[kPsi]);
  const double s = std::sin(state[kPsi]);
  const Eigen::Vector2d& a = water.acceleration_mps2;
  rate[vessel::kSurge] += vessel::aheadPart(c, s, a.x(), a.y());
  rate[vessel::kSway] += vessel::portPart(c, s, a.x(), a.y());
  return rate;
}

OrbitalMotion::OrbitalMotion() {
  rate_variance_.setConstant(kBandSigmaMps * kBandSigmaMps);
}

void OrbitalMotion::advance(double dt_s, const Vector& variance) {
  for (int band = 0; band < kBands; ++band) {
    const Eigen::Vector2d x = state_.segment<2>(4 * band);
    const Eigen::Vector2d rate = state_.segment<2>(4 * band + 2);
    const Eigen::Matrix2d m = swing(kBandsRadps[static_cast<std::size_t>(band)], dt_s);
    state_.segment<2>(4 * band) = m(0, 0) * x + m(0, 1) * rate;
    state_.segment<2>(4 * band + 2) = m(1, 0) * x + m(1, 1) * rate;
    const double square = 0.5 * (rate.squaredNorm() + variance.segment<2>(4 * band + 2).sum());
    double& known = rate_variance_[band];
    known += std::min(1.0, dt_s / kSeaMemoryS) * (square - known);
    known = std::max(known, kBandLeastMps * kBandLeastMps);
  }
}

WaterMotion OrbitalMotion::at(double in_s) const {
  WaterMotion water;
  for (int band = 0; band < kBands; ++band) {
    const double w = kBandsRadps[static_cast<std::size_t>(band)];
    const Eigen::Matrix2d m = swing(w, in_s);
    const Eigen::Vector2d x = state_.segment<2>(4 * band);
    const Eigen::Vector2d rate = state_.segment<2>(4 * band + 2);
    const Eigen::Vector2d then = m(1, 0) * x + m(1, 1) * rate;
    water.velocity_mps += then;
    water.acceleration_mps2 -=
        w * w * (m(0, 0) * x + m(0, 1) * rate) + 2.0 * kBandDamping * w * then;
  }
  return water;
}

OrbitalMotion::Slope OrbitalMotion::velocitySlope() {
  Slope slope = Slope::Zero();
  for (int band = 0; band < kBands; ++band) {
    slope.block<2, 2>(0, 4 * band + 2).setIdentity();
  }
  return slope;
}

OrbitalMotion::Slope OrbitalMotion::accelerationSlope() {
  Slope slope = Slope::Zero();
  for (int band = 0; band < kBands; ++band) {
    const double w = kBandsRadps[static_cast<std::size_t>(band)];
    slope.block<2, 2>(0, 4 * band).diagonal().setConstant(-w * w);
    slope.block<2, 2>(0, 4 * band + 2).diagonal().setConstant(-2.0 * kBandDamping * w);
  }
  return slope;
}

OrbitalMotion::Matrix OrbitalMotion::transition(double dt_s) {
  Matrix f = Matrix::Zero();
  for (int band = 0; band < kBands; ++band) {
    const Eigen::Matrix2d m = swing(kBandsRadps[static_cast<std::size_t>(band)], dt_s);
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 2; ++column) {
        f.block<2, 2>(4 * band + 2 * row, 4 * band + 2 * column)
            .diagonal()
            .setConstant(m(row, column));
      }
    }
  }
  return f;
}

OrbitalMotion::Vector OrbitalMotion::variance() const {
  Vector v;
  for (int band = 0; band < kBands; ++band) {
    const double w = kBandsRadps[static_cast<std::size_t>(band)];
    v.segment<2>(4 * band).setConstant(rate_variance_[band] / (w * w));
    v.segment<2>(4 * band + 2).setConstant(rate_variance_[band]);
  }
  return v;
}

// A driven oscillator's velocity has the variance intensity / (4 damping frequency).
OrbitalMotion::Vector OrbitalMotion::drive() const {
  Vector q = Vector::Zero();
  for (int band = 0; band < kBands; ++band) {
    const double w = kBandsRadps[static_cast<std::size_t>(band)];
    q.segment<2>(4 * band + 2).setConstant(4.0 * kBandDamping * w * rate_variance_[band]);
  }
  return q;
}

}  // namespace otter_nav::tracker
