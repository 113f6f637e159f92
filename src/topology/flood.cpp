#include "topology/flood.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace otter_nav::topology {
namespace {

constexpr std::uint8_t kFromStart = 0x80;
constexpr std::uint8_t kFromGoal = 0x40;
constexpr std::uint8_t kSides = kFromStart | kFromGoal;
constexpr std::uint8_t kSeed = 0x20;
constexpr std::array<int, 4> kEast = {1, 0, -1, 0};
constexpr std::array<int, 4> kNorth = {0, 1, 0, -1};

}  // namespace

Eigen::Vector2d Flood::corner(int x, int y) const {
  const map::GridGeometry& g = field_->geometry();
  return g.origin + g.resolution_m / parts_ * Eigen::Vector2d(x, y);
}

bool Flood::isClear(int x, int y) const {
  return parts_ == 1 ? field_->cornerClearance(x, y) >= corner_clearance_m_
                     : field_->isClear(corner(x, y), corner_clearance_m_);
}

void Flood::seed(Side& side, const Eigen::Vector2d& p, std::uint8_t mark) {
  const map::GridGeometry& g = field_->geometry();
  side.queue.clear();
  side.next = 0;
  const Eigen::Vector2i cell = ((p - g.origin) / (g.resolution_m / parts_)).cast<int>();
  for (int y = std::max(0, cell.y() - 1); y <= std::min(rows_ - 1, cell.y() + 2); ++y) {
    for (int x = std::max(0, cell.x() - 1); x <= std::min(columns_ - 1, cell.x() + 2); ++x) {
      if (isClear(x, y) && map::segmentIsClear(*field_, p, corner(x, y), clearance_m_)) {
        const std::int32_t id = y * columns_ + x;
        if ((marks_[static_cast<std::size_t>(id)] & kSides) != 0) {
          meeting_start_ = id;
          meeting_goal_ = id;
          continue;
        }
        marks_[static_cast<std::size_t>(id)] = mark | kSeed;
        side.queue.push_back(id);
      }
    }
  }
}

// One corner's neighbours. False when this side has nowhere left to go.
bool Flood::grow(Side& side, std::uint8_t mark) {
  if (side.next >= side.queue.size()) {
    return false;
  }
  const std::int32_t id = side.queue[side.next++];
  const int x = id % columns_;
  const int y = id / columns_;
  for (std::size_t k = 0; k < kEast.size(); ++k) {
    const int nx = x + kEast[k];
    const int ny = y + kNorth[k];
    if (nx < 0 || ny < 0 || nx >= columns_ || ny >= rows_) {
      continue;
    }
    const std::int32_t next = ny * columns_ + nx;
    std::uint8_t& seen = marks_[static_cast<std::size_t>(next)];
    if ((seen & kSides) == mark) {
      continue;
    }
    if ((seen & kSides) != 0) {  // the other side's
      meeting_start_ = mark == kFromStart ? id : next;
      meeting_goal_ = mark == kFromStart ? next : id;
      return true;
    }
    if (isClear(nx, ny)) {
      seen = static_cast<std::uint8_t>(mark | k);
      side.queue.push_back(next);
    }
  }
  return true;
}

bool Flood::connects(const map::DistanceField& field, const Eigen::Vector2d& start,
                     const Eigen::Vector2d& goal, double clearance_m, int parts) {
  field_ = &field;
  parts_ = parts;
  start_ = start;
  goal_ = goal;
  clearance_m_ = clearance_m;
  const map::GridGeometry& g = field.geometry();
  // Between two corners that keep this, all keeps the clearance.
  const double step_m = g.resolution_m / parts;
  corner_clearance_m_ = std::sqrt(clearance_m * clearance_m + 0.25 * step_m * step_m);
  columns_ = parts * g.width + 1;
  rows_ = parts * g.height + 1;
  marks_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
  meeting_start_ = -1;
  meeting_goal_ = -1;
  seed(from_start_, start, kFromStart);
  seed(from_goal_, goal, kFromGoal);
  while (meeting_start_ < 0) {
    if (!grow(from_start_, kFromStart) || (meeting_start_ < 0 && !grow(from_goal_, kFromGoal))) {
      return false;
    }
  }
  return true;
}

void Flood::collect(std::vector<Eigen::Vector2d>& path) const {
  path.clear();
  const auto trace = [&](std::int32_t id) {
    while (true) {
      path.push_back(corner(id % columns_, id / columns_));
      const std::uint8_t mark = marks_[static_cast<std::size_t>(id)];
      if ((mark & kSeed) != 0) {
        return;
      }
      const std::size_t k = mark & 3U;
      id -= kNorth[k] * columns_ + kEast[k];
    }
  };
  trace(meeting_start_);
  path.push_back(start_);
  std::reverse(path.begin(), path.end());
  if (meeting_goal_ != meeting_start_) {
    trace(meeting_goal_);
  }
  path.push_back(goal_);
}

}  // namespace otter_nav::topology
