// The other vessels of a scenario: where they are, what of them a beam meets, whether they touch.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "otter_nav/plant/signals.hpp"
#include "otter_nav/vessel/scripted_vessel.hpp"

namespace otter_nav::plant {

class OtherVessels {
 public:
  void set(std::vector<vessel::ScriptedVessel> vessels, double time_s);
  // Moves all to where they are at `time_s`.
  void advance(double time_s);

  [[nodiscard]] const std::vector<OtherVessel>& now() const { return now_; }

  // Distance, m, along the unit vector to the first outline within `range_m`, or infinity; 0 from
  // within one. They are upright walls from the water up, as all else.
  [[nodiscard]] double castRay(const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
                               double range_m) const;

  // The nearest one's place in now(), and the exact distance between the outlines (0: they touch).
  struct Nearest {
    std::size_t index = 0;
    double distance_m = 0.0;
  };
  [[nodiscard]] std::optional<Nearest> nearest(const vessel::Hull& hull,
                                               const Eigen::Vector2d& position,
                                               double psi_rad) const;

  // The exact distance between two outlines.
  [[nodiscard]] static double distance(const vessel::Hull& a, const vessel::Pose& at,
                                       const vessel::Hull& b, const vessel::Pose& there);

 private:
  std::vector<vessel::ScriptedVessel> scripts_;
  std::vector<OtherVessel> now_;
};

}  // namespace otter_nav::plant
