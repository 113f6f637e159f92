#include "shortest_way.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <queue>
#include <sstream>
#include <vector>

namespace otter_nav::benchmark {
namespace {

using map::DistanceField;
using map::GridGeometry;

// Theta*: A* on the eight neighbours whose parents need not be neighbours but only in sight.
class ThetaStar {
 public:
  ThetaStar(const DistanceField& field, double clearance_m)
      : field_(field),
        grid_(field.geometry()),
        clearance_m_(clearance_m),
        cost_(static_cast<std::size_t>(grid_.width) * static_cast<std::size_t>(grid_.height),
              std::numeric_limits<double>::infinity()),
        parent_(cost_.size(), -1),
        closed_(cost_.size(), 0) {}

  std::vector<Eigen::Vector2d> search(const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
    if (!grid_.contains(start) || !grid_.contains(goal)) {
      return {};
    }
    start_ = start;
    goal_ = goal;
    const Eigen::Vector2i first = grid_.cellAt(start);
    const Eigen::Vector2i last = grid_.cellAt(goal);
    first_ = static_cast<int>(grid_.index(first.x(), first.y()));
    last_ = static_cast<int>(grid_.index(last.x(), last.y()));
    cost_[static_cast<std::size_t>(first_)] = 0.0;
    parent_[static_cast<std::size_t>(first_)] = first_;
    open_.emplace(-(goal - start).norm(), first_);
    while (!open_.empty()) {
      const int cell = open_.top().second;
      open_.pop();
      if (closed_[static_cast<std::size_t>(cell)] != 0) {
        continue;
      }
      closed_[static_cast<std::size_t>(cell)] = 1;
      if (cell == last_) {
        return trace();
      }
      expand(cell);
    }
    return {};
  }

 private:
  [[nodiscard]] Eigen::Vector2d point(int cell) const {
    if (cell == first_) {
      return start_;
    }
    return cell == last_ ? goal_ : grid_.centreOf(cell % grid_.width, cell / grid_.width);
  }

  void expand(int cell) {
    const int column = cell % grid_.width;
    const int row = cell / grid_.width;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (grid_.containsCell(column + dx, row + dy)) {
          reach(cell, static_cast<int>(grid_.index(column + dx, row + dy)));
        }
      }
    }
  }

  void reach(int from, int cell) {
    const auto index = static_cast<std::size_t>(cell);
    const Eigen::Vector2d there = point(cell);
    if (closed_[index] != 0 || field_.clearance(there) < clearance_m_) {
      return;
    }
    const int above = parent_[static_cast<std::size_t>(from)];
    for (const int parent : {above, from}) {
      const double cost = cost_[static_cast<std::size_t>(parent)] + (there - point(parent)).norm();
      if (cost < cost_[index] && segmentIsClear(field_, point(parent), there, clearance_m_)) {
        cost_[index] = cost;
        parent_[index] = parent;
        open_.emplace(-cost - (goal_ - there).norm(), cell);
        return;
      }
    }
  }

  [[nodiscard]] std::vector<Eigen::Vector2d> trace() const {
    std::vector<Eigen::Vector2d> points = {goal_};
    for (int cell = last_; cell != first_; cell = parent_[static_cast<std::size_t>(cell)]) {
      points.push_back(point(parent_[static_cast<std::size_t>(cell)]));
    }
    std::reverse(points.begin(), points.end());
    return points;
  }

  const DistanceField& field_;
  const GridGeometry& grid_;
  double clearance_m_;
  Eigen::Vector2d start_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d goal_ = Eigen::Vector2d::Zero();
  int first_ = 0;
  int last_ = 0;
  std::vector<double> cost_;
  std::vector<int> parent_;
  std::vector<char> closed_;
  std::priority_queue<std::pair<double, int>> open_;  // negative estimate, cell
};

// Moves inner points towards the chord of their neighbours while the way stays clear, and drops
// those that are no longer needed.
void pullTaut(const DistanceField& field, double clearance_m,
              std::vector<Eigen::Vector2d>& points) {
  constexpr int kRounds = 60;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      if (segmentIsClear(field, points[i - 1], points[i + 1], clearance_m)) {
        points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
        continue;
      }
      const Eigen::Vector2d chord = points[i + 1] - points[i - 1];
      const double share = (points[i] - points[i - 1]).dot(chord) / chord.squaredNorm();
      const Eigen::Vector2d target = points[i - 1] + std::clamp(share, 0.0, 1.0) * chord;
      double step = 1.0;
      for (int halving = 0; halving < 6; ++halving, step *= 0.5) {
        const Eigen::Vector2d moved = points[i] + step * (target - points[i]);
        if (segmentIsClear(field, points[i - 1], moved, clearance_m) &&
            segmentIsClear(field, moved, points[i + 1], clearance_m)) {
          points[i] = moved;
          break;
        }
      }
    }
  }
}

}  // namespace

double anyAngleLength(const DistanceField& field, const Eigen::Vector2d& start,
                      const Eigen::Vector2d& goal, double clearance_m) {
  std::vector<Eigen::Vector2d> points = ThetaStar(field, clearance_m).search(start, goal);
  pullTaut(field, clearance_m, points);
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    length += (points[i] - points[i - 1]).norm();
  }
  return length;
}

ShortestWays::ShortestWays(const std::string& folder, bool use_file) {
  std::ifstream file(folder + "/shortest.csv");
  std::string line;
  while (use_file && std::getline(file, line)) {
    std::istringstream fields(line);
    std::string scenario;
    std::string mission;
    std::string kind;
    std::string length;
    if (std::getline(fields, scenario, ',') && std::getline(fields, mission, ',') &&
        std::getline(fields, kind, ',') && std::getline(fields, length, ',') &&
        scenario != "scenario") {
      known_[{scenario, std::atoi(mission.c_str())}] = std::atof(length.c_str());
    }
  }
}

double ShortestWays::find(const std::string& scenario, int mission, const DistanceField& field,
                          const Eigen::Vector2d& start, const Eigen::Vector2d& goal) const {
  const auto known = known_.find({scenario, mission});
  return known != known_.end() ? known->second : anyAngleLength(field, start, goal, kGrowthM);
}

}  // namespace otter_nav::benchmark
