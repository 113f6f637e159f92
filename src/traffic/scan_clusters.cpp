#include "scan_clusters.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/map/chart.hpp"
#include "otter_nav/vessel/hull.hpp"

namespace otter_nav::traffic {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastHeightM = 0.15;  // lower is the water
constexpr double kHullMarginM = 0.3;
constexpr std::size_t kFewestPoints = 3;
constexpr double kLargestM = 30.0;  // larger things are land that no chart shows
// Echoes of beams side by side hang together when they are this near (Borges and Aldon's idea:
// nearer than a surface seen at a grazing angle would have them).
constexpr double kGapM = 0.4;
constexpr double kGapPerSpacing = 3.0;
constexpr std::size_t kMostSkipped = 3;

}  // namespace

ScanClusters::ScanClusters(const map::OccupancyGrid& chart, const vessel::Hull& own_hull)
    : geometry_(chart.geometry), charted_(map::coastOf(chart)), own_hull_(own_hull) {}

bool ScanClusters::isCharted(const Eigen::Vector2d& point) const {
  if (charted_.empty() || !geometry_.contains(point)) {
    return false;
  }
  const Eigen::Vector2i cell = geometry_.cellAt(point);
  return charted_[geometry_.index(cell.x(), cell.y())];
}

void ScanClusters::readEchoes(const map::SensorPose& sensor, const vessel::Pose& own,
                              const Scan& scan) {
  const Eigen::Matrix3d rotation = sensor.rotation();
  echoes_.clear();
  low_.clear();
  others_.clear();
  directions_.assign(scan.ranges_m.size(), Eigen::Vector2d::Zero());
  free_m_.assign(scan.ranges_m.size(), kNaN);
  reach_m_.assign(scan.ranges_m.size(), 0.0);
  ends_at_standing_.assign(scan.ranges_m.size(), false);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range = scan.ranges_m[i];
    const bool nothing = scan.metNothing(i);
    if (!nothing && !scan.metSomething(i)) {
      continue;
    }
    const Eigen::Vector3d beam = rotation * scan.direction(i);
    const double level = beam.head<2>().norm();
    // No farther than where the beam comes too near the water.
    double reach = scan.range_max_m;
    if (beam.z() < 0.0) {
      reach = std::min(reach, (kLeastHeightM - sensor.position.z()) / beam.z());
    }
    directions_[i] = beam.head<2>() / level;
    reach_m_[i] = std::max(0.0, reach * level);
    free_m_[i] = nothing ? reach_m_[i] : std::min(reach_m_[i], range * level);
    if (nothing) {
      continue;
    }
    const Eigen::Vector2d point = (sensor.position + range * beam).head<2>();
    if (sensor.position.z() + range * beam.z() < kLeastHeightM) {
      low_.push_back({i, point, range * level, false, false});
      continue;
    }
    if (vessel::covers(own_hull_, own, point, kHullMarginM)) {
      continue;
    }
    if (isCharted(point)) {
      others_.push_back(point);
      ends_at_standing_[i] = true;
    } else {
      echoes_.push_back({i, point, range * level, memory_.isNew(point), memory_.stands(point)});
      ends_at_standing_[i] = echoes_.back().stands;
    }
  }
}

void ScanClusters::remember() {
  for (const Echo& echo : echoes_) {
    memory_.met(echo.point);
  }
  for (const Eigen::Vector2d& point : others_) {
    memory_.met(point);
  }
  constexpr double kShortOfEchoM = 0.5;
  // What comes into range or over the waves is first met there: water not known to have been free
  // up to the end would let it seem to have been there all along.
  constexpr double kShortOfReachM = 0.1;
  // Every beam: far off they are as far apart as cells are wide, and those of a vessel at rest are
  // the same each time.
  for (std::size_t i = 0; i < free_m_.size(); ++i) {
    const double short_m = free_m_[i] < reach_m_[i] ? kShortOfEchoM : kShortOfReachM;
    if (free_m_[i] > kShortOfEchoM) {  // not for NaN
      memory_.passed(eye_, eye_ + (free_m_[i] - short_m) * directions_[i]);
    }
  }
}

