// Tracks of other vessels from lidar, radar and AIS. No clock of its own: every call brings its
// time, and the same calls give the same tracks.
//
//   Tracker tracker(options, chart, own_hull);
//   tracker.addScan(stamp_s, sensor, own, scan);
//   tracker.addRadar(stamp_s, positions_in_map, own.position);
//   tracker.addAis(stamp_s, sentence);
//   planner_obstacles.add(TrackLayer(tracker.tracks(), {}));
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string_view>
#include <vector>

#include "otter_nav/ais/local_frame.hpp"
#include "otter_nav/base/result.hpp"
#include "otter_nav/map/occupancy_map.hpp"
#include "otter_nav/traffic/track.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::traffic {

struct Options {
  double radar_range_m = 145.0;  // who is nearer and not seen is doubted
  double radar_noise_m = 1.0;    // standard deviation, each axis
  ais::Datum datum;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields.group("datum", o.datum, "the map's origin on the globe");
  }
};

// What a scan says of things that move.
struct ScanVerdict {
  // A beam each: whether it met a vessel that is tracked and has moved. What such beams met does
  // not belong into a map of what stands.
  std::vector<bool> on_vessel;
  // Where a vessel was met before it was known to be one, or lay before it sailed on: what a map
  // holds there is a ghost.
  std::vector<Eigen::Vector2d> ghosts;
  // Points within the hulls of vessels that have come to lie still, at the sensor's height: the
  // map's from now on, of which the lidar sees but the near sides.
  std::vector<Eigen::Vector3d> lying;
};

class Tracker {
 public:
  // `chart` may have no cells; what it shows is never taken for a vessel.
  Tracker(const Options& options, const map::OccupancyGrid& chart, const vessel::Hull& own_hull);
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  // The reference stays valid, and what it refers to the same, until the next scan: what radar and
  // AIS tell meanwhile is in that one's verdict.
  const ScanVerdict& addScan(double stamp_s, const map::SensorPose& sensor, const vessel::Pose& own,
                             const Scan& scan);
  // All positions seen at once, from a sensor at `own`.
  void addRadar(double stamp_s, const std::vector<Eigen::Vector2d>& positions,
                const Eigen::Vector2d& own);
  // A sentence as received; an error says why it is none.
  [[nodiscard]] Status addAis(double stamp_s, std::string_view sentence);
  // Forgets tracks that were not heard or seen of for too long.
  void forget(double now_s);
  // Forgets all tracks, as if the time began with the next call: the clock was set back. Their
  // numbers are not given again.
  void beginAnew();

  // Those that are confirmed, each at the instant it was last measured.
  [[nodiscard]] const std::vector<Track>& tracks() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace otter_nav::traffic
