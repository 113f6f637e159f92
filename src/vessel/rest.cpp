#include "otter_nav/vessel/rest.hpp"

#include <cmath>

#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/steady_motion.hpp"

namespace otter_nav::vessel {
namespace {

Demand atRest(const ManoeuvringModel& model, const Disturbance& disturbance, double psi_rad) {
  return demandOf(model, disturbance, psi_rad, 0.0, 0.0, Eigen::Vector2d::Zero(),
                  Eigen::Vector2d::Zero());
}

// Through the water, of a hull that is pushed abeam.
double carriedBy(const ManoeuvringModel& model, double push_n) {
  const double abeam = std::abs(push_n);
  const double drag = steadyDrag(model.sway_drag_kgps, model.sway_drag_quadratic_kgpm, abeam);
  return std::copysign(abeam / (drag + 5e-13), push_n);  // 0 without drag and load
}

}  // namespace

double driftAbeam(const ManoeuvringModel& model, const Disturbance& disturbance, double psi_rad) {
  const double cosine = std::cos(psi_rad);
  const double sine = std::sin(psi_rad);
  const double pushed = outsideForce(cosine, sine, model, disturbance).sway;
  const Eigen::Vector2d& current = disturbance.current_mps;
  return carriedBy(model, pushed) + portPart(cosine, sine, current.x(), current.y());
}

double setOff(const ManoeuvringModel& model, const Disturbance& disturbance, double psi_rad,
              double yaw_rate_radps, const Eigen::Vector2d& velocity,
              const Eigen::Vector2d& acceleration) {
  const Demand demand =
      demandOf(model, disturbance, psi_rad, yaw_rate_radps, 0.0, velocity, acceleration);
  return std::abs(carriedBy(model, demand.sway_n));
}

double headingIntoLoad(const ManoeuvringModel& model, const Disturbance& disturbance,
                       double psi_rad) {
  constexpr double kNoLoadN = 1e-6;
  constexpr int kIterations = 20;
  double psi = psi_rad;
  for (int i = 0; i < kIterations; ++i) {
    const Demand demand = atRest(model, disturbance, psi);
    if (std::hypot(demand.tau.surge_n, demand.sway_n) < kNoLoadN) {
      return psi;
    }
    // Towards the force that the load asks for; wind loads turn with the hull themselves.
    psi += std::atan2(demand.sway_n, demand.tau.surge_n);
  }
  return psi;
}

bool isFirmLoad(const Parameters& vessel, const Disturbance& disturbance) {
  constexpr double kFirmShare = 0.09;  // of both thrusters' force
  const ManoeuvringModel& model = vessel.manoeuvring;
  const bool turns = model.feelsWind() && !disturbance.wind_mps.isZero(0.0);
  return !turns && surgeAtRest(model, disturbance, headingIntoLoad(model, disturbance, 0.0)) >
                       kFirmShare * 2.0 * vessel.thrusters.ahead_max_n;
}

double surgeAtRest(const ManoeuvringModel& model, const Disturbance& disturbance, double psi_rad) {
  return atRest(model, disturbance, psi_rad).tau.surge_n;
}

}  // namespace otter_nav::vessel
