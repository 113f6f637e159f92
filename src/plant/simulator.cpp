#include "otter_nav/plant/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "ais_transmitters.hpp"
#include "environment.hpp"
#include "lidar.hpp"
#include "odometry_sensor.hpp"
#include "other_vessels.hpp"
#include "otter_nav/plant/hull_contact.hpp"
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

class Simulator::Impl {
 public:
  Impl(const Options& options, std::unique_ptr<PlantModel> model, const map::OccupancyGrid& world,
       std::uint64_t seed)
      : environment_(options.disturbance, seed),
        odometry_(options.odometry, seed ^ kOdometrySeed),
        lidar_(options.lidar, seed ^ kLidarSeed),
        radar_(options.radar, seed ^ kRadarSeed),
        transmitters_(options.datum, seed ^ kAisSeed),
        options_(options),
        world_(world),
        model_(std::move(model)) {
    placeAt(Eigen::Vector2d::Zero(), 0.0);
  }

  void placeAt(const Eigen::Vector2d& position, double psi_rad) {
    state_ = placed(model_->settled(), position, psi_rad);
    had_contact_ = false;
    touched_vessel_.reset();
    odometry_.reset();
    observe();
  }

  bool command(const vessel::Thrusts& thrusts_n) {
    if (!thrusts_n.allFinite()) {
      return false;
    }
    command_ = model_->commandFor(thrusts_n);
    command_time_s_ = time_s_;
    return true;
  }

  void advance(double dt_s) {
    constexpr double kRounding = 1e-9;
    const double count = std::ceil(dt_s / kStepS - kRounding);
    const int steps = count > 1.0 ? static_cast<int>(count) : 1;
    for (int i = 0; i < steps; ++i) {
      stepOnce(dt_s / steps);
    }
  }

  [[nodiscard]] bool commandTimedOut() const {
    constexpr double kRounding = 1e-9;
    return time_s_ - command_time_s_ >= options_.command_timeout_s - kRounding;
  }

  [[nodiscard]] bool scanDue() const { return time_s_ >= next_scan_s_; }
  const Scan& scan() {
    constexpr double kRounding = 1e-9;
    const double period = 1.0 / options_.lidar.rate_hz;
    next_scan_s_ = (std::floor(time_s_ / period + kRounding) + 1.0) * period - kRounding;
    return lidar_.scan(world_, others_, truth_);
  }

  void setVessels(std::vector<vessel::ScriptedVessel> vessels) {
    transmitters_.set(vessels, time_s_);
    others_.set(std::move(vessels), time_s_);
    sentences_.clear();
  }
  [[nodiscard]] const std::vector<OtherVessel>& others() const { return others_.now(); }
  [[nodiscard]] bool radarDue() const {
    return options_.radar.range_m > 0.0 && time_s_ >= next_radar_s_;
  }
  std::vector<Eigen::Vector2d> radar() {
    next_radar_s_ = time_s_ + 1.0 / RadarOptions::kRateHz - 1e-9;
    return radar_.scan(others_.now(), truth_);
  }
  [[nodiscard]] std::vector<std::string> takeAis() { return std::exchange(sentences_, {}); }

  [[nodiscard]] double clearance() const {
    const double world = hullClearance(world_, options_.vessel.hull, truth_.planar.head<2>(),
                                       truth_.yaw_rad, kClearanceLimit);
    const auto nearest = nearestVessel();
    return nearest ? std::min(world, nearest->distance_m) : world;
  }
  [[nodiscard]] Eigen::Vector2d thrustLimits() const {
    constexpr double kMore = 1e6;
    const auto most = [&](double asked) {
      PlantState x = PlantState::Zero();
      x.tail<2>() = model_->commandFor(vessel::Thrusts::Constant(asked));
      return std::abs(model_->thrusts(x)[vessel::kLeft]);
    };
    return {most(kMore), most(-kMore)};
  }

  [[nodiscard]] double time() const { return time_s_; }
  [[nodiscard]] const Truth& truth() const { return truth_; }
  [[nodiscard]] const Odometry& odometry() const { return odometry_.latest(); }
  [[nodiscard]] bool inContact() const { return in_contact_; }
  [[nodiscard]] bool hadContact() const { return had_contact_; }
  [[nodiscard]] std::optional<int> touchedVessel() const { return touched_vessel_; }
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  // Wind, current and waves are taken in the step's middle and held through it.
  void stepOnce(double dt_s) {
    environment_.advance(dt_s);
    const Conditions conditions =
        environment_.at(time_s_ + 0.5 * dt_s, planarPose(state_), *model_);
    const Eigen::Vector2d command =
        commandTimedOut() ? model_->commandFor(vessel::Thrusts::Zero()) : command_;
    state_ = model_->step(state_, command, dt_s, [&](const PlantState& x) {
      return surroundings(conditions, x, *model_);
    });
    time_s_ += dt_s;
    others_.advance(time_s_);
    transmitters_.advance(others_.now(), time_s_, sentences_);
    truth_.wind_mps = conditions.wind_mps;
    truth_.current_mps = conditions.current_mps;
    observe();
  }

