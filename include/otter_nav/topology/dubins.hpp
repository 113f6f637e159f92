// Shortest curves of bounded curvature (Dubins 1957) between two poses: of the six words LSL, RSR,
// LSR, RSL, RLR and LRL the shortest. Computed here, as OMPL's aborts on some pairs in a build
// with assertions; it serves as the tests' cross-check.
#pragma once

#include <array>

#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::topology {

using vessel::Pose;

class DubinsCurve {
 public:
  enum class Turn { kLeft, kStraight, kRight };

  // The shortest curve with turns of `radius_m` > 0.
  DubinsCurve(const Pose& start, const Pose& goal, double radius_m);

  [[nodiscard]] double length() const;
  // The pose `s_m` along the curve, clamped to its ends.
  [[nodiscard]] Pose at(double s_m) const;
  [[nodiscard]] const std::array<Turn, 3>& turns() const { return turns_; }

 private:
  Pose start_;
  double radius_m_;
  std::array<Turn, 3> turns_{Turn::kLeft, Turn::kStraight, Turn::kLeft};
  std::array<double, 3> arcs_{};  // lengths in turning radii
};

}  // namespace otter_nav::topology
