#include "topology/repair.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::topology {
namespace {

constexpr double kSpacing_m = 0.5;
// Stretches closer than this are one: between them there is no room to come back to the curve.
constexpr std::size_t kMergedGap = 4;  // samples
constexpr int kPushes = 8;
constexpr double kSafeM = 1.6;     // collision points are pushed out to this
constexpr double kWindowM = 15.0;  // a repair looks this far around its stretch
constexpr int kLocalExpansions = 1500;

}  // namespace

void DubinsRepair::begin(const map::DistanceField& field, const Options& options,
                         double clearance_m, const Pose& start, const Pose& goal, GuidePath& path) {
  field_ = &field;
  options_ = &options;
  clearance_m_ = clearance_m;
  sample(start, goal, path);
  findStretches();
  pushed_.clear();
  path.collisions_m.clear();
  for (Stretch& stretch : stretches_) {
    push(stretch);
    path.collisions_m.emplace_back(spacing_m_ * static_cast<double>(stretch.from),
                                   spacing_m_ * static_cast<double>(stretch.to));
  }
  path.pushed_points.assign(pushed_.begin(), pushed_.end());
}

void DubinsRepair::sample(const Pose& start, const Pose& goal, GuidePath& path) {
  const DubinsCurve curve(start, goal, options_->turning_radius_m);
  const double length = curve.length();
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(length / kSpacing_m)));
  spacing_m_ = length / static_cast<double>(count);
  path.dubins.clear();
  samples_.clear();
  for (std::size_t i = 0; i <= count; ++i) {
    path.dubins.push_back(curve.at(spacing_m_ * static_cast<double>(i)));
    samples_.push_back(path.dubins.back().position);
  }
  samples_.back() = goal.position;  // free of rounding along the curve
}

// Along the curve by jumps: what is clear by c at a sample is clear for c - clearance further on.
void DubinsRepair::findStretches() {
  stretches_.clear();
  std::size_t i = 0;
  while (i + 1 < samples_.size()) {
    const double room = field_->clearance(samples_[i]) - clearance_m_;
    const auto jump = static_cast<std::size_t>(std::max(0.0, room) / std::max(spacing_m_, 1e-9));
    if (jump > 0) {
      i += jump;
      continue;
    }
    if (!map::segmentIsClear(*field_, samples_[i], samples_[i + 1], clearance_m_)) {
      if (!stretches_.empty() && i < stretches_.back().to + kMergedGap) {
        stretches_.back().to = i + 1;
      } else {
        stretches_.push_back({i, i + 1, 0, 0});
      }
    }
    ++i;
  }
}

// The stretch's points moved along the distance's gradient until they are safe (paper, figure of
// the path search); those on a ridge with less room stay on it.
void DubinsRepair::push(Stretch& stretch) {
  stretch.pushed = pushed_.size();
  for (std::size_t i = stretch.from + 1; i < stretch.to; ++i) {
    Eigen::Vector2d p = samples_[i];
    for (int k = 0; k < kPushes; ++k) {
      const auto here = field_->smooth(p);
      const double missing = std::max(kSafeM, clearance_m_) - here.distance_m;
      const double slope = here.gradient.norm();
      if (missing <= 0.0 || slope < 0.1) {
        break;
      }
      p += missing / slope * here.gradient;
    }
    if (field_->isClear(p, clearance_m_)) {
      pushed_.push_back(p);
    }
  }
  stretch.pushed_count = pushed_.size() - stretch.pushed;
}

bool DubinsRepair::chainIsClear(const Stretch& stretch) const {
  const Eigen::Vector2d* last = &samples_[stretch.from];
  for (std::size_t i = stretch.pushed; i < stretch.pushed + stretch.pushed_count; ++i) {
    if (!map::segmentIsClear(*field_, *last, pushed_[i], clearance_m_)) {
      return false;
    }
    last = &pushed_[i];
  }
  return map::segmentIsClear(*field_, *last, samples_[stretch.to], clearance_m_);
}

bool DubinsRepair::searchAround(const Stretch& stretch, LatticeSearch& lattice) {
  LatticeQuery query;
  query.start = samples_[stretch.from];
  query.goal = samples_[stretch.to];
  query.clearance_m = clearance_m_;
  query.block = blockCells(*options_, field_->geometry());
  query.low = query.start;
  query.high = query.start;
  for (std::size_t i = stretch.from; i <= stretch.to; ++i) {
    query.low = query.low.cwiseMin(samples_[i]);
    query.high = query.high.cwiseMax(samples_[i]);
  }
  query.low.array() -= kWindowM;
  query.high.array() += kWindowM;
  query.max_expansions = kLocalExpansions;
  return lattice.run(*field_, query, detour_) == LatticeSearch::Outcome::kFound;
}

bool DubinsRepair::run(LatticeSearch& lattice, Polyline& result) {
  result.clear();
  std::size_t next = 0;
  const auto at = [](std::size_t i) { return static_cast<std::ptrdiff_t>(i); };
  for (const Stretch& stretch : stretches_) {
    // A stretch may begin amid another's obstacle: its ends must be clear themselves.
    if (!field_->isClear(samples_[stretch.from], clearance_m_) ||
        !field_->isClear(samples_[stretch.to], clearance_m_)) {
      return false;
    }
    result.insert(result.end(), samples_.begin() + at(next),
                  samples_.begin() + at(stretch.from) + 1);
    if (chainIsClear(stretch)) {
      result.insert(result.end(), pushed_.begin() + at(stretch.pushed),
                    pushed_.begin() + at(stretch.pushed + stretch.pushed_count));
    } else if (searchAround(stretch, lattice)) {
      result.insert(result.end(), detour_.begin() + 1, detour_.end() - 1);
    } else {
      return false;
    }
    next = stretch.to;
  }
  result.insert(result.end(), samples_.begin() + at(next), samples_.end());
  return true;
}

int blockCells(const Options& options, const map::GridGeometry& geometry) {
  return std::max(1, static_cast<int>(std::lround(options.lattice_m / geometry.resolution_m)));
}

}  // namespace otter_nav::topology
