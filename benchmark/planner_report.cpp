#include "planner_report.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <ostream>
#include <vector>

#include "otter_nav/base/statistics.hpp"

namespace otter_nav::benchmark {
namespace {

using nlohmann::json;
using Cases = std::vector<const Case*>;

Cases select(const Outcome& outcome, const std::string& kind, const std::string& method,
             bool solved_only) {
  Cases cases;
  for (const Case& c : outcome.cases) {
    if (c.kind == kind && c.method == method && (c.success || !solved_only)) {
      cases.push_back(&c);
    }
  }
  return cases;
}

using Figure = std::function<double(const Case&)>;

double mean(const Cases& cases, const Figure& figure) {
  double sum = 0.0;
  for (const Case* c : cases) {
    sum += figure(*c);
  }
  return cases.empty() ? 0.0 : sum / static_cast<double>(cases.size());
}

double quantileOf(const Cases& cases, double share, const Figure& figure) {
  std::vector<double> values;
  for (const Case* c : cases) {
    values.push_back(figure(*c));
  }
  return quantile(std::move(values), share);
}

double share(const Cases& cases, const std::function<bool(const Case&)>& holds) {
  return mean(cases, [&](const Case& c) { return holds(c) ? 1.0 : 0.0; });
}

double totalMs(const Case& c) {
  return c.figures.total_ms;
}
double firstMs(const Case& c) {
  return c.figures.first_solution_ms;
}
double speed(const Case& c) {
  return c.figures.length_m / c.figures.duration_s;
}
double lengthRatio(const Case& c) {
  return c.figures.length_m / c.shortest_m;
}

bool foundAWay(const Case& c) {
  return c.figures.first_solution_ms > 0.0;
}

Cases withFirstSolution(const Cases& cases) {
  Cases found;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(found),
               [](const Case* c) { return foundAWay(*c); });
  return found;
}

Cases withShortest(const Cases& cases) {
  Cases known;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(known),
               [](const Case* c) { return c->shortest_m > 0.0; });
  return known;
}

json summarise(const Cases& all, const Cases& solved) {
  const Cases found = withFirstSolution(all);
  json s;
  s["cases"] = all.size();
  s["success_rate"] = share(all, [](const Case& c) { return c.success; });
  s["success_rate_100ms"] =
      share(all, [](const Case& c) { return c.success && totalMs(c) <= 100.0; });
  s["success_rate_1s"] =
      share(all, [](const Case& c) { return c.success && totalMs(c) <= 1000.0; });
  s["way_found_rate"] = share(all, foundAWay);
  s["first_solution_ms_median"] = quantileOf(found, 0.5, firstMs);
  s["total_ms_median"] = quantileOf(all, 0.5, totalMs);
  s["total_ms_p95"] = quantileOf(all, 0.95, totalMs);
  s["total_ms_mean"] = mean(all, totalMs);
  s["mean_speed_mps"] = mean(solved, speed);
  s["length_ratio_median"] = quantileOf(withShortest(solved), 0.5, lengthRatio);
  s["length_m_mean"] = mean(solved, [](const Case& c) { return c.figures.length_m; });
  s["duration_s_mean"] = mean(solved, [](const Case& c) { return c.figures.duration_s; });
  s["cost_mean"] = mean(solved, [](const Case& c) { return c.figures.cost; });
  s["node_utilization_mean"] = mean(all, [](const Case& c) { return c.figures.node_utilization; });
  return s;
}

json profileOf(const planner::Figures& f) {
  return {{"guide_ms", f.guide_ms},
          {"tree_ms", f.tree_ms},
          {"optimize_ms", f.optimize_ms},
          {"verify_ms", f.verify_ms}};
}

json caseJson(const Case& c) {
  json j = {{"scenario", c.scenario},
            {"mission", c.mission},
            {"kind", c.kind},
            {"seed", c.seed},
            {"method", c.method},
            {"success", c.success},
            {"reason", c.reason},
            {"first_solution_ms", nullptr},
            {"total_ms", c.figures.total_ms},
            {"length_m", c.figures.length_m},
            {"duration_s", c.figures.duration_s},
            {"cost", c.figures.cost},
            {"node_utilization", c.figures.node_utilization},
            {"samples", c.figures.samples},
            {"nodes", c.figures.nodes},
            {"local_repairs", c.figures.local_repairs},
            {"attempts", c.figures.attempts},
            {"shortest_m", c.shortest_m},
            {"profile", profileOf(c.figures)},
            {"dump", c.dump}};
  if (foundAWay(c)) {
    j["first_solution_ms"] = c.figures.first_solution_ms;
  }
  return j;
}

