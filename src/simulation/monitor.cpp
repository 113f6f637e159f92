#include "otter_nav/simulation/monitor.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/attitude.hpp"
#include "otter_nav/base/parts.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/text.hpp"
#include "otter_nav/plant/hull_contact.hpp"
#include "otter_nav/vessel/hull.hpp"
#include "otter_nav/vessel/rest.hpp"

namespace otter_nav::simulation {
namespace {

using mission::Phase;
using trajectory::TimedTrajectory;

// No noise, and sight lines between the lidar's beams, so that no cell is left out that one might
// have passed: what is only met between them was not in sight.
constexpr int kLinesEachBeam = 4;
plant::LidarOptions sharpest(plant::LidarOptions options) {
  options.beams *= kLinesEachBeam;
  options.range_noise_m = 0.0;
  options.dropout_probability = 0.0;
  return options;
}

std::string at(const char* what, const Eigen::Vector2d& p) {
  return text("%s at (%.2f m, %.2f m)", what, p.x(), p.y());
}

}  // namespace

Monitor::Monitor(const Waters& waters, const LoopOptions& options)
    : world_(waters.world),
      vessel_(options.vessel),
      lidar_(sharpest(options.plant.lidar), 0),
      band_(options.map.band),
      lidar_in_base_(options.plant.lidar.position_m),
      seen_(waters.world.cells.size(), false),
      known_(waters.world.cells.size(), false) {
  others_.set(waters.vessels, 0.0);
  followed_.resize(waters.vessels.size());
  const map::GridGeometry& g = world_.geometry();
  const map::GridGeometry& chart = waters.chart.geometry;
  for (std::size_t i = 0; options.map.trust_chart && i < known_.size(); ++i) {
    const auto width = static_cast<std::size_t>(g.width);
    const Eigen::Vector2d p = g.centreOf(static_cast<int>(i % width), static_cast<int>(i / width));
    if (chart.contains(p)) {
      const Eigen::Vector2i cell = chart.cellAt(p);
      known_[i] = waters.chart.at(cell.x(), cell.y()) == map::Cell::kFree;
    }
  }
}

void Monitor::look(const plant::Truth& truth) {
  const map::GridGeometry& g = world_.geometry();
  const double step = 0.5 * g.resolution_m;
  const auto see = [&](const Eigen::Vector3d& p, bool is_beam) {
    if (p.z() >= band_.min_m && p.z() <= band_.max_m && g.contains(p.head<2>())) {
      const Eigen::Vector2i cell = g.cellAt(p.head<2>());
      const std::size_t index = g.index(cell.x(), cell.y());
      seen_[index] = seen_[index] || is_beam;
      known_[index] = true;
    }
  };
  others_.advance(truth.stamp_s);
  const Scan& scan = lidar_.scan(world_, others_, truth);
  const Eigen::Matrix3d rotation =
      attitude(truth.roll_rad, truth.pitch_rad, truth.yaw_rad).toRotationMatrix();
  const Eigen::Vector3d eye = truth.position + rotation * lidar_in_base_;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (!scan.metSomething(i) && !scan.metNothing(i)) {
      continue;
    }
    const Eigen::Vector3d along = rotation * scan.direction(i);
    const bool is_beam = i % kLinesEachBeam == 0;
    const double free = scan.metSomething(i) ? scan.ranges_m[i] : scan.range_max_m;
    for (double d = 0.0; d < free; d += step) {
      see(eye + d * along, is_beam);
    }
    see(eye + (free + 1e-4) * along, is_beam);
  }
  follow(truth.stamp_s, eye.head<2>());
}

// By her middle: one that is half behind an island may be seen or not.
void Monitor::follow(double now_s, const Eigen::Vector2d& eye) {
  constexpr double kSameRad = 1e-3;
  constexpr double kSameMps = 1e-3;
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    Followed& her = followed_[k];
    const vessel::ScriptedMotion& now = others_.now()[k].motion;
    const Eigen::Vector2d off = now.pose.position - eye;
    const bool in_sight = off.norm() < lidar_.rangeMax() &&
                          world_.castRay(eye, off.normalized(), off.norm()) >= off.norm();
    const bool same = std::abs(wrapAngle(now.pose.psi_rad - her.motion.pose.psi_rad)) < kSameRad &&
                      std::abs(now.speed_mps - her.motion.speed_mps) < kSameMps;
    her.motion = now;
    if (!in_sight) {
      her.since_s = std::numeric_limits<double>::infinity();
    } else if (!same || std::isinf(her.since_s)) {
      her.since_s = now_s;
    }
  }
}

