#include "otter_nav/encounter/evasion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "encounter/foretold.hpp"
#include "encounter/habits.hpp"
#include "encounter/helmsman.hpp"
#include "encounter/space_time_search.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/stopping/watch.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::encounter {
namespace {

using trajectory::Piece;
using vessel::FlatPoint;

constexpr int kFinePerStep = 10;
constexpr double kFineS = Foretold::kStepS / kFinePerStep;

// The hull along its way at a joint of two pieces.
struct Joint {
  FlatPoint flat;
  FlatPoint turn;  // heading and its derivatives, as x of a point
  double surge_n = 0.0;
  double surge_mps = 0.0;
};

Hull hullOf(const Evasion::Task& task, const vessel::Parameters& vessel) {
  Hull hull;
  hull.position = task.start.position;
  hull.headTo(task.state[vessel::kPsi]);
  hull.yaw_rate_radps = task.state[vessel::kYawRate];
  const Eigen::Vector2d in_body = turned(task.start.velocity, -hull.psi_rad);
  hull.surge_mps = in_body.x();
  hull.sway_mps = in_body.y();
  hull.tau = vessel::tauFromThrusts(vessel::clampThrusts(task.thrusts, vessel.thrusters),
                                    vessel.thrusters);
  return hull;
}

Joint jointOf(const Helmsman& helmsman, const Hull& hull) {
  const Helmsman::Acceleration rate = helmsman.acceleration(hull);
  Joint joint;
  joint.flat.position = hull.position;
  joint.flat.velocity = hull.velocity();
  joint.flat.acceleration = rate.linear;
  joint.turn.position.x() = hull.psi_rad;
  joint.turn.velocity.x() = hull.yaw_rate_radps;
  joint.turn.acceleration.x() = rate.yaw_radps2;
  joint.surge_n = hull.tau.surge_n;
  joint.surge_mps = hull.surge_mps;
  return joint;
}

// Where the way itself tells the heading it is a way like any other; at rest, astern and where the
// thrust dies or turns the heading is told beside it.
Piece pieceBetween(const Joint& from, const Joint& to, double duration_s,
                   const vessel::Parameters& vessel) {
  constexpr double kFirmShare = 0.12;
  constexpr double kWellUnderWayMps = 0.8;
  Piece piece = trajectory::hermitePiece(from.flat, to.flat, duration_s);
  const double firm = kFirmShare * 2.0 * vessel.thrusters.ahead_max_n;
  const auto tells = [&](const Joint& joint) {
    return joint.surge_n > firm && joint.surge_mps > kWellUnderWayMps;
  };
  if (tells(from) && tells(to)) {
    return piece;
  }
  piece.kind = trajectory::PieceKind::kSpin;
  piece.heading = trajectory::hermitePiece(from.turn, to.turn, duration_s).position.row(0);
  return piece;
}

Aim aimOf(const Evasion::Task& task, const map::DistanceField& still, double beside_m) {
  constexpr std::size_t kMost = 12;
  Aim aim;
  aim.goal = task.goal;
  aim.arrival_m = task.arrival_m;
  aim.arrival_rad = task.arrival_rad;
  std::vector<Eigen::Vector2d> way = task.way;
  if (way.empty() || (way.back() - task.goal.position).norm() > 0.1) {
    way.push_back(task.goal.position);
  }
  std::vector<double> left(way.size(), 0.0);
  for (std::size_t k = way.size() - 1; k > 0; --k) {
    left[k - 1] = left[k] + (way[k] - way[k - 1]).norm();
  }
  // The farthest that can be reached straight, and some before it.
  for (std::size_t k = way.size(); k > 0 && aim.points.size() < kMost; --k) {
    if (map::segmentIsClear(still, task.start.position, way[k - 1], beside_m)) {
      aim.points.push_back(way[k - 1]);
      aim.left_m.push_back(left[k - 1]);
    }
  }
  if (aim.points.empty()) {
    aim.points.push_back(way.front());
    aim.left_m.push_back(left.front());
  }
  return aim;
}

Danger dangerOf(const Foretold::Nearness& worst) {
  Danger danger;
  danger.gap_m = worst.gap_m;
  return danger;
}

// Steps along a trajectory as hulls; at rest after its end.
template <typename Visit>
void walk(const trajectory::TimedTrajectory& path, double from_s, int steps,
          const vessel::Parameters& vessel, const Visit& visit) {
  const double end = path.trajectory.duration();
  for (int k = 0; k <= steps; ++k) {
    const double at = path.elapsed(from_s) + k * Foretold::kStepS;
    const vessel::State x = path.trajectory.sample(std::min(at, end), vessel).state;
    Hull hull;
    hull.position = x.head<2>();
    hull.headTo(x[vessel::kPsi]);
    if (at < end) {
      hull.surge_mps = x[vessel::kSurge];
      hull.sway_mps = x[vessel::kSway];
      hull.yaw_rate_radps = x[vessel::kYawRate];
    }
    visit(hull, k);
  }
}

}  // namespace

