#include "moment.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/stopping/braking.hpp"

namespace otter_nav::mission {

vessel::State withoutSwing(const Moment& m) {
  constexpr double kOldS = 0.5;
  const vessel::Foreseen& foreseen = m.situation.foreseen;
  vessel::State x = m.situation.state;
  if (!foreseen.poses.empty() && std::abs(foreseen.start_s - m.now_s) < kOldS) {
    const Eigen::Vector2d port = across(unitVector(x[vessel::kPsi]));
    const double swing_m = port.dot(foreseen.poses.front().position - x.head<2>());
    x.head<2>() += std::clamp(swing_m, -stopping::kSwingsM, stopping::kSwingsM) * port;
  }
  return x;
}

}  // namespace otter_nav::mission
