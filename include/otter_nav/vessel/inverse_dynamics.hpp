// Inverse dynamics: from a path's derivatives, the disturbance and the model to heading, yaw rate
// and what the thrusters must do. Derivations are in docs/model.md.
//
// Paper's model (its differential flatness, section III-B), algebraic in z' to z'''':
//   w   = m1 z'' + d2 (z' - c) - F      sum of what acts along the hull, earth frame
//   n . w = Y(psi)                      nothing but the wind's side load acts abeam
//   D   = e . w + Y'(psi),  r = n . w' / D
//   r'  = (n . w'' - 2 r e . w' - r^2 (Y + Y'')) / D
//   tau_u = e . (m1 z'' + d1 (z' - c) - F) - X(psi),  tau_r = m2 r' + d3 r - N(psi)
// with current c, earth-fixed force F, wind loads X, Y, N (vessel/motion_law.hpp), e ahead and n to
// port. Without wind the hull lies along w: e = +-w / |w|, D = +-|w|.
//
// Manoeuvring model: the sway equation, in which no thrust acts, is a differential equation for the
// heading; swayHeading() follows its stable solution, demandOf() gives the rest.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::vessel {

// What a motion along a path asks for.
struct FlatState {
  State state = State::Zero();  // velocities over ground
  Tau tau;
  // |D| in N: where it is about zero the heading follows the course, and a turning path would need
  // an unbounded yaw rate (yaw_rate and tau are then computed for a straight one).
  double heading_force_n = 0.0;
};

// Derivatives of a scalar with respect to velocity, acceleration, jerk and snap (columns).
using FlatRow = Eigen::Matrix<double, 2, 4>;

struct FlatGradient {
  double heading_force_n = 0.0;  // |D|
  double yaw_rate_radps = 0.0;
  double surge_n = 0.0;       // F_r + F_l
  double difference_n = 0.0;  // F_r - F_l
  FlatRow yaw_rate, surge, difference;
};

// Where the bow points and how firmly, N (D above).
struct Bow {
  Eigen::Vector2d ahead;
  double firmness_n;
};
struct Sailing {
  Bow bow;
  double yaw_rate_radps;
  Tau tau;
};

// Thrusters' work on a given heading, and the force to port that no thruster gives.
struct HeldDemand {
  Tau tau;
  double sway_n;
};

// Terms of the equations above, for doubles and dual numbers.
namespace inverse {

template <typename X, typename Y>
struct Vector {
  X x;
  Y y;
};
template <typename X, typename Y>
Vector(X, Y) -> Vector<X, Y>;

inline Vector<double, double> plain(const Eigen::Vector2d& v) {
  return {v.x(), v.y()};
}
template <typename A, typename B>
OTTER_NAV_INLINE auto dot(const A& a, const B& b) {
  return a.x * b.x + a.y * b.y;
}
template <typename A, typename B>
OTTER_NAV_INLINE auto crossed(const A& a, const B& b) {
  return a.x * b.y - a.y * b.x;
}

// r and r' of a hull along e with D = 1 / per_d and Y + Y'' = bend; in calm air that vanishes.
struct Calm {};
template <typename Rate, typename Acceleration>
struct Turning {
  Rate yaw_rate;
  Acceleration yaw_acceleration;
};
template <typename Rate, typename Acceleration>
Turning(Rate, Acceleration) -> Turning<Rate, Acceleration>;

template <typename E, typename PerD, typename W1, typename W2, typename Bend>
OTTER_NAV_INLINE auto turning(const E& e, const PerD& per_d, const W1& w1, const W2& w2,
                              const Bend& bend) {
  const auto r = crossed(e, w1) * per_d;
  if constexpr (std::is_same_v<Bend, Calm>) {
    return Turning{r, (crossed(e, w2) - r * (2.0 * dot(e, w1))) * per_d};
  } else {
    return Turning{r, (crossed(e, w2) - r * (2.0 * dot(e, w1) + r * bend)) * per_d};
  }
}

template <typename Rate, typename Acceleration>
OTTER_NAV_INLINE auto yawMoment(const PaperModel& m, const Rate& r, const Acceleration& r1) {
  return m.m2_kgm2 * r1 + m.d3_kgm2ps * r;
}

}  // namespace inverse