Evasion::Evasion(const vessel::Parameters& vessel)
    : vessel_(vessel), habits_(std::make_unique<Habits>()) {}
Evasion::~Evasion() = default;
Evasion::Evasion(Evasion&&) noexcept = default;
Evasion& Evasion::operator=(Evasion&&) noexcept = default;

void Evasion::observe(const std::vector<traffic::Track>& tracks) {
  habits_->observe(tracks);
}

Evasion::Way Evasion::find(const Task& task, const std::vector<traffic::Track>& tracks,
                           const map::DistanceField& still) const {
  const Helmsman helmsman(vessel_, task.disturbance, task.speed_max_mps);
  const Foretold foretold(tracks, *habits_, task.start_s, SpaceTimeSearch::kHorizonS,
                          task.start.position, helmsman.speedMost(), vessel_.hull);
  const Aim aim = aimOf(task, still, 0.5 * vessel_.hull.beam_m);
  const Hull start = hullOf(task, vessel_);
  const SpaceTimeSearch search(vessel_.hull, helmsman, aim, foretold, still, start);
  const SpaceTimeSearch::Way found = search.find();
  Way way;
  way.price = found.price;
  way.danger = dangerOf(found.worst);
  if (found.legs.empty()) {
    return way;
  }
  // The same again in finer steps, with a joint each step of the foretold.
  std::vector<Joint> joints;
  Hull hull = start;
  joints.push_back(jointOf(helmsman, hull));
  for (const SpaceTimeSearch::Leg& leg : found.legs) {
    const int fine = static_cast<int>(std::lround(leg.duration_s / kFineS));
    for (int k = 1; k <= fine; ++k) {
      helmsman.step(hull, search.helmOf(leg.order, hull), kFineS);
      if (k % kFinePerStep == 0) {
        joints.push_back(jointOf(helmsman, hull));
      }
    }
  }
  // Where it leaves what is sailed nothing jumps.
  joints.front().flat = task.start;
  for (std::size_t k = 1; k < joints.size(); ++k) {
    const std::size_t next = std::min(k + 1, joints.size() - 1);
    const double apart = static_cast<double>(next - k + 1) * Foretold::kStepS;
    joints[k].flat.jerk =
        (joints[next].flat.acceleration - joints[k - 1].flat.acceleration) / apart;
    joints[k].turn.jerk =
        (joints[next].turn.acceleration - joints[k - 1].turn.acceleration) / apart;
  }
  std::vector<Piece> pieces;
  for (std::size_t k = 1; k < joints.size(); ++k) {
    pieces.push_back(pieceBetween(joints[k - 1], joints[k], Foretold::kStepS, vessel_));
  }
  const trajectory::Trajectory found_way(std::move(pieces));
  // The search looks at two discs for the hull, and at steps; nothing that lies still may be
  // touched by its outline either. Its thrusts are those of the model it was made with.
  if (!stopping::outlineConflict(found_way, 0.0, found_way.duration(), still, vessel_, 0.0).found) {
    way.path = {found_way, task.start_s};
  }
  return way;
}

Evasion::Way Evasion::judge(const Task& task, const trajectory::TimedTrajectory& path,
                            const std::vector<traffic::Track>& tracks,
                            const map::DistanceField& still) const {
  const Helmsman helmsman(vessel_, task.disturbance, task.speed_max_mps);
  const Foretold foretold(tracks, *habits_, task.start_s, SpaceTimeSearch::kHorizonS,
                          task.start.position, helmsman.speedMost(), vessel_.hull);
  const Aim aim = aimOf(task, still, 0.5 * vessel_.hull.beam_m);
  const SpaceTimeSearch search(vessel_.hull, helmsman, aim, foretold, still, hullOf(task, vessel_));
  const std::vector<int> all = foretold.all();
  Way way;
  way.path = path;
  // What ends before the horizon goes on as it ended: what is short is no safer for that.
  const double end = path.trajectory.duration() - path.elapsed(task.start_s);
  const int along = std::clamp(static_cast<int>(end / Foretold::kStepS), 0, foretold.steps());
  Foretold::Nearness worst;
  Hull last;
  int arrived = -1;
  walk(path, task.start_s, along, vessel_, [&](const Hull& hull, int k) {
    if (arrived < 0) {
      way.price += k > 0 ? search.priceAt(hull, k, all, worst) : 0.0;
      arrived = search.arrives(hull) ? k : -1;
      last = hull;
    }
  });
  for (int k = along + 1; arrived < 0 && k <= foretold.steps(); ++k) {
    last.position += Foretold::kStepS * last.velocity();
    way.price += search.priceAt(last, k, all, worst);
  }
  way.price += arrived < 0 ? search.left(last) : SpaceTimeSearch::leftArrived(arrived);
  way.danger = dangerOf(worst);
  return way;
}

