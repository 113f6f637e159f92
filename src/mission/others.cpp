#include "others.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace otter_nav::mission {

using feasibility::Obstacles;
using traffic::Track;

void Others::newGoal(double now_s) {
  way_.clear();
  pilot_.newGoal(now_s);
  lying_off_.newGoal();
}

Moment Others::see(double now_s, const Situation& situation, const Obstacles& obstacles) {
  if (situation.tracks.empty()) {
    near_.reset();
    return {now_s, situation, obstacles};
  }
  near_.emplace(now_s, situation.tracks);
  seen_.emplace(obstacles);
  seen_->add(*near_);
  return {now_s, situation, *seen_};
}

void Others::lookOut(const Moment& m, const Sailed& sailed, const Eigen::Vector2d& goal) {
  constexpr double kCruiseShare = 0.99;  // of the speed that plans may have
  if (m.situation.hears_others) {
    pilot_.listen(m.now_s);
  }
  const bool has_way = !sailed.isEmpty();
  if (!has_way && pilot_.encounters().empty()) {
    return;
  }
  const vessel::State& x = m.situation.state;
  const bool follows =
      has_way && m.situation.tracking_error_m < 0.5 * options_.tracking_error_max_m;
  const Eigen::Vector2d steered = follows ? sailed.at(m.now_s).position : x.head<2>();
  // Who lies there is passed as any other thing is.
  std::vector<Track> under_way;
  std::copy_if(m.situation.tracks.begin(), m.situation.tracks.end(), std::back_inserter(under_way),
               [](const Track& track) { return !track.keeps_place; });
  pilot_.observe(m.now_s, {x.head<2>(), vessel::velocityOverGround(x)}, steered, under_way, goal,
                 kCruiseShare * sailed.plan.limits.speed_max_mps);
}

std::optional<encounter::Manoeuvre> Others::makeWay(const Moment& m, const Sailed& sailed,
                                                    const Eigen::Vector2d& goal, double joint_s,
                                                    double begins_mps) {
  return pilot_.decide(
      {m.now_s, sailed.path, goal, joint_s, sailed.plan.limits, m.obstacles, begins_mps});
}

bool Others::passNear(const Moment& m) const {
  constexpr double kNearM = 5.0;
  constexpr double kAheadS = 8.0;
  if (!areSome()) {
    return false;
  }
  for (double t = 0.0; t <= kAheadS; t += 1.0) {
    if (near_->clearance(m.situation.state.head<2>(), m.now_s + t) < kNearM) {
      return true;
    }
  }
  return false;
}

bool Others::crowd(const Moment& m, const Sailed& sailed) const {
  constexpr int kMany = 4;
  constexpr double kNearM = 35.0;
  constexpr double kSailsS = 6.0;  // ahead
  constexpr double kLiesS = 8.0;
  constexpr double kTooNearM = 0.8;
  if (moversWithin(m, kNearM) >= kMany) {
    return true;
  }
  const std::vector<Track> some = movers(m);
  if (some.empty()) {
    return false;
  }
  const vessel::State& x = m.situation.state;
  const bool sails = !sailed.isEmpty() && !sailed.isAtTheEnd(m.now_s);
  const encounter::Danger danger =
      sails ? evasion_.danger(sailed.path, m.now_s, kSailsS, some)
            : evasion_.danger({x.head<2>(), x[vessel::kPsi]}, m.now_s, kLiesS, some);
  return danger.gap_m < kTooNearM;
}

bool Others::areFew(const Moment& m, const Sailed& sailed) const {
  constexpr int kFew = 2;
  constexpr double kNearM = 40.0;
  constexpr double kAheadS = 8.0;
  constexpr double kClearM = 2.0;
  return moversWithin(m, kNearM) <= kFew &&
         evasion_.danger(sailed.path, m.now_s, kAheadS, movers(m)).gap_m > kClearM;
}

bool Others::areFewInVain(const Moment& m, const Sailed& sailed) {
  constexpr double kPatienceS = 5.0;
  if (!areFew(m, sailed)) {
    crowded_s_ = m.now_s;
  }
  return m.now_s - crowded_s_ > kPatienceS;
}

