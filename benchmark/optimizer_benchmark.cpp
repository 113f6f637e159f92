// The global optimiser by itself: every mission of a folder of scenarios, along a guide path.
//   optimizer_benchmark --scenarios DIR [--map world] [--kind all] [--vessel otter_gazebo] [-v]
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <queue>
#include <sstream>

#include "otter_nav/config/share.hpp"
#include "otter_nav/map/chart.hpp"
#include "otter_nav/mission/scenario.hpp"
#include "otter_nav/optimizer/global_optimizer.hpp"
#include "otter_nav/trajectory/trajectory.hpp"

namespace {

using namespace otter_nav;

double cpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<Eigen::Vector2d> findWay(const map::DistanceField& field, const Eigen::Vector2d& a,
                                     const Eigen::Vector2d& b) {
  const auto& g = field.geometry();
  const double need = 0.85;
  std::vector<float> cost(static_cast<std::size_t>(g.width) * g.height, 1e9F);
  std::vector<int> parent(cost.size(), -1);
  using Item = std::pair<float, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
  const Eigen::Vector2i ca = g.cellAt(a), cb = g.cellAt(b);
  const auto id = [&](int x, int y) { return y * g.width + x; };
  const auto h = [&](int x, int y) {
    return static_cast<float>(std::hypot(x - cb.x(), y - cb.y()));
  };
  cost[id(ca.x(), ca.y())] = 0;
  open.push({h(ca.x(), ca.y()), id(ca.x(), ca.y())});
  while (!open.empty()) {
    const auto [f, i] = open.top();
    open.pop();
    const int x = i % g.width, y = i / g.width;
    if (i == id(cb.x(), cb.y())) break;
    if (f > cost[i] + h(x, y) + 1e-3) continue;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        const int nx = x + dx, ny = y + dy;
        if ((dx == 0 && dy == 0) || !g.containsCell(nx, ny)) continue;
        if (field.clearance(g.centreOf(nx, ny)) < need) continue;
        const float c = cost[i] + static_cast<float>(std::hypot(dx, dy));
        if (c < cost[id(nx, ny)]) {
          cost[id(nx, ny)] = c;
          parent[id(nx, ny)] = i;
          open.push({c + h(nx, ny), id(nx, ny)});
        }
      }
  }
  std::vector<Eigen::Vector2d> raw;
  for (int i = id(cb.x(), cb.y()); i >= 0; i = parent[i])
    raw.push_back(g.centreOf(i % g.width, i / g.width));
  std::reverse(raw.begin(), raw.end());
  raw.front() = a;
  raw.back() = b;
  std::vector<Eigen::Vector2d> way{a};
  std::size_t at = 0;
  while (at + 1 < raw.size()) {
    std::size_t next = at + 1;
    for (std::size_t j = raw.size() - 1; j > at + 1; --j)
      if (map::segmentIsClear(field, raw[at], raw[j], 0.82)) {
        next = j;
        break;
      }
    way.push_back(raw[next]);
    at = next;
  }
  return way;
}

