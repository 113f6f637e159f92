// How far the vessel is off where it should be: what waves, and a model that is not quite the
// vessel, leave to every tracker.
#pragma once

#include <algorithm>
#include <cmath>

namespace otter_nav::mission {

class Wander {
 public:
  // `off_m` from the trajectory's point of `now_s`; times rise.
  void feel(double now_s, double off_m) {
    constexpr double kMemoryS = 15.0;
    constexpr double kStepMostS = 0.5;  // of what happened between nothing is known
    constexpr double kMostM = 0.5;      // farther off it was set aside, which is another matter
    const double dt = std::clamp(now_s - last_s_, 0.0, kStepMostS);
    last_s_ = now_s;
    felt_s_ += dt;
    const double off = std::min(off_m, kMostM);
    square_m2_ += dt / std::min(kMemoryS, felt_s_) * (off * off - square_m2_);
  }
  // It has been under way for long enough to tell.
  [[nodiscard]] bool isKnown() const {
    constexpr double kLongEnoughS = 5.0;
    return felt_s_ > kUsualS + kLongEnoughS;
  }
  // Twice the root of the mean square lately, m.
  [[nodiscard]] double reach() const { return 2.0 * std::sqrt(square_m2_); }

 private:
  static constexpr double kUsualM = 0.03;  // until more is known
  static constexpr double kUsualS = 2.0;   // for which that counts

  double last_s_ = 0.0;
  double felt_s_ = kUsualS;
  double square_m2_ = kUsualM * kUsualM;
};

}  // namespace otter_nav::mission
