#include "archipelago/walls.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace otter_nav::scenario {
namespace {

using map::Cell;
using map::OccupancyGrid;

constexpr double kBorderM = 1.0;
constexpr double kWallM = 0.75;

struct Box {
  double west;
  double south;
  double east;
  double north;
};

class Drawing {
 public:
  Drawing(Random& random, OccupancyGrid& grid)
      : random_(random), grid_(grid), half_m_(-grid.geometry.origin.x()) {}

  void streets() {
    const std::vector<double> columns = streetsAcross();
    const std::vector<double> rows = streetsAcross();
    for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
      for (std::size_t j = 0; j + 1 < rows.size(); ++j) {
        draw({columns[i] + halfStreet(), rows[j] + halfStreet(), columns[i + 1] - halfStreet(),
              rows[j + 1] - halfStreet()});
      }
    }
    for (std::size_t i = 1; i + 1 < columns.size(); ++i) {
      for (std::size_t j = 0; j + 1 < rows.size(); ++j) {
        const double y = random_.uniform(rows[j] + kWidestM, rows[j + 1] - kWidestM);
        if (random_.uniform() < kClosedShare) {
          draw({columns[i] - kWidestM, y, columns[i] + kWidestM, y + kWallM});
        }
      }
    }
    for (std::size_t j = 1; j + 1 < rows.size(); ++j) {
      for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
        const double x = random_.uniform(columns[i] + kWidestM, columns[i + 1] - kWidestM);
        if (random_.uniform() < kClosedShare) {
          draw({x, rows[j] - kWidestM, x + kWallM, rows[j] + kWidestM});
        }
      }
    }
  }

  void halls() {
    divide({-half_m_, -half_m_, half_m_, half_m_});
    scatter(0.001, 0.3, 1.2);
  }

  void harbour() {
    for (const double side : {-1.0, 1.0}) {
      for (double x = -half_m_ + 8.0; x < half_m_ - 12.0;) {
        const double width = random_.uniform(2.0, 5.0);
        pierFromNorthOrSouth(x, width, side);
        x += width + random_.uniform(12.0, 22.0);
      }
      for (double y = -half_m_ + 8.0; y < half_m_ - 12.0;) {
        const double length = random_.uniform(0.05, 0.17) * 2.0 * half_m_;
        const double width = random_.uniform(2.0, 5.0);
        const double quay = side * half_m_;
        draw({std::min(quay, quay - side * length), y, std::max(quay, quay - side * length),
              y + width});
        y += width + random_.uniform(12.0, 22.0);
      }
    }
    for (const double share : {-0.2, 0.17}) {
      const double y = share * half_m_;
      const double entrance = random_.uniform(-0.5, 0.5) * half_m_;
      draw({-0.6 * half_m_, y, entrance - 5.0, y + 2.5});
      draw({entrance + 5.0, y, 0.6 * half_m_, y + 2.5});
    }
    scatter(0.0014, 0.2, 0.8);
  }

  void border() {
    draw({-half_m_, -half_m_, half_m_, -half_m_ + kBorderM});
    draw({-half_m_, half_m_ - kBorderM, half_m_, half_m_});
    draw({-half_m_, -half_m_, -half_m_ + kBorderM, half_m_});
    draw({half_m_ - kBorderM, -half_m_, half_m_, half_m_});
  }

 private:
  static constexpr double kWidestM = 6.0;  // a wall across reaches so far from a street's middle
  static constexpr double kClosedShare = 0.2;

  void draw(const Box& box, Cell cell = Cell::kOccupied) {
    const map::GridGeometry& g = grid_.geometry;
    const auto at = [&](double m, int last) {
      return std::clamp(static_cast<int>(std::floor((m + half_m_) / g.resolution_m)), 0, last);
    };
    for (int row = at(box.south, g.height - 1); row <= at(box.north, g.height - 1); ++row) {
      for (int column = at(box.west, g.width - 1); column <= at(box.east, g.width - 1); ++column) {
        grid_.cells[g.index(column, row)] = cell;
      }
    }
  }

  double halfStreet() { return random_.uniform(2.5, 5.0); }

  std::vector<double> streetsAcross() {
    std::vector<double> middles = {-half_m_};
    while (middles.back() < half_m_ - 25.0) {
      middles.push_back(middles.back() + random_.uniform(18.0, 45.0));
    }
    return middles;
  }

  void divide(const Box& room) {
    const double width = room.east - room.west;
    const double height = room.north - room.south;
    if (std::max(width, height) < 40.0) {
      return;
    }
    const double door = random_.uniform(4.0, 7.0);
    if (width > height) {
      const double x = random_.uniform(room.west + 0.3 * width, room.east - 0.3 * width);
      draw({x, room.south, x + kWallM, room.north});
      const double y = random_.uniform(room.south + 2.0, room.north - 2.0 - door);
      draw({x, y, x + kWallM, y + door}, Cell::kFree);
      divide({room.west, room.south, x, room.north});
      divide({x + kWallM, room.south, room.east, room.north});
      return;
    }
    const double y = random_.uniform(room.south + 0.3 * height, room.north - 0.3 * height);
    draw({room.west, y, room.east, y + kWallM});
    const double x = random_.uniform(room.west + 2.0, room.east - 2.0 - door);
    draw({x, y, x + door, y + kWallM}, Cell::kFree);
    divide({room.west, room.south, room.east, y});
    divide({room.west, y + kWallM, room.east, room.north});
  }

  void pierFromNorthOrSouth(double x, double width, double side) {
    const double length = random_.uniform(0.08, 0.29) * 2.0 * half_m_;
    const double quay = side * half_m_;
    draw(
        {x, std::min(quay, quay - side * length), x + width, std::max(quay, quay - side * length)});
    if (random_.uniform() < 0.3) {
      return;
    }
    const double apart = random_.uniform(9.0, 13.0);
    for (double out = 8.0; out < length - 6.0; out += apart) {
      const double finger = random_.uniform(3.0, 6.0);
      const double y = quay - side * out;
      draw({x - finger, y, x + width + finger, y + 0.5});
    }
  }

  // So many squares a square metre, of half a side from least to most.
  void scatter(double density, double least_m, double most_m) {
    const int count = static_cast<int>(density * 4.0 * half_m_ * half_m_);
    for (int i = 0; i < count; ++i) {
      const double x = random_.uniform(-half_m_, half_m_);
      const double y = random_.uniform(-half_m_, half_m_);
      const double half = random_.uniform(least_m, most_m);
      draw({x - half, y - half, x + half, y + half});
    }
  }

  Random& random_;
  OccupancyGrid& grid_;
  double half_m_;
};

}  // namespace

void drawWalls(Walls walls, Random& random, OccupancyGrid& grid) {
  Drawing drawing(random, grid);
  if (walls == Walls::kStreets) {
    drawing.streets();
  } else if (walls == Walls::kHalls) {
    drawing.halls();
  } else if (walls == Walls::kHarbour) {
    drawing.harbour();
  }
  drawing.border();
}

}  // namespace otter_nav::scenario