double median(std::vector<double> v, double q = 0.5) {
  if (v.empty()) return 0.0;
  std::sort(v.begin(), v.end());
  return v[std::min(v.size() - 1, static_cast<std::size_t>(q * v.size()))];
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("The global optimiser by itself");
  std::string scenarios, map_kind = "world", kind = "all", vessel_name = "otter_gazebo", dump;
  bool verbose = false;
  int only = -1;
  app.add_option("--scenarios", scenarios)->required();
  app.add_option("--map", map_kind);
  app.add_option("--kind", kind);
  app.add_option("--vessel", vessel_name);
  app.add_option("--only", only);
  app.add_option("--dump", dump);
  app.add_flag("-v", verbose);
  optimizer::GlobalOptions options;
  app.add_option("--wo", options.weight_original);
  app.add_option("--wf", options.weight_smooth_first);
  app.add_option("--growth", options.weight_growth);
  app.add_option("--spin", options.spin_angle_rad);
  app.add_option("--share", options.thrust_share);
  app.add_option("--spinshare", options.spin_thrust_share);
  app.add_option("--dilate", options.dilation_max);
  app.add_option("--vmax", options.speed_max_mps);
  app.add_option("--wmin", options.heading_force_min_n);
  app.add_option("--qr", options.quicken_rounds);
  app.add_option("--qg", options.quicken_growth);
  app.add_option("--yaw", options.yaw_rate_max_radps);
  app.add_option("--wss", options.weight_smooth_straight);
  app.add_option("--wt", options.weight_time);
  app.add_option("--wl", options.weight_length);
  app.add_option("--ws", options.weight_smooth);
  app.add_option("--wc", options.weight_clearance);
  app.add_option("--wd", options.weight_dynamics);
  app.add_option("--piece", options.piece_length_m);
  app.add_option("--iters", options.iterations_per_round);
  app.add_option("--rounds", options.rounds);
  app.add_option("--margin", options.clearance_margin_m);
  app.add_option("--tmargin", options.thrust_margin);
  CLI11_PARSE(app, argc, argv);
  const auto vessel = vessel::loadParameters(*config::vesselFile(vessel_name)).value();
  optimizer::GlobalOptimizer global(options, vessel);

  std::map<std::string, double> shortest;
  std::ifstream csv(scenarios + "/shortest.csv");
  for (std::string line; std::getline(csv, line);) {
    std::stringstream s(line);
    std::string a, b, c, d;
    std::getline(s, a, ',');
    std::getline(s, b, ',');
    std::getline(s, c, ',');
    std::getline(s, d, ',');
    if (a != "scenario") shortest[a + b] = std::stod(d);
  }
  std::map<std::string, std::vector<double>> ms, ratio, speed;
  std::map<std::string, int> ok, last, total;
  std::vector<std::filesystem::path> files;
  for (const auto& e : std::filesystem::directory_iterator(scenarios))
    if (e.path().extension() == ".yaml" &&
        e.path().stem().string().find("_chart") == std::string::npos &&
        e.path().stem().string().find("_world") == std::string::npos)
      files.push_back(e.path());
  std::sort(files.begin(), files.end());
  int index = -1;
  for (const auto& file : files) {
    const auto scenario = mission::loadScenario(file.string()).value();
    const auto grid =
        map::loadChart(map_kind == "world" ? scenario.world_path : scenario.chart_path).value();
    const map::DistanceField field(grid, {});
    for (std::size_t m = 0; m < scenario.missions.size(); ++m) {
      const auto& mission = scenario.missions[m];
      ++index;
      if ((kind != "all" && kind != mission.kind) || (only >= 0 && index != only)) continue;
      const auto way = findWay(field, mission.start.position, mission.goal.position);
      optimizer::Boundary start, goal;
      start.flat.position = mission.start.position;
      start.psi_rad = mission.start.psi_rad;
      goal.flat.position = mission.goal.position;
      goal.psi_rad = mission.goal.psi_rad;
      double best = 1e9;
      Result<optimizer::Optimized> result = failure("");
      for (int i = 0; i < 3; ++i) {
        const double t = cpuSeconds();
        result = global.optimize(field, way, start, goal, {});
        best = std::min(best, cpuSeconds() - t);
      }
      ++total[mission.kind];
      double verify_ms = 0;
      double len = 0, dur = 1;
      if (result) {
        const double t = cpuSeconds();
        (void)optimizer::verify(result->trajectory, field, vessel, start, goal,
                                global.checkOptions());
        verify_ms = 1e3 * (cpuSeconds() - t);
        len = trajectory::length(result->trajectory);
        dur = result->trajectory.duration();
        ++ok[mission.kind];
        last[mission.kind] += result->last_resort;
        ms[mission.kind].push_back(1e3 * best);
        speed[mission.kind].push_back(len / dur);
        ratio[mission.kind].push_back(len / shortest[scenario.name + std::to_string(m)]);
        if (!dump.empty()) {
          std::ofstream out(dump + "/" + scenario.name + "_" + std::to_string(m) + ".csv");
          out << "t,x,y,psi,u,v,r,tau_u,tau_r\n";
          out.precision(12);
          for (int k = 0; k * 0.02 <= dur; ++k) {
            const auto s = result->trajectory.sample(0.02 * k, vessel);
            out << s.t_s;
            for (int q = 0; q < 6; ++q) out << ',' << s.state[q];
            out << ',' << s.tau.surge_n << ',' << s.tau.yaw_nm << '\n';
          }
        }
      }
      if (verbose || !result || result->last_resort)
        std::printf(
            "%3d %s %zu %s %s it %d %.2f ms verify %.2f ms len %.1f dur %.1f v %.2f ratio %.3f clr "
            "%.2f thr %.2f %s\n",
            index, scenario.name.c_str(), m, mission.kind.c_str(), result ? "ok" : "FAIL",
            result ? result->iterations : 0, 1e3 * best, verify_ms, len, dur, len / dur,
            len / shortest[scenario.name + std::to_string(m)],
            result ? result->verification.clearance_m : 0.0,
            result ? result->verification.thrust_share : 0.0,
            result ? (result->last_resort ? "LAST RESORT" : "") : result.error().message.c_str());
    }
  }
  for (const char* k : {"local", "cross"})
    if (total[k])
      std::printf(
          "%s: %d/%d (last resort %d) ms median %.2f 95%% %.2f max %.2f | speed median %.3f min "
          "%.3f | ratio median %.4f max %.3f\n",
          k, ok[k], total[k], last[k], median(ms[k]), median(ms[k], 0.95), median(ms[k], 1.0),
          median(speed[k]), median(speed[k], 0.0), median(ratio[k]), median(ratio[k], 1.0));
}
