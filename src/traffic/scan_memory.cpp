#include "scan_memory.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace otter_nav::traffic {
namespace {

constexpr int kSide = 256;
// Smaller than what may stand there, or beams that pass beside it in its cell say that it wasn't.
constexpr double kCellM = 0.25;
constexpr double kStepM = 0.4;      // along a beam
constexpr double kStagger = 0.618;  // of a step, from scan to scan: no cell is left out for long
constexpr int kMarginCells = 48;  // the square moves when the vessel is nearer to its middle's edge
constexpr std::uint8_t kSeenFree = 5;  // scans
constexpr std::int32_t kNewForMs = 3000;
constexpr std::int32_t kUnknownForMs = 600;   // the same where nobody knows whether it was free
constexpr std::int32_t kFreeHoldsMs = 20000;  // what was free so long ago says nothing
constexpr std::int32_t kEchoHoldsMs = 1000;   // what was met so long ago need not be there any more
constexpr std::int32_t kHiddenForMs = 20000;  // but what stood, and nothing has shown to be gone
// After as long without a scan nothing that is remembered says anything any more.
constexpr std::int32_t kHoldsMs = std::max(kFreeHoldsMs, kHiddenForMs);
// So often the cells count from a later instant: 32 bits hold 24 days.
constexpr std::int32_t kCountsForMs = 24 * 3600 * 1000;

// Of negative ones too, for the side is a power of two.
static_assert((kSide & (kSide - 1)) == 0);
int modulo(int value) {
  return value & (kSide - 1);
}

}  // namespace

ScanMemory::ScanMemory() : cells_(static_cast<std::size_t>(kSide) * kSide) {}

Eigen::Vector2i ScanMemory::cellAt(const Eigen::Vector2d& p) const {
  return {static_cast<int>(std::floor(p.x() / kCellM)),
          static_cast<int>(std::floor(p.y() / kCellM))};
}
bool ScanMemory::contains(const Eigen::Vector2i& cell) const {
  const Eigen::Vector2i off = cell - corner_;
  return off.minCoeff() >= 0 && off.maxCoeff() < kSide;
}
std::size_t ScanMemory::indexOf(const Eigen::Vector2i& cell) const {
  return static_cast<std::size_t>(modulo(cell.y()) * kSide + modulo(cell.x()));
}

void ScanMemory::forget() {
  std::fill(cells_.begin(), cells_.end(), Cell());
  placed_ = false;
}

// What stands does so for longer than it has to, whatever is cut off of when it was met first.
void ScanMemory::countFromLater() {
  static_assert(kNewForMs < kHoldsMs && kUnknownForMs < kHoldsMs);
  const std::int32_t later_ms = now_ms_ - 2 * kHoldsMs;
  const auto moved = [&](std::int32_t time_ms) { return std::max(0, time_ms - later_ms); };
  for (Cell& cell : cells_) {
    if (std::max(cell.met_last_ms, cell.free_last_ms) < now_ms_ - kHoldsMs) {
      cell = Cell();
      continue;
    }
    cell.met_since_ms = cell.met_since_ms < 0 ? -1 : moved(cell.met_since_ms);
    cell.met_last_ms = moved(cell.met_last_ms);
    cell.free_last_ms = moved(cell.free_last_ms);
  }
  counts_from_s_ += 1e-3 * later_ms;
  now_ms_ -= later_ms;
}

