#include "optimizer/solve/initial_spline.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kSpacingM = 1.0;
constexpr int kBandSteps = 60;
constexpr double kSlowestMps = 0.8;
constexpr int kMostArcPoints = 12;
constexpr double kArcReachM = 12.0;  // an arc ends heading for the way this far on
constexpr double kEndShare = 0.35;   // of the other parts' duration, the ones next to the ends last
constexpr double kWideTurnRad = 0.9;

double lengthOf(const std::vector<Eigen::Vector2d>& polyline) {
  double length = 0.0;
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    length += (polyline[i] - polyline[i - 1]).norm();
  }
  return length;
}

}  // namespace

Eigen::Vector2d pointAlong(const std::vector<Eigen::Vector2d>& polyline, double distance_m) {
  const bool backward = distance_m < 0.0;
  double left = std::abs(distance_m);
  const std::size_t n = polyline.size();
  for (std::size_t i = 1; i < n; ++i) {
    const Eigen::Vector2d& a = polyline[backward ? n - i : i - 1];
    const Eigen::Vector2d& b = polyline[backward ? n - i - 1 : i];
    const double length = (b - a).norm();
    if (length >= left && length > 0.0) {
      return a + left / length * (b - a);
    }
    left -= length;
  }
  return backward ? polyline.front() : polyline.back();
}

// Each point moves to the middle of its neighbours and off obstacles, in turn.
void InitialWay::stretchBand(const map::DistanceField& field,
                             const std::vector<Eigen::Vector2d>& polyline,
                             const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const double length = std::max(lengthOf(polyline), 2.0 * kSpacingM);
  const int parts = std::max(4, static_cast<int>(std::ceil(length / kSpacingM)));
  band_.clear();
  for (int i = 0; i <= parts; ++i) {
    band_.push_back(pointAlong(polyline, length * i / parts));
  }
  band_.front() = from;
  band_.back() = to;
  next_ = band_;
  for (int step = 0; step < kBandSteps; ++step) {
    for (std::size_t i = 1 + held_head_; i + 1 + held_tail_ < band_.size(); ++i) {
      Eigen::Vector2d p = 0.5 * band_[i] + 0.25 * (band_[i - 1] + band_[i + 1]);
      const map::DistanceField::Smooth d = field.smooth(p);
      if (d.distance_m < options_.clearance_m) {
        const double steep = std::max(d.gradient.norm(), 0.3);
        p += std::min(options_.clearance_m - d.distance_m, 0.5) / steep * d.gradient / steep;
      }
      next_[i] = p;
    }
    std::swap(band_, next_);
  }
}

// The steady speed in a turn: the bow leads the course by beta, so that the sway drag carries it
// round; surge force and the moment d3 k v share the thrust.
double InitialWay::speedIn(double curvature_per_m) const {
  const vessel::PaperModel& m = vessel_.paper;
  const double force = 2.0 * vessel_.thrusters.ahead_max_n * options_.force_share;
  double low = 0.0;
  double high = options_.speed_max_mps;
  const double k = std::abs(curvature_per_m);
  for (int i = 0; i < 12; ++i) {
    const double v = 0.5 * (low + high);
    const double beta = std::atan2(m.m1_kg * v * k, m.d2_kgps);
    const double surge = m.d1_kgps * v * std::cos(beta) + m.m1_kg * v * v * k * std::sin(beta);
    const double need = surge + m.d3_kgm2ps * k * v / vessel_.thrusters.lever_arm_m;
    (need < force ? low : high) = v;
  }
  return std::max(low, kSlowestMps);
}

void InitialWay::paceBand(double speed_from, double speed_to) {
  const std::size_t n = band_.size();
  spacing_m_ = lengthOf(band_) / static_cast<double>(n - 1);
  tangent_.resize(n);
  curvature_.assign(n, 0.0);
  speed_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d chord = band_[std::min(i + 1, n - 1)] - band_[i > 0 ? i - 1 : 0];
    tangent_[i] = chord / std::max(chord.norm(), 1e-9);
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Eigen::Vector2d& a = tangent_[i - 1];
    const Eigen::Vector2d& b = tangent_[i + 1];
    curvature_[i] = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)) / (2.0 * spacing_m_);
  }
  for (std::size_t i = 0; i < n; ++i) {
    speed_[i] = speedIn(curvature_[i]);
  }
  speed_.front() = std::max(speed_from, kSlowestMps);
  speed_.back() = std::max(speed_to, kSlowestMps);
  const vessel::PaperModel& m = vessel_.paper;
  const double force = 2.0 * vessel_.thrusters.ahead_max_n * options_.force_share;
  for (std::size_t i = 1; i < n; ++i) {
    const double v = speed_[i - 1];
    const double accel = std::max(0.7 * (force - m.d1_kgps * v) / m.m1_kg, 0.05);
    speed_[i] = std::min(speed_[i], std::sqrt(v * v + 2.0 * accel * spacing_m_));
  }
  for (std::size_t i = n - 1; i-- > 1;) {
    const double v = speed_[i + 1];
    const double astern = 2.0 * vessel_.thrusters.astern_max_n * options_.force_share;
    const double drag = 0.7 * std::min(m.d2_kgps * v, m.d1_kgps * v + astern) / m.m1_kg;
    speed_[i] = std::min(speed_[i], std::sqrt(v * v + 2.0 * drag * spacing_m_));
  }
}

