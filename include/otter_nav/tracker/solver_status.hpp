// How an optimal control step ended.
#pragma once

#include <string_view>

namespace otter_nav::tracker {

enum class SolverStatus {
  kSolved,
  kIterationsExhausted,  // a feasible, not yet optimal plan
  kNotFinite,            // a number that is not finite came in or out: no plan
  kIndefinite,           // the regularised Hessian is not positive definite: no plan
};

[[nodiscard]] constexpr bool usable(SolverStatus status) {
  return status == SolverStatus::kSolved || status == SolverStatus::kIterationsExhausted;
}

[[nodiscard]] constexpr std::string_view name(SolverStatus status) {
  switch (status) {
    case SolverStatus::kSolved:
      return "solved";
    case SolverStatus::kIterationsExhausted:
      return "iterations exhausted";
    case SolverStatus::kNotFinite:
      return "not finite";
    case SolverStatus::kIndefinite:
      return "indefinite";
  }
  return "unknown";
}

}  // namespace otter_nav::tracker
