// What every hull model gives the simulator: its derivative, its actuators, its trim.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "otter_nav/base/result.hpp"
#include "otter_nav/base/rk4.hpp"
#include "otter_nav/plant/options.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::plant {

constexpr double kGravity = 9.81;  // m/s^2

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Rows of PlantState. Inside the plant everything is Fossen's: earth frame NED, body frame forward,
// starboard, down; nu = [u v w p q r], eta = [x y z phi theta psi]; then one state a propeller,
// whose meaning is the model's own (shaft speed in rad/s, or thrust in N), left and right.
enum PlantIndex : int {
  kU = 0,
  kV = 1,
  kW = 2,
  kP = 3,
  kQ = 4,
  kR = 5,
  kNorth = 6,
  kEast = 7,
  kDown = 8,
  kRoll = 9,
  kPitch = 10,
  kYaw = 11,
  kPropeller = 12
};
constexpr int kPlantStateSize = 14;
using PlantState = Eigen::Matrix<double, kPlantStateSize, 1>;

inline Vector6 velocityOf(const PlantState& x) {
  return x.head<6>();
}

// The water and air around the hull, in its own frame (forward, starboard, down).
struct Surroundings {
  // The water's motion averaged over the hull: [u v 0 0 0 r], over ground.
  Vector6 water_velocity = Vector6::Zero();
  // Its acceleration in inertial space, resolved in the body frame; 0 for a steady current.
  Vector6 water_acceleration = Vector6::Zero();
  // The plane fitted to the surface under the hull: its [z phi theta] as a pose (down positive),
  // relative to still water, and their rates.
  Eigen::Vector3d surface = Eigen::Vector3d::Zero();
  Eigen::Vector3d surface_rate = Eigen::Vector3d::Zero();
  Vector6 force = Vector6::Zero();  // wind and constant forces: [X Y Z K M N]
};

// One hull, its actuators and its trim. The models say what moves them; the propellers' states and
// the Runge-Kutta step are the same for all. Unless a model says otherwise, the states are thrusts
// and the hull's trim is level.
class PlantModel {
 public:
  // `lag_s`: time constant of the propellers' states behind their command; 0: they take it up at
  // once, and a step writes it into the state.
  explicit PlantModel(double lag_s) : lag_s_(lag_s) {}
  virtual ~PlantModel() = default;

  // One RK4 step under a constant command (in the unit of the propeller states);
  // `surroundings(x)` gives what acts.
  template <typename SurroundingsAt>
  [[nodiscard]] PlantState step(const PlantState& x, const Eigen::Vector2d& command, double dt_s,
                                const SurroundingsAt& surroundings) const {
    PlantState start = x;
    if (propellersAtOnce()) {
      start.tail<2>() = saturate(command);
    }
    return rk4Step(
        [&](double /*t*/, const PlantState& state) {
          return derivative(state, command, surroundings(state));
        },
        0.0, start, dt_s);
  }
  // x' under a command.
  [[nodiscard]] PlantState derivative(const PlantState& x, const Eigen::Vector2d& command,
                                      const Surroundings& around) const {
    PlantState dx = hullDerivative(x, around);
    dx.tail<2>() = propellersAtOnce() ? Eigen::Vector2d::Zero()
                                      : Eigen::Vector2d((saturate(command) - x.tail<2>()) / lag_s_);
    return dx;
  }
  [[nodiscard]] bool propellersAtOnce() const { return lag_s_ == 0.0; }

  // eta', the pose's part of the derivative.
  [[nodiscard]] virtual Vector6 poseRate(const PlantState& x) const;
  // At rest over ground where calm water carries the hull, at the origin, heading north.
  [[nodiscard]] virtual PlantState settled() const = 0;

  // The propeller command, within the propellers' limits, that gives these thrusts in the end.
  [[nodiscard]] virtual Eigen::Vector2d commandFor(const vessel::Thrusts& thrusts_n) const {
    return saturate(thrusts_n);
  }
  [[nodiscard]] virtual Eigen::Vector2d saturate(const Eigen::Vector2d& command) const = 0;
  [[nodiscard]] virtual vessel::Thrusts thrusts(const PlantState& x) const { return x.tail<2>(); }

  // Force of a true wind (air velocity over ground, body frame) on the hull.
  [[nodiscard]] virtual Vector6 windForce(const Eigen::Vector2d& wind_in_body,
                                          const Vector6& velocity) const = 0;

  // Half length and half spread of the pontoons' grid points, m: where waves are felt.
  [[nodiscard]] virtual Eigen::Vector2d gridHalfSize() const = 0;
  [[nodiscard]] virtual double draft() const = 0;
  // Whether the water's orbital motion carries the hull in the plane, too; otherwise waves heave,
  // roll and pitch it only.
  [[nodiscard]] virtual bool wavesCarryInPlane() const = 0;

 private:
  // nu' and eta'; the propellers' rows are overwritten.
  [[nodiscard]] virtual PlantState hullDerivative(const PlantState& x,
                                                  const Surroundings& around) const = 0;

  double lag_s_;
};

// The model that the file of `options.vessel` asks for.
[[nodiscard]] Result<std::unique_ptr<PlantModel>> makePlantModel(const Options& options);

}  // namespace otter_nav::plant
