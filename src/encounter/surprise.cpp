#include "otter_nav/encounter/surprise.hpp"

#include <algorithm>

namespace otter_nav::encounter {

void Surprise::decided(const std::vector<traffic::Track>& tracks) {
  velocities_.clear();
  for (const traffic::Track& track : tracks) {
    velocities_[track.id] = track.velocity;
  }
}

bool Surprise::isNear(const Eigen::Vector2d& position,
                      const std::vector<traffic::Track>& tracks) const {
  constexpr double kOtherwiseMps = 0.8;  // tracks wander
  constexpr double kSoonS = 2.5;
  constexpr double kHullsM = 4.0;  // between the middles of hulls that touch
  return std::any_of(tracks.begin(), tracks.end(), [&](const traffic::Track& track) {
    const auto before = velocities_.find(track.id);
    const bool is_new = before == velocities_.end();
    if (is_new ? !track.makesWay() : (track.velocity - before->second).norm() < kOtherwiseMps) {
      return false;
    }
    const double speed = std::max(track.velocity.norm(), is_new ? 0.0 : before->second.norm());
    return (track.position - position).norm() < kHullsM + kSoonS * speed;
  });
}

}  // namespace otter_nav::encounter
