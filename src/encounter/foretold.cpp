#include "encounter/foretold.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::encounter {
namespace {

constexpr double kFarM = 6.0;  // farther off nobody is a danger at that moment
// What a tracked middle is off, and we off our way, at any time.
constexpr double kDeviationM = 0.3;
constexpr double kDeviationMostM = 4.0;
// Whoever is near may turn towards us at once; she comes the farther the faster she is.
constexpr double kMayTurn = 0.1;
constexpr double kDoubted = 0.9;    // existence: reported, but seen no more
constexpr double kFromHabit = 0.8;  // go on as before, and
constexpr double kNotFromHabit = 0.2;
constexpr double kMayTurnFromHabit = 0.04;
constexpr double kGrownShare = 0.6;  // of what a track itself says it may stray
constexpr double kHabitPerS = 0.15;  // standard deviation, m, of who goes on as before
// At a corner, for each radian of it, times what the way is known to: who is met once a second only
// is on either side of it when she is met, and the way between is cut.
constexpr double kAtCorner = 0.8;
constexpr double kSheerM = 0.3;
constexpr double kSheerS = 0.4;

// How far a way turns around a place of it, rad.
double turnAt(const std::vector<Eigen::Vector2d>& places, std::size_t at) {
  constexpr std::size_t kSteps = 5;  // to either side
  constexpr double kMostRad = 1.2;
  constexpr double kLeastM = 0.1;
  const std::size_t from = at < kSteps ? 0 : at - kSteps;
  const std::size_t to = std::min(at + kSteps, places.size() - 1);
  const Eigen::Vector2d comes = places[at] - places[from];
  const Eigen::Vector2d goes = places[to] - places[at];
  if (comes.norm() < kLeastM || goes.norm() < kLeastM) {
    return 0.0;
  }
  return std::min(kMostRad, std::abs(std::atan2(cross(comes, goes), comes.dot(goes))));
}

}  // namespace

Foretold::Foretold(const std::vector<traffic::Track>& tracks, const Habits& habits, double from_s,
                   double horizon_s, const Eigen::Vector2d& place, double own_mps,
                   const vessel::Hull& own)
    : steps_(static_cast<int>(std::ceil(horizon_s / kStepS - 1e-9))), discs_(own) {
  for (const traffic::Track& track : tracks) {
    const double speed = track.velocity.norm();
    const double reach = horizon_s * (speed + own_mps) + kFarM + track.length_m;
    if ((track.position - place).norm() > reach) {
      continue;
    }
    traffic::PredictionOptions options;
    options.sigmas = 1.0;
    options.horizon_s = from_s + horizon_s - track.stamp_s + 1.0;
    traffic::Track turning = track;
    if (const std::optional<double> turn = habits.steadyTurn(track)) {
      turning.turn_rate_radps = *turn;
      turning.turn_time_s = traffic::kSteadyTurnS;
    }
    const traffic::PredictedPath path(turning, options);
    Mover mover;
    mover.mps = speed;
    const bool disc = track.shape == traffic::Shape::kDisc;
    mover.half_length_m = disc ? 0.0 : 0.5 * track.length_m;
    mover.half_beam_m = disc ? 0.0 : 0.5 * track.beam_m;
    mover.radius_m = disc ? 0.5 * track.length_m : 0.0;
    mover.hits_m2 = 4.0 * (mover.half_length_m + mover.radius_m + discs_.radius_m) *
                    (mover.half_beam_m + mover.radius_m + discs_.radius_m);
    mover.reach_m = std::hypot(mover.half_length_m, mover.half_beam_m) + mover.radius_m;
    const std::vector<Way> as_before = habits.ways(track, from_s, kStepS, steps_ + 1);
    mover.may_turn = as_before.empty() ? kMayTurn : kMayTurnFromHabit;
    mover.probable = as_before.empty() ? 1.0 : kNotFromHabit;
    if (track.existence < kDoubted) {
      mover.probable *= track.existence * track.existence;
      mover.may_turn *= track.existence;
    }
    mover.places.reserve(static_cast<std::size_t>(steps_) + 1);
    for (int k = 0; k <= steps_; ++k) {
      const traffic::Outline outline = path.at(from_s + k * kStepS);
      Place there;
      there.middle = outline.position;
      there.ahead = unitVector(outline.heading_rad);
      const double grown = 0.5 * (outline.half_length_m - mover.half_length_m +
                                  outline.half_beam_m - mover.half_beam_m);
      there.deviation_m = std::min(kDeviationMostM, std::hypot(kDeviationM, kGrownShare * grown));
      mover.places.push_back(there);
    }
    movers_.push_back(mover);
    if (as_before.empty()) {
      continue;
    }
    // The same vessel, as she went before.
    mover.may_turn = 0.0;
    const double on_a_way = mover.probable * kFromHabit / kNotFromHabit;
    for (const Way& way : as_before) {
      mover.probable = on_a_way * way.share;
      const double way_m = std::sqrt(way.variance_m2);
      for (int k = 0; k <= steps_; ++k) {
        const auto at = static_cast<std::size_t>(k);
        Place& there = mover.places[at];
        const Eigen::Vector2d step = way.places[at + 1] - way.places[at];
        there.middle = way.places[at];
        there.ahead = step.norm() > 1e-3 ? step.normalized() : there.ahead;
        there.deviation_m = std::hypot(kDeviationM, kHabitPerS * k * kStepS,
                                       kAtCorner * turnAt(way.places, at) * way_m);
      }
      movers_.push_back(mover);
    }
  }
}

