// The vessel in its world: plant model, propellers, disturbances, sensors and contact, stepped in
// time. Knows no ROS; the same options, seed and commands give the same run.
//
//   auto simulator = plant::Simulator::create(options, world, seed);
//   simulator->placeAt({10.0, 20.0}, 0.5);
//   simulator->step(thrusts, 0.01);
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/base/scan.hpp"
#include "otter_nav/map/occupancy_grid.hpp"
#include "otter_nav/plant/options.hpp"
#include "otter_nav/plant/signals.hpp"
#include "otter_nav/vessel/scripted_vessel.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::plant {

class Simulator {
 public:
  // The plant at rest in the settled trim at the origin, heading east, at time zero. Throws
  // std::invalid_argument for an unknown plant model (readers check it first). A grid of no cells
  // is open water; occupied cells are walls, everything beyond the grid is water.
  Simulator(const Options& options, const map::OccupancyGrid& world, std::uint64_t seed);
  ~Simulator();
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;

  // The same with an error instead of an exception.
  [[nodiscard]] static Result<Simulator> create(const Options& options,
                                                const map::OccupancyGrid& world,
                                                std::uint64_t seed);

  // At this pose, at rest over ground in the plane, in the settled trim about the waves there and
  // moved up and down with them; time and disturbances go on.
  void placeAt(const Eigen::Vector2d& position, double psi_rad);

  // Takes a command, N a side, positive ahead; the plant saturates it. A command that is not finite
  // is refused: the last one goes on until it times out.
  bool command(const vessel::Thrusts& thrusts_n);
  // Goes on for `dt_s` under the last command (RK4 steps of at most 0.01 s).
  void advance(double dt_s);
  // command() and advance().
  void step(const vessel::Thrusts& thrusts_n, double dt_s);

  [[nodiscard]] double time() const;
  [[nodiscard]] const Truth& truth() const;
  [[nodiscard]] const Odometry& odometry() const;
  // Whether no command came for longer than the timeout.
  [[nodiscard]] bool commandTimedOut() const;

  // True once each 1 / rate_hz seconds of simulated time, until scan() is called.
  [[nodiscard]] bool scanDue() const;
  // Casts the beams from the present pose. The reference stays valid until the next call.
  [[nodiscard]] const Scan& scan();

  // Other vessels sail from now on, their time counted from the plant's time zero. They do as they
  // are written; the lidar, the radar and AIS tell of them, and contact with them is contact.
  void setVessels(std::vector<vessel::ScriptedVessel> vessels);
  [[nodiscard]] const std::vector<OtherVessel>& others() const;

  // True once a second of simulated time where there is a radar, until radar() is called: the
  // middles of other vessels, m ahead and to port of base_link, level.
  [[nodiscard]] bool radarDue() const;
  [[nodiscard]] std::vector<Eigen::Vector2d> radar();
  // The AIS sentences (!AIVDM) sent since the last call.
  [[nodiscard]] std::vector<std::string> takeAis();

  // Whether the hull's outline touches an occupied cell or another vessel now, or has since
  // placeAt(); and which vessel it touched last.
  [[nodiscard]] bool inContact() const;
  [[nodiscard]] bool hadContact() const;
  [[nodiscard]] std::optional<int> touchedVessel() const;
  // Exact distance, m, of the hull's outline to the nearest occupied cell or vessel, 0 in contact;
  // saturates at kClearanceLimit.
  [[nodiscard]] double clearance() const;
  static constexpr double kClearanceLimit = 20.0;

  [[nodiscard]] const Options& options() const;
  // Most thrust a side can give, N: ahead, astern (both positive).
  [[nodiscard]] Eigen::Vector2d thrustLimits() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace otter_nav::plant
