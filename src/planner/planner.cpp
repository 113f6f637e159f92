#include "otter_nav/planner/planner.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/feasibility/lee_shore.hpp"
#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/optimizer/global_optimizer.hpp"
#include "otter_nav/topology/guide_path.hpp"
#include "otter_nav/vessel/hull.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "planner/creeping.hpp"
#include "planner/fallback.hpp"
#include "planner/guide_line.hpp"
#include "planner/hull_search.hpp"
#include "planner/sampler.hpp"
#include "planner/search.hpp"

namespace otter_nav::planner {
namespace {

// Beyond the clearance, that the guide line is pushed out to.
constexpr double kRoomM = 0.7;
constexpr double kTurningRoomM = 0.1;        // beyond the hull's corners, where creeping may end
constexpr double kSampleSpeedShare = 0.867;  // of the speed limit, along the guide line
// A start faster than the limit is slowed down to so much of it, in so many times what the drag
// takes.
constexpr double kSlowedShares[] = {0.9, 0.0};
constexpr double kSlowingShares[] = {1.0, 1.6, 0.7, 2.5};
constexpr double kNearlyAtRestShare = 0.1;
constexpr double kPauseS = 0.5;
// Of the guide path, where a plan that may end early does.
constexpr double kWholeShare = 0.6;  // of time and samples, for the whole way
constexpr double kPartsOfThePath[] = {0.5, 0.25};
constexpr double kStretchShare = 0.6;  // a place is looked for from so much of that on
// Attempts with other samples before the last resorts, and of the time for them.
constexpr int kPatience = 3;
constexpr double kPatienceShare = 0.3;
// Beyond the key states: where the way is easy the trees have met by then, and where it is not, the
// guide path is optimised in less time than they take.
constexpr int kFewSamples = 40;
// Under way, of each search (likewise) and of a query: the next clearance is better than more.
constexpr int kSearchUnderWay = 100;
constexpr int kSamplesUnderWay = 400;
// Of a query under way, all its tries together, as optimizer::Budget counts; and what a sample and
// an edge of the trees that is bent take of it.
constexpr int kWorkUnderWay = 4500;
// From a start faster than its limit, or where a part of the way will do as well; but where
// something moves it would be elsewhere by then.
constexpr int kWorkInTwoSteps = 9000;
constexpr int kWorkAtRestAmongOthers = 5000;
constexpr int kWorkAtRest = std::numeric_limits<int>::max();
constexpr int kWorkOfASample = 2;
constexpr int kWorkOfARepair = 7;
constexpr double kNearM = 0.3;  // a goal nearer than this needs no search
// A hull that a load from abeam carries off holds its place and its way by turning to and fro:
// its corners swing by what it is carried in so long, s.
constexpr double kSwingS = 1.2;
constexpr int kPosesMost = 400000;  // that a way for the hull's rectangle is looked for through
constexpr int kTrySamples = 150;    // what one more try may draw, and any try counts for

double costOf(const trajectory::Trajectory& trajectory, double sigma) {
  double cost = 0.0;
  for (const trajectory::Piece& piece : trajectory.pieces()) {
    cost += pieceCost(piece, sigma);
  }
  return cost;
}

bool isTooFast(const Query& query) {
  return query.start.flat.velocity.norm() > query.limits.speed_max_mps;
}

int workFor(const feasibility::Obstacles& obstacles, const Query& query) {
  const bool moves = obstacles.rateBound() > 0.0;
  if (trajectory::atRest(query.start)) {
    return moves && !query.may_end_early ? kWorkAtRestAmongOthers : kWorkAtRest;
  }
  const bool in_two_steps = isTooFast(query) || query.may_end_early;
  return in_two_steps && !moves ? kWorkInTwoSteps : kWorkUnderWay;
}

// Under limits that no plan can be made for; else empty.
std::string whyNothingMoves(const feasibility::SafetyLimits& limits) {
  if (!(limits.speed_max_mps > 0.0)) {
    return "the limits allow no speed";
  }
  return limits.thrust_share > 0.0 ? "" : "the limits allow no thrust";
}

KinoState stateOf(const trajectory::Boundary& end) {
  return {end.flat.position, end.flat.velocity, end.flat.acceleration};
}

}  // namespace

// The planner's stages for one query, in order.
class Planner::Pipeline {
 public:
  Pipeline(const Options& options, const vessel::Parameters& vessel)
      : options_(options),
        vessel_(vessel),
        finder_(options.topology),
        search_({options.sigma, options.max_nodes, options.local_optimization}, vessel),
        optimizer_(options.optimizer, vessel),
        hull_search_(vessel.hull) {}

