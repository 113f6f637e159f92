#include "closed_loop.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "otter_nav/plant/simulator.hpp"
#include "otter_nav/tracker/tracker.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::benchmark {
namespace {

// Sums over the measured window.
class Tally {
 public:
  explicit Tally(const vessel::Thrusters& limits) : limits_(limits) {}

  void add(const plant::Truth& truth, const vessel::FlatPoint& reference,
           const tracker::Command& command, double dt_s) {
    const double error = (truth.planar.head<2>() - reference.position).norm();
    const double speed = vessel::speedOf(truth.planar);
    const double yaw_rate = truth.planar[vessel::kYawRate];
    ++count_;
    sums_.mean_error_m += error;
    sums_.max_error_m = std::max(sums_.max_error_m, error);
    sums_.mean_speed += speed;
    sums_.max_speed = std::max(sums_.max_speed, speed);
    sums_.planned_mean_speed += reference.velocity.norm();
    sums_.yaw_rate_integral += yaw_rate * yaw_rate * dt_s;
    sums_.thrust_rms_n += 0.5 * command.thrusts.squaredNorm();
    if (count_ > 1) {
      sums_.thrust_rate_rms_nps += 0.5 * ((command.thrusts - last_) / dt_s).squaredNorm();
    }
    last_ = command.thrusts;
    sums_.saturation_share += vessel::thrustMargin(command.thrusts, limits_) < 1e-3 ? 1.0 : 0.0;
    sums_.unsolved_share += command.solver == tracker::SolverStatus::kSolved ? 0.0 : 1.0;
  }

  [[nodiscard]] RunFigures figures() const {
    RunFigures f = sums_;
    const double n = std::max(1, count_);
    f.mean_error_m /= n;
    f.mean_speed /= n;
    f.planned_mean_speed /= n;
    f.thrust_rms_n = std::sqrt(f.thrust_rms_n / n);
    f.thrust_rate_rms_nps = std::sqrt(f.thrust_rate_rms_nps / n);
    f.saturation_share /= n;
    f.unsolved_share /= n;
    return f;
  }

 private:
  vessel::Thrusters limits_;
  RunFigures sums_;
  int count_ = 0;
  vessel::Thrusts last_ = vessel::Thrusts::Zero();
};

void dumpRow(std::ostream& out, const plant::Truth& truth, const vessel::State& reference,
             const tracker::Command& command) {
  out << truth.stamp_s;
  for (int i = 0; i < vessel::kStateSize; ++i) {
    out << ',' << truth.planar[i];
  }
  out << ',' << truth.roll_rad << ',' << truth.pitch_rad << ',' << command.thrusts[0] << ','
      << command.thrusts[1];
  for (int i = 0; i < vessel::kStateSize; ++i) {
    out << ',' << reference[i];
  }
  out << ',' << (truth.planar.head<2>() - reference.head<2>()).norm() << ','
      << command.outside_force_n.x() << ',' << command.outside_force_n.y() << ','
      << command.outside_moment_nm << ',' << command.disturbance.mean.current_mps.x() << ','
      << command.disturbance.mean.current_mps.y() << ',' << tracker::name(command.mode) << '\n';
}

}  // namespace

Result<RunFigures> run(const RunSetup& setup, std::ostream* dump,
                       const std::function<void(double)>& progress) {
  auto simulator = plant::Simulator::create(setup.plant, map::OccupancyGrid{}, setup.seed);
  if (!simulator) {
    return failure(simulator.error().message);
  }
  const trajectory::Sample start = setup.trajectory.sample(0.0, setup.vessel);
  simulator->placeAt(start.state.head<2>(), start.state[vessel::kPsi]);
  const auto tracker = tracker::Tracker::create(setup.tracker, setup.vessel);
  if (Status status = tracker->setTrajectory({setup.trajectory, simulator->time()}); !status) {
    return failure(status.error().message);
  }
  if (dump != nullptr) {
    *dump << "t,x,y,psi,u,v,r,roll,pitch,f_left,f_right,x_ref,y_ref,psi_ref,u_ref,v_ref,r_ref,"
             "error,force_x,force_y,moment,current_x,current_y,mode\n";
  }
  const double period = setup.tracker.period_s;
  const double began = simulator->time();
  const int cycles = static_cast<int>(setup.duration_s / period);
  Tally tally(setup.vessel.thrusters);
  std::vector<double> step_us;
  step_us.reserve(static_cast<std::size_t>(cycles));
  double capsized_at_s = -1.0;
  for (int i = 0; i < cycles; ++i) {
    const double now = simulator->time();
    tracker->addOdometry(simulator->odometry().stamp_s, simulator->odometry().state,
                         -simulator->odometry().pitch_rad);
    const auto before = std::chrono::steady_clock::now();
    const tracker::Command command = tracker->step(now);
    const auto after = std::chrono::steady_clock::now();
    step_us.push_back(std::chrono::duration<double, std::micro>(after - before).count());
    const trajectory::Sample reference = setup.trajectory.sample(now - began, setup.vessel);
    if (now - began >= setup.errors_from_s) {
      tally.add(simulator->truth(), reference.flat, command, period);
    }
    if (dump != nullptr) {
      dumpRow(*dump, simulator->truth(), reference.state, command);
    }
    simulator->step(command.thrusts, period);
    if (plant::capsized(simulator->truth().roll_rad, simulator->truth().pitch_rad)) {
      capsized_at_s = now - began;
      break;
    }
    if (progress && i % 200 == 0) {
      progress(static_cast<double>(i) / cycles);
    }
  }
  RunFigures figures = tally.figures();
  figures.step_us = percentiles(step_us);
  figures.capsized_at_s = capsized_at_s;
  return figures;
}

}  // namespace otter_nav::benchmark
