#include "otter_nav/plant/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "ais_transmitters.hpp"
#include "environment.hpp"
#include "odometry_sensor.hpp"
#include "otter_nav/plant/hull_contact.hpp"
#include "otter_nav/plant/lidar.hpp"
#include "otter_nav/plant/other_vessels.hpp"
#include "otter_nav/plant/plant_model.hpp"
#include "otter_nav/plant/world_map.hpp"
#include "radar.hpp"

namespace otter_nav::plant {
namespace {

constexpr double kStepS = 0.01;  // of the integrator, at most

// Offsets that keep the sensors' noise apart from the disturbances'.
constexpr std::uint64_t kOdometrySeed = 0x6f646f6dULL;
constexpr std::uint64_t kLidarSeed = 0x6c696461ULL;
constexpr std::uint64_t kRadarSeed = 0x72616461ULL;
constexpr std::uint64_t kAisSeed = 0x61697362ULL;

}  // namespace

// The instruments, the others, and where everything has got to.
struct Simulator::Parts {
  Parts(const Options& asked, std::unique_ptr<PlantModel> sailed, const map::OccupancyGrid& grid,
        std::uint64_t seed)
      : environment(asked.disturbance, seed),
        odometry(asked.odometry, seed ^ kOdometrySeed),
        lidar(asked.lidar, seed ^ kLidarSeed),
        radar(asked.radar, seed ^ kRadarSeed),
        transmitters(asked.datum, seed ^ kAisSeed),
        options(asked),
        world(grid),
        model(std::move(sailed)) {}

  [[nodiscard]] bool commandTimedOut() const {
    constexpr double kRounding = 1e-9;
    return time_s - command_time_s >= options.command_timeout_s - kRounding;
  }

  // Wind, current and waves are taken in the step's middle and held through it.
  void stepOnce(double dt_s) {
    environment.advance(dt_s);
    const Conditions conditions = environment.at(time_s + 0.5 * dt_s, planarPose(state), *model);
    const Eigen::Vector2d held =
        commandTimedOut() ? model->commandFor(vessel::Thrusts::Zero()) : command;
    state = model->step(state, held, dt_s,
                        [&](const PlantState& x) { return surroundings(conditions, x, *model); });
    time_s += dt_s;
    others.advance(time_s);
    transmitters.advance(others.now(), time_s, sentences);
    truth.wind_mps = conditions.wind_mps;
    truth.current_mps = conditions.current_mps;
    observe();
  }

  // Where calm water would carry it, moved with the waves there: dropped onto a sea from mean level
  // a light hull may turn over before it has done anything.
  void rideTheWaves() {
    const Surroundings around =
        surroundings(environment.at(time_s, planarPose(state), *model), state, *model);
    state.segment<3>(kDown) += around.surface;
    state.segment<3>(kW) += around.surface_rate;
  }

  void observe() {
    const Eigen::Vector2d wind = truth.wind_mps;
    const Eigen::Vector2d current = truth.current_mps;
    truth = toTruth(state, model->poseRate(state));
    truth.stamp_s = time_s;
    truth.thrusts_n = model->thrusts(state);
    truth.wind_mps = wind;
    truth.current_mps = current;
    odometry.measure(truth);
    in_contact = hullTouches(world, options.vessel.hull, truth.planar.head<2>(), truth.yaw_rad);
    if (const auto nearest = nearestVessel(); nearest && nearest->distance_m == 0.0) {
      in_contact = true;
      touched_vessel = others.now()[nearest->index].id;
    }
    had_contact = had_contact || in_contact;
  }

  [[nodiscard]] std::optional<OtherVessels::Nearest> nearestVessel() const {
    return others.nearest(options.vessel.hull, truth.planar.head<2>(), truth.yaw_rad);
  }