  Plan plan(const feasibility::Obstacles& obstacles, const Query& query,
            const Termination& termination) {
    if (std::string why = whyNothingMoves(query.limits); !why.empty()) {
      Plan none;
      none.reason = std::move(why);
      return none;
    }
    const int work = workFor(obstacles, query);
    work_left_ = work;
    Plan plan = planOffShores(obstacles, query, termination);
    plan.figures.work = work - work_left_;
    return plan;
  }

 private:
  Plan planOffShores(const feasibility::Obstacles& obstacles, const Query& query,
                     const Termination& termination) {
    const feasibility::SafetyLimits& limits = query.limits;
    without_lee_ = &obstacles;
    if (limits.drift_m.isZero(0.0) || !limits.drift_m.allFinite()) {
      return planInTime(obstacles, query, termination);
    }
    feasibility::Obstacles all = obstacles;
    const feasibility::LeeShore lee(
        obstacles.field(), limits.drift_m, std::min(limits.clearance_m, 0.5 * limits.hull.length_m),
        limits.clearance_m, query.start.flat.position, query.goal.flat.position);
    all.add(lee);
    return planInTime(all, query, termination);
  }

  // A start faster than the limit: where no way was found on which the vessel slows down, it does
  // so first, straight ahead.
  Plan planInTime(const feasibility::Obstacles& obstacles, const Query& query,
                  const Termination& termination) {
    const bool too_fast = isTooFast(query);
    samples_left_ = termination.max_iterations;
    if (!trajectory::atRest(query.start)) {
      samples_left_ = std::min(samples_left_, kSamplesUnderWay);
    }
    const int after =
        query.may_end_early || too_fast ? static_cast<int>((1.0 - kWholeShare) * work_left_) : 0;
    Termination whole = termination;
    whole.max_iterations = samples_left_;
    if (query.may_end_early || too_fast) {
      whole.budget_s *= kWholeShare;
      whole.max_iterations = static_cast<int>(kWholeShare * whole.max_iterations);
    }
    work_left_ -= after;
    Plan plan = planAmong(obstacles, query, whole);
    work_left_ += after;
    if (plan.outcome == Outcome::kSolved) {
      return fell_back_ && mayCreep(query) &&
                     isInReach(query.start.flat.position, query.goal.flat.position)
                 ? quickerCreeping(query, termination, std::move(plan))
                 : plan;
    }
    if (!too_fast) {
      return query.may_end_early ? planOnGuide(obstacles, query, termination, std::move(plan))
                                 : plan;
    }
    for (const double longer : kSlowingShares) {
      for (const double share : kSlowedShares) {
        const std::optional<Termination> once = onceMore(termination);
        Plan other = once ? planSlowed(obstacles, query, *once, share, longer) : Plan{};
        if (other.outcome == Outcome::kSolved) {
          return other;
        }
      }
    }
    return plan;
  }

  // For one more try with what is left of the query's time and samples; nothing if that is used up.
  [[nodiscard]] std::optional<Termination> onceMore(const Termination& termination) const {
    const bool late = termination.elapsed_s && termination.elapsed_s() >= termination.budget_s;
    if (late || samples_left_ <= 0 || work_left_ <= 0) {
      return std::nullopt;
    }
    Termination once = termination;
    once.max_iterations = std::min(samples_left_, kTrySamples);
    return once;
  }

  struct OnGuide {
    double along_m;
    Eigen::Vector2d position;
    double course_rad;
    double clearance_m;
  };

  // Where the whole way can't be planned: a part of it; or creeping, as the hull's rectangle
  // passes.
  Plan planOnGuide(const feasibility::Obstacles& obstacles, const Query& query,
                   const Termination& termination, Plan none) {
    std::vector<OnGuide> places = placesOnGuide(obstacles.field());
    Plan plan = planPartOfThePath(obstacles, query, termination, places, std::move(none));
    const bool may_creep = mayCreep(query) && plan.outcome != Outcome::kSolved &&
                           plan.outcome != Outcome::kGoalBlocked;
    if (may_creep && places.empty()) {
      findTightGuide(query);
      places = placesOnGuide(without_lee_->field());
    }
    return may_creep ? creep(query, termination, places, std::move(plan)) : plan;
  }

  static bool mayCreep(const Query& query) {
    return query.may_creep && trajectory::atRest(query.start);
  }

  // From stop to stop along the guide path the hull turns and rests in places that nobody chose:
  // where creeping leads as far in less time, it does so where there is most room.
  Plan quickerCreeping(const Query& query, const Termination& termination, Plan plan) {
    Plan other = creepTo(query.goal, 0.0, query, termination, Plan{});
    const bool is_quicker =
        other.outcome == Outcome::kSolved && other.figures.duration_s < plan.figures.duration_s;
    return is_quicker ? other : plan;
  }

  static bool isInReach(const Eigen::Vector2d& from, const Eigen::Vector2d& place) {
    constexpr double kWithin = 0.95;  // of the search's reach
    return (place - from).cwiseAbs().maxCoeff() < kWithin * HullSearch::kReachM;
  }

