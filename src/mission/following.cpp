#include "following.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "sea_room.hpp"

namespace otter_nav::mission {

double Following::error(const Moment& m, const Sailed& sailed) const {
  constexpr double kSpeaksOfItS = 0.3;
  if (sailed.isEmpty() || m.now_s - sailed.given_s > kSpeaksOfItS) {
    return m.situation.tracking_error_m;
  }
  const Eigen::Vector2d there = sailed.at(m.now_s).position;
  return std::min(m.situation.tracking_error_m, (m.situation.state.head<2>() - there).norm());
}

double Following::mayBeOff(const Moment& m, const Sailed& sailed) const {
  constexpr double kMostLengths = 1.25;  // where all of that is
  constexpr double kAheadS = 10.0;
  constexpr double kStepS = 1.0;
  const double least_m = options_.tracking_error_max_m;
  if (!safety_.weather().isStrong() || sailed.isEmpty()) {
    return least_m;
  }
  double clear_m = m.obstacles.clearance(m.situation.state.head<2>(), m.now_s);
  for (double later = 0.0; later <= kAheadS; later += kStepS) {
    const double then_s = m.now_s + later;
    clear_m = std::min(clear_m, m.obstacles.clearance(sailed.at(then_s).position, then_s));
  }
  const double drift_m = safety_.weather().drift().norm();
  const double share = clear_m < drift_m ? clear_m / drift_m : 1.0;
  return std::max(least_m, share * kMostLengths * vessel_.hull.length_m);
}

bool Following::isFarOff(const Moment& m, const Sailed& sailed) const {
  return error(m, sailed) > mayBeOff(m, sailed);
}

bool Following::isLeftBehind(const Moment& m, const Sailed& sailed) const {
  constexpr double kShareWithWeather = 0.7;
  const double share = safety_.plansWithWeather() ? kShareWithWeather : 1.0;
  return std::max(error(m, sailed), lateBy(m.now_s)) > share * mayBeOff(m, sailed);
}

std::optional<Following::Later> Following::fallsBehind(const Moment& m,
                                                       const Sailed& sailed) const {
  const bool strong = safety_.weather().isStrong();
  const double least_m = strong ? 0.3 : 0.15;
  const double under_way_mps = strong ? 0.2 : 0.8;
  const vessel::State& x = m.situation.state;
  const vessel::FlatPoint wanted = sailed.at(m.now_s);
  const double speed = wanted.velocity.norm();
  if (m.situation.tracking_error_m < least_m || speed < under_way_mps ||
      safety_.plansWithWeather()) {
    return std::nullopt;
  }
  const Eigen::Vector2d along = wanted.velocity / speed;
  const double behind_m = (wanted.position - x.head<2>()).dot(along);
  if (behind_m < least_m || vessel::velocityOverGround(x).dot(along) > speed) {
    return std::nullopt;
  }
  Later later{sailed.path, behind_m};
  later.path.start_time_s += behind_m / speed;
  return later;
}

void Following::putOff(double now_s, const Later& later) {
  // Another plan would be as late in a gust; a vessel that makes no way at all gets one.
  constexpr double kGustShare = 0.25;
  late_m_ = lateBy(now_s) + (safety_.weather().isStrong() ? kGustShare : 1.0) * later.behind_m;
  late_at_s_ = now_s;
}

double Following::lateBy(double now_s) const {
  constexpr double kMadeGoodMps = 0.1;
  return std::max(late_m_ - kMadeGoodMps * (now_s - late_at_s_), 0.0);
}

bool Following::hasLostItsHeading(const Moment& m, const Sailed& sailed) const {
  const Weather& weather = safety_.weather();
  // Crabbing in a firm load the bow is far off the course anyhow.
  const double lost_rad = safety_.plansWithWeather() ? 1.2 : 0.8;
  constexpr double kFirmShare = 0.25;  // of the thrust; with less the path wants no heading
  const trajectory::Sample wanted =
      sailed.path.trajectory.sample(sailed.path.elapsed(m.now_s), vessel_, sailed.plan.disturbance);
  const bool spins = std::isinf(wanted.heading_force_n);
  const bool firm =
      spins ? vessel::canLie(vessel_.manoeuvring, weather.mean(), wanted.state[vessel::kPsi])
            : wanted.heading_force_n > kFirmShare * 2.0 * vessel_.thrusters.ahead_max_n;
  const double psi_rad = m.situation.state[vessel::kPsi];
  // In strong wind it is sailed on headings near the wind's line, bow or stern to it, whatever
  // the path's.
  const bool lies_in_wind = weather.isStrong() && safety_.isHeldInWind(psi_rad);
  return weather.isKnown() && firm && !lies_in_wind &&
         error(m, sailed) > 0.5 * mayBeOff(m, sailed) &&
         std::abs(wrapAngle(psi_rad - wanted.state[vessel::kPsi])) > lost_rad;
}

bool Following::isSetAside(const Moment& m, const Sailed& sailed) {
  constexpr double kPatienceS = 1.5;
  if (!isFarOff(m, sailed)) {
    off_since_s_ = m.now_s;
  }
  if (goesAshore(m, sailed)) {
    return true;
  }
  if (error(m, sailed) < 0.5 * mayBeOff(m, sailed)) {
    return false;
  }
  return (isFarOff(m, sailed) && m.now_s - off_since_s_ >= kPatienceS) || goesOntoSomething(m);
}

// Where the wind can take the heading, with something near, a plan from there leads nowhere: at
// rest, bow to it, there is a better. Unless the vessel is coming back. A gust lets go of it no
// sooner than it lies so, and the sooner it turns the less way it has got: it is seen soon how
// far off it will be.
bool Following::goesAshore(const Moment& m, const Sailed& sailed) const {
  constexpr double kSoonS = 1.5;
  const vessel::FlatPoint wanted = sailed.at(m.now_s);
  const Eigen::Vector2d velocity = vessel::velocityOverGround(m.situation.state);
  const Eigen::Vector2d off = m.situation.state.head<2>() - wanted.position;
  // Late on its way it is where nothing lies: what is sailed waits for it.
  const double speed = wanted.velocity.norm();
  const Eigen::Vector2d along =
      speed > 0.0 ? (wanted.velocity / speed).eval() : Eigen::Vector2d::Zero();
  const double made_good_mps = std::clamp(velocity.dot(along), 0.0, speed);
  const Eigen::Vector2d goes_off = velocity - made_good_mps * along;
  const bool hurries = safety_.weather().isStrong() && off.dot(goes_off) >= 0.0 &&
                       SeaRoom(m, safety_, vessel_.hull).hasALeeShore();
  return hurries && (off + kSoonS * goes_off).norm() > options_.tracking_error_max_m;
}

bool Following::goesOntoSomething(const Moment& m) const {
  constexpr double kAheadS = 2.0;
  constexpr double kStepS = 0.25;
  const vessel::State& x = m.situation.state;
  const double here = m.obstacles.clearance(x.head<2>(), m.now_s);
  const Eigen::Vector2d velocity = vessel::velocityOverGround(x);
  for (double later = kStepS; later <= kAheadS; later += kStepS) {
    const double there = m.obstacles.clearance(x.head<2>() + later * velocity, m.now_s + later);
    if (there < safety_.critical() && there < here) {
      return true;
    }
  }
  return false;
}

}  // namespace otter_nav::mission
