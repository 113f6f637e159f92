#include "otter_nav/identification/coefficients.hpp"

namespace otter_nav::identification {

const std::array<const char*, kCoefficientCount> kCoefficientNames = {
    "surge_inertia_kg",          "sway_inertia_kg",          "yaw_inertia_kgm2",
    "surge_centripetal_kg",      "sway_centripetal_kg",      "munk_kg",
    "surge_drag_kgps",           "sway_drag_kgps",           "yaw_drag_kgm2ps",
    "surge_drag_quadratic_kgpm", "sway_drag_quadratic_kgpm", "yaw_drag_quadratic_kgm2",
    "sway_from_yaw_kgmps",       "yaw_from_sway_kgmps"};

Coefficients coefficientsOf(const vessel::ManoeuvringModel& m) {
  Coefficients c;
  c << m.surge_inertia_kg, m.sway_inertia_kg, m.yaw_inertia_kgm2, m.surge_centripetal_kg,
      m.sway_centripetal_kg, m.munk_kg, m.surge_drag_kgps, m.sway_drag_kgps, m.yaw_drag_kgm2ps,
      m.surge_drag_quadratic_kgpm, m.sway_drag_quadratic_kgpm, m.yaw_drag_quadratic_kgm2,
      m.sway_from_yaw_kgmps, m.yaw_from_sway_kgmps;
  return c;
}

vessel::ManoeuvringModel modelOf(const Coefficients& c) {
  vessel::ManoeuvringModel m;
  m.surge_inertia_kg = c[kSurgeInertia];
  m.sway_inertia_kg = c[kSwayInertia];
  m.yaw_inertia_kgm2 = c[kYawInertia];
  m.surge_centripetal_kg = c[kSurgeCentripetal];
  m.sway_centripetal_kg = c[kSwayCentripetal];
  m.munk_kg = c[kMunk];
  m.surge_drag_kgps = c[kSurgeDrag];
  m.sway_drag_kgps = c[kSwayDrag];
  m.yaw_drag_kgm2ps = c[kYawDrag];
  m.surge_drag_quadratic_kgpm = c[kSurgeDragQuadratic];
  m.sway_drag_quadratic_kgpm = c[kSwayDragQuadratic];
  m.yaw_drag_quadratic_kgm2 = c[kYawDragQuadratic];
  m.sway_from_yaw_kgmps = c[kSwayFromYaw];
  m.yaw_from_sway_kgmps = c[kYawFromSway];
  return m;
}

}  // namespace otter_nav::identification