std::optional<Others::Evading> Others::evade(const Moment& m, const Sailed& sailed,
                                             const vessel::Pose& goal, bool evades,
                                             bool plan_is_due) {
  constexpr double kWorthS = 0.4;  // another way: tracks wander
  constexpr double kWorthAPlanS = 4.0;
  constexpr double kLeastLeftS = 4.0;
  constexpr double kLeastAgainS = 0.06;  // a scan of the lidar
  const std::vector<Track>& tracks = m.situation.tracks;
  const double since_s = m.now_s - evaded_s_;
  if (evades && since_s < kAgainS &&
      (since_s < kLeastAgainS || !surprise_.isNear(m.situation.state.head<2>(), tracks))) {
    return std::nullopt;
  }
  evaded_s_ = m.now_s;
  surprise_.decided(tracks);
  encounter::Evasion::Task from = task(m, sailed, goal);
  // Not into water that nobody has seen, unless it lies in such.
  constexpr double kInKnownM = 0.5;
  const map::DistanceField& known = m.obstacles.inKnownWater().field();
  const bool in_known = known.clearance(from.start.position) > kInKnownM;
  const map::DistanceField& still = in_known ? known : m.obstacles.field();
  if (const auto off =
          lying_off_.place(m.now_s, from.start.position, goal.position, tracks, still, evasion_)) {
    from.goal = {*off, safety_.restHeading(from.state[vessel::kPsi])};
    from.way.clear();
    from.arrival_m = from.arrival_rad = 0.0;
  }
  Evading found{evasion_.find(from, tracks, still), from.start_s > m.now_s, from.speed_max_mps};
  if (evades && found.from_sailed && sailed.path.left(m.now_s) > kLeastLeftS) {
    const double kept = evasion_.judge(from, sailed.path, tracks, still).price;
    if (kept < found.way.price + (plan_is_due ? kWorthAPlanS : kWorthS)) {
      return std::nullopt;
    }
  }
  if (found.way.path.trajectory.empty()) {
    no_way_s_ = m.now_s;
  }
  return found;
}

void Others::rememberTheWay(const trajectory::Trajectory& plan) {
  constexpr double kApartM = 3.0;
  way_.clear();
  const double end = plan.duration();
  for (double t = 0.0; t < end; t += 0.5) {
    const Eigen::Vector2d there = plan.flat(t).position;
    if (way_.empty() || (there - way_.back()).norm() > kApartM) {
      way_.push_back(there);
    }
  }
}

std::vector<Track> Others::movers(const Moment& m) {
  std::vector<Track> some;
  std::copy_if(m.situation.tracks.begin(), m.situation.tracks.end(), std::back_inserter(some),
               [](const Track& track) { return track.makesWay(); });
  return some;
}

int Others::moversWithin(const Moment& m, double range_m) {
  const Eigen::Vector2d here = m.situation.state.head<2>();
  return static_cast<int>(
      std::count_if(m.situation.tracks.begin(), m.situation.tracks.end(), [&](const Track& track) {
        return track.makesWay() && (track.position - here).norm() < range_m;
      }));
}

encounter::Evasion::Task Others::task(const Moment& m, const Sailed& sailed,
                                      const vessel::Pose& goal) const {
  constexpr double kAheadS = 0.15;
  constexpr double kOffM = 0.5;
  constexpr double kStillMps = 0.3;
  encounter::Evasion::Task task;
  const vessel::State& x = m.situation.state;
  const double at = sailed.isEmpty() ? 0.0 : sailed.path.elapsed(m.now_s + kAheadS);
  if (!sailed.isEmpty() && at < sailed.path.trajectory.duration() && at >= 0.0 &&
      m.situation.tracking_error_m < kOffM) {
    const trajectory::Sample sample = sailed.path.trajectory.sample(at, vessel_);
    task.start_s = m.now_s + kAheadS;
    task.start = sample.flat;
    task.state = sample.state;
    task.thrusts = sample.thrusts;
    if (!std::isinf(sample.heading_force_n)) {
      task.state[vessel::kPsi] = x[vessel::kPsi] + kAheadS * x[vessel::kYawRate];
    }
  } else {
    task.start_s = m.now_s;
    task.start.position = x.head<2>();
    task.state = x;
    if (vessel::speedOf(x) < kStillMps) {
      task.state.tail<3>().setZero();
    }
    task.start.velocity = vessel::velocityOverGround(task.state);
  }
  task.disturbance = safety_.weather().mean();
  feasibility::SafetyLimits limits =
      feasibility::SafetyLimits::of(vessel_, 0.0, safety_.calmThrustShare());
  limits.limitSpeed(safety_.speedMax());
  task.speed_max_mps = std::min(limits.speed_max_mps, safety_.speedInWaves());
  // From the nearest point of the way on.
  auto nearest = way_.begin();
  for (auto it = way_.begin(); it != way_.end(); ++it) {
    nearest =
        (*it - task.start.position).norm() < (*nearest - task.start.position).norm() ? it : nearest;
  }
  task.way.assign(nearest, way_.end());
  task.goal = {goal.position, safety_.restHeading(goal.psi_rad)};
  task.arrival_m = options_.arrival_distance_m;
  task.arrival_rad = options_.arrival_heading_rad;
  return task;
}

}  // namespace otter_nav::mission
