#include <algorithm>
#include <cmath>

#include "optimizer/ends/end_manoeuvre.hpp"
#include "optimizer/solve/initial_spline.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/feasibility/piece_check.hpp"
#include "otter_nav/optimizer/ends.hpp"
#include "otter_nav/trajectory/motion_along.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "otter_nav/vessel/steady_motion.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kLookAheadM = 5.0;  // beyond a manoeuvre, that the path's direction is taken over
constexpr int kAimRounds = 4;
constexpr double kAimedRad = 0.03;
// Off the path by less, the vessel gets under way straight ahead and turns as it sails: the moment
// of a turn that has hardly begun is braked with thrust that getting under way takes.
constexpr double kHardlyOffRad = 0.06;
constexpr double kSlowestMps = 0.5;  // of an arrival, where the speed limit is not lower
constexpr double kSlowestShare = 0.4;
constexpr double kReachRad = 0.3;  // steps of a manoeuvre's parameters that are still nearly linear
constexpr double kReachMps = 0.8;
constexpr double kStep = 1e-3;  // of parameters, for differences
constexpr double kBowToLoadRad = 0.05;
// A path that leaves farther to leeward than this begins with a turn: led round the bow it would
// hardly move through the water.
constexpr double kBeforeLoadCosine = -0.3;
constexpr double kCrabSpeedShare = 0.8;  // of the speed limit
constexpr double kShrunkTurnRad = 0.02;  // that a turn shrinks to
constexpr double kLongestShare = 0.3;    // of the path, for the arrival

using StateVector = Eigen::Matrix<double, 8, 1>;

StateVector stateOf(const vessel::FlatPoint& z) {
  StateVector state;
  state << z.position, z.velocity, z.acceleration, z.jerk;
  return state;
}

Eigen::Vector2d directionOf(const vessel::FlatPoint& z, double psi_rad) {
  constexpr double kSlowMps = 0.1;
  return z.velocity.norm() > kSlowMps ? Eigen::Vector2d(z.velocity.normalized())
                                      : unitVector(psi_rad);
}

}  // namespace

double EndChooser::slowest() const {
  return std::min(kSlowestMps, kSlowestShare * options_.limits.speed_max_mps);
}

bool EndChooser::clear(const map::DistanceField& field, const Manoeuvre& manoeuvre) const {
  for (const trajectory::Piece& piece : manoeuvre.pieces) {
    feasibility::PieceReport report;
    report.yaw_rate_radps = safety_.yaw_rate_max_radps;
    feasibility::PieceCheck(piece, vessel_, safety_).checkClearance(field, 0.0, report);
    if (report.fault != feasibility::Fault::kNone) {
      return false;
    }
  }
  return true;
}

// Bow to a firm load a path begins and ends without a manoeuvre.
bool EndChooser::liesInLoad(const trajectory::Boundary& end) const {
  if (!options_.in_load) {
    return false;
  }
  const double into =
      vessel::headingIntoLoad(vessel_.manoeuvring, options_.limits.disturbance, end.psi_rad);
  return std::abs(wrapAngle(into - end.psi_rad)) < kBowToLoadRad;
}

void EndChooser::make(End& end) const {
  end.manoeuvre =
      end.kind == End::Kind::kLaunch
          ? launch(end.position, end.psi_rad, end.turn_rad, vessel_, end.limits)
          : arrival(end.position, end.psi_rad, end.turn_rad, end.speed_mps, vessel_, end.limits);
}

// Where a hull points that sails a course in a load.
double EndChooser::crabbing(double course_rad) const {
  const double speed = kCrabSpeedShare * safety_.speed_max_mps;
  const auto headings = vessel::steadyHeadings(speed * unitVector(course_rad), course_rad, vessel_,
                                               options_.limits.disturbance);
  return headings.empty() ? course_rad : headings.front().psi_rad;
}

// The drifting hull comes far while it turns: it is to end on the heading for the course from
// there.
void EndChooser::leaveDrifting(const std::vector<Eigen::Vector2d>& path, End& end) const {
  double reached_m = 0.0;
  for (int round = 0; round < kAimRounds; ++round) {
    const Eigen::Vector2d ahead = trajectory::pointAlong(path, 2.0 * kLookAheadM + reached_m);
    const Eigen::Vector2d from = round == 0 ? end.position : end.manoeuvre.joint.position;
    const double turn_rad = wrapAngle(crabbing(angleOf(ahead - from)) - end.psi_rad);
    const bool aimed = round > 0 && std::abs(turn_rad - end.turn_rad) < kAimedRad;
    // Not the other way round for a little more.
    const bool other_side = turn_rad * end.turn_rad < 0.0 && std::abs(turn_rad) > 0.5 * kPi;
    if (round == 0 || !other_side) {
      end.turn_rad = turn_rad;
    }
    make(end);
    if (aimed) {
      return;
    }
    reached_m = (end.manoeuvre.joint.position - end.position).norm();
  }
}

