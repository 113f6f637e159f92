// The planner benchmark's results as a table beside the paper's and as JSON.
#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "planner_cases.hpp"

namespace otter_nav::benchmark {

// Everything, with a summary for each kind of mission and method.
[[nodiscard]] nlohmann::json toJson(const Outcome& outcome, const Request& request);

// The paper's table I with ours beside it, for each kind of mission; with `profile` where the
// time went.
void printTable(const Outcome& outcome, const Request& request, bool profile, std::ostream& out);

// A line for each case without a plan: scenario, mission, method, seed and the reason.
void printRefused(const Outcome& outcome, std::ostream& out);

}  // namespace otter_nav::benchmark
