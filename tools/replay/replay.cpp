#include "replay/replay.hpp"

#include <cmath>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::plant {
namespace {

Surroundings inCurrent(const SteadyCurrent& current, const PlantState& x) {
  Surroundings around;
  around.water_velocity[kU] = current.speed_mps * std::cos(current.direction_rad - x[kYaw]);
  around.water_velocity[kV] = current.speed_mps * std::sin(current.direction_rad - x[kYaw]);
  return around;
}

}  // namespace

Recording replay(const PlantModel& model, const Recording& recording, const SteadyCurrent& current,
                 double step_s) {
  constexpr double kRounding = 1e-6;
  const auto surroundings_at = [&](const PlantState& x) { return inCurrent(current, x); };
  const auto speeds_of = [](const RecordedRow& row) {
    return Eigen::Vector2d(row.state.tail<2>());
  };

  PlantState x = recording.has_motion ? recording.rows.front().state : model.settled();
  x.tail<2>() = model.propellersAtOnce() ? model.saturate(speeds_of(recording.rows.front()))
                                         : Eigen::Vector2d::Zero();
  Recording result;
  result.has_motion = true;
  result.rows.push_back({recording.rows.front().time_s, x});
  for (std::size_t k = 0; k + 1 < recording.rows.size(); ++k) {
    const RecordedRow& here = recording.rows[k];
    const RecordedRow& next = recording.rows[k + 1];
    const double interval_s = next.time_s - here.time_s;
    const int steps = std::max(1, static_cast<int>(std::ceil(interval_s / step_s - kRounding)));
    for (int i = 0; i < steps; ++i) {
      x = model.step(x, speeds_of(here), interval_s / steps, surroundings_at);
    }
    if (model.propellersAtOnce()) {
      x.tail<2>() = model.saturate(speeds_of(next));
    }
    result.rows.push_back({next.time_s, x});
  }
  return result;
}

ReplayDifference worstDifference(const Recording& a, const Recording& b) {
  ReplayDifference worst;
  for (std::size_t k = 0; k < std::min(a.rows.size(), b.rows.size()); ++k) {
    const PlantState& one = a.rows[k].state;
    const PlantState& other = b.rows[k].state;
    const double position = (one.segment<3>(kNorth) - other.segment<3>(kNorth)).norm();
    const double heading = std::abs(wrapAngle(one[kYaw] - other[kYaw]));
    // Written so that a difference that is not a number counts as the worst.
    if (!(position <= worst.position_m)) {
      worst.position_m = position;
      worst.position_time_s = a.rows[k].time_s;
    }
    if (!(heading <= worst.heading_rad)) {
      worst.heading_rad = heading;
      worst.heading_time_s = a.rows[k].time_s;
    }
  }
  return worst;
}

}  // namespace otter_nav::plant
