#include "otter_nav/vessel/parameters.hpp"

#include <array>
#include <charconv>
#include <sstream>

namespace otter_nav::vessel {
namespace {

constexpr config::Range kPositive{1e-6, 1e6};
constexpr config::Range kNotNegative{0.0, 1e6};
constexpr config::Range kAny{-1e6, 1e6};

Status readPaper(config::Section section, PaperModel& model) {
  section.read("m1_kg", model.m1_kg, kPositive);
  section.read("m2_kgm2", model.m2_kgm2, kPositive);
  section.read("d1_kgps", model.d1_kgps, kPositive);
  section.read("d2_kgps", model.d2_kgps, kPositive);
  section.read("d3_kgm2ps", model.d3_kgm2ps, kPositive);
  return section.finish();
}

Status readManoeuvring(config::Section section, ManoeuvringModel& model) {
  section.read("surge_inertia_kg", model.surge_inertia_kg, kPositive);
  section.read("sway_inertia_kg", model.sway_inertia_kg, kPositive);
  section.read("yaw_inertia_kgm2", model.yaw_inertia_kgm2, kPositive);
  section.read("surge_centripetal_kg", model.surge_centripetal_kg, kAny);
  section.read("sway_centripetal_kg", model.sway_centripetal_kg, kAny);
  section.read("munk_kg", model.munk_kg, kAny);
  section.read("surge_drag_kgps", model.surge_drag_kgps, kNotNegative);
  section.read("sway_drag_kgps", model.sway_drag_kgps, kNotNegative);
  section.read("yaw_drag_kgm2ps", model.yaw_drag_kgm2ps, kNotNegative);
  section.read("surge_drag_quadratic_kgpm", model.surge_drag_quadratic_kgpm, kNotNegative);
  section.read("sway_drag_quadratic_kgpm", model.sway_drag_quadratic_kgpm, kNotNegative);
  section.read("yaw_drag_quadratic_kgm2", model.yaw_drag_quadratic_kgm2, kNotNegative);
  section.read("sway_from_yaw_kgmps", model.sway_from_yaw_kgmps, kAny);
  section.read("yaw_from_sway_kgmps", model.yaw_from_sway_kgmps, kAny);
  if (section.has("wind_surge_kgpm")) {
    section.read("wind_surge_kgpm", model.wind_surge_kgpm, kNotNegative);
    section.read("wind_sway_kgpm", model.wind_sway_kgpm, kNotNegative);
    section.read("wind_yaw_kg", model.wind_yaw_kg, kAny);
  }
  return section.finish();
}

Status readThrusters(config::Section section, Thrusters& thrusters) {
  section.read("lever_arm_m", thrusters.lever_arm_m, kPositive);
  section.read("ahead_max_n", thrusters.ahead_max_n, kPositive);
  section.read("astern_max_n", thrusters.astern_max_n, kNotNegative);
  if (section.has("lag_s")) {
    section.read("lag_s", thrusters.lag_s, kNotNegative);
  }
  return section.finish();
}

Status readHull(config::Section section, Hull& hull) {
  section.read("length_m", hull.length_m, kPositive);
  section.read("beam_m", hull.beam_m, kPositive);
  return section.finish();
}

// The shortest text that reads back to the same number.
std::string text(double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), end.ptr};
}

}  // namespace

ManoeuvringModel ManoeuvringModel::fromPaper(const PaperModel& paper) {
  ManoeuvringModel model;
  model.surge_inertia_kg = paper.m1_kg;
  model.sway_inertia_kg = paper.m1_kg;
  model.yaw_inertia_kgm2 = paper.m2_kgm2;
  model.surge_centripetal_kg = paper.m1_kg;
  model.sway_centripetal_kg = paper.m1_kg;
  model.surge_drag_kgps = paper.d1_kgps;
  model.sway_drag_kgps = paper.d2_kgps;
  model.yaw_drag_kgm2ps = paper.d3_kgm2ps;
  return model;
}