// The paper's model in still or moving water and air. Cheap to copy; the small functions are inline
// for the hot loops of the search.
class InverseDynamics {
 public:
  explicit InverseDynamics(const Parameters& vessel, const Disturbance& disturbance = {});

  // w, and with the next derivatives w' and w''.
  [[nodiscard]] Eigen::Vector2d headingForce(const Eigen::Vector2d& velocity,
                                             const Eigen::Vector2d& acceleration) const {
    return headingForceRate(velocity, acceleration) - sway_offset_n_;
  }
  [[nodiscard]] Eigen::Vector2d headingForceRate(const Eigen::Vector2d& acceleration,
                                                 const Eigen::Vector2d& jerk) const {
    return model_.m1_kg * jerk + model_.d2_kgps * acceleration;
  }
  // m1 z'' + d1 (z' - c) - F: its part ahead is what the thrusters push with in still air; its
  // length is no less.
  [[nodiscard]] Eigen::Vector2d surgeForce(const Eigen::Vector2d& velocity,
                                           const Eigen::Vector2d& acceleration) const {
    return model_.m1_kg * acceleration + model_.d1_kgps * velocity - surge_offset_n_;
  }
  [[nodiscard]] Eigen::Vector2d throughWater(const Eigen::Vector2d& velocity) const {
    return velocity - disturbance_.current_mps;
  }
  // The same with the wind's load ahead, for a hull roughly along `ahead`.
  [[nodiscard]] Eigen::Vector2d push(const Eigen::Vector2d& ahead, const Eigen::Vector2d& velocity,
                                     const Eigen::Vector2d& acceleration) const {
    const Eigen::Vector2d force = surgeForce(velocity, acceleration);
    if (!windy_) {
      return force;
    }
    const Eigen::Vector2d e = ahead / std::max(ahead.norm(), 1e-9);
    return force - wind(e).x * e;
  }
  // What pushes a hull at rest along `ahead`, N; zero in calm water.
  [[nodiscard]] double loadAhead(const Eigen::Vector2d& ahead) const {
    return ahead.dot(surge_offset_n_) + air(ahead).x;
  }
  // What pushes a hull at rest to port of `ahead`, N; zero in calm water.
  [[nodiscard]] double loadAbeam(const Eigen::Vector2d& ahead) const {
    return cross(ahead, sway_offset_n_) + air(ahead).y;
  }
  [[nodiscard]] double greatestLoadAbeam() const {
    return sway_offset_n_.norm() +
           (windy_ ? wind_.wind_sway_kgpm * disturbance_.wind_mps.squaredNorm() : 0.0);
  }
  // The most that wind, current and force push a hull at rest with along its length, N.
  [[nodiscard]] double greatestLoad() const {
    return surge_offset_n_.norm() +
           (windy_ ? wind_.wind_surge_kgpm * disturbance_.wind_mps.squaredNorm() : 0.0);
  }
  // z'' from w, and z''' from w'.
  [[nodiscard]] Eigen::Vector2d accelerationFrom(const Eigen::Vector2d& heading_force,
                                                 const Eigen::Vector2d& velocity) const {
    return jerkFrom(heading_force + sway_offset_n_, velocity);
  }
  [[nodiscard]] Eigen::Vector2d jerkFrom(const Eigen::Vector2d& heading_force_rate,
                                         const Eigen::Vector2d& acceleration) const {
    return (heading_force_rate - model_.d2_kgps * acceleration) / model_.m1_kg;
  }
  // A hull pushed along a given heading: psi, psi' and the surge force with its rate give z'' and
  // z''' of `motion`, whose position and velocity are set.
  void push(double psi_rad, double yaw_rate_radps, double surge_n, double surge_rate_nps,
            FlatPoint& motion) const;
  // z'' alone.
  [[nodiscard]] Eigen::Vector2d pushed(double psi_rad, double surge_n,
                                       const Eigen::Vector2d& velocity) const {
    const Eigen::Vector2d e = unitVector(psi_rad);
    const Air air = this->air(e);
    return accelerationFrom(headingForceAhead(air, e, surge_n, velocity) * e + air.y * across(e),
                            velocity);
  }
  // d scalar / d (z', ..., z'''') from its derivatives by w, w' and w''.
  [[nodiscard]] FlatRow byPath(const Eigen::Vector2d& by_w,
                               const Eigen::Vector2d& by_w1 = Eigen::Vector2d::Zero(),
                               const Eigen::Vector2d& by_w2 = Eigen::Vector2d::Zero()) const {
    FlatRow row;
    row.col(0) = model_.d2_kgps * by_w;
    row.col(1) = model_.m1_kg * by_w + model_.d2_kgps * by_w1;
    row.col(2) = model_.m1_kg * by_w1 + model_.d2_kgps * by_w2;
    row.col(3) = model_.m1_kg * by_w2;
    return row;
  }