  // At the narrowest clearance it is the discs that cover the hull's rectangle which count there.
  [[nodiscard]] feasibility::SafetyLimits creepingLimits(const Query& query) const {
    feasibility::SafetyLimits limits = query.limits;
    if (query.may_end_early) {
      const feasibility::HullCover cover(vessel_.hull, limits.hull_margin_m);
      limits.clearance_m = std::min(limits.clearance_m, cover.middle_m);
    }
    return limits;
  }

  // A guide path for one that is nearer to something than plans keep, or for which all ways are
  // closed at that.
  void findTightGuide(const Query& query) {
    constexpr double kLessM = 1e-3;
    const map::DistanceField& field = without_lee_->field();
    const double clearance_m = std::min(creepingLimits(query).clearance_m,
                                        field.clearance(query.start.flat.position) - kLessM);
    const vessel::Pose goal{query.goal.flat.position, query.goal.psi_rad};
    if (clearance_m <= 0.0 || !finder_.find(field, query.guideStart(), goal, guide_, clearance_m)) {
      guide_.points.clear();
    }
  }

  // To the place with most room on a stretch of the guide path, the farther ones first, from which
  // the hull can go on; else `none` stays the answer.
  Plan planPartOfThePath(const feasibility::Obstacles& obstacles, const Query& query,
                         const Termination& termination, const std::vector<OnGuide>& places,
                         Plan none) {
    const double length = places.empty() ? 0.0 : places.back().along_m;
    for (const double share : kPartsOfThePath) {
      const std::optional<Termination> once = onceMore(termination);
      const OnGuide* best = nullptr;
      for (const OnGuide& place : places) {
        const bool on_stretch = place.along_m <= share * length &&
                                place.along_m >= kStretchShare * share * length &&
                                place.along_m >= vessel_.hull.length_m;
        if (on_stretch && (best == nullptr || place.clearance_m > best->clearance_m)) {
          best = &place;
        }
      }
      if (!once || best == nullptr || best->clearance_m < query.limits.clearance_m) {
        continue;
      }
      Query part = query;
      part.warm_start = {};
      part.guide_path.clear();
      part.goal = {};
      part.goal.flat.position = best->position;
      part.goal.psi_rad = best->course_rad;
      Plan plan = planAmong(obstacles, part, *once);
      if (plan.outcome == Outcome::kSolved && leadsOn(query, termination, *best)) {
        plan.left_m = leftAfter(*best, places, query);
        return plan;
      }
    }
    return none;
  }

  // Whether the hull gets from there to the goal, if that is near enough to tell.
  bool leadsOn(const Query& query, const Termination& termination, const OnGuide& place) {
    const Eigen::Vector2d off = query.goal.flat.position - place.position;
    return off.cwiseAbs().maxCoeff() >= HullSearch::kReachM ||
           !hullWay(creepingLimits(query), termination, {place.position, place.course_rad},
                    {query.goal.flat.position, query.goal.psi_rad})
                .empty();
  }

  std::vector<vessel::Pose> hullWay(const feasibility::SafetyLimits& limits,
                                    const Termination& termination, const vessel::Pose& from,
                                    const vessel::Pose& to) {
    HullRoom room{limits.clearance_m, limits.hull_margin_m};
    if (vessel_.manoeuvring.feelsWind() || !limits.felt.force_n.isZero(0.0)) {
      room.swings_m = [&](double psi_rad) {
        return kSwingS * std::abs(vessel::driftAbeam(vessel_.manoeuvring, limits.felt, psi_rad));
      };
    }
    return hull_search_.find(*without_lee_, from, to, room, kPosesMost, [&termination] {
      return termination.elapsed_s && termination.elapsed_s() >= termination.budget_s;
    });
  }

  // To the goal; or, where that is out of the search's reach, to the farthest place on the guide
  // path with room to turn, or failing that to the farthest.
  Plan creep(const Query& query, const Termination& termination, const std::vector<OnGuide>& places,
             Plan none) {
    if (isInReach(query.start.flat.position, query.goal.flat.position)) {
      return creepTo(query.goal, 0.0, query, termination, std::move(none));
    }
    const double turning_m = vessel::circumscribedRadius(vessel_.hull) + kTurningRoomM;
    for (const double room_m : {turning_m, 0.0}) {
      const auto last = std::find_if(places.rbegin(), places.rend(), [&](const OnGuide& place) {
        return isInReach(query.start.flat.position, place.position) && place.clearance_m >= room_m;
      });
      if (last != places.rend() && none.outcome != Outcome::kSolved) {
        trajectory::Boundary there;
        there.flat.position = last->position;
        there.psi_rad = last->course_rad;
        none = creepTo(there, leftAfter(*last, places, query), query, termination, std::move(none));
      }
    }
    return none;
  }