Foretold::Nearness Foretold::at(const Eigen::Vector2d& position, const Eigen::Vector2d& ahead,
                                int k, const std::vector<int>& near) const {
  Nearness nearness;
  const Eigen::Vector2d to_disc = discs_.ahead_m * ahead;
  for (const int m : near) {
    const Mover& mover = movers_[static_cast<std::size_t>(m)];
    const Place& there = mover.places[static_cast<std::size_t>(std::min(k, steps_))];
    const Eigen::Vector2d off = position - there.middle;
    const double far = mover.reach_m + discs_.ahead_m + discs_.radius_m + kFarM;
    if (off.squaredNorm() > far * far) {
      continue;
    }
    const Eigen::Vector2d port = across(there.ahead);
    double gap = 1e3;
    for (const double side : {1.0, -1.0}) {
      const Eigen::Vector2d disc = off + side * to_disc;
      const double x = std::abs(there.ahead.dot(disc)) - mover.half_length_m;
      const double y = std::abs(port.dot(disc)) - mover.half_beam_m;
      const double distance = x > 0.0 && y > 0.0 ? std::hypot(x, y) : std::max(x, y);
      gap = std::min(gap, distance - mover.radius_m - discs_.radius_m);
    }
    nearness.gap_m = std::min(nearness.gap_m, gap);
    const double apart = std::max(0.0, gap) / there.deviation_m;
    // Who may be anywhere is hardly just there.
    const double sure =
        1.0 / (1.0 + 2.0 * kPi * there.deviation_m * there.deviation_m / mover.hits_m2);
    nearness.danger +=
        mover.probable * sure * sure * std::exp(-apart * apart) +
        mover.may_turn * std::exp(-std::max(0.0, gap) / (kSheerM + kSheerS * mover.mps));
  }
  return nearness;
}

void Foretold::whoIsNear(const Eigen::Vector2d& position, int k, int for_steps, double own_mps,
                         std::vector<int>& near) const {
  near.clear();
  const double time = for_steps * kStepS;
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    const Mover& mover = movers_[m];
    const Eigen::Vector2d& there =
        mover.places[static_cast<std::size_t>(std::min(k, steps_))].middle;
    const double reach =
        mover.reach_m + kFarM + discs_.ahead_m + discs_.radius_m + time * (own_mps + mover.mps);
    if ((position - there).squaredNorm() < reach * reach) {
      near.push_back(static_cast<int>(m));
    }
  }
}

std::vector<int> Foretold::all() const {
  std::vector<int> all(movers_.size());
  for (std::size_t m = 0; m < all.size(); ++m) {
    all[m] = static_cast<int>(m);
  }
  return all;
}

}  // namespace otter_nav::encounter
