#include "otter_nav/traffic/track.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::traffic {
namespace {

constexpr double kSampleS = 0.5;

// A turn rate that dies out has turned by this angle after `t_s`.
double turnedBy(const Track& track, double t_s) {
  return track.turn_rate_radps * track.turn_time_s * (1.0 - std::exp(-t_s / track.turn_time_s));
}

// Position's variance, each axis, of a velocity that strays as an Ornstein-Uhlenbeck process from
// none at t = 0 (its integral's variance).
double strayVariance(double t_s, const PredictionOptions& o) {
  const double k = t_s / o.stray_time_s;
  const double reach = o.stray_deviation_mps * o.stray_time_s;
  return reach * reach * (2.0 * k - 3.0 + 4.0 * std::exp(-k) - std::exp(-2.0 * k));
}

Eigen::Matrix2d positionCovariance(const Track& track, double t_s, const PredictionOptions& o) {
  const Eigen::Matrix4d& p = track.covariance;
  const Eigen::Matrix2d mixed = p.topRightCorner<2, 2>();
  return p.topLeftCorner<2, 2>() + t_s * (mixed + mixed.transpose()) +
         t_s * t_s * p.bottomRightCorner<2, 2>() +
         (track.keeps_place ? 0.0 : strayVariance(t_s, o)) * Eigen::Matrix2d::Identity();
}

// The present outline moved to `position` and grown by what is uncertain after `t_s`.
Outline grown(const Track& track, const Eigen::Vector2d& position, double t_s,
              const PredictionOptions& o) {
  const Eigen::Matrix2d covariance = positionCovariance(track, t_s, o);
  const auto growth = [&](const Eigen::Vector2d& axis) {
    const double variance = std::max(0.0, axis.dot(covariance * axis));
    return std::min(o.growth_max_m, o.sigmas * std::sqrt(variance));
  };
  Outline outline;
  outline.position = position;
  outline.heading_rad = track.heading_rad + turnedBy(track, t_s);
  outline.bow = unitVector(outline.heading_rad);
  const Eigen::Vector2d& ahead = outline.bow;
  const Eigen::Vector2d port = across(ahead);
  outline.half_length_m = growth(ahead);
  outline.half_beam_m = growth(port);
  if (track.shape == Shape::kDisc) {
    outline.radius_m = 0.5 * track.length_m;
  } else {
    outline.half_length_m += 0.5 * track.length_m;
    outline.half_beam_m += 0.5 * track.beam_m;
  }
  return outline;
}

}  // namespace

Outline::Distance Outline::distanceTo(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d& ahead = bow;
  const Eigen::Vector2d port = across(ahead);
  const Eigen::Vector2d off = point - position;
  const Eigen::Vector2d local(ahead.dot(off), port.dot(off));
  const Eigen::Vector2d over = local.cwiseAbs() - Eigen::Vector2d(half_length_m, half_beam_m);
  const Eigen::Vector2d outside = over.cwiseMax(0.0);
  Eigen::Vector2d slope;  // in the box's axes, of its positive quadrant
  double distance = outside.norm();
  if (distance > 0.0) {
    slope = outside / distance;
  } else {
    distance = over.maxCoeff();
    slope = over.x() > over.y() ? Eigen::Vector2d::UnitX() : Eigen::Vector2d::UnitY();
  }
  const double along = std::copysign(slope.x(), local.x());
  const double athwart = std::copysign(slope.y(), local.y());
  return {distance - radius_m, along * ahead + athwart * port};
}

double Outline::reach() const {
  return std::hypot(half_length_m, half_beam_m) + radius_m;
}

