#include "otter_nav/identification/manoeuvres.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "manoeuvre.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::identification {
namespace {

// In the order of ManoeuvreKind.
constexpr std::array<const char*, 4> kKindNames = {"speed_step", "zigzag", "circle", "spiral"};

Result<ManoeuvreOptions> readManoeuvre(config::Section section) {
  ManoeuvreOptions o;
  std::string kind;
  section.read("kind", kind, {kKindNames.begin(), kKindNames.end()});
  const auto* found = std::find(kKindNames.begin(), kKindNames.end(), kind);
  o.kind = static_cast<ManoeuvreKind>(found - kKindNames.begin());
  section.read("ahead", o.ahead, {-1.0, 1.0});
  section.read("seconds", o.seconds, {0.1, 600.0});
  if (o.kind != ManoeuvreKind::kSpeedStep) {
    section.read("turn", o.turn, {-1.0, 1.0});
  }
  if (o.kind == ManoeuvreKind::kZigzag || o.kind == ManoeuvreKind::kSpiral) {
    section.read("count", o.count, {1, 100});
  }
  if (o.kind == ManoeuvreKind::kZigzag || o.kind == ManoeuvreKind::kCircle) {
    double angle_deg = 0.0;
    section.read("angle_deg", angle_deg, {1.0, 3600.0});
    o.angle_rad = angle_deg * kPi / 180.0;
  }
  const Status status = section.finish();
  if (!status) {
    return failure(status.error().message);
  }
  return o;
}

}  // namespace

vessel::Thrusts thrustsOf(double ahead, double turn, const vessel::Thrusters& thrusters) {
  const double least = -thrusters.astern_max_n / thrusters.ahead_max_n;
  const double mean = ahead < 0.0 ? -ahead * least : ahead;
  const double half = std::clamp(turn, -0.5 * (1.0 - least), 0.5 * (1.0 - least));
  const double kept = std::clamp(mean, least + std::abs(half), 1.0 - std::abs(half));
  vessel::Thrusts thrusts;
  thrusts[vessel::kLeft] = (kept - half) * thrusters.ahead_max_n;
  thrusts[vessel::kRight] = (kept + half) * thrusters.ahead_max_n;
  return vessel::clampThrusts(thrusts, thrusters);
}

Result<std::vector<ManoeuvreOptions>> readExcitation(config::Section section) {
  std::vector<ManoeuvreOptions> manoeuvres;
  for (const config::Section& entry : section.children("manoeuvres")) {
    const Result<ManoeuvreOptions> one = readManoeuvre(entry);
    if (!one) {
      return failure(one.error().message);
    }
    manoeuvres.push_back(*one);
  }
  const Status status = section.finish();
  if (!status) {
    return failure(status.error().message);
  }
  return manoeuvres;
}

Excitation::Excitation(std::vector<ManoeuvreOptions> manoeuvres, const vessel::Thrusters& thrusters)
    : manoeuvres_(std::move(manoeuvres)), thrusters_(thrusters) {}
Excitation::~Excitation() = default;
Excitation::Excitation(Excitation&&) noexcept = default;
Excitation& Excitation::operator=(Excitation&&) noexcept = default;

vessel::Thrusts Excitation::step(double time_s, const vessel::State& state) {
  unwrapped_psi_rad_ =
      started_ ? unwrapNear(state[vessel::kPsi], unwrapped_psi_rad_) : state[vessel::kPsi];
  if (started_ && time_s < last_s_) {
    running_.reset();
  }
  last_s_ = time_s;
  started_ = true;
  while (!finished()) {
    if (!running_) {
      running_ = makeManoeuvre(manoeuvres_[current_], unwrapped_psi_rad_);
      began_s_ = time_s;
    }
    const Shares shares =
        running_->step(time_s - began_s_, unwrapped_psi_rad_, state[vessel::kYawRate]);
    if (!running_->finished()) {
      return thrustsOf(shares.ahead, shares.turn, thrusters_);
    }
    running_.reset();
    ++current_;
  }
  return vessel::Thrusts::Zero();
}

std::string Excitation::progress() const {
  if (finished()) {
    return "finished";
  }
  return std::to_string(current_ + 1) + " of " + std::to_string(manoeuvres_.size()) + ": " +
         kKindNames[static_cast<std::size_t>(manoeuvres_[current_].kind)];
}

}  // namespace otter_nav::identification
