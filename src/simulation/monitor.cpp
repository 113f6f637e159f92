#include "otter_nav/simulation/monitor.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
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

std::string at(const char* what, const Eigen::Vector2d& p) {
  return text("%s at (%.2f m, %.2f m)", what, p.x(), p.y());
}

}  // namespace

Monitor::Monitor(const Waters& waters, const LoopOptions& options)
    : world_(waters.world),
      vessel_(options.vessel),
      range_m_(options.plant.lidar.range_max_m),
      period_s_(1.0 / options.plant.lidar.rate_hz),
      eye_ahead_m_(options.plant.lidar.position_m.x()),
      seen_(waters.world.cells.size(), false),
      known_(waters.world.cells.size(), false) {
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

// Four times as many sight lines as the lidar has beams, so that no cell is left out that it meets.
void Monitor::look(const Eigen::Vector2d& from) {
  constexpr int kLines = 2880;
  const map::GridGeometry& g = world_.geometry();
  const double step = 0.5 * g.resolution_m;
  const auto see = [&](const Eigen::Vector2d& p) {
    if (g.contains(p)) {
      const Eigen::Vector2i cell = g.cellAt(p);
      seen_[g.index(cell.x(), cell.y())] = true;
      known_[g.index(cell.x(), cell.y())] = true;
    }
  };
  for (int k = 0; k < kLines; ++k) {
    const double bearing = 2.0 * kPi * k / kLines;
    const Eigen::Vector2d along = unitVector(bearing);
    const double free = std::min(world_.castRay(from, along, range_m_), range_m_);
    for (double d = 0.0; d < free; d += step) {
      see(from + d * along);
    }
    see(from + (free + 1e-6) * along);
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
  const double psi = now.state[vessel::kPsi];
  // The decision of this step could go by what was in sight before it.
  if (now.t_s >= next_look_s_) {
    next_look_s_ = now.t_s + period_s_ - 1e-6;
    stop_fault_ = faultOf(loop);
    look(here + eye_ahead_m_ * unitVector(psi));
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
