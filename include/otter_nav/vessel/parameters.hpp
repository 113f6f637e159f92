// What a vessel is: its planar models, thrusters and hull. One YAML file a vessel
// (config/vessels), read by every node and program.
#pragma once

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"

namespace otter_nav::vessel {

// Ranges of coefficients: inertias, drags, terms of either sign.
constexpr config::Range kPositive{1e-6, 1e6};
constexpr config::Range kNotNegative{0.0, 1e6};
constexpr config::Range kEitherSign{-1e6, 1e6};

// Each struct's describe() is the one list of its numbers: key with unit, member, range, meaning.
// Reader, writer, identification and reports go through it (config/fields.hpp).

// h = [m1, m2, d1, d2, d3] of the paper's model (equation 1 with the consistent Coriolis matrix).
struct PaperModel {
  double m1_kg = 35.0;
  double m2_kgm2 = 11.0;
  double d1_kgps = 20.0;
  double d2_kgps = 20.0;
  double d3_kgm2ps = 20.0;

  template <typename Self, typename Fields>
  static constexpr void describe(Self& m, Fields& fields) {
    fields("m1_kg", m.m1_kg, kPositive, "inertia in surge and sway, added mass included");
    fields("m2_kgm2", m.m2_kgm2, kPositive, "inertia in yaw");
    fields("d1_kgps", m.d1_kgps, kPositive, "linear drag in surge, N per m/s");
    fields("d2_kgps", m.d2_kgps, kPositive, "linear drag in sway, N per m/s");
    fields("d3_kgm2ps", m.d3_kgm2ps, kPositive, "linear drag in yaw, N m per rad/s");
  }
};

// The tracker's model: the same three equations with every coefficient free (Fossen 2021, chapter
// 6.5), for hulls whose sway inertia, drag or yaw damping the paper's five numbers cannot hold. The
// equations stand in vessel/motion_law.hpp. fromPaper() gives the paper's model exactly. Number is
// double, or a dual number where derivatives by the coefficients are wanted.
template <typename Number>
struct BasicManoeuvringModel {
  Number surge_inertia_kg = 35.0;
  Number sway_inertia_kg = 35.0;
  Number yaw_inertia_kgm2 = 11.0;
  Number surge_centripetal_kg = 35.0;
  Number sway_centripetal_kg = 35.0;
  Number munk_kg = 0.0;
  Number surge_drag_kgps = 20.0;
  Number sway_drag_kgps = 20.0;
  Number yaw_drag_kgm2ps = 20.0;
  Number surge_drag_quadratic_kgpm = 0.0;
  Number sway_drag_quadratic_kgpm = 0.0;
  Number yaw_drag_quadratic_kgm2 = 0.0;
  Number sway_from_yaw_kgmps = 0.0;
  Number yaw_from_sway_kgmps = 0.0;
  Number wind_surge_kgpm = 0.0;
  Number wind_sway_kgpm = 0.0;
  Number wind_yaw_kg = 0.0;

