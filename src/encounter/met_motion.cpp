#include "encounter/met_motion.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace otter_nav::encounter {
namespace {

bool isKnown(const traffic::Track& track) {
  return std::max(track.covariance(2, 2), track.covariance(3, 3)) <= kKnownMps * kKnownMps;
}

GoesOn asTracked(const traffic::Track& track) {
  GoesOn now;
  now.stamp_s = track.stamp_s;
  now.mean << track.position, track.velocity;
  now.covariance = track.covariance;
  return now;
}

}  // namespace

Straying::Straying(double dt) {
  constexpr double kDensity = 3.0;  // of a white acceleration, m^2/s^3
  for (int axis = 0; axis < 2; ++axis) {
    moves(axis, axis + 2) = dt;
    adds(axis, axis) = kDensity * dt * dt * dt / 3.0;
    adds(axis, axis + 2) = adds(axis + 2, axis) = kDensity * dt * dt / 2.0;
    adds(axis + 2, axis + 2) = kDensity * dt;
  }
}

std::optional<GoesOn> MetMotion::follow(const traffic::Track& track) {
  constexpr double kWellMetM = 0.75;  // by the lidar; the radar's places are not so good
  constexpr double kSameInstantS = 0.05;
  constexpr double kStrangeMps = 2.0;  // standard deviation of a velocity that begins anew
  const traffic::Track::Met& met = track.met;
  if (met.deviation_m <= 0.0) {
    return isKnown(track) ? std::optional(asTracked(track)) : std::nullopt;
  }
  if (met.stamp_s <= now_.stamp_s) {
    return std::nullopt;
  }
  const double speed = std::max(now_.mean.tail<2>().norm(), track.velocity.norm());
  const bool reached = canBeAt(met, speed);
  const bool fits = update(met);
  lost_ = lost_ || (!fits && !reached);
  last_ = met;
  if (met.deviation_m < kWellMetM && isKnown(track) &&
      std::abs(met.stamp_s - track.stamp_s) < kSameInstantS) {
    now_ = asTracked(track);
    now_.stamp_s = met.stamp_s;
  } else if (!fits) {
    const double variance = met.deviation_m * met.deviation_m;
    now_.mean << met.position, track.velocity;
    now_.covariance.setZero();
    now_.covariance.diagonal() << variance, variance, kStrangeMps * kStrangeMps,
        kStrangeMps * kStrangeMps;
  }
  return now_;
}

bool MetMotion::update(const traffic::Track::Met& met) {
  constexpr double kGate2 = 25.0;  // squared Mahalanobis distance
  constexpr double kLongS = 4.0;
  const double dt = met.stamp_s - std::exchange(now_.stamp_s, met.stamp_s);
  if (now_.covariance(0, 0) <= 0.0 || dt > kLongS) {
    return false;
  }
  const Straying straying(dt);
  const Eigen::Vector4d mean = straying.moves * now_.mean;
  const Eigen::Matrix4d covariance =
      straying.moves * now_.covariance * straying.moves.transpose() + straying.adds;
  const Eigen::Vector2d off = met.position - mean.head<2>();
  const Eigen::Matrix2d spread = covariance.topLeftCorner<2, 2>() +
                                 met.deviation_m * met.deviation_m * Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d inverse = spread.inverse();
  if (off.dot(inverse * off) > kGate2) {
    return false;
  }
  const Eigen::Matrix<double, 4, 2> gain = covariance.leftCols<2>() * inverse;
  now_.mean = mean + gain * off;
  now_.covariance = covariance - gain * covariance.topRows<2>();
  return true;
}

bool MetMotion::canBeAt(const traffic::Track::Met& met, double speed_mps) const {
  constexpr double kSoonS = 2.5;  // the radar may miss her once
  constexpr double kFaster = 1.2;
  constexpr double kSigmas = 3.0;
  const double dt = met.stamp_s - last_.stamp_s;
  return last_.deviation_m > 0.0 && dt < kSoonS &&
         (met.position - last_.position).norm() <
             kFaster * speed_mps * dt + kSigmas * std::hypot(last_.deviation_m, met.deviation_m);
}

bool MetMotion::wasLost() {
  return std::exchange(lost_, false);
}

}  // namespace otter_nav::encounter