  Plan creepTo(const trajectory::Boundary& end, double left_m, const Query& query,
               const Termination& termination, Plan none) {
    const vessel::Pose start{query.start.flat.position, query.start.psi_rad};
    // A vessel that stopped nearer to something creeps away from there with what it has.
    feasibility::SafetyLimits limits = creepingLimits(query);
    const HullRoom has = hull_search_.roomAt(*without_lee_, start);
    limits.clearance_m = std::min(limits.clearance_m, has.centre_m);
    limits.hull_margin_m = std::min(limits.hull_margin_m, std::max(0.0, has.beside_m));
    const std::vector<vessel::Pose> way =
        hullWay(limits, termination, start, {end.flat.position, end.psi_rad});
    if (way.size() < 2) {
      return none;
    }
    Plan plan;
    plan.trajectory = creepAlong(way, vessel_, limits);
    const auto verification =
        feasibility::verify(plan.trajectory, *without_lee_, vessel_, query.start, end, limits);
    if (!verification.ok) {
      none.reason += "; creeping: " + verification.reason;
      return none;
    }
    plan.outcome = Outcome::kSolved;
    plan.left_m = left_m;
    measure(plan);
    plan.figures.total_ms =
        termination.elapsed_s ? 1e3 * termination.elapsed_s() : none.figures.total_ms;
    return plan;
  }

  [[nodiscard]] std::vector<OnGuide> placesOnGuide(const map::DistanceField& field) const {
    constexpr double kStepM = 0.2;
    std::vector<OnGuide> places;
    double before = 0.0;
    for (std::size_t k = 1; k < guide_.points.size(); ++k) {
      const Eigen::Vector2d leg = guide_.points[k] - guide_.points[k - 1];
      const double length = leg.norm();
      for (double s = 0.5 * kStepM; s < length; s += kStepM) {
        const Eigen::Vector2d p = guide_.points[k - 1] + s / length * leg;
        places.push_back({before + s, p, angleOf(leg), field.clearance(p)});
      }
      before += length;
    }
    return places;
  }

  // The last place on the guide path lies short of the goal.
  static double leftAfter(const OnGuide& place, const std::vector<OnGuide>& places,
                          const Query& query) {
    return places.back().along_m - place.along_m +
           (query.goal.flat.position - places.back().position).norm();
  }

  // Down to `share` of the limit, in `longer` times what the drag alone would take.
  Plan planSlowed(const feasibility::Obstacles& obstacles, const Query& query,
                  const Termination& termination, double share, double longer) {
    const vessel::FlatPoint& from = query.start.flat;
    const double speed = from.velocity.norm();
    const double slowed = share * query.limits.speed_max_mps;
    const double lag_s = vessel_.paper.m1_kg / vessel_.paper.d1_kgps;
    const double takes_s =
        longer * lag_s * std::log(speed / std::max(slowed, kNearlyAtRestShare * speed));
    const Eigen::Vector2d ahead = from.velocity / speed;
    Query rest = query;
    rest.warm_start = {};
    rest.guide_path.clear();
    rest.start.flat = {};
    rest.start.flat.position = from.position + 0.5 * (speed + slowed) * takes_s * ahead;
    rest.start.flat.velocity = slowed * ahead;
    rest.start.psi_rad = angleOf(ahead);
    const double pause_s = slowed > 0.0 ? 0.0 : kPauseS;
    Plan plan = planAmong(obstacles.startingAt(takes_s + pause_s), rest, termination);
    if (plan.outcome != Outcome::kSolved) {
      return plan;
    }
    std::vector<trajectory::Piece> pieces = {
        trajectory::hermitePiece(from, rest.start.flat, takes_s)};
    if (pause_s > 0.0) {
      pieces.push_back(trajectory::spinPiece(rest.start.flat.position, rest.start.psi_rad,
                                             rest.start.psi_rad, pause_s));
      pieces.back().position =
          trajectory::hermitePiece(rest.start.flat, plan.trajectory.flat(0.0), pause_s).position;
    }
    pieces.insert(pieces.end(), plan.trajectory.pieces().begin(), plan.trajectory.pieces().end());
    plan.trajectory = trajectory::Trajectory(std::move(pieces));
    const auto verification = feasibility::verify(plan.trajectory, obstacles, vessel_, query.start,
                                                  query.goal, query.limits);
    if (!verification.ok) {
      plan.outcome = Outcome::kNoPath;
      plan.reason = verification.reason;
      return plan;
    }
    measure(plan);
    return plan;
  }

