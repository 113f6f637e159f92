// The equations of motion, written once, for whatever number they are wanted in: double, packs of
// doubles (the tracker's shooting), dual numbers (Jacobians by state, current or coefficients).
//   surge_inertia (u' - r c_v) = surge_centripetal v r - surge_drag u - surge_drag_quadratic |u| u
//                                + tau_u + X
//   sway_inertia  (v' + r c_u) = -sway_centripetal u r - sway_drag v - sway_drag_quadratic |v| v
//                                - sway_from_yaw r + Y
//   yaw_inertia    r'          = -munk u v - yaw_drag r - yaw_drag_quadratic |r| r
//                                - yaw_from_sway v + tau_r + N
// with u, v through the water on the right and over ground on the left, the current's body
// components c_u, c_v (steady in the earth frame: c_u' = r c_v, c_v' = -r c_u), and X, Y, N what
// pushes from outside (Fossen 2021, chapters 6.5, 10.1 and 10.3; docs/model.md).
#pragma once

#include "otter_nav/base/dual.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::vessel {

// What acts beside the thrusters: water moving with `current` (earth frame, m/s, irrotational and
// steady), air moving with `wind` (earth frame, m/s), a force fixed in the earth frame, a yaw
// moment.
struct Disturbance {
  Eigen::Vector2d current_mps = Eigen::Vector2d::Zero();
  Eigen::Vector2d wind_mps = Eigen::Vector2d::Zero();
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();
  double moment_nm = 0.0;
};

// A disturbance as it is known: what is likeliest, and how sure of it one is.
struct DisturbanceEstimate {
  // Rows and columns of the covariance: force x, y (N), moment (N m), current x, y and wind x, y
  // (m/s), earth frame. What is not estimated has no variance.
  enum Index : int { kForce = 0, kMoment = 2, kCurrent = 3, kWind = 5, kSize = 7 };
  Disturbance mean;
  Eigen::Matrix<double, kSize, kSize> covariance = Eigen::Matrix<double, kSize, kSize>::Zero();
  // How fast the waves are that move the hull, or that none do.
  bool knows_waves = false;
};

// Surge, sway, yaw: forces N and moment N m, or accelerations. Each of its own type, since each
// may depend on different variables.
template <typename Surge, typename Sway, typename Yaw>
struct Body {
  Surge surge;
  Sway sway;
  Yaw yaw;
};
template <typename Surge, typename Sway, typename Yaw>
Body(Surge, Sway, Yaw) -> Body<Surge, Sway, Yaw>;

// An earth-fixed vector seen from the hull, ahead and to port.
template <typename Cosine, typename Sine, typename X, typename Y>
[[nodiscard]] OTTER_NAV_INLINE auto aheadPart(const Cosine& cosine, const Sine& sine, const X& x,
                                              const Y& y) {
  return cosine * x + sine * y;
}
template <typename Cosine, typename Sine, typename X, typename Y>
[[nodiscard]] OTTER_NAV_INLINE auto portPart(const Cosine& cosine, const Sine& sine, const X& x,
                                             const Y& y) {
  return cosine * y - sine * x;
}

// Cosine and sine of a variable heading, `Direction` being the heading's.
template <int Direction, typename Value>
struct Turned {
  Dual<Value, Directions{1} << Direction> cosine, sine;
  Turned(const Value& c, const Value& s)
      : cosine(dual::chain(c, -s, variable<Direction>(c))),
        sine(dual::chain(s, c, variable<Direction>(s))) {}
};

// X, Y, N: the wind's loads are wind_surge |wx| wx, wind_sway |wy| wy and wind_yaw wx wy, with wx,
// wy the wind over the ground seen from the hull (its own speed is small beside the wind's).
template <typename Number, typename Cosine, typename Sine>
[[nodiscard]] OTTER_NAV_INLINE auto outsideForce(const Cosine& cosine, const Sine& sine,
                                                 const BasicManoeuvringModel<Number>& m,
                                                 const Disturbance& d) {
  const auto wind_ahead = aheadPart(cosine, sine, d.wind_mps.x(), d.wind_mps.y());
  const auto wind_port = portPart(cosine, sine, d.wind_mps.x(), d.wind_mps.y());
  return Body{aheadPart(cosine, sine, d.force_n.x(), d.force_n.y()) +
                  m.wind_surge_kgpm * signedSquare(wind_ahead),
              portPart(cosine, sine, d.force_n.x(), d.force_n.y()) +
                  m.wind_sway_kgpm * signedSquare(wind_port),
              m.wind_yaw_kg * (wind_ahead * wind_port) + d.moment_nm};
}

// What the water does to a hull moving with u, v (through it) and r.
template <typename Number, typename Surge, typename Sway, typename Yaw>
[[nodiscard]] OTTER_NAV_INLINE auto waterForce(const BasicManoeuvringModel<Number>& m,
                                               const Surge& u, const Sway& v, const Yaw& r) {
  return Body{m.surge_centripetal_kg * (v * r) - m.surge_drag_kgps * u -
                  m.surge_drag_quadratic_kgpm * signedSquare(u),
              -(m.sway_centripetal_kg * (u * r)) - m.sway_drag_kgps * v -
                  m.sway_drag_quadratic_kgpm * signedSquare(v) - m.sway_from_yaw_kgmps * r,
              -(m.munk_kg * (u * v)) - m.yaw_drag_kgm2ps * r -
                  m.yaw_drag_quadratic_kgm2 * signedSquare(r) - m.yaw_from_sway_kgmps * v};
}

// 1 / inertia.
template <typename Number>
struct Mobility {
  Number surge, sway, yaw;
  explicit Mobility(const BasicManoeuvringModel<Number>& m)
      : surge(inverse(m.surge_inertia_kg)),
        sway(inverse(m.sway_inertia_kg)),
        yaw(inverse(m.yaw_inertia_kgm2)) {}
};

// u', v', r' over ground: on a heading, body velocities over ground, the current, what pushes from
// outside and the thrusters' surge force and yaw moment.
template <typename Number, typename Cosine, typename Sine, typename Outside, typename CurrentX,
          typename CurrentY, typename Surge, typename Sway, typename Yaw, typename Thrust>
[[nodiscard]] OTTER_NAV_INLINE auto bodyAcceleration(
    const BasicManoeuvringModel<Number>& model, const Mobility<Number>& mobility,
    const Cosine& cosine, const Sine& sine, const Outside& outside, const CurrentX& current_x,
    const CurrentY& current_y, const Surge& u_ground, const Sway& v_ground, const Yaw& r,
    const Thrust& surge_n, const Thrust& yaw_nm) {
  const auto current_u = aheadPart(cosine, sine, current_x, current_y);
  const auto current_v = portPart(cosine, sine, current_x, current_y);
  const auto water = waterForce(model, u_ground - current_u, v_ground - current_v, r);
  return Body{(water.surge + outside.surge + surge_n) * mobility.surge + r * current_v,
              (water.sway + outside.sway) * mobility.sway - r * current_u,
              (water.yaw + outside.yaw + yaw_nm) * mobility.yaw};
}

// x', y' in the earth frame.
template <typename Rate>
struct Plane {
  Rate x, y;
};
template <typename Cosine, typename Sine, typename Surge, typename Sway>
[[nodiscard]] OTTER_NAV_INLINE auto positionRate(const Cosine& cosine, const Sine& sine,
                                                 const Surge& u, const Sway& v) {
  using Rate = decltype(cosine * u - sine * v);
  return Plane<Rate>{cosine * u - sine * v, sine * u + cosine * v};
}

}  // namespace otter_nav::vessel