  Environment environment;
  OdometrySensor odometry;
  Lidar lidar;
  Radar radar;
  OtherVessels others;
  AisTransmitters transmitters;
  std::vector<std::string> sentences;  // sent and not yet taken
  PlantState state = PlantState::Zero();
  Truth truth;
  Eigen::Vector2d command = Eigen::Vector2d::Zero();
  Options options;
  WorldMap world;
  std::unique_ptr<PlantModel> model;
  double time_s = 0.0;
  double command_time_s = -std::numeric_limits<double>::infinity();
  double next_scan_s = 0.0;
  double next_radar_s = 0.0;
  bool in_contact = false;
  bool had_contact = false;
  std::optional<int> touched_vessel;
};

Simulator::Simulator(const Options& options, const map::OccupancyGrid& world, std::uint64_t seed) {
  Result<std::unique_ptr<PlantModel>> model = makePlantModel(options);
  if (!model) {
    throw std::invalid_argument(model.error().message);
  }
  parts_ = std::make_unique<Parts>(options, std::move(*model), world, seed);
  placeAt(Eigen::Vector2d::Zero(), 0.0);
}

Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;

Result<Simulator> Simulator::create(const Options& options, const map::OccupancyGrid& world,
                                    std::uint64_t seed) {
  if (Result<std::unique_ptr<PlantModel>> model = makePlantModel(options); !model) {
    return failure(model.error().message);
  }
  const std::size_t cells = world.geometry.index(0, world.geometry.height);
  if (world.cells.size() != cells) {
    return failure("world of " + std::to_string(world.geometry.width) + " by " +
                   std::to_string(world.geometry.height) + " cells holds " +
                   std::to_string(world.cells.size()) + " of them");
  }
  return Simulator(options, world, seed);
}

void Simulator::placeAt(const Eigen::Vector2d& position, double psi_rad) {
  parts_->state = placed(parts_->model->settled(), position, psi_rad);
  parts_->rideTheWaves();
  parts_->had_contact = false;
  parts_->touched_vessel.reset();
  parts_->odometry.reset();
  parts_->observe();
}

bool Simulator::command(const vessel::Thrusts& thrusts_n) {
  if (!thrusts_n.allFinite()) {
    return false;
  }
  parts_->command = parts_->model->commandFor(thrusts_n);
  parts_->command_time_s = parts_->time_s;
  return true;
}

void Simulator::advance(double dt_s) {
  constexpr double kRounding = 1e-9;
  const double count = std::ceil(dt_s / kStepS - kRounding);
  const int steps = count > 1.0 ? static_cast<int>(count) : 1;
  for (int i = 0; i < steps; ++i) {
    parts_->stepOnce(dt_s / steps);
  }
}

void Simulator::step(const vessel::Thrusts& thrusts_n, double dt_s) {
  command(thrusts_n);
  advance(dt_s);
}

double Simulator::time() const {
  return parts_->time_s;
}
const Truth& Simulator::truth() const {
  return parts_->truth;
}
const Odometry& Simulator::odometry() const {
  return parts_->odometry.latest();
}
bool Simulator::commandTimedOut() const {
  return parts_->commandTimedOut();
}
bool Simulator::scanDue() const {
  return parts_->time_s >= parts_->next_scan_s;
}
// It came due that much early at most: it must not come due again.
const Scan& Simulator::scan() {
  constexpr double kEarlyMostS = 1e-6;
  const double period = 1.0 / parts_->options.lidar.rate_hz;
  const double turn = std::floor((parts_->time_s + 2.0 * kEarlyMostS) / period);
  parts_->next_scan_s = (turn + 1.0) * period - kEarlyMostS;
  return parts_->lidar.scan(parts_->world, parts_->others, parts_->truth);
}
bool Simulator::inContact() const {
  return parts_->in_contact;
}
bool Simulator::hadContact() const {
  return parts_->had_contact;
}
std::optional<int> Simulator::touchedVessel() const {
  return parts_->touched_vessel;
}
void Simulator::setVessels(std::vector<vessel::ScriptedVessel> vessels) {
  parts_->transmitters.set(vessels, parts_->time_s);
  parts_->others.set(std::move(vessels), parts_->time_s);
  parts_->sentences.clear();
}
const std::vector<OtherVessel>& Simulator::others() const {
  return parts_->others.now();
}
bool Simulator::radarDue() const {
  return parts_->options.radar.range_m > 0.0 && parts_->time_s >= parts_->next_radar_s;
}
std::vector<Eigen::Vector2d> Simulator::radar() {
  parts_->next_radar_s = parts_->time_s + 1.0 / RadarOptions::kRateHz - 1e-9;
  return parts_->radar.scan(parts_->others.now(), parts_->truth);
}
std::vector<std::string> Simulator::takeAis() {
  return std::exchange(parts_->sentences, {});
}
double Simulator::clearance() const {
  const double world =
      hullClearance(parts_->world, parts_->options.vessel.hull, parts_->truth.planar.head<2>(),
                    parts_->truth.yaw_rad, kClearanceLimit);
  const auto nearest = parts_->nearestVessel();
  return nearest ? std::min(world, nearest->distance_m) : world;
}
const Options& Simulator::options() const {
  return parts_->options;
}
Eigen::Vector2d Simulator::thrustLimits() const {
  constexpr double kMore = 1e6;
  const auto most = [&](double asked) {
    PlantState x = PlantState::Zero();
    x.tail<2>() = parts_->model->commandFor(vessel::Thrusts::Constant(asked));
    return std::abs(parts_->model->thrusts(x)[vessel::kLeft]);
  };
  return {most(kMore), most(-kMore)};
}

}  // namespace otter_nav::plant
