#include "tracker/wind_corridor.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::tracker {
namespace {

constexpr double kGust = 1.3;          // over the mean: two standard deviations of gusts of 0.15
constexpr double kGustMemoryS = 20.0;  // of the mean
constexpr double kGapS = 0.1;          // a longer one counts as that
constexpr double kHeldShare = 0.9;     // of the thrusters' moment, in the gust
// A heading that was lost is brought back, unless it has turned nearly round.
constexpr double kSternCosine = -0.5;

}  // namespace

WindCorridor::WindCorridor(const vessel::Parameters& vessel)
    : yaw_kg_(std::abs(vessel.manoeuvring.wind_yaw_kg)),
      moment_nm_(vessel::greatestMoment(vessel.thrusters)) {}

void WindCorridor::feel(double time_s, const Eigen::Vector2d& wind_mps) {
  const double dt = felt_ ? std::clamp(time_s - felt_at_s_, 0.0, kGapS) : kGapS;
  wind_mps_ = wind_mps;
  felt_s_ = std::min(felt_s_ + dt, kGustMemoryS);  // of all that was felt, until that is so long
  mean_mps_ += dt / felt_s_ * (wind_mps.norm() - mean_mps_);
  felt_at_s_ = time_s;
  felt_ = true;
}

HeadingCorridor WindCorridor::about(double psi_rad) const {
  HeadingCorridor corridor;
  const double gust_mps = std::max(wind_mps_.norm(), kGust * mean_mps_);
  const double most_nm = 0.5 * yaw_kg_ * gust_mps * gust_mps;  // at 45 degrees
  if (kHeldShare * moment_nm_ < most_nm) {
    const double bow = angleOf(-wind_mps_);
    corridor.is_sterns = std::cos(psi_rad - bow) < kSternCosine;
    corridor.psi_rad = corridor.is_sterns ? bow + kPi : bow;
    corridor.half_width_rad = 0.5 * std::asin(kHeldShare * moment_nm_ / most_nm);
  }
  return corridor;
}

}  // namespace otter_nav::tracker
