#include "otter_nav/planner/planner.hpp"

#include <chrono>

#include "pipeline.hpp"

namespace otter_nav::planner {

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
    case Outcome::kNoWay:
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

Plan Planner::plan(const map::DistanceField& field, const Query& query,
                   const Termination& termination) {
  return pipeline_->plan(field, query, termination);
}

}  // namespace otter_nav::planner
