#include "environment.hpp"

#include <cmath>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::plant {
namespace {

// Independent streams from one seed (the finaliser of splitmix64).
std::uint64_t stream(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t z = seed + (index + 1) * 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

enum StreamIndex : std::uint64_t { kWindStream = 0, kCurrentStream = 1, kWaveStream = 2 };

// East, north to forward, starboard; NED's yaw is clockwise from north.
struct BodyFrame {
  explicit BodyFrame(double yaw_ned) : cos_yaw(std::cos(yaw_ned)), sin_yaw(std::sin(yaw_ned)) {}
  [[nodiscard]] Eigen::Vector2d fromMap(const Eigen::Vector2d& v) const {
    return {cos_yaw * v.y() + sin_yaw * v.x(), -sin_yaw * v.y() + cos_yaw * v.x()};
  }
  double cos_yaw;
  double sin_yaw;
};

}  // namespace

Environment::Environment(const EnvironmentOptions& options, std::uint64_t seed)
    : options_(options),
      wind_(options.wind, stream(seed, kWindStream)),
      current_(options.current, stream(seed, kCurrentStream)),
      waves_(options.waves, stream(seed, kWaveStream)) {}

void Environment::advance(double dt_s) {
  wind_.advance(dt_s);
  current_.advance(dt_s);
}

Conditions Environment::at(double time_s, const vessel::State& planar,
                           const PlantModel& model) const {
  Conditions c;
  c.wind_mps = wind_.velocity();
  c.current_mps = current_.velocity();
  c.force_n = options_.force_n;
  if (!waves_.empty()) {
    c.waves = waves_.underHull(planar.head<2>(), planar[vessel::kPsi], time_s, model.gridHalfSize(),
                               model.draft());
    if (!model.wavesCarryInPlane()) {
      c.waves.orbital_velocity_mps.setZero();
      c.waves.orbital_acceleration_mps2.setZero();
      c.waves.rotation_radps = 0.0;
      c.waves.rotation_rate_radps2 = 0.0;
    }
  }
  return c;
}

Surroundings surroundings(const Conditions& conditions, const PlantState& x,
                          const PlantModel& model) {
  const BodyFrame body(x[kYaw]);
  const HullWaves& w = conditions.waves;
  const Eigen::Vector2d current = body.fromMap(conditions.current_mps);
  Surroundings around;
  around.water_velocity[kU] = current.x() + w.orbital_velocity_mps.x();
  around.water_velocity[kV] = current.y() - w.orbital_velocity_mps.y();
  around.water_velocity[kR] = -w.rotation_radps;
  around.water_acceleration[kU] = w.orbital_acceleration_mps2.x();
  around.water_acceleration[kV] = -w.orbital_acceleration_mps2.y();
  around.water_acceleration[kR] = -w.rotation_rate_radps2;
  // Water that rises to port heels the hull to starboard; water that rises ahead lifts the bow.
  around.surface = {-w.elevation_m, w.slope.y(), w.slope.x()};
  around.surface_rate = {-w.elevation_rate_mps, w.slope_rate_radps.y(), w.slope_rate_radps.x()};
  around.force = model.windForce(body.fromMap(conditions.wind_mps), velocityOf(x));
  around.force.head<2>() += body.fromMap(conditions.force_n);
  return around;
}

vessel::State planarPose(const PlantState& x) {
  vessel::State s = vessel::State::Zero();
  s[vessel::kX] = x[kEast];
  s[vessel::kY] = x[kNorth];
  s[vessel::kPsi] = wrapAngle(0.5 * kPi - x[kYaw]);
  return s;
}

Truth toTruth(const PlantState& x, const Vector6& pose_rate) {
  Truth t;
  t.planar = planarPose(x);
  t.position = {x[kEast], x[kNorth], -x[kDown]};
  t.roll_rad = x[kRoll];
  t.pitch_rad = -x[kPitch];
  t.yaw_rad = t.planar[vessel::kPsi];
  t.velocity_in_body = {x[kU], -x[kV], -x[kW]};
  t.angular_velocity_in_body = {x[kP], -x[kQ], -x[kR]};
  const double c = std::cos(x[kYaw]);
  const double s = std::sin(x[kYaw]);
  t.planar[vessel::kSurge] = c * pose_rate[0] + s * pose_rate[1];
  t.planar[vessel::kSway] = s * pose_rate[0] - c * pose_rate[1];
  t.planar[vessel::kYawRate] = -pose_rate[5];
  return t;
}

PlantState placed(PlantState x, const Eigen::Vector2d& position, double psi_rad) {
  x[kEast] = position.x();
  x[kNorth] = position.y();
  x[kYaw] = wrapAngle(0.5 * kPi - psi_rad);
  return x;
}

}  // namespace otter_nav::plant