  Plan planAmong(const feasibility::Obstacles& obstacles, const Query& query,
                 const Termination& termination) {
    Run run{obstacles, query, termination, {}};
    run.samples_left = termination.max_iterations;
    const double began = run.now();
    guide_.points.clear();
    if (checkEnds(run) && !planNearby(run) && findGuide(run)) {
      tryWarmStart(run);
      buildLine(run);
      const int attempts = std::max(options_.max_attempts, options_.improve_attempts + 1);
      for (int attempt = 0; attempt < attempts && !done(run); ++attempt) {
        attemptOnce(run, attempt);
      }
      keepTrees(run);
    }
    conclude(run);
    fell_back_ = run.fallback;
    samples_left_ -= std::max(kTrySamples, run.plan.figures.samples);  // optimising costs too
    run.plan.figures.total_ms = 1e3 * (run.now() - began);
    return std::move(run.plan);
  }

  // What one query's stages share.
  struct Run {
    const feasibility::Obstacles& obstacles;
    const Query& query;
    const Termination& termination;
    Plan plan;
    int samples_left = 0;
    bool fallback = false;  // the plan so far could not be optimised
    bool resorted = false;  // to what makes such plans

    [[nodiscard]] double now() const {
      return termination.elapsed_s ? termination.elapsed_s() : 0.0;
    }
    [[nodiscard]] bool timeUp(double share = 1.0) const {
      return termination.elapsed_s && termination.elapsed_s() >= share * termination.budget_s;
    }
    [[nodiscard]] bool solved() const { return plan.outcome == Outcome::kSolved; }
  };

  // Where the trees begin: at the ends themselves where the whole will be optimised, as which way
  // to leave is chosen there; without it, after a straight launch and before a straight stop.
  enum class Roots { kAtEnds, kLaunched };

  static bool checkEnds(Run& run) {
    const auto passes = [&run](const trajectory::Boundary& end, const char* name, Outcome outcome) {
      const std::string why = topology::whyBlocked(
          run.obstacles.field(), {end.flat.position, end.psi_rad}, run.query.limits.clearance_m);
      if (!why.empty()) {
        run.plan.outcome = outcome;
        run.plan.reason = name + why;
      }
      return why.empty();
    };
    return passes(run.query.start, "the start ", Outcome::kStartBlocked) &&
           passes(run.query.goal, "the goal ", Outcome::kGoalBlocked);
  }

  // A goal within reach of the hull: straight there, turning on the spot.
  bool planNearby(Run& run) {
    const Query& query = run.query;
    const std::vector<Eigen::Vector2d> line = {query.start.flat.position, query.goal.flat.position};
    if (!trajectory::atRest(query.start) || (line[1] - line[0]).norm() > kNearM) {
      return false;
    }
    const double began = run.now();
    auto nearby =
        optimizer_.stopAndSpin(run.obstacles, line, query.start, query.goal, query.limits);
    run.plan.figures.optimize_ms += 1e3 * (run.now() - began);
    if (nearby) {
      accept(run, std::move(nearby->trajectory), false);
    }
    return nearby.has_value();
  }

  bool findGuide(Run& run) {
    const Query& query = run.query;
    const vessel::FlatPoint& from = query.start.flat;
    const bool has_dead_ends = !query.dead_ends.empty();
    if (query.guide_path.size() >= 2 && !has_dead_ends) {
      guide_.points = query.guide_path;
      guide_.points.front() = from.position;
      guide_.points.back() = query.goal.flat.position;
      return true;
    }
    const double began = run.now();
    const vessel::Pose goal{query.goal.flat.position, query.goal.psi_rad};
    const auto findIn = [&](const map::DistanceField& field) {
      return finder_.find(field, query.guideStart(), goal, guide_, query.limits.clearance_m);
    };
    auto found = findIn(has_dead_ends ? withoutDeadEnds(run) : run.obstacles.field());
    if (!found && has_dead_ends && query.may_end_early) {
      found = findIn(run.obstacles.field());
    }
    run.plan.figures.guide_ms = 1e3 * (run.now() - began);
    if (!found) {
      run.plan.reason = found.error().message;
      run.plan.outcome =
          found.error().failure == topology::Failure::kStartBlocked  ? Outcome::kStartBlocked
          : found.error().failure == topology::Failure::kGoalBlocked ? Outcome::kGoalBlocked
                                                                     : Outcome::kNoPath;
    }
    return found.has_value();
  }

  // Neither start nor goal is cut off.
  const map::DistanceField& withoutDeadEnds(const Run& run) {
    constexpr double kDeadEndM = 0.4;
    constexpr double kLeftM = 0.1;
    const Query& query = run.query;
    open_ends_ = run.obstacles.field();
    for (const Eigen::Vector2d& place : query.dead_ends) {
      const double near = std::min((place - query.start.flat.position).norm(),
                                   (place - query.goal.flat.position).norm());
      const double radius = std::min(kDeadEndM, near - query.limits.clearance_m - kLeftM);
      if (radius > 0.0) {
        open_ends_.occupy(place, radius);
      }
    }
    return open_ends_;
  }

