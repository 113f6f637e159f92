// Whether somebody near has done since the last decision what it did not reckon with. The next one
// doesn't wait then: what is sailed was chosen for who goes another way. Without a clock.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "otter_nav/traffic/track.hpp"

namespace otter_nav::encounter {

class Surprise {
 public:
  // A decision is made with these.
  void decided(const std::vector<traffic::Track>& tracks);
  // Since then somebody has turned, has changed her speed or has come into sight who can be at
  // `position` within a few seconds.
  [[nodiscard]] bool isNear(const Eigen::Vector2d& position,
                            const std::vector<traffic::Track>& tracks) const;

 private:
  std::map<int, Eigen::Vector2d> velocities_;  // by the tracks' numbers
};

}  // namespace otter_nav::encounter
