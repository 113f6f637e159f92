#include "cylinder_field.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "otter_nav/base/random.hpp"

namespace otter_nav::scenario {
namespace {

using map::Cell;
using map::OccupancyGrid;

constexpr int kDraws = 4000;

// Marks that clump: a share of a lattice filled at random, then each cell goes with its
// neighbours a few times over.
class Clumps {
 public:
  Clumps(int columns, int rows, Random& random) : columns_(columns), rows_(rows) {
    const double share = random.uniform(0.2, 0.5);
    marks_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (char& mark : marks_) {
      mark = random.uniform() < share ? 1 : 0;
    }
    const int rounds = static_cast<int>(random.uniform(0.0, 4.0));
    for (int k = 0; k < rounds; ++k) {
      smooth();
    }
  }
  [[nodiscard]] bool at(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_ &&
           marks_[static_cast<std::size_t>(row * columns_ + column)] != 0;
  }

 private:
  void smooth() {
    constexpr int kJoins = 5;   // of eight neighbours
    constexpr int kLeaves = 1;  // fewer, and a mark goes
    std::vector<char> next(marks_.size());
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        int near = at(column, row) ? -1 : 0;
        for (int k = 0; k < 9; ++k) {
          near += at(column + k % 3 - 1, row + k / 3 - 1) ? 1 : 0;
        }
        const bool mark = near >= kJoins || (at(column, row) && near >= kLeaves);
        next[static_cast<std::size_t>(row * columns_ + column)] = mark ? 1 : 0;
      }
    }
    marks_ = std::move(next);
  }

  int columns_;
  int rows_;
  std::vector<char> marks_;
};

OccupancyGrid basin(const CylinderFieldOptions& o) {
  OccupancyGrid grid;
  map::GridGeometry& g = grid.geometry;
  g.resolution_m = o.resolution_m;
  g.width = static_cast<int>(std::lround((o.width_m + 2.0 * o.border_m) / o.resolution_m));
  g.height =
      static_cast<int>(std::lround((o.length_m + 2.0 * (o.end_m + o.border_m)) / o.resolution_m));
  g.origin = -0.5 * o.resolution_m * Eigen::Vector2d(g.width, g.height);
  grid.cells.assign(static_cast<std::size_t>(g.width) * static_cast<std::size_t>(g.height),
                    Cell::kFree);
  const int border = static_cast<int>(std::lround(o.border_m / o.resolution_m));
  for (int row = 0; row < g.height; ++row) {
    for (int column = 0; column < g.width; ++column) {
      if (std::min({row, column, g.height - 1 - row, g.width - 1 - column}) < border) {
        grid.cells[g.index(column, row)] = Cell::kOccupied;
      }
    }
  }
  return grid;
}

// Whole squares count: a cell is occupied where the cylinder touches it.
void drawCylinder(const Eigen::Vector2d& centre, double radius_m, OccupancyGrid& grid) {
  const map::GridGeometry& g = grid.geometry;
  const Eigen::Vector2i low = g.cellAt(centre - Eigen::Vector2d::Constant(radius_m));
  const Eigen::Vector2i high = g.cellAt(centre + Eigen::Vector2d::Constant(radius_m));
  for (int row = low.y(); row <= high.y(); ++row) {
    for (int column = low.x(); column <= high.x(); ++column) {
      const Eigen::Vector2d off = (g.centreOf(column, row) - centre).cwiseAbs();
      const Eigen::Vector2d nearest =
          (off - Eigen::Vector2d::Constant(0.5 * g.resolution_m)).cwiseMax(0.0);
      if (g.containsCell(column, row) && nearest.norm() < radius_m) {
        grid.cells[g.index(column, row)] = Cell::kOccupied;
      }
    }
  }
}

// A way through that wanders: what stands nearer to a leg of it than this leg's clearance is left
// out. One leg is as narrow as wanted, the others are wider by chance.
class Wander {
 public:
  Wander(const CylinderFieldOptions& o, const Mission& mission, double narrowest_m,
         Random& random) {
    constexpr double kLegM = 4.0;
    constexpr double kAsideShare = 0.6;  // of a leg
    constexpr double kWiderM = 0.6;
    const double half = 0.5 * o.width_m - narrowest_m;
    legs_.push_back({mission.start.position, narrowest_m});
    for (double y = -0.5 * o.length_m; y < 0.5 * o.length_m;
         y += random.uniform(0.7, 1.3) * kLegM) {
      const double aside = legs_.back().end.x() + random.uniform(-kAsideShare, kAsideShare) * kLegM;
      legs_.push_back(
          {{std::clamp(aside, -half, half), y}, narrowest_m + random.uniform(0.0, kWiderM)});
    }
    legs_.push_back({mission.goal.position, narrowest_m});
    const double narrow = random.uniform(2.0, static_cast<double>(legs_.size()) - 1.0);
    legs_[static_cast<std::size_t>(narrow)].clear_m = narrowest_m;
  }
  [[nodiscard]] bool meets(const Eigen::Vector2d& p, double radius_m) const {
    for (std::size_t k = 1; k < legs_.size(); ++k) {
      const Eigen::Vector2d& from = legs_[k - 1].end;
      const Eigen::Vector2d leg = legs_[k].end - from;
      const double share = std::clamp((p - from).dot(leg) / leg.squaredNorm(), 0.0, 1.0);
      if ((p - from - share * leg).norm() < legs_[k].clear_m + radius_m) {
        return true;
      }
    }
    return false;
  }

