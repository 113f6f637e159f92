#include "otter_nav/map/distance_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "distance_transform.hpp"

namespace otter_nav::map {
namespace {

constexpr std::uint8_t kAmidFree = 0;
constexpr std::uint8_t kOnOutline = 1;  // both kinds of cell around it: the transform's sites
constexpr std::uint8_t kAmidOccupied = 2;

// The interpolated bound loses at most 0.71 spread / (2 distance) cells, where spread is how far
// apart the four corners' nearest points are: at most 0.15 cells if spread <= 0.42 distance.
constexpr float kSpreadSquared = 0.42F * 0.42F;

double square(double x) {
  return x * x;
}

}  // namespace

DistanceField::DistanceField(const OccupancyGrid& grid, const DistanceFieldOptions& options)
    : geometry_(grid.geometry),
      options_(options),
      inverse_resolution_(1.0 / grid.geometry.resolution_m),
      cap_(static_cast<int>(std::ceil(options.max_distance_m / grid.geometry.resolution_m)) + 2),
      corner_width_(grid.geometry.width + 1) {
  const auto cells =
      static_cast<std::size_t>(geometry_.width) * static_cast<std::size_t>(geometry_.height);
  const auto corners =
      static_cast<std::size_t>(corner_width_) * static_cast<std::size_t>(geometry_.height + 1);
  occupied_.resize(cells);
  up_.resize(cells);
  down_.resize(cells);
  corner_kind_.resize(corners);
  corner_up_.resize(corners);
  corner_down_.resize(corners);
  corner_distance_.resize(corners);
  tight_.resize(cells);
  update(grid, {0, 0, geometry_.width, geometry_.height});
}

void DistanceField::update(const OccupancyGrid& grid, const CellRectangle& changed) {
  const Window cells{std::max(0, changed.column), std::max(0, changed.row),
                     std::min(geometry_.width, changed.column + changed.width),
                     std::min(geometry_.height, changed.row + changed.height)};
  if (cells.x0 >= cells.x1 || cells.y0 >= cells.y1) {
    return;
  }
  markOccupied(grid, cells);
  spread(cells);
}

void DistanceField::occupy(const Eigen::Vector2d& place, double radius_m) {
  const Eigen::Vector2d at = (place - geometry_.origin) * inverse_resolution_;
  const double radius = radius_m * inverse_resolution_;
  const auto cell = [](double x, int most) {
    return static_cast<int>(std::clamp(std::floor(x), 0.0, static_cast<double>(most)));
  };
  const Window cells{
      cell(at.x() - radius, geometry_.width), cell(at.y() - radius, geometry_.height),
      cell(at.x() + radius + 1.0, geometry_.width), cell(at.y() + radius + 1.0, geometry_.height)};
  if (cells.x0 >= cells.x1 || cells.y0 >= cells.y1) {
    return;
  }
  for (int y = cells.y0; y < cells.y1; ++y) {
    for (int x = cells.x0; x < cells.x1; ++x) {
      if ((Eigen::Vector2d(x + 0.5, y + 0.5) - at).norm() <= radius) {
        occupied_[geometry_.index(x, y)] = 1;
      }
    }
  }
  spread(cells);
}

void DistanceField::spread(const Window& cells) {
  markCorners({cells.x0, cells.y0, cells.x1 + 1, cells.y1 + 1});
  transform(cells);
}

void DistanceField::markOccupied(const OccupancyGrid& grid, const Window& cells) {
  for (int y = cells.y0; y < cells.y1; ++y) {
    for (int x = cells.x0; x < cells.x1; ++x) {
      const Cell cell = grid.at(x, y);
      const bool occupied =
          cell == Cell::kOccupied || (cell == Cell::kUnknown && options_.unknown_is_occupied);
      occupied_[geometry_.index(x, y)] = occupied ? 1 : 0;
    }
  }
}

void DistanceField::markCorners(const Window& corners) {
  const int width = geometry_.width;
  for (int y = corners.y0; y < corners.y1; ++y) {
    // Beyond the map all is occupied.
    const std::uint8_t* below = y > 0 ? &occupied_[geometry_.index(0, y - 1)] : nullptr;
    const std::uint8_t* above = y < geometry_.height ? &occupied_[geometry_.index(0, y)] : nullptr;
    std::uint8_t* kind =
        &corner_kind_[static_cast<std::size_t>(y) * static_cast<std::size_t>(corner_width_)];
    const auto pair = [&](int x) {
      return (below != nullptr ? below[x] : 1) + (above != nullptr ? above[x] : 1);
    };
    int left = corners.x0 > 0 ? pair(corners.x0 - 1) : 2;
    for (int x = corners.x0; x < corners.x1; ++x) {
      const int right = x < width ? pair(x) : 2;
      const int around = left + right;
      kind[x] = around == 0 ? kAmidFree : (around == 4 ? kAmidOccupied : kOnOutline);
      left = right;
    }
  }
}

void DistanceField::transform(const Window& changed) {
  const auto cap = static_cast<std::uint16_t>(cap_);
  sweepColumns({geometry_.width, geometry_.height, cap, 0}, occupied_, changed.x0, changed.x1,
               changed.y0, changed.y1, up_, down_);
  sweepColumns({corner_width_, geometry_.height + 1, cap, cap}, corner_kind_, changed.x0,
               changed.x1 + 1, changed.y0, changed.y1 + 1, corner_up_, corner_down_);
  // One corner more than can change on each side: the cells there look at it.
  const Window out{std::max(0, changed.x0 - cap_ - 1), std::max(0, changed.y0 - cap_ - 1),
                   std::min(corner_width_, changed.x1 + cap_ + 2),
                   std::min(geometry_.height + 1, changed.y1 + cap_ + 2)};
  RowEnvelope envelope(corner_width_, cap_);
  CornerRow south(corner_width_);
  CornerRow north(corner_width_);
  for (int y = out.y0; y < out.y1; ++y) {
    const auto start = static_cast<std::size_t>(y) * static_cast<std::size_t>(corner_width_);
    envelope.run(&corner_up_[start], &corner_down_[start], out.x0, out.x1, north);
    for (int x = out.x0; x < out.x1; ++x) {
      const std::size_t i = start + static_cast<std::size_t>(x);
      const float magnitude =
          std::sqrt(static_cast<float>(north.squared[static_cast<std::size_t>(x)]));
      corner_distance_[i] = corner_kind_[i] == kAmidOccupied ? -magnitude : magnitude;
    }
    if (y > out.y0) {
      judgeRow(y - 1, out, south, north);
    }
    std::swap(south, north);
  }
}

// Branchless over plain arrays, so that the compiler does eight cells at a time.
void DistanceField::judgeRow(int row, const Window& corners, const CornerRow& south,
                             const CornerRow& north) {
  const std::int32_t near_cap = (cap_ - 2) * (cap_ - 2);
  const std::int32_t capped = cap_ * cap_;
  const std::int32_t *ds = south.squared.data(), *dn = north.squared.data();
  const std::int32_t *xs = south.site_x.data(), *xn = north.site_x.data();
  const std::int32_t *ys = south.site_y.data(), *yn = north.site_y.data();
  const std::uint8_t* occupied = &occupied_[geometry_.index(0, row)];
  std::uint8_t* __restrict tight = &tight_[geometry_.index(0, row)];
  const int end = corners.x1 - 1;
  for (int w = corners.x0; w < end; ++w) {
    const int e = w + 1;
    const auto least = std::min(std::min(ds[w], ds[e]), std::min(dn[w], dn[e]));
    const auto most = std::max(std::max(ds[w], ds[e]), std::max(dn[w], dn[e]));
    const auto east = std::max(std::max(xs[w], xs[e]), std::max(xn[w], xn[e]));
    const auto west = std::min(std::min(xs[w], xs[e]), std::min(xn[w], xn[e]));
    const auto high = std::max(std::max(ys[w], ys[e]), std::max(yn[w], yn[e]) + 1);
    const auto low = std::min(std::min(ys[w], ys[e]), std::min(yn[w], yn[e]) + 1);
    // Of capped corners the sites mean nothing; clipped, their products stay in range.
    const auto wide = std::min(east - west, 20000);
    const auto tall = std::min(high - low, 20000);
    const float spread = static_cast<float>(wide * wide + tall * tall);
    const int one = static_cast<int>(most < capped) &
                    static_cast<int>(spread <= kSpreadSquared * static_cast<float>(least));
    tight[w] = static_cast<std::uint8_t>(static_cast<int>(least >= near_cap) | one |
                                         static_cast<int>(occupied[w] != 0));
  }
}

// Outwards from the point's own column until no column can hold anything nearer.
double DistanceField::exactSquared(const Bound& at) const {
  const std::size_t start = geometry_.index(0, at.row);
  const double above = at.row - at.y;      // plus steps up
  const double below = at.y - at.row - 1;  // plus steps down
  double best = square(cap_);
  const auto visit = [&](int column, double dx) {
    double dy = 0.0;
    if (column >= 0 && column < geometry_.width) {
      const std::size_t index = start + static_cast<std::size_t>(column);
      dy = std::max(0.0, std::min(up_[index] + above, down_[index] + below));
    }
    best = std::min(best, dx * dx + dy * dy);
  };
  visit(at.column, 0.0);
  const double fx = at.x - at.column;
  for (int k = 1; k <= cap_; ++k) {
    const double west = fx + k - 1;
    const double east = k - fx;
    if (west * west >= best && east * east >= best) {
      break;
    }
    visit(at.column - k, west);
    visit(at.column + k, east);
  }
  return best;
}

double DistanceField::clearance(const Eigen::Vector2d& p) const {
  constexpr double kAlwaysExact = std::numeric_limits<double>::infinity();
  return std::min(std::sqrt(squaredBound(p, kAlwaysExact)), options_.max_distance_m);
}

bool DistanceField::isClear(const Eigen::Vector2d& p, double clearance_m) const {
  const double needed = clearance_m * clearance_m;
  return clearance_m <= options_.max_distance_m && squaredBound(p, needed) >= needed;
}

DistanceField::Smooth DistanceField::smooth(const Eigen::Vector2d& p) const {
  const Eigen::Vector2d raw = (p - geometry_.origin) * inverse_resolution_;
  const Eigen::Vector2d q(std::clamp(raw.x(), 0.0, static_cast<double>(geometry_.width)),
                          std::clamp(raw.y(), 0.0, static_cast<double>(geometry_.height)));
  if (!(q - raw).isZero(0.0)) {  // outside the map: the way back in
    const double outside = (q - raw).norm();
    return {-outside * geometry_.resolution_m, (q - raw) / outside};
  }
  const int column = std::min(static_cast<int>(q.x()), geometry_.width - 1);
  const int row = std::min(static_cast<int>(q.y()), geometry_.height - 1);
  const double fx = q.x() - column;
  const double fy = q.y() - row;
  const float* corner =
      &corner_distance_[static_cast<std::size_t>(row) * static_cast<std::size_t>(corner_width_) +
                        static_cast<std::size_t>(column)];
  const double south_slope = corner[1] - corner[0];
  const double north_slope = corner[corner_width_ + 1] - corner[corner_width_];
  const double south = corner[0] + fx * south_slope;
  const double north = corner[corner_width_] + fx * north_slope;
  const double limit = options_.max_distance_m;
  const double distance_m = (south + fy * (north - south)) * geometry_.resolution_m;
  if (distance_m >= limit) {
    return {limit, Eigen::Vector2d::Zero()};
  }
  return {distance_m, {south_slope + fy * (north_slope - south_slope), north - south}};
}

}  // namespace otter_nav::map