  // The same from its derivative by the surge force.
  [[nodiscard]] FlatRow bySurgeForce(const Eigen::Vector2d& by_force) const {
    FlatRow row = FlatRow::Zero();
    row.col(0) = model_.d1_kgps * by_force;
    row.col(1) = model_.m1_kg * by_force;
    return row;
  }

  // The bow for w, on the side of `ahead`; |D| is taken as no less than `floor_n`.
  [[nodiscard]] Bow bow(const Eigen::Vector2d& w, const Eigen::Vector2d& ahead,
                        double floor_n) const {
    return windy_ ? bowInWind(w, ahead, floor_n) : calmBow(w, ahead, floor_n);
  }
  // d (vector . bow) / d w.
  [[nodiscard]] static Eigen::Vector2d bowGradient(const Bow& bow, const Eigen::Vector2d& vector) {
    return (vector - vector.dot(bow.ahead) * bow.ahead) / bow.firmness_n;
  }

  // The branch of the heading is the one within 90 degrees of `ahead`, any vector that points
  // roughly to where the bow is (the velocity through the water when sailing ahead). Where D
  // vanishes the motion is taken as straight along `ahead`.
  [[nodiscard]] FlatState state(const FlatPoint& z, const Eigen::Vector2d& ahead) const;
  // Without that exception: |D| is taken as no less than `floor_n`.
  [[nodiscard]] Sailing sailing(const FlatPoint& z, const Eigen::Vector2d& ahead,
                                double floor_n) const {
    return windy_ ? sailingInWind(z, ahead, floor_n)
                  : along(calmBow(headingForce(z.velocity, z.acceleration), ahead, floor_n),
                          calmAir(), inverse::Calm{}, z);
  }
  // The same with derivatives; the bow along +w.
  [[nodiscard]] FlatGradient gradient(const FlatPoint& z, double floor_n) const;
  // What gradient() says, without derivatives.
  [[nodiscard]] FlatGradient demand(const FlatPoint& z, double floor_n) const;
  // On a heading that the path does not decide: spins, straight motion.
  [[nodiscard]] HeldDemand held(const Eigen::Vector2d& bow, double yaw_rate_radps,
                                double yaw_acceleration, const Eigen::Vector2d& velocity,
                                const Eigen::Vector2d& acceleration) const {
    return windy_
               ? heldIn(wind(bow), bow, yaw_rate_radps, yaw_acceleration, velocity, acceleration)
               : heldIn(calmAir(), bow, yaw_rate_radps, yaw_acceleration, velocity, acceleration);
  }
  // A state as a point of a path: yaw rate as it is, surge force to hold the speed, but no less
  // than gives the path a heading (`force_least_n` along it) and no more than `force_max_n`.
  [[nodiscard]] FlatPoint fromState(const State& state, double force_least_n,
                                    double force_max_n) const;

  [[nodiscard]] const PaperModel& model() const { return model_; }