// The hull's squares: what of them was seen to be occupied, or is known to nobody.
std::string Monitor::faultAt(const Eigen::Vector2d& position, double psi_rad) const {
  const map::GridGeometry& g = world_.geometry();
  const bool touches = plant::hullTouches(world_, vessel_.hull, position, psi_rad);
  const double reach = vessel::circumscribedRadius(vessel_.hull) + g.resolution_m;
  const map::CellRectangle near = g.around(position, reach);
  for (int row = near.row; row < near.row + near.height; ++row) {
    for (int column = near.column; column < near.column + near.width; ++column) {
      const std::size_t index = g.index(column, row);
      const Eigen::Vector2d square = g.centreOf(column, row);
      const bool occupied = world_.freeCells(column, row) == 0;
      const double wider = occupied ? 0.71 * g.resolution_m : 0.0;
      const bool under_it = vessel::covers(vessel_.hull, {position, psi_rad}, square, wider);
      if (under_it && occupied && touches && seen_[index]) {
        return at("the stop touches something that was in sight", square);
      }
      if (under_it && !occupied && !known_[index]) {
        return at("the stop leads into water that was not seen", square);
      }
    }
  }
  return {};
}

// Whom the tracker must know by now, where she would be with her course kept.
bool Monitor::meets(const vessel::Pose& own, double now_s, double later_s) const {
  constexpr double kKnownS = 3.0;
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    const Followed& her = followed_[k];
    vessel::Pose there = her.motion.pose;
    there.position += later_s * her.motion.speed_mps * unitVector(there.psi_rad);
    if (now_s - her.since_s >= kKnownS &&
        plant::OtherVessels::distance(vessel_.hull, own, others_.now()[k].hull, there) == 0.0) {
      return true;
    }
  }
  return false;
}

std::string Monitor::fault(const TimedTrajectory& stop, double now_s) const {
  constexpr double kStepS = 0.05;
  const double end = stop.trajectory.duration();
  const double from = std::clamp(stop.elapsed(now_s), 0.0, end);
  const int steps = partsOf(end - from, kStepS, 0);
  for (int k = 0; k <= steps; ++k) {
    const double t = std::min(end, from + k * kStepS);
    const vessel::State x = stop.trajectory.sample(t, vessel_).state;
    std::string fault = faultAt(x.head<2>(), x[vessel::kPsi]);
    if (!fault.empty()) {
      return fault;
    }
    if (vessel::speedOf(x) > vessel::kRestMps &&
        meets({x.head<2>(), x[vessel::kPsi]}, now_s, t - from)) {
      return at("the stop meets another vessel under way", x.head<2>());
    }
  }
  const vessel::State last = stop.trajectory.sample(end, vessel_).state;
  return vessel::speedOf(last) > vessel::kRestMps ? "the stop ends under way" : "";
}

// Under way there must be a stop that is still to be had; while coming to rest it is sailed.
std::string Monitor::faultOf(const ClosedLoop& loop) const {
  constexpr double kApartM = 0.2;
  const mission::Supervisor& supervisor = loop.supervisor();
  const TimedTrajectory& sailed = supervisor.sailed();
  const Phase phase = supervisor.phase();
  if (sailed.trajectory.empty()) {
    return {};
  }
  if (phase == Phase::kSailing || phase == Phase::kReplanning) {
    const auto& stop = supervisor.lastStop();
    const auto place = [&](const TimedTrajectory& path) -> Eigen::Vector2d {
      return path.trajectory.flat(path.elapsed(loop.time())).position;
    };
    if (!stop || (place(*stop) - place(sailed)).norm() > kApartM) {
      return at("no stop", place(sailed));
    }
    return fault(*stop, loop.time());
  }
  const bool comes_to_rest =
      phase == Phase::kStopping || phase == Phase::kBackingOff || phase == Phase::kTurningBack;
  return comes_to_rest ? fault(sailed, loop.time()) : std::string();
}

void Monitor::watch(const ClosedLoop& loop) {
  const scenario::MotionSample now = loop.motion();
  const Eigen::Vector2d here = now.state.head<2>();
  // The decision on a scan could go by what was in sight before it.
  if (loop.scannedFrom().stamp_s > looked_s_) {
    looked_s_ = loop.scannedFrom().stamp_s;
    stop_fault_ = faultOf(loop);
    look(loop.scannedFrom());
  }
  result_.margin_m =
      result_.steps == 0 ? now.clearance_m : std::min(result_.margin_m, now.clearance_m);
  ++result_.steps;
  const std::string fault = now.clearance_m <= 0.0 ? at("contact", here) : stop_fault_;
  if (!fault.empty()) {
    ++result_.violations;
    if (result_.first.empty()) {
      result_.first = text("%.2f s: ", now.t_s) + fault;
    }
  }
}

}  // namespace otter_nav::simulation