Knot InitialWay::knotAt(double s) const {
  const double at = std::clamp(s / spacing_m_, 0.0, static_cast<double>(band_.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(at), band_.size() - 2);
  const double f = at - static_cast<double>(i);
  Knot knot;
  const Eigen::Vector2d along = ((1.0 - f) * tangent_[i] + f * tangent_[i + 1]).normalized();
  const double v = (1.0 - f) * speed_[i] + f * speed_[i + 1];
  const double k = (1.0 - f) * curvature_[i] + f * curvature_[i + 1];
  const double slope = (speed_[i + 1] - speed_[i]) / spacing_m_;
  knot.state.col(0) = (1.0 - f) * band_[i] + f * band_[i + 1];
  knot.state.col(1) = v * along;
  knot.state.col(2) = v * slope * along + v * v * k * Eigen::Vector2d(-along.y(), along.x());
  return knot;
}

// Distances along the band that cut its time into equal parts, with shorter ones next to the ends.
void InitialWay::cutTime(double part_s) {
  const std::size_t n = band_.size();
  time_.assign(n, 0.0);
  for (std::size_t i = 1; i < n; ++i) {
    time_[i] = time_[i - 1] + 2.0 * spacing_m_ / (speed_[i - 1] + speed_[i]);
  }
  const int parts = std::max(2, static_cast<int>(std::ceil(time_.back() / part_s)));
  const double even_s = time_.back() / parts;
  times_ = {0.0, kEndShare * even_s};
  for (int k = 1; k < parts; ++k) {
    times_.push_back(even_s * k);
  }
  times_.push_back(time_.back() - kEndShare * even_s);
  times_.push_back(time_.back());
  cuts_.clear();
  std::size_t i = 0;
  for (const double t : times_) {
    while (i + 2 < n && time_[i + 1] < t) {
      ++i;
    }
    const double f = std::clamp((t - time_[i]) / (time_[i + 1] - time_[i]), 0.0, 1.0);
    cuts_.push_back(spacing_m_ * (static_cast<double>(i) + f));
  }
}

// A way that turns at speed: from `from` along `direction` on a circle until it heads for a point
// of the polyline ahead, which it follows from there.
void InitialWay::appendArc(const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
                           const Eigen::Vector2d& towards,
                           std::vector<Eigen::Vector2d>& points) const {
  const double step = kSpacingM / options_.turn_radius_m;
  Eigen::Vector2d p = from;
  double course = std::atan2(direction.y(), direction.x());
  points.push_back(p);
  for (int i = 0; i < kMostArcPoints; ++i) {
    const Eigen::Vector2d leg = towards - p;
    const double turn = wrapAngle(std::atan2(leg.y(), leg.x()) - course);
    if (std::abs(turn) < step) {
      return;
    }
    course += turn > 0.0 ? step : -step;
    p += kSpacingM * Eigen::Vector2d(std::cos(course), std::sin(course));
    points.push_back(p);
  }
}

// The polyline between both ends, with arcs where it leaves their directions.
void InitialWay::turnAtEnds(const std::vector<Eigen::Vector2d>& polyline,
                            const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                            const WayEnds& ends) {
  const double length = lengthOf(polyline);
  const double reach = std::min(kArcReachM, 0.3 * length);
  std::vector<Eigen::Vector2d> tail;
  held_head_ = held_tail_ = 0;
  turned_.clear();
  const auto wide = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.dot(b) < std::cos(kWideTurnRad) * a.norm() * b.norm();
  };
  const double lead = (from - polyline.front()).norm();
  const double trail = (to - polyline.back()).norm();
  const Eigen::Vector2d ahead = pointAlong(polyline, lead + reach);
  const Eigen::Vector2d behind = pointAlong(polyline, -trail - reach);
  const bool head = wide(ends.leave, ahead - from);
  if (head) {
    appendArc(from, ends.leave, ahead, turned_);
    held_head_ = turned_.size() - 1;
  } else {
    turned_.push_back(from);
  }
  if (wide(ends.arrive, to - behind)) {
    appendArc(to, -ends.arrive, behind, tail);
    held_tail_ = tail.size() - 1;
  } else {
    tail.push_back(to);
  }
  double s = 0.0;
  for (std::size_t i = 1; i + 1 < polyline.size(); ++i) {
    s += (polyline[i] - polyline[i - 1]).norm();
    if (s > lead + (head ? reach : kSpacingM) &&
        s < length - trail - (held_tail_ > 0 ? reach : kSpacingM)) {
      turned_.push_back(polyline[i]);
    }
  }
  turned_.insert(turned_.end(), tail.rbegin(), tail.rend());
}

void InitialWay::build(const map::DistanceField& field,
                       const std::vector<Eigen::Vector2d>& polyline, const WayEnds& ends,
                       Spline& spline) {
  const Eigen::Vector2d& from = ends.start.position;
  const Eigen::Vector2d& to = ends.goal.position;
  const auto fixedKnot = [](const vessel::FlatPoint& z) {
    Knot knot;
    knot.state << z.position, z.velocity, z.acceleration, z.jerk;
    knot.free = false;
    return knot;
  };
  turnAtEnds(polyline, from, to, ends);
  stretchBand(field, turned_, from, to);
  paceBand(ends.start.velocity.norm(), ends.goal.velocity.norm());
  cutTime(options_.piece_length_m / options_.speed_max_mps);
  spline.knots = {fixedKnot(ends.start)};
  spline.spans.clear();
  for (std::size_t i = 1; i < cuts_.size(); ++i) {
    spline.spans.push_back({times_[i] - times_[i - 1]});
    spline.knots.push_back(knotAt(cuts_[i]));
  }
  spline.knots.back() = fixedKnot(ends.goal);
}

}  // namespace otter_nav::optimizer
