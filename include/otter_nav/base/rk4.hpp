// The one Runge-Kutta step of the project (paper, equation 7): every model gives its derivative.
#pragma once

namespace otter_nav {

// One explicit fourth-order step of `dt` seconds. `derivative(t, x)` returns a State; State is an
// Eigen vector of fixed size, so nothing is allocated.
template <typename State, typename Derivative>
State rk4Step(const Derivative& derivative, double t, const State& x, double dt) {
  const State k1 = derivative(t, x);
  const State k2 = derivative(t + 0.5 * dt, State(x + 0.5 * dt * k1));
  const State k3 = derivative(t + 0.5 * dt, State(x + 0.5 * dt * k2));
  const State k4 = derivative(t + dt, State(x + dt * k3));
  return x + dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

}  // namespace otter_nav