  // What is being sailed stays a candidate, improved if that can be done.
  void tryWarmStart(Run& run) {
    const Query& query = run.query;
    if (query.warm_start.empty()) {
      return;
    }
    const double began = run.now();
    const auto verification = feasibility::verify(query.warm_start, run.obstacles, vessel_,
                                                  query.start, query.goal, query.limits);
    run.plan.figures.verify_ms += 1e3 * (run.now() - began);
    if (verification.ok) {
      accept(run, query.warm_start, false);
    }
  }

  void buildLine(const Run& run) {
    const feasibility::SafetyLimits& limits = run.query.limits;
    GuideLineOptions line;
    line.speed_mps = kSampleSpeedShare * limits.speed_max_mps;
    line.speed_start_mps = run.query.start.flat.velocity.norm();
    line.force_ahead_n = 2.0 * limits.thrust_share * vessel_.thrusters.ahead_max_n;
    line.corridor_m = options_.corridor_m;
    line.safe_distance_m = limits.clearance_m + kRoomM;
    line_.build(guide_.points, run.obstacles.field(), vessel_, line);
  }

  // An optimised plan, and no better one is asked for.
  [[nodiscard]] bool isGood(const Run& run) const {
    return run.solved() && !run.fallback && run.plan.figures.attempts > options_.improve_attempts;
  }
  [[nodiscard]] bool done(const Run& run) const {
    return isSpent(run) || run.samples_left <= 0 || isGood(run) || (run.resorted && isFutile(run));
  }
  [[nodiscard]] bool isSpent(const Run& run) const { return run.timeUp() || work_left_ <= 0; }

  // A tree's path, optimised; failing that the guide path. Later attempts draw other samples: a
  // few cost less than the last resorts, and end in better plans.
  void attemptOnce(Run& run, int attempt) {
    ++run.plan.figures.attempts;
    if (!options_.global_optimization) {
      beginTrees(run, attempt, Roots::kLaunched);
      if (growTrees(run, options_.attempt_samples)) {
        closeTreesPath(run);
      }
      return;
    }
    beginTrees(run, attempt, Roots::kAtEnds);
    optimizeTreesPath(run, sampler_->keyStates() + kFewSamples);
    if (attempt == 0 && !isGood(run) && !isSpent(run)) {
      optimizeGuide(run, 0, 1);
    }
    if (!done(run) && !run.query.warm_start.empty() && attempt == 0) {
      optimizeTrajectory(run, run.query.warm_start);
    }
    if (!done(run) && !search_.solved()) {
      optimizeTreesPath(run, mostSamples(run));
    }
    if ((!run.solved() || run.fallback) && !patient(run, attempt)) {
      lastResorts(run, attempt);
    }
  }

  // Under a low speed limit the guide path with more care makes the faster plans, and under way it
  // is had sooner.
  [[nodiscard]] bool patient(const Run& run, int attempt) const {
    return attempt + 1 < std::min(options_.max_attempts, kPatience) &&
           trajectory::atRest(run.query.start) &&
           feasibility::speedShare(vessel_, run.query.limits) == 1.0 &&
           run.samples_left > options_.attempt_samples && !run.timeUp(kPatienceShare);
  }

  // The guide path with more care, then from stop to stop; and the trees' path made feasible by the
  // least that will do.
  void lastResorts(Run& run, int attempt) {
    const bool first = !run.resorted;
    run.resorted = true;
    if (first && !isGood(run) && !isSpent(run)) {
      optimizeGuide(run, 1, optimizer::Budget().max_attempts);
    }
    const bool poor = !run.solved() || (run.fallback && first);
    if (!poor || run.timeUp() || isFutile(run)) {
      return;
    }
    beginTrees(run, attempt, Roots::kLaunched);
    if (growTrees(run, mostSamples(run))) {
      closeTreesPath(run);
    }
  }

  [[nodiscard]] int mostSamples(const Run& run) const {
    return trajectory::atRest(run.query.start) ? options_.attempt_samples
                                               : sampler_->keyStates() + kSearchUnderWay;
  }
  // Under way, with what comes first: what doesn't become a plan, or trees that haven't met, won't
  // with other samples either.
  [[nodiscard]] static bool isFutile(const Run& run) {
    return !trajectory::atRest(run.query.start);
  }

  void placeRoots(const Run& run, Roots roots) {
    const feasibility::SafetyLimits& limits = run.query.limits;
    KinoState start = stateOf(run.query.start);
    KinoState goal = stateOf(run.query.goal);
    launch_.reset();
    stop_.reset();
    if (roots == Roots::kLaunched) {
      const double speed = launchSpeed(vessel_, limits);
      stop_ = stopAt(goal.position, line_.at(line_.length()).direction, speed);
      goal = stop_->root;
      if (trajectory::atRest(run.query.start)) {
        launch_ = launchFrom(start.position, line_.at(0.0).direction, speed);
        start = launch_->root;
      }
    }
    search_.reset(run.obstacles.startingAt(launch_ ? launch_->piece.duration_s : 0.0), limits,
                  start, goal);
  }

