// What is known of other vessels: their true motion with an error that wanders slowly, the same
// every time.
#pragma once

#include <cmath>
#include <vector>

#include "otter_nav/plant/simulator.hpp"
#include "otter_nav/traffic/track.hpp"

namespace otter_nav::simulation {

class Lookout {
 public:
  void look(double now_s, const std::vector<plant::OtherVessel>& others) {
    tracks_.clear();
    for (const plant::OtherVessel& other : others) {
      constexpr double kErrorM = 0.5;
      constexpr double kErrorMps = 0.03;
      const double phase = 0.7 * now_s + other.id;
      const double heading = other.motion.pose.psi_rad;
      traffic::Track track;
      track.id = other.id;
      track.stamp_s = now_s;
      track.heading_rad = heading;
      track.position = other.motion.pose.position +
                       kErrorM * Eigen::Vector2d(std::sin(phase), std::cos(1.3 * phase));
      track.velocity =
          other.motion.speed_mps * Eigen::Vector2d(std::cos(heading), std::sin(heading)) +
          kErrorMps * Eigen::Vector2d(std::sin(0.3 * phase), std::cos(0.4 * phase));
      track.length_m = other.hull.length_m;
      track.beam_m = other.hull.beam_m;
      track.covariance.diagonal() << kErrorM * kErrorM, kErrorM * kErrorM, kErrorMps * kErrorMps,
          kErrorMps * kErrorMps;
      tracks_.push_back(track);
    }
  }
  [[nodiscard]] const std::vector<traffic::Track>& tracks() const { return tracks_; }

 private:
  std::vector<traffic::Track> tracks_;
};

}  // namespace otter_nav::simulation