struct PaperRow {
  const char* method;
  double length_m, duration_s, cost, utilization, time_ms, success;
};
constexpr PaperRow kPaper[] = {{"baseline", 71.4, 20.5, 24.3, 29.7, 58.1, 86},
                               {"local", 71.8, 20.8, 24.2, 40.6, 47.8, 96},
                               {"global", 69.6, 21.6, 22.1, 30.8, 60.2, 84},
                               {"proposed", 69.3, 21.3, 21.9, 41.8, 45.6, 98}};

void print(std::ostream& out, const char* format, const std::vector<double>& v,
           const std::string& name) {
  char line[256];
  std::snprintf(line, sizeof(line), format, name.c_str(), v[0], v[1], v[2], v[3], v[4], v[5]);
  out << line;
}

void printPaperTable(const json& kinds, std::ostream& out) {
  const char* kFormat = "  %-20s %8.1f %8.1f %8.1f %8.1f %9.2f %8.1f\n";
  out << "  method                len m   time s     cost   util %   algo ms   succ %\n";
  for (const auto& [method, s] : kinds.items()) {
    print(out, kFormat,
          {s["length_m_mean"], s["duration_s_mean"], s["cost_mean"],
           100.0 * s["node_utilization_mean"].get<double>(), s["total_ms_mean"],
           100.0 * s["success_rate_100ms"].get<double>()},
          method);
    for (const PaperRow& row : kPaper) {
      if (method == row.method) {
        print(out, kFormat,
              {row.length_m, row.duration_s, row.cost, row.utilization, row.time_ms, row.success},
              "  the paper's");
      }
    }
  }
}

void printTimes(const json& kinds, std::ostream& out) {
  out << "  method             first ms   total ms     95th %   1 s succ %    m/s   length ratio\n";
  for (const auto& [method, s] : kinds.items()) {
    print(
        out, "  %-16s %10.2f %10.2f %10.2f %12.1f %6.2f %14.3f\n",
        {s["first_solution_ms_median"], s["total_ms_median"], s["total_ms_p95"],
         100.0 * s["success_rate_1s"].get<double>(), s["mean_speed_mps"], s["length_ratio_median"]},
        method);
  }
}

void printProfile(const Outcome& outcome, const std::string& kind, const std::string& method,
                  std::ostream& out) {
  const Cases all = select(outcome, kind, method, false);
  const std::vector<std::pair<const char*, Figure>> parts = {
      {"guide path", [](const Case& c) { return c.figures.guide_ms; }},
      {"trees", [](const Case& c) { return c.figures.tree_ms; }},
      {"optimisation", [](const Case& c) { return c.figures.optimize_ms; }},
      {"verification", [](const Case& c) { return c.figures.verify_ms; }},
      {"total", totalMs}};
  out << "  " << method << ": time by part, ms (median, 95th, mean)\n";
  for (const auto& [name, figure] : parts) {
    char line[128];
    std::snprintf(line, sizeof(line), "    %-14s %8.3f %8.3f %8.3f\n", name,
                  quantileOf(all, 0.5, figure), quantileOf(all, 0.95, figure), mean(all, figure));
    out << line;
  }
}

}  // namespace

json toJson(const Outcome& outcome, const Request& request) {
  json j;
  j["vessel"] = outcome.vessel;
  j["map"] = request.map;
  j["budget_ms"] = request.budget_ms;
  j["clock"] = request.clock;
  j["distance_field_ms"] = outcome.field_ms;
  j["cases"] = json::array();
  for (const Case& c : outcome.cases) {
    j["cases"].push_back(caseJson(c));
  }
  j["summary"] = json::object();
  for (const std::string kind : {"local", "cross"}) {
    for (const std::string& method : request.methods) {
      const Cases all = select(outcome, kind, method, false);
      if (!all.empty()) {
        j["summary"][kind][method] = summarise(all, select(outcome, kind, method, true));
      }
    }
  }
  return j;
}

void printTable(const Outcome& outcome, const Request& request, bool profile, std::ostream& out) {
  const json summary = toJson(outcome, request)["summary"];
  for (const auto& [kind, methods] : summary.items()) {
    out << "\n"
        << kind << " missions, vessel " << outcome.vessel << ", " << request.map
        << " maps (success: verified whole, within 100 ms)\n";
    printPaperTable(methods, out);
    printTimes(methods, out);
    for (const auto& [method, figures] : methods.items()) {
      if (profile) {
        printProfile(outcome, kind, method, out);
      }
    }
  }
  double field = 0.0;
  for (const double ms : outcome.field_ms) {
    field += ms / static_cast<double>(outcome.field_ms.size());
  }
  char line[128];
  std::snprintf(line, sizeof(line),
                "\ndistance field (apart from the times above): %.1f ms a map\n", field);
  out << line;
}

void printRefused(const Outcome& outcome, std::ostream& out) {
  for (const Case& c : outcome.cases) {
    if (!c.success) {
      out << c.scenario << " " << c.mission << ", " << c.method << ", seed " << c.seed << ": "
          << c.reason << "\n";
    }
  }
}

}  // namespace otter_nav::benchmark
