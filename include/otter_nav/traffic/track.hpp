// What is known of another vessel, and the way it will probably take.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace otter_nav::traffic {

// Who has told of a track: bits of Track::sources.
enum Source : std::uint32_t { kLidar = 1U, kRadar = 2U, kAis = 4U };

// The outline that is kept clear of: a rectangle along the heading, or a disc as long as it is
// broad, where no heading is known.
enum class Shape { kBox, kDisc };

// No vessel on earth is longer or faster; foretold, one would be everywhere.
constexpr double kLongestM = 1000.0;
constexpr double kFastestMps = 100.0;

constexpr double kSteadyTurnS = 40.0;  // in which a turn that has been steady dies out

// Map frame (ENU), SI units, angles counter-clockwise from east.
struct Track {
  int id = 0;              // of the tracker; the same for the track's whole life
  std::uint32_t mmsi = 0;  // AIS identity; 0: none known
  double stamp_s = 0.0;    // what follows is of this instant of the mission's clock
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // the outline's middle
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // over ground
  double heading_rad = 0.0;
  double turn_rate_radps = 0.0;  // of course and heading alike
  double turn_time_s = 5.0;      // in which the turn will have fallen to 1 / e
  bool keeps_place = false;      // at anchor, a buoy, or lying still: foretold to stay
  Shape shape = Shape::kBox;
  double length_m = 0.0;  // up to kLongestM, as the beam
  double beam_m = 0.0;
  // Of [x m, y m, v_x m/s, v_y m/s].
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  double existence = 1.0;     // probability that there is a vessel at all
  std::uint32_t sources = 0;  // bits of Source
  // Where a sensor last met the outline's middle. Nothing of how she went before is in it, as it is
  // in what stands above. A deviation of 0: nothing is known.
  struct Met {
    double stamp_s = 0.0;
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    double deviation_m = 0.0;  // standard deviation, each axis
  };
  Met met;

  // Faster than what lies still is taken to be while its track wanders.
  [[nodiscard]] bool makesWay() const {
    constexpr double kMakesWayMps = 0.5;
    return velocity.norm() >= kMakesWayMps;
  }
};

// How a track goes on. The turn dies out; the velocity strays from the present one as an
// Ornstein-Uhlenbeck process, so that the position's variance grows with time and not with its
// cube (Millefiori and others, Modeling vessel kinematics using a stochastic mean-reverting
// process for long-term prediction, IEEE TAES 2016).
struct PredictionOptions {
  double stray_deviation_mps = 0.1;  // of the velocity, each axis, in the long run
  double stray_time_s = 10.0;        // and its correlation time
  double sigmas = 2.0;               // the outline grows by so many standard deviations
  double growth_max_m = 4.0;         // but on no side by more
  double horizon_s = 120.0;          // from here on straight ahead, growing no more
};

// One track's outline at an instant: a box of half_length by half_beam, rounded with `radius_m`.
struct Outline {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
  Eigen::Vector2d bow = Eigen::Vector2d::UnitX();  // the same as a direction, kept at hand
  double half_length_m = 0.0;
  double half_beam_m = 0.0;
  double radius_m = 0.0;

  // Signed distance of `point`, m, and its gradient; negative inside.
  struct Distance {
    double distance_m = 0.0;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  };
  [[nodiscard]] Distance distanceTo(const Eigen::Vector2d& point) const;
  // Of the circle around it.
  [[nodiscard]] double reach() const;
};

// A track's predicted way with the outline grown by what is uncertain. Continuous in time, also
// before the track's stamp (straight back, as certain as at the stamp).
class PredictedPath {
 public:
  PredictedPath(const Track& track, const PredictionOptions& options);

  [[nodiscard]] const Track& track() const { return track_; }
  // Times on the mission's clock.
  [[nodiscard]] Outline at(double time_s) const;
  // A lower bound of the distance to the outline, quickly: the circle around it.
  [[nodiscard]] double distanceBound(const Eigen::Vector2d& point, double time_s) const;
  // Nothing of the outline comes nearer to a fixed point faster than this, m/s.
  [[nodiscard]] double rateBound() const { return rate_bound_mps_; }

 private:
  [[nodiscard]] std::size_t segmentAt(double time_s, double& share) const;

  Track track_;
  std::vector<Outline> samples_;   // every kSampleS from the stamp on; straight lines between them
  std::vector<double> reaches_m_;  // of a sample and the next
  double rate_bound_mps_ = 0.0;
};

// The track itself, moved on to `time_s` by the same law, its covariance grown.
[[nodiscard]] Track predicted(const Track& track, double time_s, const PredictionOptions& options);

}  // namespace otter_nav::traffic