PredictedPath::PredictedPath(const Track& track, const PredictionOptions& options) : track_(track) {
  const auto count = static_cast<std::size_t>(std::ceil(options.horizon_s / kSampleS)) + 1;
  samples_.reserve(std::max<std::size_t>(count, 2));
  Eigen::Vector2d position = track.position;
  for (std::size_t k = 0; k < std::max<std::size_t>(count, 2); ++k) {
    const double t = kSampleS * static_cast<double>(k);
    samples_.push_back(grown(track, position, t, options));
    const double middle = turnedBy(track, t + 0.5 * kSampleS);
    position += kSampleS * (Eigen::Rotation2Dd(middle) * track.velocity);
    if (k == 0) {
      continue;
    }
    const Outline& a = samples_[k - 1];
    const Outline& b = samples_[k];
    const double moved =
        (b.position - a.position).norm() +
        std::abs(b.heading_rad - a.heading_rad) * std::max(a.reach(), b.reach()) +
        std::hypot(b.half_length_m - a.half_length_m, b.half_beam_m - a.half_beam_m);
    rate_bound_mps_ = std::max(rate_bound_mps_, moved / kSampleS);
    reaches_m_.push_back(std::max(a.reach(), b.reach()));
  }
}

std::size_t PredictedPath::segmentAt(double time_s, double& share) const {
  const double steps = (time_s - track_.stamp_s) / kSampleS;
  const auto last = static_cast<double>(samples_.size() - 2);
  const double segment = std::clamp(std::floor(steps), 0.0, last);
  share = steps - segment;
  return static_cast<std::size_t>(segment);
}

Outline PredictedPath::at(double time_s) const {
  double share = 0.0;
  const std::size_t k = segmentAt(time_s, share);
  const Outline& a = samples_[k];
  const Outline& b = samples_[k + 1];
  Outline outline = a;
  outline.position += share * (b.position - a.position);  // also before and beyond the samples
  const double within = std::clamp(share, 0.0, 1.0);
  if (b.heading_rad != a.heading_rad) {
    outline.heading_rad += within * (b.heading_rad - a.heading_rad);
    outline.bow = unitVector(outline.heading_rad);
  }
  outline.half_length_m += within * (b.half_length_m - a.half_length_m);
  outline.half_beam_m += within * (b.half_beam_m - a.half_beam_m);
  return outline;
}

double PredictedPath::distanceBound(const Eigen::Vector2d& point, double time_s) const {
  double share = 0.0;
  const std::size_t k = segmentAt(time_s, share);
  const Eigen::Vector2d& from = samples_[k].position;
  return (from + share * (samples_[k + 1].position - from) - point).norm() - reaches_m_[k];
}

Track predicted(const Track& track, double time_s, const PredictionOptions& options) {
  const double t = std::max(0.0, time_s - track.stamp_s);
  PredictionOptions to_here = options;
  to_here.horizon_s = t;
  const PredictedPath path(track, to_here);
  Track later = track;
  later.stamp_s = time_s;
  const double turned = turnedBy(track, t);
  later.position = path.at(time_s).position;
  later.velocity = Eigen::Rotation2Dd(turned) * track.velocity;
  later.heading_rad = track.heading_rad + turned;
  later.turn_rate_radps = track.turn_rate_radps * std::exp(-t / track.turn_time_s);
  const Eigen::Matrix2d velocity = track.covariance.bottomRightCorner<2, 2>();
  const Eigen::Matrix2d mixed = track.covariance.topRightCorner<2, 2>() + t * velocity;
  const double kept = std::exp(-t / options.stray_time_s);
  const double variance = options.stray_deviation_mps * options.stray_deviation_mps;
  const double both = variance * options.stray_time_s * (1.0 - kept) * (1.0 - kept);
  later.covariance.topLeftCorner<2, 2>() = positionCovariance(track, t, options);
  later.covariance.topRightCorner<2, 2>() = mixed + both * Eigen::Matrix2d::Identity();
  later.covariance.bottomLeftCorner<2, 2>() = later.covariance.topRightCorner<2, 2>().transpose();
  later.covariance.bottomRightCorner<2, 2>() =
      velocity + variance * (1.0 - kept * kept) * Eigen::Matrix2d::Identity();
  return later;
}

}  // namespace otter_nav::traffic