 private:
  struct Leg {
    Eigen::Vector2d end;
    double clear_m;
  };
  std::vector<Leg> legs_;
};

int drawField(const CylinderFieldOptions& o, const Wander& way, Random& random,
              OccupancyGrid& grid) {
  const double pitch = 2.0 * o.radius_m;
  const int columns = static_cast<int>(o.width_m / pitch);
  const int rows = static_cast<int>(o.length_m / pitch);
  const Clumps clumps(columns, rows, random);
  int count = 0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if (clumps.at(column, row)) {
        const Eigen::Vector2d within(random.uniform(0.3, 0.7), random.uniform(0.3, 0.7));
        const Eigen::Vector2d centre = pitch * (Eigen::Vector2d(column, row) + within) -
                                       0.5 * Eigen::Vector2d(o.width_m, o.length_m);
        if (!way.meets(centre, o.radius_m)) {
          drawCylinder(centre, o.radius_m, grid);
          ++count;
        }
      }
    }
  }
  return count;
}

Mission through(const CylinderFieldOptions& o, Random& random) {
  constexpr double kBesideShare = 0.25;  // of the width, to either side
  const double y = 0.5 * o.length_m + 0.5 * o.end_m;
  const auto across = [&] {
    return std::round(random.uniform(-kBesideShare, kBesideShare) * o.width_m * 100.0) / 100.0;
  };
  Mission mission;
  mission.start = {{across(), -y}, 1.571};
  mission.goal = {{across(), y}, 1.571};
  return mission;
}

}  // namespace

double widestWay(const map::DistanceField& field, const Eigen::Vector2d& from,
                 const Eigen::Vector2d& to) {
  const map::GridGeometry& g = field.geometry();
  if (!g.contains(from) || !g.contains(to)) {
    return 0.0;
  }
  const Eigen::Vector2i first = g.cellAt(from);
  const Eigen::Vector2i last = g.cellAt(to);
  const std::size_t goal = g.index(last.x(), last.y());
  // Dijkstra's search with the least clearance on the way in place of a length.
  std::vector<double> best(static_cast<std::size_t>(g.width) * static_cast<std::size_t>(g.height),
                           0.0);
  const auto clearanceAt = [&](const Eigen::Vector2i& cell) {
    return field.clearance(g.centreOf(cell.x(), cell.y()));
  };
  std::priority_queue<std::pair<double, std::size_t>> front;
  best[g.index(first.x(), first.y())] = clearanceAt(first);
  front.emplace(clearanceAt(first), g.index(first.x(), first.y()));
  while (!front.empty()) {
    const auto [width, index] = front.top();
    front.pop();
    if (index == goal) {
      return width;
    }
    if (width < best[index]) {
      continue;
    }
    const int column = static_cast<int>(index % static_cast<std::size_t>(g.width));
    const int row = static_cast<int>(index / static_cast<std::size_t>(g.width));
    for (int k = 0; k < 9; ++k) {
      const Eigen::Vector2i next(column + k % 3 - 1, row + k / 3 - 1);
      if (!g.containsCell(next.x(), next.y())) {
        continue;
      }
      const double there = std::min(width, clearanceAt(next));
      double& known = best[g.index(next.x(), next.y())];
      if (there > known) {
        known = there;
        front.emplace(there, g.index(next.x(), next.y()));
      }
    }
  }
  return 0.0;
}

Result<CylinderField> generateCylinderField(const CylinderFieldOptions& options,
                                            std::uint64_t seed) {
  Random random(seed);
  const OccupancyGrid empty = basin(options);
  for (int k = 0; k < kDraws; ++k) {
    CylinderField field;
    field.world = empty;
    field.mission = through(options, random);
    constexpr double kCellsLost = 1.0;  // to whole squares
    const double wanted = random.uniform(options.best_min_m, options.best_max_m);
    const Wander way(options, field.mission, wanted + kCellsLost * options.resolution_m, random);
    field.cylinders = drawField(options, way, random, field.world);
    if (field.cylinders < options.fewest || field.cylinders > options.most) {
      continue;
    }
    const map::DistanceField distances(field.world, {2.0 * options.best_max_m, false});
    field.best_m = widestWay(distances, field.mission.start.position, field.mission.goal.position);
    if (field.best_m >= options.best_min_m && field.best_m <= options.best_max_m) {
      field.chart = empty;
      std::fill(field.chart.cells.begin(), field.chart.cells.end(), Cell::kUnknown);
      return field;
    }
  }
  return failure("cylinder field: none among " + std::to_string(kDraws) +
                 " draws has the wanted number of cylinders and width of the best way");
}

}  // namespace otter_nav::scenario