  void observe() {
    const Eigen::Vector2d wind = truth_.wind_mps;
    const Eigen::Vector2d current = truth_.current_mps;
    truth_ = toTruth(state_, model_->poseRate(state_));
    truth_.stamp_s = time_s_;
    truth_.thrusts_n = model_->thrusts(state_);
    truth_.wind_mps = wind;
    truth_.current_mps = current;
    odometry_.measure(truth_);
    in_contact_ =
        hullTouches(world_, options_.vessel.hull, truth_.planar.head<2>(), truth_.yaw_rad);
    if (const auto nearest = nearestVessel(); nearest && nearest->distance_m == 0.0) {
      in_contact_ = true;
      touched_vessel_ = others_.now()[nearest->index].id;
    }
    had_contact_ = had_contact_ || in_contact_;
  }

  [[nodiscard]] std::optional<OtherVessels::Nearest> nearestVessel() const {
    return others_.nearest(options_.vessel.hull, truth_.planar.head<2>(), truth_.yaw_rad);
  }

  Environment environment_;
  OdometrySensor odometry_;
  Lidar lidar_;
  Radar radar_;
  OtherVessels others_;
  AisTransmitters transmitters_;
  std::vector<std::string> sentences_;  // sent and not yet taken
  PlantState state_ = PlantState::Zero();
  Truth truth_;
  Eigen::Vector2d command_ = Eigen::Vector2d::Zero();
  Options options_;
  WorldMap world_;
  std::unique_ptr<PlantModel> model_;
  double time_s_ = 0.0;
  double command_time_s_ = -std::numeric_limits<double>::infinity();
  double next_scan_s_ = 0.0;
  double next_radar_s_ = 0.0;
  bool in_contact_ = false;
  bool had_contact_ = false;
  std::optional<int> touched_vessel_;
};

Simulator::Simulator(const Options& options, const map::OccupancyGrid& world, std::uint64_t seed) {
  Result<std::unique_ptr<PlantModel>> model = makePlantModel(options);
  if (!model) {
    throw std::invalid_argument(model.error().message);
  }
  impl_ = std::make_unique<Impl>(options, std::move(*model), world, seed);
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
  impl_->placeAt(position, psi_rad);
}
bool Simulator::command(const vessel::Thrusts& thrusts_n) {
  return impl_->command(thrusts_n);
}
void Simulator::advance(double dt_s) {
  impl_->advance(dt_s);
}
void Simulator::step(const vessel::Thrusts& thrusts_n, double dt_s) {
  impl_->command(thrusts_n);
  impl_->advance(dt_s);
}
double Simulator::time() const {
  return impl_->time();
}
const Truth& Simulator::truth() const {
  return impl_->truth();
}
const Odometry& Simulator::odometry() const {
  return impl_->odometry();
}
bool Simulator::commandTimedOut() const {
  return impl_->commandTimedOut();
}
bool Simulator::scanDue() const {
  return impl_->scanDue();
}
const Scan& Simulator::scan() {
  return impl_->scan();
}
bool Simulator::inContact() const {
  return impl_->inContact();
}
bool Simulator::hadContact() const {
  return impl_->hadContact();
}
std::optional<int> Simulator::touchedVessel() const {
  return impl_->touchedVessel();
}
void Simulator::setVessels(std::vector<vessel::ScriptedVessel> vessels) {
  impl_->setVessels(std::move(vessels));
}
const std::vector<OtherVessel>& Simulator::others() const {
  return impl_->others();
}
bool Simulator::radarDue() const {
  return impl_->radarDue();
}
std::vector<Eigen::Vector2d> Simulator::radar() {
  return impl_->radar();
}
std::vector<std::string> Simulator::takeAis() {
  return impl_->takeAis();
}
double Simulator::clearance() const {
  return impl_->clearance();
}
const Options& Simulator::options() const {
  return impl_->options();
}
Eigen::Vector2d Simulator::thrustLimits() const {
  return impl_->thrustLimits();
}

}  // namespace otter_nav::plant
