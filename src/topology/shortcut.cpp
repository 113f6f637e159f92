#include "topology/shortcut.hpp"

#include <algorithm>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::topology {
namespace {

constexpr int kRounds = 5;
constexpr int kHalvings = 6;
constexpr double kEnough = 2e-4;  // relative gain of a round that is not worth another

}  // namespace

bool Shortener::clear(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  return map::segmentIsClear(*field_, a, b, clearance_m_);
}

// From each vertex kept, on to the farthest found visible by doubling strides and then halving.
void Shortener::shortcut(Polyline& path) {
  if (path.size() < 3) {
    return;
  }
  scratch_.clear();
  std::size_t at = 0;
  const std::size_t last = path.size() - 1;
  scratch_.push_back(path[0]);
  while (at < last) {
    std::size_t seen = at + 1;
    std::size_t hidden = last + 1;
    for (std::size_t stride = 2; seen < last; stride *= 2) {
      const std::size_t next = std::min(last, at + stride);
      if (!clear(path[at], path[next])) {
        hidden = next;
        break;
      }
      seen = next;
    }
    while (hidden <= last && hidden - seen > 1) {
      const std::size_t middle = seen + (hidden - seen) / 2;
      (clear(path[at], path[middle]) ? seen : hidden) = middle;
    }
    at = seen;
    scratch_.push_back(path[at]);
  }
  path.swap(scratch_);
}

// Each vertex towards the line between its neighbours, as far as both its segments stay clear.
void Shortener::pull(Polyline& path) const {
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Eigen::Vector2d a = path[i - 1];
    const Eigen::Vector2d b = path[i + 1];
    const Eigen::Vector2d v = path[i];
    const double to_a = (a - v).norm();
    const double to_b = (b - v).norm();
    if (to_a < 1e-6 || to_b < 1e-6) {
      continue;
    }
    // Along the bisector: it meets the line between the neighbours at this point.
    const Eigen::Vector2d target = (a * to_b + b * to_a) / (to_a + to_b);
    if ((target - v).norm() < 1e-3) {
      continue;
    }
    double share = 0.0;
    double step = 0.5;
    for (int k = 0; k < kHalvings; ++k, step *= 0.5) {
      const Eigen::Vector2d moved = v + (share + step) * (target - v);
      share += clear(a, moved) && clear(moved, b) ? step : 0.0;
    }
    path[i] = v + share * (target - v);
  }
}

// A corner is cut off where the straight cut is clear: two vertices for one.
void Shortener::cut(Polyline& path) {
  scratch_.clear();
  scratch_.push_back(path.front());
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Eigen::Vector2d& v = path[i];
    const Eigen::Vector2d to_a = scratch_.back() - v;
    const Eigen::Vector2d to_b = path[i + 1] - v;
    const double straightness = -to_a.dot(to_b) / (to_a.norm() * to_b.norm() + 1e-12);
    const double reach = std::min({to_a.norm(), to_b.norm(), 8.0});
    if (straightness > 0.999 || reach < 0.05) {
      scratch_.push_back(v);
      continue;
    }
    const Eigen::Vector2d towards_a = to_a.normalized() * reach;
    const Eigen::Vector2d towards_b = to_b.normalized() * reach;
    double share = 0.0;
    double step = 0.5;
    for (int k = 0; k < kHalvings; ++k, step *= 0.5) {
      const double tried = share + step;
      share += clear(v + tried * towards_a, v + tried * towards_b) ? step : 0.0;
    }
    if (share > 0.0) {
      scratch_.push_back(v + share * towards_a);
      scratch_.push_back(v + share * towards_b);
    } else {
      scratch_.push_back(v);
    }
  }
  scratch_.push_back(path.back());
  path.swap(scratch_);
}

void Shortener::run(const map::DistanceField& field, double clearance_m, Polyline& path) {
  field_ = &field;
  clearance_m_ = clearance_m;
  shortcut(path);
  double length = lengthOf(path);
  for (int round = 0; round < kRounds && path.size() > 2; ++round) {
    pull(path);
    cut(path);
    shortcut(path);
    const double shorter = lengthOf(path);
    if (shorter > length * (1.0 - kEnough)) {
      break;
    }
    length = shorter;
  }
}

}  // namespace otter_nav::topology