Danger Evasion::danger(const trajectory::TimedTrajectory& path, double from_s, double ahead_s,
                       const std::vector<traffic::Track>& tracks) const {
  const Foretold foretold(tracks, *habits_, from_s, ahead_s,
                          path.trajectory.flat(path.elapsed(from_s)).position,
                          vessel_.top_speed_mps, vessel_.hull);
  if (foretold.empty()) {
    return {};
  }
  const std::vector<int> all = foretold.all();
  Danger danger;
  walk(path, from_s, foretold.steps(), vessel_, [&](const Hull& hull, int k) {
    const Foretold::Nearness nearness = foretold.at(hull.position, hull.ahead, k, all);
    danger.gap_m = std::min(danger.gap_m, nearness.gap_m);
  });
  return danger;
}

Danger Evasion::danger(const vessel::Pose& lies, double from_s, double ahead_s,
                       const std::vector<traffic::Track>& tracks) const {
  const Foretold foretold(tracks, *habits_, from_s, ahead_s, lies.position, 0.0, vessel_.hull);
  const std::vector<int> all = foretold.all();
  Danger danger;
  for (int k = 0; k <= foretold.steps(); ++k) {
    const Foretold::Nearness nearness =
        foretold.at(lies.position, unitVector(lies.psi_rad), k, all);
    danger.gap_m = std::min(danger.gap_m, nearness.gap_m);
  }
  return danger;
}

double Evasion::shareKnown(const std::vector<traffic::Track>& tracks) const {
  constexpr double kAheadS = 4.0;
  int all = 0;
  int known = 0;
  for (const traffic::Track& track : tracks) {
    if (track.makesWay()) {
      ++all;
      known +=
          habits_->steadyTurn(track) || !habits_->foretell(track, track.stamp_s, kAheadS, 1).empty()
              ? 1
              : 0;
    }
  }
  return all == 0 ? 1.0 : static_cast<double>(known) / all;
}

Eigen::Vector2d Evasion::quietPlace(const Eigen::Vector2d& from, double now_s,
                                    const std::vector<traffic::Track>& tracks,
                                    const map::DistanceField& still) const {
  constexpr double kReachM = 12.0;
  constexpr double kEachM = 1.5;
  constexpr double kOffStillM = 0.8;
  constexpr double kAheadS = 8.0;  // in which somebody will hardly turn
  constexpr double kPerM = 0.25;   // of the way there
  const double hull = 0.5 * vessel_.hull.length_m;
  std::vector<Eigen::Vector2d> comes;
  for (const traffic::Track& track : tracks) {
    const double ahead_s = track.makesWay() ? kAheadS : 0.0;
    for (double t = 0.0; t <= ahead_s; t += 0.5) {
      comes.push_back(track.position + (now_s - track.stamp_s + t) * track.velocity);
    }
  }
  habits_->placesWithin(from, 3.0 * kReachM, comes);
  Eigen::Vector2d best = from;
  double most = -std::numeric_limits<double>::infinity();
  for (double x = -kReachM; x <= kReachM; x += kEachM) {
    for (double y = -kReachM; y <= kReachM; y += kEachM) {
      const Eigen::Vector2d place = from + Eigen::Vector2d(x, y);
      if (std::hypot(x, y) > kReachM || still.clearance(place) < hull + kOffStillM) {
        continue;
      }
      double open = kReachM;
      for (const Eigen::Vector2d& there : comes) {
        open = std::min(open, (there - place).norm());
      }
      const double worth = open - kPerM * std::hypot(x, y);
      if (worth > most) {
        most = worth;
        best = place;
      }
    }
  }
  return best;
}

}  // namespace otter_nav::encounter
