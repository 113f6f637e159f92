// Queries as a mission asks them where wind and current are known (docs/planner.md, In wind and
// current): from rest bow to a firm load, and again under way where load or limits have changed.
#pragma once

#include <optional>

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/planner/planner.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::benchmark {

// Limits and load of all queries. What is not given stays as it is without.
struct Load {
  vessel::Disturbance disturbance;      // earth frame, steady
  std::optional<double> beside_m;       // of the hull's side from everything occupied
  std::optional<double> thrust_share;   // of what plans usually take
  std::optional<double> hull_margin_m;  // of the discs that cover the hull
};

// Plans that are asked for while another is sailed.
struct UnderWay {
  double at_share = 0.0;  // of the duration of the plan from rest; 0: the plan from rest itself
  std::optional<double> speed_max_mps;         // from there on
  std::optional<Eigen::Vector2d> force_n;      // likewise, earth frame
  std::optional<Eigen::Vector2d> current_mps;  // likewise
};

// `query` under `load`: both ends bow to it where it is firm, and no more clearance than there is
// at the ends.
[[nodiscard]] planner::Query underLoad(planner::Query query, const Load& load,
                                       const vessel::Parameters& vessel,
                                       const map::DistanceField& field);

// `query` once more from a place of the plan `sailed` that came of it, with as much thrust as that
// takes there.
[[nodiscard]] planner::Query underWay(planner::Query query, const trajectory::Trajectory& sailed,
                                      const UnderWay& change, const vessel::Parameters& vessel);

}  // namespace otter_nav::benchmark
