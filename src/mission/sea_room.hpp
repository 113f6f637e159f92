// Where wind takes a vessel, and where there is room for that: to leeward of a place or of a way,
// and ahead or astern along the wind's line (docs/weather.md, Beyond thrust).
#pragma once

#include <Eigen/Core>

#include "moment.hpp"
#include "otter_nav/trajectory/timed_trajectory.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "safety.hpp"

namespace otter_nav::mission {

// Of one moment; what it is made of outlives it.
class SeaRoom {
 public:
  SeaRoom(const Moment& moment, const Safety& safety, const vessel::Hull& hull)
      : moment_(moment), safety_(safety), hull_(hull) {}

  // The hull lies nearer than its length to where a heading that is lost would take it, or half a
  // length more to where it is: a current sets it across the wind.
  [[nodiscard]] bool hasALeeShore() const;
  // How far to leeward of a place nothing lies, m, at most `far_m`.
  [[nodiscard]] double toLeeward(const Eigen::Vector2d& position, double far_m) const;
  // The least on the stretch of the way from now on, up to what a lost heading takes.
  [[nodiscard]] double toLeeward(const trajectory::TimedTrajectory& path, double ahead_s) const;
  // How far ahead of a vessel that lies along what pushes, m (negative: astern), there is enough
  // room round it and to leeward, or most; 0 where it has that already, or there is no better
  // place. It had to stop so often hereabouts; to wait in strong wind takes more than to set out.
  [[nodiscard]] double toMake(int stops, bool to_wait) const;
  // So far from there, bow to what pushes, or stern in strong wind.
  [[nodiscard]] trajectory::Trajectory leg(const Eigen::Vector2d& from, double ahead_m) const;

 private:
  // The hull's heading, or in strong wind the one into it, bow or stern, as far as turning there
  // needs no room.
  [[nodiscard]] double windward() const;
  [[nodiscard]] const Weather& weather() const { return safety_.weather(); }
  [[nodiscard]] double clearance(const Eigen::Vector2d& place) const {
    return moment_.obstacles.clearance(place, moment_.now_s);
  }

  const Moment& moment_;
  const Safety& safety_;
  const vessel::Hull& hull_;
};

}  // namespace otter_nav::mission