Result<Parameters> readParameters(config::Section section) {
  Parameters parameters;
  section.read("name", parameters.name);
  section.read("top_speed_mps", parameters.top_speed_mps, kPositive);
  const bool has_manoeuvring = section.has("manoeuvring_model");
  Status status = readPaper(section.child("paper_model"), parameters.paper);
  if (status) {
    status = readThrusters(section.child("thrusters"), parameters.thrusters);
  }
  if (status) {
    status = readHull(section.child("hull"), parameters.hull);
  }
  if (status && has_manoeuvring) {
    status = readManoeuvring(section.child("manoeuvring_model"), parameters.manoeuvring);
  } else if (status) {
    parameters.manoeuvring = ManoeuvringModel::fromPaper(parameters.paper);
  }
  if (status) {
    status = section.finish();
  }
  if (!status) {
    return failure(status.error().message);
  }
  return parameters;
}

Result<Parameters> loadParameters(const std::string& path) {
  const Result<YAML::Node> node = config::loadFile(path);
  if (!node) {
    return failure(node.error().message);
  }
  return readParameters(config::Section(*node, path));
}

Parameters withThrustShare(const Parameters& parameters, double share) {
  Parameters less = parameters;
  less.thrusters.ahead_max_n *= share;
  less.thrusters.astern_max_n *= share;
  less.top_speed_mps *= share;
  return less;
}

std::string toYaml(const Parameters& p) {
  std::ostringstream out;
  out << "name: " << p.name << "\ntop_speed_mps: " << text(p.top_speed_mps);
  out << "\npaper_model:\n  m1_kg: " << text(p.paper.m1_kg)
      << "\n  m2_kgm2: " << text(p.paper.m2_kgm2) << "\n  d1_kgps: " << text(p.paper.d1_kgps)
      << "\n  d2_kgps: " << text(p.paper.d2_kgps) << "\n  d3_kgm2ps: " << text(p.paper.d3_kgm2ps);
  const ManoeuvringModel& m = p.manoeuvring;
  out << "\nmanoeuvring_model:\n  surge_inertia_kg: " << text(m.surge_inertia_kg)
      << "\n  sway_inertia_kg: " << text(m.sway_inertia_kg)
      << "\n  yaw_inertia_kgm2: " << text(m.yaw_inertia_kgm2)
      << "\n  surge_centripetal_kg: " << text(m.surge_centripetal_kg)
      << "\n  sway_centripetal_kg: " << text(m.sway_centripetal_kg)
      << "\n  munk_kg: " << text(m.munk_kg) << "\n  surge_drag_kgps: " << text(m.surge_drag_kgps)
      << "\n  sway_drag_kgps: " << text(m.sway_drag_kgps)
      << "\n  yaw_drag_kgm2ps: " << text(m.yaw_drag_kgm2ps)
      << "\n  surge_drag_quadratic_kgpm: " << text(m.surge_drag_quadratic_kgpm)
      << "\n  sway_drag_quadratic_kgpm: " << text(m.sway_drag_quadratic_kgpm)
      << "\n  yaw_drag_quadratic_kgm2: " << text(m.yaw_drag_quadratic_kgm2)
      << "\n  sway_from_yaw_kgmps: " << text(m.sway_from_yaw_kgmps)
      << "\n  yaw_from_sway_kgmps: " << text(m.yaw_from_sway_kgmps);
  if (m.feelsWind()) {
    out << "\n  wind_surge_kgpm: " << text(m.wind_surge_kgpm)
        << "\n  wind_sway_kgpm: " << text(m.wind_sway_kgpm)
        << "\n  wind_yaw_kg: " << text(m.wind_yaw_kg);
  }
  out << "\nthrusters:\n  lever_arm_m: " << text(p.thrusters.lever_arm_m)
      << "\n  ahead_max_n: " << text(p.thrusters.ahead_max_n)
      << "\n  astern_max_n: " << text(p.thrusters.astern_max_n)
      << "\n  lag_s: " << text(p.thrusters.lag_s);
  out << "\nhull:\n  length_m: " << text(p.hull.length_m) << "\n  beam_m: " << text(p.hull.beam_m)
      << "\n";
  return out.str();
}

}  // namespace otter_nav::vessel
