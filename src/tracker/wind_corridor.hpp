// In strong wind: the headings, about the one into it and the one before it, on which a gust leaves
// the thrusters' moment some of itself. The wind's moment goes with the sine of twice the angle to
// the bow (docs/weather.md). A hull that holds its way against a current lies askew in the wind,
// where the next gust takes its heading and blows it off by metres; giving way to the side a little
// costs less.
#pragma once

#include <Eigen/Core>

#include "otter_nav/vessel/parameters.hpp"
#include "tracker/ocp/problem.hpp"

namespace otter_nav::tracker {

class WindCorridor {
 public:
  explicit WindCorridor(const vessel::Parameters& vessel);

  // The wind as it is estimated, earth frame.
  void feel(double time_s, const Eigen::Vector2d& wind_mps);
  // Round the bow to it, or the stern for a hull whose heading, `psi_rad`, is far nearer to that;
  // all headings where no gust takes the moment.
  [[nodiscard]] HeadingCorridor about(double psi_rad) const;

 private:
  double yaw_kg_;  // of the wind's moment
  double moment_nm_;
  Eigen::Vector2d wind_mps_ = Eigen::Vector2d::Zero();
  double mean_mps_ = 0.0;
  double felt_s_ = 0.0;
  double felt_at_s_ = 0.0;
  bool felt_ = false;
};

}  // namespace otter_nav::tracker