 private:
  // X, Y, N on a heading and their derivatives by it.
  struct Air {
    double x = 0.0, x1 = 0.0;
    double y = 0.0, y1 = 0.0, y2 = 0.0, y3 = 0.0;
    double n = 0.0, n1 = 0.0;
  };
  [[nodiscard]] Air calmAir() const {
    Air air;
    air.n = disturbance_.moment_nm;
    return air;
  }
  [[nodiscard]] Air air(const Eigen::Vector2d& bow) const { return windy_ ? wind(bow) : calmAir(); }
  [[nodiscard]] Air wind(const Eigen::Vector2d& bow) const;
  // Along w, on the side of `ahead`.
  [[nodiscard]] static Bow calmBow(const Eigen::Vector2d& w, const Eigen::Vector2d& ahead,
                                   double floor_n) {
    const double side = w.dot(ahead) >= 0.0 ? 1.0 : -1.0;
    const double norm = std::max(w.norm(), floor_n);
    return {side / norm * w, side * norm};
  }
  // `bend` is Y + Y''.
  template <typename Bend>
  [[nodiscard]] OTTER_NAV_INLINE Sailing along(const Bow& bow, const Air& air, const Bend& bend,
                                               const FlatPoint& z) const {
    const auto turn = inverse::turning(inverse::plain(bow.ahead), 1.0 / bow.firmness_n,
                                       inverse::plain(headingForceRate(z.acceleration, z.jerk)),
                                       inverse::plain(headingForceRate(z.jerk, z.snap)), bend);
    return {bow,
            turn.yaw_rate,
            {bow.ahead.dot(surgeForce(z.velocity, z.acceleration)) - air.x,
             inverse::yawMoment(model_, turn.yaw_rate, turn.yaw_acceleration) - air.n}};
  }
  [[nodiscard]] Bow bowInWind(const Eigen::Vector2d& w, const Eigen::Vector2d& ahead,
                              double floor_n) const;
  [[nodiscard]] Sailing sailingInWind(const FlatPoint& z, const Eigen::Vector2d& ahead,
                                      double floor_n) const;
  [[nodiscard]] OTTER_NAV_INLINE HeldDemand heldIn(const Air& air, const Eigen::Vector2d& bow,
                                                   double yaw_rate_radps, double yaw_acceleration,
                                                   const Eigen::Vector2d& velocity,
                                                   const Eigen::Vector2d& acceleration) const {
    return {{bow.dot(surgeForce(velocity, acceleration)) - air.x,
             inverse::yawMoment(model_, yaw_rate_radps, yaw_acceleration) - air.n},
            cross(bow, headingForce(velocity, acceleration)) - air.y};
  }
  // w on a given heading, ahead; all of it in calm air.
  [[nodiscard]] double headingForceAhead(const Air& air, const Eigen::Vector2d& bow, double surge_n,
                                         const Eigen::Vector2d& velocity) const {
    const Eigen::Vector2d through = velocity - disturbance_.current_mps;
    return surge_n + (model_.d2_kgps - model_.d1_kgps) * bow.dot(through) + air.x;
  }

  PaperModel model_;
  double lever_m_;
  double singular_n_;  // D below it says nothing of the heading
  bool windy_;
  ManoeuvringModel wind_;  // its wind loads
  Disturbance disturbance_;
  Eigen::Vector2d surge_offset_n_, sway_offset_n_;  // d1 c + F, d2 c + F
};

// The heading by the manoeuvring model's sway equation a step of `dt_s` after `psi_before_rad`,
// with the motion at the step's end: D psi' = balance(psi), D = (sway_centripetal - sway_inertia) e
// . w + sway_from_yaw, by an implicit Euler step, which follows the stable solution whatever D is.
// The paper's model has D = 0 and the equation is its flatness; a hull with more sway inertia than
// the turn feels has D < 0 and relaxes to that solution. Where the balance hardly depends on the
// heading (at rest, coasting, braking, wind from astern as strong as the drag), or D > 0, it is
// `psi_path_rad`. In a wind in which the hull can lie on that (vessel/rest.hpp) it keeps it at
// walking pace, and leaves it for the balance's own gradually up to twice that.
struct SwayHeading {
  double psi_rad;
  double trust;  // 0 to 1: whether the position says firmly where the bow should point
};
[[nodiscard]] SwayHeading swayHeading(const Parameters& vessel, const Disturbance& disturbance,
                                      const Eigen::Vector2d& velocity,
                                      const Eigen::Vector2d& acceleration, double psi_before_rad,
                                      double psi_path_rad, double dt_s);

// Body velocities over ground and the forces that a motion on a heading asks of the thrusters, by
// the manoeuvring model; `sway_n` is what none of them gives.
struct Demand {
  double surge_mps, sway_mps;
  Tau tau;
  double sway_n;
};
[[nodiscard]] Demand demandOf(const ManoeuvringModel& model, const Disturbance& disturbance,
                              double psi_rad, double yaw_rate_radps, double yaw_acceleration,
                              const Eigen::Vector2d& velocity, const Eigen::Vector2d& acceleration);

}  // namespace otter_nav::vessel
