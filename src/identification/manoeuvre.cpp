#include "manoeuvre.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::identification {
namespace {

// Shares of thrust per radian and per rad/s that hold a heading, gently: the speed is what is
// excited. At most a tenth of the thrust goes into it.
constexpr double kHeadingGain = 0.3;
constexpr double kYawRateGain = 0.3;
constexpr double kHoldLimit = 0.1;

class SpeedStep : public Manoeuvre {
 public:
  using Manoeuvre::Manoeuvre;

  Shares step(double elapsed_s, double psi_rad, double yaw_rate_radps) override {
    finished_ = elapsed_s >= options_.seconds;
    const double turn = kHeadingGain * (psi_rad_ - psi_rad) - kYawRateGain * yaw_rate_radps;
    return {options_.ahead, std::clamp(turn, -kHoldLimit, kHoldLimit)};
  }
};

class Zigzag : public Manoeuvre {
 public:
  using Manoeuvre::Manoeuvre;

  Shares step(double elapsed_s, double psi_rad, double /*yaw_rate_radps*/) override {
    if (side_ * (psi_rad - psi_rad_) >= options_.angle_rad) {
      side_ = -side_;
      ++swings_;
    }
    finished_ = swings_ >= options_.count || elapsed_s >= options_.seconds;
    return {options_.ahead, side_ * options_.turn};
  }

 private:
  double side_ = 1.0;
  int swings_ = 0;
};

class Circle : public Manoeuvre {
 public:
  using Manoeuvre::Manoeuvre;

  Shares step(double elapsed_s, double psi_rad, double /*yaw_rate_radps*/) override {
    finished_ = std::abs(psi_rad - psi_rad_) >= options_.angle_rad || elapsed_s >= options_.seconds;
    return {options_.ahead, options_.turn};
  }
};

// Dieudonne's: the turn goes from +turn to -turn and back, each step held until it is steady.
class Spiral : public Manoeuvre {
 public:
  using Manoeuvre::Manoeuvre;

  Shares step(double elapsed_s, double /*psi_rad*/, double /*yaw_rate_radps*/) override {
    const int number = static_cast<int>(elapsed_s / options_.seconds);
    finished_ = number > 2 * options_.count;
    const int from_end = std::abs(options_.count - std::min(number, 2 * options_.count));
    return {options_.ahead, options_.turn * (2.0 * from_end / options_.count - 1.0)};
  }
};

}  // namespace

std::unique_ptr<Manoeuvre> makeManoeuvre(const ManoeuvreOptions& options, double psi_rad) {
  switch (options.kind) {
    case ManoeuvreKind::kZigzag:
      return std::make_unique<Zigzag>(options, psi_rad);
    case ManoeuvreKind::kCircle:
      return std::make_unique<Circle>(options, psi_rad);
    case ManoeuvreKind::kSpiral:
      return std::make_unique<Spiral>(options, psi_rad);
    case ManoeuvreKind::kSpeedStep:
      break;
  }
  return std::make_unique<SpeedStep>(options, psi_rad);
}

}  // namespace otter_nav::identification