// The course is led from where the manoeuvre ends to a point of the path ahead.
void EndChooser::leaveAlong(const std::vector<Eigen::Vector2d>& path, End& end) const {
  const Eigen::Vector2d ahead = trajectory::pointAlong(path, kLookAheadM);
  const double drifts_s = vessel_.paper.m1_kg / vessel_.paper.d2_kgps;
  double leave = angleOf(ahead - end.position);
  for (int round = 0; round < kAimRounds; ++round) {
    end.turn_rad = wrapAngle(leave - end.psi_rad);
    if (!end.limits.settle && std::abs(end.turn_rad) < kHardlyOffRad) {
      end.turn_rad = 0.0;
      make(end);
      return;
    }
    make(end);
    const Eigen::Vector2d along = unitVector(leave);
    const vessel::FlatPoint& z = end.manoeuvre.joint;
    const Eigen::Vector2d aside = z.velocity - along.dot(z.velocity) * along;
    const double next = angleOf(ahead - (z.position + drifts_s * aside));
    const bool aimed = std::abs(wrapAngle(next - leave)) < kAimedRad;
    leave = next;
    if (aimed) {
      break;
    }
  }
}

// The course is led from a point of the path to where the manoeuvre begins.
void EndChooser::arriveAlong(const std::vector<Eigen::Vector2d>& path, End& end) const {
  const Eigen::Vector2d behind = trajectory::pointAlong(
      path, -kLookAheadM - arrivalLength(end.speed_mps, vessel_, end.limits));
  end.turn_rad = wrapAngle(end.psi_rad - angleOf(end.position - behind));
  // Where what pushes would set the turning hull aside, the way leads to the goal on its heading.
  const auto lies = [&](double turn_rad) {
    return vessel::canLie(vessel_.manoeuvring, end.limits.disturbance, end.psi_rad - turn_rad);
  };
  const bool carried =
      options_.straight_arrival || !lies(0.5 * end.turn_rad) || !lies(end.turn_rad);
  if (carried || (std::abs(end.turn_rad) < options_.turn_least_rad && !options_.careful)) {
    end.turn_rad = 0.0;
  }
  for (int round = 0; round < kAimRounds; ++round) {
    make(end);
    const vessel::FlatPoint& z = end.manoeuvre.joint;
    const double off = wrapAngle(angleOf(z.velocity) - angleOf(z.position - behind));
    if (end.turn_rad == 0.0 || std::abs(off) < kAimedRad) {
      break;
    }
    const double next = end.turn_rad + off;
    end.turn_rad = next * end.turn_rad > 0.0 ? next : 0.0;
  }
}

bool EndChooser::drifts() const {
  return !vessel::paperHolds(vessel_) && vessel::isFirmLoad(vessel_, options_.limits.disturbance);
}

// Drifting through the water turns the hull as well, and carries it on, which only the motion
// tells: as much of the moment is kept back, and of the speed.
void EndChooser::leaveWithin(const std::vector<Eigen::Vector2d>& path, End& end) const {
  constexpr int kRounds = 4;
  constexpr double kMore = 0.85;
  constexpr double kFastestShare = 0.95;  // of the speed limit
  for (int round = 0; round < kRounds; ++round) {
    leaveDrifting(path, end);
    const trajectory::Trajectory turn(end.manoeuvre.pieces);
    const trajectory::MotionAlong motion(turn, vessel_, end.limits.disturbance, end.psi_rad);
    double share = 0.0;
    double speed_mps = 0.0;
    for (const trajectory::MotionAlong::Point& point : motion.points()) {
      speed_mps = std::max(speed_mps, point.speed_mps);
      share = std::max(share, vessel::shareOfLimit(point.thrusts, vessel_.thrusters));
    }
    const double most_mps = kFastestShare * safety_.speed_max_mps;
    if (share <= end.limits.thrust_share && speed_mps <= most_mps) {
      return;
    }
    end.limits.kept_nm += kMore * std::max(0.0, share - end.limits.thrust_share) *
                          vessel::greatestMoment(vessel_.thrusters);
    if (speed_mps > most_mps) {
      end.limits.speed_max_mps =
          std::min(end.limits.speed_max_mps, safety_.speed_max_mps) * most_mps / speed_mps;
    }
  }
}

End EndChooser::chooseStart(const map::DistanceField& field,
                            const std::vector<Eigen::Vector2d>& path,
                            const trajectory::Boundary& start) const {
  End end;
  end.manoeuvre.joint = start.flat;
  if (!trajectory::atRest(start)) {
    return end;
  }
  const Eigen::Vector2d bow = unitVector(start.psi_rad);
  const Eigen::Vector2d ahead = trajectory::pointAlong(path, kLookAheadM) - start.flat.position;
  if (liesInLoad(start) && bow.dot(ahead) > kBeforeLoadCosine * ahead.norm()) {
    return end;
  }
  end.kind = End::Kind::kLaunch;
  end.position = start.flat.position;
  end.psi_rad = start.psi_rad;
  end.limits = options_.limits;
  end.limits.settle = options_.careful;
  if (drifts()) {
    leaveWithin(path, end);
    return end;
  }
  leaveAlong(path, end);
  if (!end.limits.settle && !clear(field, end.manoeuvre)) {
    end.limits.settle = true;
    leaveAlong(path, end);
  }
  return end;
}

