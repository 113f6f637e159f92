#include "otter_nav/vessel/inverse_dynamics.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/rest.hpp"

namespace otter_nav::vessel {
namespace {

using Eigen::Vector2d;
using namespace inverse;

// Shares of what all thrusters give ahead. Far above rounding, which where D passes through zero
// would turn into a yaw acceleration, and far below what a turning path may have:
constexpr double kSingularShare = 5e-4;
// The sway balance's slope over the heading is about the thrust ahead that the path asks for. Below
// the least the position hardly says where the bow should point. Under more than a light load the
// heading found is only a wish, and trusted more and more as the slope grows to the steady one.
constexpr double kLeastSlopeShare = 0.1;
constexpr double kLeastSlowShare = 0.02;  // of a slow hull, as far as
constexpr double kLeastDragShare = 0.5;   // so much of the drag at its speed goes
constexpr double kSteadySlopeShare = 0.3;
constexpr double kLightLoadShare = 0.05;
constexpr double kRoundingMps = 1e-9;  // of D over the sway inertia
constexpr int kSwayIterations = 3;
// After a step of less the heading is exact to its square.
constexpr double kSmallSwayStepRad = 3e-4;
constexpr double kFarSwayStepRad = 0.1;  // in wind, whose load bends the balance
constexpr int kBowIterations = 6;
constexpr double kLongestBowStepRad = 0.5;

// Directions of dual numbers.
enum Direction : int { kByW = 0, kByW1 = 2, kByW2 = 4, kByVelocity = 6 };  // x, then y
enum Heading : int { kByPsi, kByYawRate };

template <int D>
auto seeded(const Vector2d& v) {
  return Vector{variable<D>(v.x()), variable<D + 1>(v.y())};
}
// What the equations of motion leave for the thrusters, and abeam for nobody.
template <typename Cosine, typename Sine, typename Rate>
auto thrustDemand(const ManoeuvringModel& m, const Disturbance& d, const Cosine& c, const Sine& s,
                  const Rate& r, double yaw_acceleration, const Vector2d& velocity,
                  const Vector2d& acceleration) {
  const Vector2d through = velocity - d.current_mps;
  const auto u = aheadPart(c, s, through.x(), through.y());
  const auto v = portPart(c, s, through.x(), through.y());
  const auto water = waterForce(m, u, v, r);
  const auto outside = outsideForce(c, s, m, d);
  // u' - r c_v = e . z'' + r v, v' + r c_u = n . z'' - r u.
  return Body{m.surge_inertia_kg * (aheadPart(c, s, acceleration.x(), acceleration.y()) + r * v) -
                  water.surge - outside.surge,
              m.sway_inertia_kg * (portPart(c, s, acceleration.x(), acceleration.y()) - r * u) -
                  water.sway - outside.sway,
              m.yaw_inertia_kgm2 * yaw_acceleration - water.yaw - outside.yaw};
}

}  // namespace

InverseDynamics::InverseDynamics(const Parameters& vessel, const Disturbance& disturbance)
    : model_(vessel.paper),
      lever_m_(vessel.thrusters.lever_arm_m),
      singular_n_(kSingularShare * 2.0 * vessel.thrusters.ahead_max_n),
      windy_(vessel.manoeuvring.feelsWind() && !disturbance.wind_mps.isZero(0.0)),
      wind_(vessel.manoeuvring),
      disturbance_(disturbance),
      surge_offset_n_(model_.d1_kgps * disturbance.current_mps + disturbance.force_n),
      sway_offset_n_(model_.d2_kgps * disturbance.current_mps + disturbance.force_n) {}

InverseDynamics::Air InverseDynamics::wind(const Vector2d& bow) const {
  Air air;
  Disturbance wind = disturbance_;
  wind.force_n.setZero();  // part of w
  const Turned<0, double> once(bow.x(), bow.y());
  const Turned<0, Dual<double, 1>> twice(once.cosine, once.sine);
  const Turned<0, Dual<Dual<double, 1>, 1>> thrice(twice.cosine, twice.sine);
  const auto load = outsideForce(thrice.cosine, thrice.sine, wind_, wind);
  air.x = load.surge.value.value.value;
  air.x1 = load.surge.slopes[0].value.value;
  air.y = load.sway.value.value.value;
  air.y1 = load.sway.slopes[0].value.value;
  air.y2 = load.sway.slopes[0].slopes[0].value;
  air.y3 = load.sway.slopes[0].slopes[0].slopes[0];
  air.n = load.yaw.value.value.value;
  air.n1 = load.yaw.slopes[0].value.value;
  return air;
}

Bow InverseDynamics::bowInWind(const Vector2d& w, const Vector2d& ahead, double floor_n) const {
  Bow bow = calmBow(w, ahead, floor_n);
  const double side = bow.firmness_n >= 0.0 ? 1.0 : -1.0;
  double psi = angleOf(bow.ahead);
  for (int i = 0; i <= kBowIterations; ++i) {
    bow.ahead = unitVector(psi);
    const Air air = wind(bow.ahead);
    bow.firmness_n = side * std::max(side * (bow.ahead.dot(w) + air.y1), floor_n);
    psi += std::clamp((cross(bow.ahead, w) - air.y) / bow.firmness_n, -kLongestBowStepRad,
                      kLongestBowStepRad);
  }
  return bow;
}

Sailing InverseDynamics::sailingInWind(const FlatPoint& z, const Vector2d& ahead,
                                       double floor_n) const {
  const Bow b = bowInWind(headingForce(z.velocity, z.acceleration), ahead, floor_n);
  const Air air = wind(b.ahead);
  return along(b, air, air.y + air.y2, z);
}

FlatState InverseDynamics::state(const FlatPoint& z, const Vector2d& ahead) const {
  Sailing s = sailing(z, ahead, 1e-9);
  const double firmness = std::abs(s.bow.firmness_n);
  const Vector2d& e = s.bow.ahead;
  double psi = angleOf(e);
  if (firmness <= singular_n_) {
    psi = angleOf(ahead);
    s.bow.ahead = unitVector(psi);
    s.yaw_rate_radps = 0.0;
    s.tau = held(e, 0.0, 0.0, z.velocity, z.acceleration).tau;
  }
  FlatState flat;
  flat.state << z.position, psi, e.dot(z.velocity), cross(e, z.velocity), s.yaw_rate_radps;
  flat.tau = s.tau;
  flat.heading_force_n = firmness;
  return flat;
}

FlatGradient InverseDynamics::gradient(const FlatPoint& z, double floor_n) const {
  const Vector2d w = headingForce(z.velocity, z.acceleration);
  const Bow b = bow(w, w, floor_n);
  const Air air = this->air(b.ahead);
  const double per_d = 1.0 / b.firmness_n;
  const bool floored = b.firmness_n <= floor_n;
  // d psi = n . dw / D, d D = (e + (Y + Y'') n / D) . dw. A floored D stands still, and without
  // wind e = w / D.
  const Vector2d n = across(b.ahead);
  const Vector2d psi_w = per_d * n;
  const Vector2d d_w = floored ? Vector2d(0.0, 0.0) : Vector2d(b.ahead + (air.y + air.y2) * psi_w);
  using ByW = Dual<double, 0b11U << kByW>;
  const auto dual = [](double value, const Vector2d& by_w) {
    ByW x(value);
    x.slopes[0] = by_w.x();
    x.slopes[1] = by_w.y();
    return x;
  };
  const auto byHeading = [&](double value, double by_psi) { return dual(value, by_psi * psi_w); };
  const bool scaled = floored && !windy_;
  const Vector2d ex_w = scaled ? Vector2d(per_d, 0.0) : Vector2d(n.x() * psi_w);
  const Vector2d ey_w = scaled ? Vector2d(0.0, per_d) : Vector2d(n.y() * psi_w);
  const Vector e{dual(b.ahead.x(), ex_w), dual(b.ahead.y(), ey_w)};
  const auto per_d_dual = dual(per_d, -per_d * per_d * d_w);
  const auto w1 = seeded<kByW1>(headingForceRate(z.acceleration, z.jerk));
  const auto w2 = seeded<kByW2>(headingForceRate(z.jerk, z.snap));
  // m1 z'' + d1 (z' - c) - F = w + (d1 - d2) (z' - c)
  const auto through = seeded<kByVelocity>(z.velocity - disturbance_.current_mps);
  const auto surge = dot(e, seeded<kByW>(w)) + (model_.d1_kgps - model_.d2_kgps) * dot(e, through);
  const auto row = [&](const auto& x) {
    FlatRow r = byPath({slope<kByW>(x), slope<kByW + 1>(x)}, {slope<kByW1>(x), slope<kByW1 + 1>(x)},
                       {slope<kByW2>(x), slope<kByW2 + 1>(x)});
    r.col(0) += Vector2d(slope<kByVelocity>(x), slope<kByVelocity + 1>(x));
    return r;
  };
  const auto result = [&](const auto& turn, const auto& surge_n, const auto& outside_nm) {
    const auto difference =
        (yawMoment(model_, turn.yaw_rate, turn.yaw_acceleration) - outside_nm) * (1.0 / lever_m_);
    FlatGradient g;
    g.heading_force_n = b.firmness_n;
    g.yaw_rate_radps = turn.yaw_rate.value;
    g.surge_n = surge_n.value;
    g.difference_n = difference.value;
    g.yaw_rate = row(turn.yaw_rate);
    g.surge = row(surge_n);
    g.difference = row(difference);
    return g;
  };
  if (!windy_) {
    return result(turning(e, per_d_dual, w1, w2, Calm{}), surge, air.n);
  }
  return result(turning(e, per_d_dual, w1, w2, byHeading(air.y + air.y2, air.y1 + air.y3)),
                surge - byHeading(air.x, air.x1), byHeading(air.n, air.n1));
}

FlatGradient InverseDynamics::demand(const FlatPoint& z, double floor_n) const {
  const Vector2d w = headingForce(z.velocity, z.acceleration);
  const Sailing s = sailing(z, w, floor_n);
  FlatGradient g;
  g.heading_force_n = s.bow.firmness_n;
  g.yaw_rate_radps = s.yaw_rate_radps;
  g.surge_n = s.tau.surge_n;
  g.difference_n = s.tau.yaw_nm / lever_m_;
  return g;
}

void InverseDynamics::push(double psi_rad, double yaw_rate_radps, double surge_n,
                           double surge_rate_nps, FlatPoint& z) const {
  // w = (tau_u + (d2 - d1) e . (z' - c) + X) e + Y n
  const Vector2d e = unitVector(psi_rad);
  const Vector2d n = across(e);
  const Air air = this->air(e);
  const Vector2d through = z.velocity - disturbance_.current_mps;
  const double extra = model_.d2_kgps - model_.d1_kgps;
  const double ahead = headingForceAhead(air, e, surge_n, z.velocity);
  z.acceleration = accelerationFrom(ahead * e + air.y * n, z.velocity);
  const double r = yaw_rate_radps;
  const double ahead_rate =
      surge_rate_nps + extra * (r * n.dot(through) + e.dot(z.acceleration)) + r * air.x1;
  z.jerk = jerkFrom((ahead_rate - r * air.y) * e + r * (ahead + air.y1) * n, z.acceleration);
}

FlatPoint InverseDynamics::fromState(const State& x, double force_least_n,
                                     double force_max_n) const {
  const Vector2d e = unitVector(x[kPsi]);
  const Vector2d n = across(e);
  FlatPoint z;
  z.position = x.head<2>();
  z.velocity = velocityOverGround(x);
  const double through = e.dot(z.velocity - disturbance_.current_mps);
  const Air air = this->air(e);
  // Along the hull: the thrusters' and the wind's.
  const double force = std::min(std::max(model_.d2_kgps * through, force_least_n - air.y1),
                                force_max_n + std::min(air.x, 0.0));
  z.acceleration = accelerationFrom(force * e + air.y * n, z.velocity);
  z.jerk = jerkFrom(x[kYawRate] * ((force + air.y1) * n - air.y * e), z.acceleration);
  return z;
}

namespace {

// Where the sway force that a motion lacks falls through nothing, and how steeply about there.
struct FirmHeading {
  double psi_rad = 0.0;
  double slope_n = 0.0;  // per radian; 0: nowhere
};

// The nearest to `psi_near_rad`, over a finite angle: a wind's load abeam goes with the square of
// what comes from there, so near bow to it nothing is firm to the first order. Where the balance
// settles, without the way there: the hull's own turning is left out.
FirmHeading firmHeading(const ManoeuvringModel& model, const Disturbance& disturbance,
                        const Vector2d& velocity, const Vector2d& acceleration,
                        double psi_near_rad) {
  constexpr double kStepRad = 0.1;
  constexpr int kSteps = 15;
  constexpr int kFirmHalvings = 12;
  constexpr double kAboutRad = 0.2;
  const auto lacks = [&](double psi) {
    return thrustDemand(model, disturbance, std::cos(psi), std::sin(psi), 0.0, 0.0, velocity,
                        acceleration)
        .sway;
  };
  double port = lacks(psi_near_rad);
  double starboard = port;
  for (int k = 1; k <= kSteps; ++k) {
    const double from = (k - 1) * kStepRad;
    const double next_port = lacks(psi_near_rad + from + kStepRad);
    const double next_starboard = lacks(psi_near_rad - from - kStepRad);
    const bool to_port = port >= 0.0 && next_port < 0.0;
    const bool to_starboard = starboard < 0.0 && next_starboard >= 0.0;
    if (to_port || to_starboard) {
      double low = to_port ? psi_near_rad + from : psi_near_rad - from - kStepRad;
      double high = low + kStepRad;
      for (int i = 0; i < kFirmHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        (lacks(middle) >= 0.0 ? low : high) = middle;
      }
      const double psi = 0.5 * (low + high);
      return {psi, (lacks(psi - kAboutRad) - lacks(psi + kAboutRad)) / (2.0 * kAboutRad)};
    }
    port = next_port;
    starboard = next_starboard;
  }
  return {};
}

}  // namespace

SwayHeading swayHeading(const Parameters& vessel, const Disturbance& disturbance,
                        const Vector2d& velocity, const Vector2d& acceleration,
                        double psi_before_rad, double psi_path_rad, double dt_s) {
  const ManoeuvringModel& m = vessel.manoeuvring;
  const double thrust_n = 2.0 * vessel.thrusters.ahead_max_n;
  const double drag_n = m.surge_drag_kgps * (velocity - disturbance.current_mps).norm();
  const double least_slope_n =
      std::clamp(kLeastDragShare * drag_n, kLeastSlowShare * thrust_n, kLeastSlopeShare * thrust_n);
  double psi = unwrapNear(psi_before_rad, psi_path_rad);
  const double before = psi;
  double slope_n = 0.0;
  const bool windy = m.feelsWind() && !disturbance.wind_mps.isZero(0.0);
  const bool lies = windy && canLie(m, disturbance, psi_path_rad);
  for (int i = 0; i < kSwayIterations; ++i) {
    const Turned<kByPsi, double> turned(std::cos(psi), std::sin(psi));
    const auto lacking = thrustDemand(m, disturbance, turned.cosine, turned.sine,
                                      variable<kByYawRate>(0.0), 0.0, velocity, acceleration)
                             .sway;
    slope_n = -slope<kByPsi>(lacking);
    const double turns = slope<kByYawRate>(lacking);
    const bool vague = slope_n < least_slope_n || turns > kRoundingMps * m.sway_inertia_kg;
    const double step =
        vague ? 0.0 : (turns * (psi - before) / dt_s + lacking.value) / (turns / dt_s - slope_n);
    if (windy && !(lies && vague) && (vague || std::abs(step) > kFarSwayStepRad)) {
      const FirmHeading firm = firmHeading(m, disturbance, velocity, acceleration, before);
      const bool holds = firm.slope_n >= least_slope_n;
      psi = holds ? firm.psi_rad : psi_path_rad;
      slope_n = holds ? firm.slope_n : 0.0;
      break;
    }
    if (vague) {
      psi = psi_path_rad;
      break;
    }
    psi -= step;
    if (std::abs(step) < kSmallSwayStepRad) {
      break;
    }
  }
  // Slowly a little wind would have it turn half round within a leg, and back at its end.
  if (lies) {
    const double share =
        std::clamp((velocity - disturbance.current_mps).norm() / kWalkingMps - 1.0, 0.0, 1.0);
    psi = unwrapNear(psi_path_rad + share * wrapAngle(psi - psi_path_rad), before);
  }
  const bool loaded = !disturbance.wind_mps.isZero(0.0) || !disturbance.force_n.isZero(0.0);
  const OutsideLoad load = loaded ? outsideLoad(psi, m, disturbance) : OutsideLoad{};
  const double calm = 2.0 - std::hypot(load.surge_n, load.sway_n) / (kLightLoadShare * thrust_n);
  const double steady = (slope_n - least_slope_n) / (kSteadySlopeShare * thrust_n);
  return {psi, std::clamp(std::max(calm, steady), 0.0, 1.0)};
}

Demand demandOf(const ManoeuvringModel& model, const Disturbance& disturbance, double psi_rad,
                double yaw_rate_radps, double yaw_acceleration, const Vector2d& velocity,
                const Vector2d& acceleration) {
  const Vector2d e = unitVector(psi_rad);
  const auto demand = thrustDemand(model, disturbance, e.x(), e.y(), yaw_rate_radps,
                                   yaw_acceleration, velocity, acceleration);
  return {e.dot(velocity), cross(e, velocity), {demand.surge, demand.yaw}, demand.sway};
}

}  // namespace otter_nav::vessel