void ScanMemory::begin(double time_s, const Eigen::Vector2d& eye) {
  const auto since_ms = std::llround(1000.0 * (time_s - counts_from_s_));
  if (since_ms < now_ms_ || since_ms > now_ms_ + kHoldsMs) {  // the clock was set, or no scans
    forget();
  }
  if (!placed_) {
    counts_from_s_ = time_s;
  }
  now_ms_ = placed_ ? static_cast<std::int32_t>(since_ms) : 0;
  if (now_ms_ > kCountsForMs) {
    countFromLater();
  }
  stagger_ = std::fmod(stagger_ + kStagger, 1.0);
  const Eigen::Vector2i middle = cellAt(eye) - Eigen::Vector2i::Constant(kSide / 2);
  if (!placed_) {
    corner_ = middle;
    placed_ = true;
    return;
  }
  for (int axis = 0; axis < 2; ++axis) {
    const int shift = middle[axis] - corner_[axis];
    if (std::abs(shift) < kMarginCells / 2) {
      continue;
    }
    // Columns or rows that come in anew hold what left on the other side.
    const int count = std::min(std::abs(shift), kSide);
    for (int k = 0; k < count; ++k) {
      const int line =
          shift > 0 ? corner_[axis] + kSide + shift - 1 - k : corner_[axis] + shift + k;
      for (int i = 0; i < kSide; ++i) {
        Eigen::Vector2i cell;
        cell[axis] = line;
        cell[1 - axis] = i;
        cells_[indexOf(cell)] = Cell();
      }
    }
    corner_[axis] = middle[axis];
  }
}

bool ScanMemory::standsSince(const Cell& cell) const {
  if (cell.met_since_ms < 0 || now_ms_ - cell.met_last_ms > kHiddenForMs) {
    return false;
  }
  return cell.met_last_ms - cell.met_since_ms >
         (cell.free_count < kSeenFree ? kUnknownForMs : kNewForMs);
}

bool ScanMemory::isNew(const Eigen::Vector2d& point) const {
  const Eigen::Vector2i at = cellAt(point);
  if (!contains(at)) {
    return false;
  }
  const Cell& here = cells_[indexOf(at)];
  if (here.free_count < kSeenFree || now_ms_ - here.free_last_ms > kFreeHoldsMs) {
    return false;
  }
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      const Eigen::Vector2i around = at + Eigen::Vector2i(dx, dy);
      if (contains(around) && standsSince(cells_[indexOf(around)])) {
        return false;
      }
    }
  }
  return true;
}

bool ScanMemory::stands(const Eigen::Vector2d& point) const {
  const Eigen::Vector2i at = cellAt(point);
  return contains(at) && standsSince(cells_[indexOf(at)]);
}

void ScanMemory::met(const Eigen::Vector2d& point) {
  const Eigen::Vector2i at = cellAt(point);
  if (!contains(at)) {
    return;
  }
  Cell& cell = cells_[indexOf(at)];
  const bool lately = now_ms_ - cell.met_last_ms <= kEchoHoldsMs;
  if (cell.met_since_ms < 0 || !(lately || standsSince(cell))) {
    cell.met_since_ms = now_ms_;
  }
  cell.met_last_ms = now_ms_;
}

// Every few tenths of a metre, at other places in the next scan; a cell that was met lately is left
// alone, so that a beam that passes beside something in the same cell doesn't take it away.
void ScanMemory::passed(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double length = along.norm();
  const int steps = static_cast<int>(length / kStepM);
  if (steps < 1) {
    return;
  }
  const Eigen::Vector2d step = along / steps;
  // Of a square no more than the ends need be looked at.
  const bool within = contains(cellAt(from)) && contains(cellAt(to));
  Eigen::Vector2d p = from + stagger_ * step;
  for (int k = 0; k < steps; ++k, p += step) {
    const Eigen::Vector2i at = cellAt(p);
    if (!within && !contains(at)) {
      return;
    }
    Cell& cell = cells_[indexOf(at)];
    if (cell.free_last_ms == now_ms_) {
      continue;
    }
    if (cell.met_since_ms >= 0) {
      if (now_ms_ - cell.met_last_ms < kEchoHoldsMs) {
        continue;
      }
      cell.met_since_ms = -1;
      cell.free_count = 0;
    }
    if (now_ms_ - cell.free_last_ms > kFreeHoldsMs) {
      cell.free_count = 0;
    }
    cell.free_last_ms = now_ms_;
    cell.free_count = static_cast<std::uint8_t>(std::min<int>(cell.free_count + 1, 250));
  }
}

}  // namespace otter_nav::traffic