  void beginTrees(const Run& run, int attempt, Roots roots) {
    placeRoots(run, roots);
    SamplerOptions options;
    options.key_spacing_m /= 1.0 + 0.5 * attempt;
    options.uniform_share = options_.uniform_share;
    options.speed_max_mps = kSampleSpeedShare * run.query.limits.speed_max_mps;
    const double slow = feasibility::speedShare(vessel_, run.query.limits);
    options.accel_mps2 *= slow * slow;
    sampler_.emplace(options, line_, run.obstacles.field(),
                     run.query.seed + 0x9e3779b97f4a7c15ULL * static_cast<std::uint64_t>(attempt));
    search_.joinRoots();
  }

  // Samples until the trees meet, then improve_samples more; `most` of them since they began.
  bool growTrees(Run& run, int most) {
    const double began = run.now();
    const SearchCounts before = search_.counts();
    int budget =
        std::min(run.samples_left, std::min(most, options_.attempt_samples) - before.samples);
    int improving = options_.improve_samples;
    const auto work = [&] {
      const SearchCounts& now = search_.counts();
      return kWorkOfASample * (now.samples - before.samples) +
             kWorkOfARepair * (now.tried - before.tried);
    };
    while (budget-- > 0 && !run.timeUp() && work() < work_left_) {
      if (search_.solved() && improving-- <= 0) {
        break;
      }
      search_.extend(sampler_->next());
      if (search_.solved() && run.plan.figures.first_solution_ms == 0.0) {
        run.plan.figures.first_solution_ms = 1e3 * run.now();
      }
    }
    const SearchCounts& counts = search_.counts();
    Figures& figures = run.plan.figures;
    figures.samples += counts.samples - before.samples;
    figures.nodes += counts.joined - before.joined;
    figures.local_repairs += counts.repairs - before.repairs;
    figures.tree_ms += 1e3 * (run.now() - began);
    run.samples_left -= counts.samples - before.samples;
    work_left_ -= work();
    return search_.solved();
  }

  void optimizeTreesPath(Run& run, int most) {
    if (growTrees(run, most)) {
      run.plan.figures.tree_cost = search_.bestCost();
      optimizeTrajectory(run, trajectory::Trajectory(search_.recall()));
    }
  }

  void closeTreesPath(Run& run) {
    const double began = run.now();
    std::vector<trajectory::Piece> whole;
    if (launch_) {
      whole.push_back(launch_->piece);
    }
    const std::vector<trajectory::Piece> path = search_.recall();
    whole.insert(whole.end(), path.begin(), path.end());
    whole.push_back(stop_->piece);
    run.plan.figures.tree_cost = search_.bestCost();
    auto closed =
        closePath(whole, run.query.start, run.query.goal, run.obstacles, vessel_, run.query.limits);
    run.plan.figures.verify_ms += 1e3 * (run.now() - began);
    if (closed) {
      accept(run, std::move(*closed), options_.global_optimization);
    } else if (!run.solved()) {
      run.plan.reason = closed.error().message;
    }
  }

  [[nodiscard]] optimizer::Budget budgetOf(const Run& run) const {
    optimizer::Budget budget;
    budget.elapsed_s = run.termination.elapsed_s;
    budget.budget_s = run.termination.budget_s;
    budget.max_work = work_left_;
    return budget;
  }

  // One attempt only: the guide path is a better second one.
  void optimizeTrajectory(Run& run, const trajectory::Trajectory& initial) {
    const double began = run.now();
    optimizer::Budget budget = budgetOf(run);
    budget.max_attempts = 1;
    take(run, began,
         optimizer_.optimize(run.obstacles, initial, run.query.start, run.query.goal, budget,
                             run.query.limits));
  }

  // The tree's path could not be made feasible: the guide path itself may be.
  void optimizeGuide(Run& run, int first_attempt, int max_attempts) {
    const double began = run.now();
    const std::string reason = run.plan.reason;
    optimizer::Budget budget = budgetOf(run);
    budget.first_attempt = first_attempt;
    budget.max_attempts = max_attempts;
    take(run, began,
         optimizer_.optimize(run.obstacles, guide_.points, run.query.start, run.query.goal, budget,
                             run.query.limits));
    if (!reason.empty()) {
      run.plan.reason = reason;  // of the tree's path, if both fail
    }
  }

