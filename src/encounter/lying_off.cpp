#include "otter_nav/encounter/lying_off.hpp"

#include <algorithm>

namespace otter_nav::encounter {
namespace {

bool areMany(const Eigen::Vector2d& position, const std::vector<traffic::Track>& tracks) {
  constexpr int kMany = 8;
  constexpr double kNearM = 60.0;
  return std::count_if(tracks.begin(), tracks.end(), [&](const traffic::Track& track) {
           return track.makesWay() && (track.position - position).norm() < kNearM;
         }) >= kMany;
}

}  // namespace

std::optional<Eigen::Vector2d> LyingOff::place(double now_s, const Eigen::Vector2d& position,
                                               const Eigen::Vector2d& goal,
                                               const std::vector<traffic::Track>& tracks,
                                               const map::DistanceField& still,
                                               const Evasion& evasion) {
  constexpr double kLeastS = 5.0;  // the first tracks are few
  constexpr double kMostS = 60.0;
  constexpr double kRightBeforeM = 8.0;
  constexpr double kKnown = 0.9;
  constexpr double kAnewS = 3.0;
  is_over_ = is_over_ || (goal - position).norm() < kRightBeforeM;
  if (is_over_ || (!since_s_ && !areMany(position, tracks))) {
    return std::nullopt;
  }
  const bool begins = !since_s_;
  since_s_ = since_s_.value_or(now_s);
  const double lain_s = now_s - *since_s_;
  is_over_ = lain_s > kMostS || (lain_s > kLeastS && evasion.shareKnown(tracks) > kKnown);
  if (is_over_) {
    return std::nullopt;
  }
  if (begins || now_s - chosen_s_ > kAnewS) {
    chosen_s_ = now_s;
    place_ = evasion.quietPlace(position, now_s, tracks, still);
  }
  return place_;
}

}  // namespace otter_nav::encounter
