// Before it goes in among many of whom nobody knows how they will go on, a vessel lies off, where
// fewest come, and looks on until it has seen most of their ways. Without a clock.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "otter_nav/encounter/evasion.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/traffic/track.hpp"

namespace otter_nav::encounter {

class LyingOff {
 public:
  void newGoal() { *this = {}; }

  // Where to lie, map frame, for a vessel at `position` that keeps clear of `still`; nothing: it
  // goes on, as it does right before the goal; once it has lain off it will not do so again.
  [[nodiscard]] std::optional<Eigen::Vector2d> place(double now_s, const Eigen::Vector2d& position,
                                                     const Eigen::Vector2d& goal,
                                                     const std::vector<traffic::Track>& tracks,
                                                     const map::DistanceField& still,
                                                     const Evasion& evasion);

 private:
  bool is_over_ = false;
  std::optional<double> since_s_;
  double chosen_s_ = 0.0;
  Eigen::Vector2d place_ = Eigen::Vector2d::Zero();
};

}  // namespace otter_nav::encounter