  void take(Run& run, double began_s, Result<optimizer::Optimized> optimized) {
    work_left_ -= optimizer_.work();
    run.plan.figures.optimize_ms += 1e3 * (run.now() - began_s);
    if (optimized) {
      run.plan.figures.iterations += optimized->iterations;
      accept(run, std::move(optimized->trajectory), optimized->last_resort);
    } else if (!run.solved()) {
      run.plan.reason = optimized.error().message;
    }
  }

  // The best by J, the search's own measure. A fallback (from stop to stop, or slowed down) is
  // better than nothing, and worse than anything optimised.
  void accept(Run& run, trajectory::Trajectory trajectory, bool fallback) const {
    const double cost = costOf(trajectory, options_.sigma);
    const bool better = fallback == run.fallback ? cost < run.plan.figures.cost : run.fallback;
    if (run.solved() && !better) {
      return;
    }
    run.fallback = fallback;
    run.plan.figures.cost = cost;
    run.plan.trajectory = std::move(trajectory);
    run.plan.outcome = Outcome::kSolved;
  }

  void measure(Plan& plan) const {
    plan.figures.cost = costOf(plan.trajectory, options_.sigma);
    plan.figures.length_m = trajectory::length(plan.trajectory);
    plan.figures.duration_s = plan.trajectory.duration();
  }

  void conclude(Run& run) const {
    Figures& figures = run.plan.figures;
    figures.node_utilization =
        figures.samples > 0 ? static_cast<double>(figures.nodes) / figures.samples : 0.0;
    if (run.solved()) {
      run.plan.reason.clear();
      measure(run.plan);
    } else if (run.timeUp()) {
      run.plan.outcome = Outcome::kTimeUp;
      run.plan.reason = "the time is up" + (run.plan.reason.empty() ? "" : ": " + run.plan.reason);
    } else if (run.plan.reason.empty()) {
      run.plan.reason = "no path was found in " + std::to_string(figures.samples) + " samples";
    }
  }

  void keepTrees(Run& run) const {
    if (!options_.keep_trees) {
      return;
    }
    constexpr int kPointsPerPiece = 8;
    run.plan.guide_path = guide_.points;
    std::vector<trajectory::Piece> pieces;
    for (const Tree* tree : {&search_.fromStart(), &search_.toGoal()}) {
      for (int i = 1; i < tree->size(); ++i) {
        pieces.clear();
        search_.appendEdge(*tree, i, pieces);
        Plan::Branch branch;
        branch.from_goal = tree->direction() == Direction::kToRoot;
        for (const trajectory::Piece& piece : pieces) {
          for (int k = 0; k <= kPointsPerPiece; ++k) {
            branch.points.push_back(piece.flat(piece.duration_s * k / kPointsPerPiece).position);
          }
        }
        run.plan.trees.push_back(std::move(branch));
      }
    }
  }

  Options options_;
  vessel::Parameters vessel_;
  topology::GuidePathFinder finder_;
  topology::GuidePath guide_;
  map::DistanceField open_ends_;  // the map with what led to nowhere closed
  GuideLine line_;
  Search search_;
  std::optional<Sampler> sampler_;
  bool fell_back_ = false;  // what was planned last could not be optimised
  int samples_left_ = 0;    // of the query, all tries together
  int work_left_ = 0;       // likewise
  std::optional<Launch> launch_;
  std::optional<Launch> stop_;
  optimizer::GlobalOptimizer optimizer_;
  HullSearch hull_search_;
  // Of the query. Creeping no heading is lost, in the weather in which it is asked for.
  const feasibility::Obstacles* without_lee_ = nullptr;
};

vessel::Pose Query::guideStart() const {
  const vessel::FlatPoint& from = start.flat;
  const bool moving = from.velocity.norm() > 0.1;
  return {from.position, moving ? angleOf(from.velocity) : start.psi_rad};
}

Termination wallClock(double budget_s, int max_iterations) {
  const auto start = std::chrono::steady_clock::now();
  Termination termination;
  termination.elapsed_s = [start] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  termination.budget_s = budget_s;
  termination.max_iterations = max_iterations;
  return termination;
}

const char* toString(Outcome outcome) {
  switch (outcome) {
    case Outcome::kSolved:
      return "solved";
    case Outcome::kStartBlocked:
      return "start blocked";
    case Outcome::kGoalBlocked:
      return "goal blocked";
    case Outcome::kNoPath:
      return "no way";
    case Outcome::kTimeUp:
      return "time up";
  }
  return "unknown";
}

Planner::Planner(const Options& options, const vessel::Parameters& vessel)
    : pipeline_(std::make_unique<Pipeline>(options, vessel)) {}
Planner::~Planner() = default;
Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;

Plan Planner::plan(const feasibility::Obstacles& obstacles, const Query& query,
                   const Termination& termination) {
  return pipeline_->plan(obstacles, query, termination);
}

}  // namespace otter_nav::planner
