// What a vessel is: its planar models, thrusters and hull. One YAML file a vessel
// (config/vessels), read by every node and program.
#pragma once

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"

namespace otter_nav::vessel {

// h = [m1, m2, d1, d2, d3] of the paper's model (equation 1 with the consistent Coriolis matrix).
struct PaperModel {
  double m1_kg = 35.0;      // inertia in surge and sway, added mass included
  double m2_kgm2 = 11.0;    // inertia in yaw
  double d1_kgps = 20.0;    // linear drag in surge, N per m/s
  double d2_kgps = 20.0;    // linear drag in sway, N per m/s
  double d3_kgm2ps = 20.0;  // linear drag in yaw, N m per rad/s
};

// The tracker's model: the same three equations with every coefficient free (Fossen 2021, chapter
// 6.5), for hulls whose sway inertia, drag or yaw damping the paper's five numbers cannot hold.
//   surge_inertia u' = surge_centripetal v r + tau_u - surge_drag u - surge_drag_quadratic |u| u
//   sway_inertia  v' = -sway_centripetal u r - sway_drag v - sway_drag_quadratic |v| v
//                      - sway_from_yaw r
//   yaw_inertia   r' = tau_r - yaw_drag r - yaw_drag_quadratic |r| r - munk u v - yaw_from_sway v
// with u, v through the water. fromPaper() gives the paper's model exactly.
struct ManoeuvringModel {
  double surge_inertia_kg = 35.0;
  double sway_inertia_kg = 35.0;
  double yaw_inertia_kgm2 = 11.0;
  double surge_centripetal_kg = 35.0;
  double sway_centripetal_kg = 35.0;
  double munk_kg = 0.0;
  double surge_drag_kgps = 20.0;
  double sway_drag_kgps = 20.0;
  double yaw_drag_kgm2ps = 20.0;
  double surge_drag_quadratic_kgpm = 0.0;
  double sway_drag_quadratic_kgpm = 0.0;
  double yaw_drag_quadratic_kgm2 = 0.0;
  double sway_from_yaw_kgmps = 0.0;
  double yaw_from_sway_kgmps = 0.0;
  // Wind w over the water, seen from the body: wind_surge |wx| wx ahead, wind_sway |wy| wy to port
  // and wind_yaw wx wy about the yaw axis (Fossen 2021, section 10.1, written without angles; the
  // hull's own speed is small beside the wind's). Zero, and optional in files: no wind loads.
  double wind_surge_kgpm = 0.0;
  double wind_sway_kgpm = 0.0;
  double wind_yaw_kg = 0.0;

  [[nodiscard]] bool feelsWind() const {
    return wind_surge_kgpm != 0.0 || wind_sway_kgpm != 0.0 || wind_yaw_kg != 0.0;
  }
  static ManoeuvringModel fromPaper(const PaperModel& paper);
};

// Two fixed thrusters, `lever_arm_m` to port and starboard of the centre line.
struct Thrusters {
  double lever_arm_m = 0.39;
  double ahead_max_n = 50.0;   // per side
  double astern_max_n = 50.0;  // per side, a positive number
  double lag_s = 0.0;          // time constant of the thrust behind its command; optional in files
};

struct Hull {
  double length_m = 2.0;
  double beam_m = 1.08;
};

struct Parameters {
  std::string name = "otter_gazebo";
  PaperModel paper;
  ManoeuvringModel manoeuvring;
  Thrusters thrusters;
  Hull hull;
  double top_speed_mps = 5.0;  // steady surge at full thrust
};

// The vessel as it is with `share` of its thrust, in (0, 1]: what is left beside the rest kept for
// wind and current. The top speed falls with it, as under linear drag.
[[nodiscard]] Parameters withThrustShare(const Parameters& parameters, double share);

// Reads config/vessels/NAME.yaml. A file without `manoeuvring_model` gets fromPaper().
[[nodiscard]] Result<Parameters> loadParameters(const std::string& path);
[[nodiscard]] Result<Parameters> readParameters(config::Section section);
// The YAML text loadParameters() reads back to the same numbers.
[[nodiscard]] std::string toYaml(const Parameters& parameters);

}  // namespace otter_nav::vessel