  [[nodiscard]] bool feelsWind() const {
    return wind_surge_kgpm != 0.0 || wind_sway_kgpm != 0.0 || wind_yaw_kg != 0.0;
  }
  static BasicManoeuvringModel fromPaper(const PaperModel& paper) {
    BasicManoeuvringModel model;
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

  template <typename Self, typename Fields>
  static constexpr void describe(Self& m, Fields& fields) {
    fields("surge_inertia_kg", m.surge_inertia_kg, kPositive, "added mass included, as below");
    fields("sway_inertia_kg", m.sway_inertia_kg, kPositive, "");
    fields("yaw_inertia_kgm2", m.yaw_inertia_kgm2, kPositive, "");
    fields("surge_centripetal_kg", m.surge_centripetal_kg, kEitherSign, "surge force by v r");
    fields("sway_centripetal_kg", m.sway_centripetal_kg, kEitherSign, "sway force by -u r");
    fields("munk_kg", m.munk_kg, kEitherSign, "yaw moment by -u v");
    fields("surge_drag_kgps", m.surge_drag_kgps, kNotNegative, "linear");
    fields("sway_drag_kgps", m.sway_drag_kgps, kNotNegative, "");
    fields("yaw_drag_kgm2ps", m.yaw_drag_kgm2ps, kNotNegative, "");
    fields("surge_drag_quadratic_kgpm", m.surge_drag_quadratic_kgpm, kNotNegative, "by |u| u");
    fields("sway_drag_quadratic_kgpm", m.sway_drag_quadratic_kgpm, kNotNegative, "by |v| v");
    fields("yaw_drag_quadratic_kgm2", m.yaw_drag_quadratic_kgm2, kNotNegative, "by |r| r");
    fields("sway_from_yaw_kgmps", m.sway_from_yaw_kgmps, kEitherSign, "sway force by -r");
    fields("yaw_from_sway_kgmps", m.yaw_from_sway_kgmps, kEitherSign, "yaw moment by -v");
    fields.optional("wind_surge_kgpm", m.wind_surge_kgpm, kNotNegative, "wind: by |wx| wx");
    fields.optional("wind_sway_kgpm", m.wind_sway_kgpm, kNotNegative, "by |wy| wy");
    fields.optional("wind_yaw_kg", m.wind_yaw_kg, kEitherSign, "yaw moment by wx wy");
  }
};
using ManoeuvringModel = BasicManoeuvringModel<double>;

// Two fixed thrusters, `lever_arm_m` to port and starboard of the centre line.
struct Thrusters {
  double lever_arm_m = 0.39;
  double ahead_max_n = 50.0;
  double astern_max_n = 50.0;
  double lag_s = 0.0;

  template <typename Self, typename Fields>
  static constexpr void describe(Self& t, Fields& fields) {
    fields("lever_arm_m", t.lever_arm_m, kPositive, "of each from the centre line");
    fields("ahead_max_n", t.ahead_max_n, kPositive, "a side");
    fields("astern_max_n", t.astern_max_n, kNotNegative, "a side, a positive number");
    fields.optional("lag_s", t.lag_s, kNotNegative, "time constant of thrust behind its command");
  }
};

struct Hull {
  double length_m = 2.0;
  double beam_m = 1.08;

  template <typename Self, typename Fields>
  static constexpr void describe(Self& h, Fields& fields) {
    fields("length_m", h.length_m, kPositive, "over all");
    fields("beam_m", h.beam_m, kPositive, "over all");
  }
};

struct Parameters {
  std::string name = "otter_gazebo";
  PaperModel paper;
  ManoeuvringModel manoeuvring;
  Thrusters thrusters;
  Hull hull;
  double top_speed_mps = 5.0;
  double speed_max_mps = 0.0;
  // What sails for it in simulation: `planar` is the manoeuvring model above, `otter` and
  // `otter_gazebo` are plants of their own (docs/plant.md).
  std::string plant_model = "planar";

  template <typename Self, typename Fields>
  static void describe(Self& p, Fields& fields) {
    fields("name", p.name, "of the vessel");
    fields("top_speed_mps", p.top_speed_mps, kPositive, "steady surge at full thrust");
    fields.optional("speed_max_mps", p.speed_max_mps, kNotNegative,
                    "over ground, that it may go; 0: as fast as it can");
    fields.optionalText("plant_model", p.plant_model, {"planar", "otter", "otter_gazebo"},
                        "what sails for it in simulation");
    fields.group("paper_model", p.paper, "the planner's");
    fields.optionalGroup("manoeuvring_model", p.manoeuvring, "the tracker's");
    fields.group("thrusters", p.thrusters, "two fixed ones");
    fields.group("hull", p.hull, "outline, centred on base_link");
  }
};

// Reads config/vessels/NAME.yaml or another file. One without `manoeuvring_model` gets fromPaper().
[[nodiscard]] Result<Parameters> loadParameters(const std::string& name_or_path);
[[nodiscard]] Result<Parameters> readParameters(config::Section section);
// The YAML text loadParameters() reads back to the same numbers.
[[nodiscard]] std::string toYaml(const Parameters& parameters);

}  // namespace otter_nav::vessel
