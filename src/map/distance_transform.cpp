#include "distance_transform.hpp"

#include <algorithm>

namespace otter_nav::map {
namespace {

void sweepRow(const std::uint8_t* sites, const std::uint16_t* before, std::uint16_t outside,
              std::uint16_t cap, int x0, int x1, std::uint16_t* steps) {
  for (int x = x0; x < x1; ++x) {
    const std::uint16_t from = before != nullptr ? before[x] : outside;
    const auto next = static_cast<std::uint16_t>(from < cap ? from + 1 : cap);
    steps[x] = sites[x] == 1 ? std::uint16_t{0} : next;
  }
}

}  // namespace

void sweepColumns(const ColumnSweep& sweep, const std::vector<std::uint8_t>& sites, int x0, int x1,
                  int y0, int y1, std::vector<std::uint16_t>& up,
                  std::vector<std::uint16_t>& down) {
  const auto row_at = [&](int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(sweep.width);
  };
  for (int y = y1 - 1; y >= std::max(0, y0 - sweep.cap); --y) {
    const std::uint16_t* before = y + 1 < sweep.height ? &up[row_at(y + 1)] : nullptr;
    sweepRow(&sites[row_at(y)], before, sweep.outside, sweep.cap, x0, x1, &up[row_at(y)]);
  }
  for (int y = y0; y < std::min(sweep.height, y1 + sweep.cap); ++y) {
    const std::uint16_t* before = y > 0 ? &down[row_at(y - 1)] : nullptr;
    sweepRow(&sites[row_at(y)], before, sweep.outside, sweep.cap, x0, x1, &down[row_at(y)]);
  }
}

CornerRow::CornerRow(int width)
    : squared(static_cast<std::size_t>(width)),
      site_x(static_cast<std::size_t>(width)),
      site_y(static_cast<std::size_t>(width)) {}

RowEnvelope::RowEnvelope(int width, int cap)
    : width_(width),
      cap_(cap),
      site_(static_cast<std::size_t>(width)),
      height_(static_cast<std::size_t>(width)) {}

// A parabola hides between its neighbours when they meet before it comes up; the comparison of
// the two meeting points is cross-multiplied, so no division and no rounding.
void RowEnvelope::build(const std::uint16_t* up, const std::uint16_t* down, int x0, int x1) {
  std::int32_t* const site = site_.data();
  std::int64_t* const height = height_.data();
  std::size_t size = 0;
  for (int x = std::max(0, x0 - cap_); x < std::min(width_, x1 + cap_); ++x) {
    const std::int64_t gap = std::min(up[x], down[x]);
    if (gap >= cap_) {
      continue;
    }
    const std::int64_t h = gap * gap + static_cast<std::int64_t>(x) * x;
    for (; size > 1; --size) {
      const std::size_t top = size - 1;
      const std::int64_t left = (height[top] - height[top - 1]) * (x - site[top]);
      const std::int64_t right = (h - height[top]) * (site[top] - site[top - 1]);
      if (left < right) {
        break;
      }
    }
    site[size] = x;
    height[size] = h;
    ++size;
  }
  size_ = size;
}

void RowEnvelope::run(const std::uint16_t* up, const std::uint16_t* down, int x0, int x1,
                      CornerRow& out) {
  build(up, down, x0, x1);
  const std::int32_t cap_squared = cap_ * cap_;
  if (size_ == 0) {
    std::fill(out.squared.begin() + x0, out.squared.begin() + x1, cap_squared);
    return;
  }
  const std::int32_t* const sites = site_.data();
  const std::int64_t* const height = height_.data();
  const std::size_t last = size_ - 1;
  const auto value = [&](std::size_t k, std::int64_t x) {  // less x^2
    return height[k] - 2 * x * sites[k];
  };
  std::size_t k = 0;
  for (int x = x0; x < x1; ++x) {
    std::int64_t here = value(k, x);
    for (; k < last; ++k) {
      const std::int64_t next = value(k + 1, x);
      if (next > here) {
        break;
      }
      here = next;
    }
    const auto i = static_cast<std::size_t>(x);
    const std::int64_t distance = here + static_cast<std::int64_t>(x) * x;
    const std::int32_t site = sites[k];
    out.squared[i] = static_cast<std::int32_t>(std::min<std::int64_t>(distance, cap_squared));
    out.site_x[i] = site;
    out.site_y[i] = up[site] <= down[site] ? up[site] : -down[site];
  }
}

}  // namespace otter_nav::map
