// The optimal control problems the solver's tests share.
#pragma once

#include <cmath>
#include <memory>

#include "otter_nav/vessel/parameters.hpp"
#include "tracker/ocp/rti_solver.hpp"

namespace otter_nav::tracker::test {

struct Problem {
  vessel::Parameters vessel;
  OcpOptions options;
  RtiOptions rti;
  vessel::Disturbance disturbance;
  std::array<WaterMotion, kMaxStages> water;
  vessel::State measured;
  std::unique_ptr<OcpReference> reference = std::make_unique<OcpReference>();
};

// A circle of 20 m at 3 m/s; the vessel starts `aside_m` from it, and on it has
// thrust enough.
inline Problem circle(int stages, double aside_m) {
  Problem p;
  p.vessel.manoeuvring.sway_centripetal_kg = 30.0;
  p.vessel.manoeuvring.munk_kg = 3.0;
  p.vessel.manoeuvring.wind_surge_kgpm = 0.5;
  p.vessel.manoeuvring.wind_sway_kgpm = 0.4;
  p.vessel.manoeuvring.wind_yaw_kg = -0.3;
  p.vessel.manoeuvring.surge_drag_quadratic_kgpm = 2.0;
  p.options.stages = stages;
  p.options.step_s = 2.0 / stages;
  vessel::State q;
  q << 100.0, 100.0, 1.0, 1.0, 1.0, 1.0;
  p.options.weights.state = q * p.options.step_s;
  p.options.weights.terminal = q;
  p.options.weights.thrusts.setConstant(1e-3 * p.options.step_s);
  p.options.lower_n.setConstant(aside_m > 0.0 ? -40.0 : -200.0);
  p.options.upper_n.setConstant(aside_m > 0.0 ? 50.0 : 200.0);
  p.disturbance.force_n = {3.0, 8.0};
  p.disturbance.current_mps = {0.3, -0.2};
  p.disturbance.moment_nm = 1.0;
  p.disturbance.wind_mps = {1.5, -4.0};
  p.reference->fading_per_s = 0.3;
  p.measured << 20.0 - aside_m, 0.02, 1.57, 2.98, 0.05, 0.15;
  for (int k = 0; k <= stages; ++k) {
    const double angle = 0.15 * k * p.options.step_s;
    p.reference->states[k] << 20.0 * std::cos(angle), 20.0 * std::sin(angle), 1.5707963 + angle,
        3.0, 0.0, 0.15;
    p.reference->attitude[k] = k % 3 == 0 ? 0.2 : 1.0;
    if (k < stages) {
      p.reference->thrusts[k] << 30.0, 32.0;
    }
  }
  return p;
}

}  // namespace otter_nav::tracker::test