void ScanClusters::divide(std::size_t beams, double increment_rad) {
  clusters_.clear();
  const auto belong = [&](const Echo& a, const Echo& b, std::size_t skipped) {
    const double spacing = std::max(a.range_m, b.range_m) * std::abs(increment_rad);
    return skipped <= kMostSkipped &&
           (a.point - b.point).norm() <
               kGapM + kGapPerSpacing * spacing * static_cast<double>(skipped);
  };
  for (std::size_t k = 0; k < echoes_.size(); ++k) {
    const bool goes_on =
        k > 0 && belong(echoes_[k - 1], echoes_[k], echoes_[k].beam - echoes_[k - 1].beam);
    if (!goes_on) {
      clusters_.emplace_back();
    }
    Cluster& cluster = clusters_.back();
    cluster.points.push_back(echoes_[k].point);
    cluster.beams.push_back(echoes_[k].beam);
    cluster.new_points += echoes_[k].is_new ? 1 : 0;
    cluster.standing_points += echoes_[k].stands ? 1 : 0;
  }
  // A full turn's last beam is beside its first.
  const bool full_turn = std::abs(increment_rad) * static_cast<double>(beams) > 2.0 * kPi - 0.1;
  if (full_turn && clusters_.size() > 1 &&
      belong(echoes_.back(), echoes_.front(), echoes_.front().beam + beams - echoes_.back().beam)) {
    Cluster& first = clusters_.front();
    Cluster& last = clusters_.back();
    last.points.insert(last.points.end(), first.points.begin(), first.points.end());
    last.beams.insert(last.beams.end(), first.beams.begin(), first.beams.end());
    last.new_points += first.new_points;
    last.standing_points += first.standing_points;
    std::swap(first, last);
    clusters_.pop_back();
  }
  clusters_.erase(std::remove_if(clusters_.begin(), clusters_.end(),
                                 [](const Cluster& cluster) {
                                   return cluster.points.size() < kFewestPoints ||
                                          (cluster.points.front() - cluster.points.back()).norm() >
                                              kLargestM;
                                 }),
                  clusters_.end());
}

void ScanClusters::findCuts(Cluster& cluster) const {
  constexpr double kEchoNearerM = 1.0;
  const std::size_t beams = free_m_.size();
  const auto hidden = [&](std::size_t beam, const Eigen::Vector2d& point, std::size_t step) {
    return free_m_[(beam + step) % beams] < (point - eye_).norm() - kEchoNearerM;
  };
  cluster.first_hidden = hidden(cluster.beams.front(), cluster.points.front(), beams - 1);
  cluster.last_hidden = hidden(cluster.beams.back(), cluster.points.back(), 1);
  for (const Eigen::Vector2d& point : {cluster.points.front(), cluster.points.back()}) {
    cluster.out_of_range =
        cluster.out_of_range || (point - eye_).norm() > range_max_m_ - kEchoNearerM;
  }
}

const std::vector<Cluster>& ScanClusters::gather(double stamp_s, const map::SensorPose& sensor,
                                                 const vessel::Pose& own, const Scan& scan) {
  eye_ = sensor.position.head<2>();
  sensor_from_level_ = sensor.rotation().topLeftCorner<2, 2>().inverse();
  angle_min_rad_ = scan.angle_min_rad;
  increment_rad_ = scan.angle_increment_rad;
  range_max_m_ = scan.range_max_m;
  memory_.begin(stamp_s, eye_);
  readEchoes(sensor, own, scan);
  remember();
  divide(scan.ranges_m.size(), scan.angle_increment_rad);
  for (Cluster& cluster : clusters_) {
    findCuts(cluster);
  }
  return clusters_;
}

double ScanClusters::inSight(const Eigen::Vector2d& position, double near_m, double doubt_m,
                             double beam_m) const {
  const Eigen::Vector2d off = position - eye_;
  const double range = off.norm();
  constexpr double kMarginM = 0.5;
  if (range - near_m - doubt_m > range_max_m_ || free_m_.empty()) {
    return 0.0;
  }
  const double half = std::atan2(0.25 * beam_m, std::max(range, 0.1));
  const double bearing = std::atan2(off.y(), off.x());
  double most = 0.0;
  for (const double side : {-half, 0.0, half}) {
    // The beam that lies over this bearing, whichever way the lidar turns and stands.
    const Eigen::Vector2d beam_ahead = sensor_from_level_ * unitVector(bearing + side);
    const double angle = std::atan2(beam_ahead.y(), beam_ahead.x()) - angle_min_rad_;
    const double turned = std::copysign(1.0, increment_rad_) * angle;
    const double turns = std::remainder(turned - kPi, 2.0 * kPi) + kPi;  // 0 to 2 pi
    const auto beam = static_cast<std::size_t>(std::lround(turns / std::abs(increment_rad_)));
    if (beam < free_m_.size() &&
        free_m_[beam] > range - near_m - (ends_at_standing_[beam] ? 0.0 : doubt_m)) {
      most = std::max(most, range + kMarginM < reach_m_[beam] ? 1.0 : 0.5);
    }
  }
  return most;
}

}  // namespace otter_nav::traffic
