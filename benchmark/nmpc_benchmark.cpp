// One step of the tracker's optimal control: preparation, feedback and total time of the real-time
// iteration, or the whole solution by Ipopt.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "otter_nav/base/progress_line.hpp"
#include "tracker/ocp/rti_solver.hpp"
#include "tracking/nmpc_cases.hpp"
#include "tracking/oracle/ipopt_solver.hpp"
#include "tracking/percentiles.hpp"

namespace {

using namespace otter_nav;
using benchmark::NmpcCycles;

struct Arguments {
  int horizon = 20;
  std::string kase = "nominal";
  std::string solver = "rti";
  std::string vessel = "otter_gazebo";
  std::string out;
  int cycles = 0;
};

struct Times {
  std::vector<double> preparation_us;
  std::vector<double> feedback_us;
  std::vector<double> total_us;
  int unsolved = 0;
};

double now() {
  return std::chrono::duration<double, std::micro>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

Times timeRti(NmpcCycles& cycles, int count, const vessel::Parameters& vessel) {
  auto solver = std::make_unique<tracker::RtiSolver>(cycles.ocp(), tracker::RtiOptions{},
                                                     vessel.manoeuvring, vessel.thrusters);
  auto reference = std::make_unique<tracker::OcpReference>();
  solver->setDisturbance(cycles.disturbance());
  cycles.fill(*reference);
  solver->initialize(*reference);
  Times times;
  ProgressLine bar(std::cerr, isatty(STDERR_FILENO) != 0);
  for (int i = 0; i < count; ++i) {
    cycles.fill(*reference);
    const double start = now();
    solver->shift(i == 0 ? 0.0 : NmpcCycles::period() / cycles.ocp().step_s);
    solver->prepare(*reference);
    const double prepared = now();
    const tracker::SolverStatus status = solver->feedback(cycles.state());
    const double done = now();
    times.preparation_us.push_back(prepared - start);
    times.feedback_us.push_back(done - prepared);
    times.total_us.push_back(done - start);
    times.unsolved += status == tracker::SolverStatus::kSolved ? 0 : 1;
    cycles.advance(solver->thrusts()[0]);
    if (i % 100 == 99) {
      bar.show(i + 1, count);
    }
  }
  return times;
}

Times timeIpopt(NmpcCycles& cycles, int count, const vessel::Parameters& vessel) {
  tracker::IpoptSolver solver(cycles.ocp(), vessel.manoeuvring, vessel.thrusters);
  auto reference = std::make_unique<tracker::OcpReference>();
  tracker::IpoptSolution last;
  Times times;
  ProgressLine bar(std::cerr, isatty(STDERR_FILENO) != 0);
  for (int i = 0; i < count; ++i) {
    cycles.fill(*reference);
    const double start = now();
    auto solution = solver.solve(cycles.state(), *reference, cycles.disturbance(),
                                 last.thrusts.empty() ? nullptr : &last);
    const double done = now();
    times.preparation_us.push_back(0.0);
    times.feedback_us.push_back(done - start);
    times.total_us.push_back(done - start);
    if (solution) {
      last = std::move(*solution);
    } else {
      ++times.unsolved;
    }
    cycles.advance(last.thrusts.empty() ? vessel::Thrusts::Zero().eval() : last.thrusts[0]);
    if (i % 10 == 9) {
      bar.show(i + 1, count);
    }
  }
  return times;
}

nlohmann::json toJson(const benchmark::Percentiles& p) {
  return {{"median", p.median}, {"p99", p.p99}, {"max", p.max}};
}

void print(const char* what, const benchmark::Percentiles& p) {
  std::printf("%-14s median %9.2f us   99 %% %9.2f us   max %9.2f us\n", what, p.median, p.p99,
              p.max);
}

int runOnce(const Arguments& a, const vessel::Parameters& vessel) {
  const bool rti = a.solver == "rti";
  const int count = a.cycles > 0 ? a.cycles : rti ? 20000 : 500;
  NmpcCycles cycles(
      a.kase == "saturated" ? benchmark::NmpcCase::kSaturated : benchmark::NmpcCase::kNominal,
      a.horizon, 2.0, vessel);
  const Times times = rti ? timeRti(cycles, count, vessel) : timeIpopt(cycles, count, vessel);
  const auto preparation = benchmark::percentiles(times.preparation_us);
  const auto feedback = benchmark::percentiles(times.feedback_us);
  const auto total = benchmark::percentiles(times.total_us);
  std::printf("%s, N = %d, %s, %d cycles at 100 Hz, %d unsolved\n", a.solver.c_str(), a.horizon,
              a.kase.c_str(), count, times.unsolved);
  print("preparation", preparation);
  print("feedback", feedback);
  print("total", total);
  if (!a.out.empty()) {
    std::ofstream out(a.out);
    const nlohmann::json json = {{"preparation_us", toJson(preparation)},
                                 {"feedback_us", toJson(feedback)},
                                 {"total_us", toJson(total)}};
    out << json.dump(2) << "\n";
    if (!out) {
      std::cerr << "nmpc_benchmark: " << a.out << ": cannot be written\n";
      return 1;
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app("Times of one step of the tracker's optimal control, 2 s horizon.");
  app.add_option("--horizon", a.horizon, "stages")
      ->check(CLI::Range(1, tracker::kMaxStages))
      ->capture_default_str();
  app.add_option("--case", a.kase, "nominal or saturated")
      ->check(CLI::IsMember({"nominal", "saturated"}))
      ->capture_default_str();
  app.add_option("--solver", a.solver, "rti or ipopt")
      ->check(CLI::IsMember({"rti", "ipopt"}))
      ->capture_default_str();
  app.add_option("--vessel", a.vessel, "NAME of config/vessels or a YAML file")
      ->capture_default_str();
  app.add_option("--cycles", a.cycles, "default 20000 (rti), 500 (ipopt)")
      ->check(CLI::Range(1, 100000000));
  app.add_option("--out", a.out, "JSON of the times");
  CLI11_PARSE(app, argc, argv);
  const auto vessel = vessel::loadParameters(a.vessel);
  if (!vessel) {
    std::cerr << "nmpc_benchmark: " << vessel.error().message << "\n";
    return 1;
  }
  return runOnce(a, *vessel);
}
