// The least length a way can have: what trajectories are measured against.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <utility>

#include "otter_nav/map/distance_field.hpp"

namespace otter_nav::benchmark {

// Growth of obstacles the lengths are for.
constexpr double kGrowthM = 0.8;

// Length of a near-shortest any-angle path (Theta*, Nash et al. 2007, on the cells' centres, then
// pulled taut) between two points for a disc of radius `clearance_m`; 0 if there is none.
[[nodiscard]] double anyAngleLength(const map::DistanceField& field, const Eigen::Vector2d& start,
                                    const Eigen::Vector2d& goal, double clearance_m);

class ShortestWays {
 public:
  // Lengths in `folder`/shortest.csv (scenario,mission,kind,shortest_m) are used, if the file is
  // there and `use_file` is set: they are for the world maps.
  ShortestWays(const std::string& folder, bool use_file);

  [[nodiscard]] double find(const std::string& scenario, int mission,
                            const map::DistanceField& field, const Eigen::Vector2d& start,
                            const Eigen::Vector2d& goal) const;

 private:
  std::map<std::pair<std::string, int>, double> known_;
};

}  // namespace otter_nav::benchmark