End EndChooser::chooseGoal(const map::DistanceField& field,
                           const std::vector<Eigen::Vector2d>& path,
                           const trajectory::Boundary& goal) const {
  struct Choice {
    double speed_share, drift_share;
  };
  const double longest = kLongestShare * lengthOf(path);
  End end;
  if (liesInLoad(goal)) {
    end.psi_rad = goal.psi_rad;
    end.manoeuvre.joint = goal.flat;
    return end;
  }
  end.kind = End::Kind::kArrival;
  end.position = goal.flat.position;
  end.psi_rad = goal.psi_rad;
  for (const Choice& choice : {Choice{1.0, 1.0}, Choice{0.7, 1.0}, Choice{0.5, 0.0}}) {
    end.limits = options_.limits;
    end.limits.drift_mps *= options_.careful ? 0.0 : choice.drift_share;
    end.speed_mps = options_.arrival_speed_mps * choice.speed_share;
    while (end.speed_mps > slowest() &&
           arrivalLength(end.speed_mps, vessel_, end.limits) > longest) {
      end.speed_mps *= 0.9;
    }
    arriveAlong(path, end);
    if (clear(field, end.manoeuvre)) {
      break;
    }
  }
  return end;
}

ChosenEnds EndChooser::choose(const map::DistanceField& field,
                              const std::vector<Eigen::Vector2d>& path,
                              const trajectory::Boundary& start,
                              const trajectory::Boundary& goal) const {
  return {chooseStart(field, path, start), chooseGoal(field, path, goal)};
}

SplineEnds EndChooser::splineEnds(const ChosenEnds& chosen,
                                  const trajectory::Boundary& start) const {
  SplineEnds ends;
  ends.start = chosen.start.manoeuvre.joint;
  ends.goal = chosen.goal.manoeuvre.joint;
  ends.leave = directionOf(ends.start, start.psi_rad);
  ends.arrive = directionOf(ends.goal, chosen.goal.psi_rad);
  return ends;
}

// By differences.
std::optional<EndFamily> EndChooser::familyOf(const End& end) const {
  if (end.kind == End::Kind::kUnderWay) {
    return std::nullopt;
  }
  EndFamily family;
  family.reach = {kReachRad, std::min(kReachMps, options_.limits.speed_max_mps)};
  const StateVector now = stateOf(end.manoeuvre.joint);
  const auto difference = [&](End moved, int column, double step) {
    make(moved);
    family.state.col(column) = (stateOf(moved.manoeuvre.joint) - now) / step;
    family.duration_s[column] = (moved.manoeuvre.duration_s - end.manoeuvre.duration_s) / step;
  };
  if (end.turn_rad != 0.0) {
    const double step = end.turn_rad > 0.0 ? kStep : -kStep;
    End moved = end;
    moved.turn_rad += step;
    difference(moved, 0, step);
  }
  if (end.kind == End::Kind::kArrival) {
    End moved = end;
    moved.speed_mps += kStep;
    difference(moved, 1, kStep);
  }
  return family;
}

void EndChooser::guide(const ChosenEnds& chosen, Spline& spline) const {
  const auto guideBy = [&](const End& end, Knot& knot) {
    if (!knot.family) {
      knot.family = familyOf(end);
    }
  };
  guideBy(chosen.start, spline.knots.front());
  guideBy(chosen.goal, spline.knots.back());
}

void EndChooser::follow(Knot& knot, End& end) const {
  if (!knot.family || knot.family->moved.isZero()) {
    return;
  }
  // A turn keeps its side, and does not vanish.
  const double side = end.turn_rad < 0.0 ? -1.0 : 1.0;
  if (end.turn_rad != 0.0) {
    end.turn_rad = side * std::max(side * (end.turn_rad + knot.family->moved[0]), kShrunkTurnRad);
  }
  end.speed_mps = std::clamp(end.speed_mps + knot.family->moved[1], slowest(),
                             std::max(slowest(), options_.arrival_speed_max_mps));
  make(end);
  const StateVector state = stateOf(end.manoeuvre.joint);
  for (int m = 0; m < 4; ++m) {
    knot.state.col(m) = state.segment<2>(2 * m);
  }
  knot.family.reset();
}

void EndChooser::follow(Spline& spline, ChosenEnds& chosen) const {
  follow(spline.knots.front(), chosen.start);
  follow(spline.knots.back(), chosen.goal);
}

}  // namespace otter_nav::optimizer
