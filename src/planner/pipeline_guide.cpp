// Before the search: are the ends free, and is there a way at all?
#include <algorithm>
#include <cmath>
#include <sstream>

#include "pipeline.hpp"

namespace otter_nav::planner {
namespace {

std::string describe(const Eigen::Vector2d& p) {
  std::ostringstream text;
  text.precision(5);
  text << "(" << p.x() << ", " << p.y() << ") m";
  return text.str();
}

// Why a vessel can't be at `p`, or nothing.
std::string blocked(const map::DistanceField& field, const Eigen::Vector2d& p, double psi_rad,
                    double clearance_m) {
  if (!p.allFinite() || !std::isfinite(psi_rad)) {
    return "is not a finite pose";
  }
  if (!field.geometry().contains(p)) {
    return describe(p) + " is outside the map";
  }
  const double clearance = field.clearance(p);
  if (clearance < clearance_m) {
    std::ostringstream text;
    text.precision(3);
    text << describe(p) << " is " << clearance << " m from an obstacle, " << clearance_m
         << " m are asked for";
    return text.str();
  }
  return "";
}

}  // namespace

bool Planner::Pipeline::checkEnds(Run& run) const {
  const std::string start =
      blocked(run.field, run.query.start.position, run.query.start_psi_rad, run.clearance_m);
  if (!start.empty()) {
    run.plan.outcome = Outcome::kStartBlocked;
    run.plan.reason = "the start " + start;
    return false;
  }
  const std::string goal =
      blocked(run.field, run.query.goal, run.query.goal_psi_rad, run.clearance_m);
  if (!goal.empty()) {
    run.plan.outcome = Outcome::kGoalBlocked;
    run.plan.reason = "the goal " + goal;
    return false;
  }
  return true;
}

bool Planner::Pipeline::findGuide(Run& run) {
  if (run.query.guide_path.size() >= 2) {
    guide_.points = run.query.guide_path;
    guide_.points.front() = run.query.start.position;
    guide_.points.back() = run.query.goal;
    return true;
  }
  const double began = run.now();
  if (run.clearance_m != finder_clearance_m_) {
    topology::Options options = options_.topology;
    options.clearance_m = run.clearance_m;
    options.safe_distance_m = std::max(options.safe_distance_m, run.clearance_m);
    finder_ = topology::GuidePathFinder(options);
    finder_clearance_m_ = run.clearance_m;
  }
  const Eigen::Vector2d& velocity = run.query.start.velocity;
  const double psi =
      velocity.norm() > 0.1 ? std::atan2(velocity.y(), velocity.x()) : run.query.start_psi_rad;
  const auto found = finder_.find(run.field, {run.query.start.position, psi},
                                  {run.query.goal, run.query.goal_psi_rad}, guide_);
  run.plan.figures.guide_ms = 1e3 * (run.now() - began);
  if (!found) {
    run.plan.reason = found.error().message;
    run.plan.outcome =
        found.error().failure == topology::Failure::kStartBlocked  ? Outcome::kStartBlocked
        : found.error().failure == topology::Failure::kGoalBlocked ? Outcome::kGoalBlocked
                                                                   : Outcome::kNoWay;
    return false;
  }
  return true;
}

}  // namespace otter_nav::planner
