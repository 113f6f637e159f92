// How a path begins and ends: the one door to launch, arrival, spins and the way from stop to stop.
// What they are made of (forced motion, turns in closed form) lies in src/optimizer/ends.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/trajectory/boundary.hpp"
#include "otter_nav/trajectory/piece.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::optimizer {

struct EndFamily;
struct Knot;
struct Spline;
struct SplineEnds;

struct SpinLimits {
  double thrust_share = 0.9;        // of the weaker of ahead and astern, on both sides
  double yaw_rate_max_radps = 0.0;  // to be set: at 0 nothing turns
  double ramp_s = 0.12;             // in which the moment goes from one value to the next
};

// Appends the pieces of a spin by `turn_rad` from rest to rest: full moment up to the yaw rate's
// limit, steady, full moment back (the time-optimal turn of m2 r' = tau - d3 r), averaged over
// `ramp_s` so that the moment is continuous. Each of its exponentials is met by pieces of degree 7
// with heading, yaw rate and its two derivatives.
void appendSpin(const Eigen::Vector2d& position, double psi_start_rad, double turn_rad,
                const vessel::Parameters& vessel, const SpinLimits& limits,
                std::vector<trajectory::Piece>& pieces);
// Duration, s, of a spin by `turn_rad`.
[[nodiscard]] double spinDuration(double turn_rad, const vessel::Parameters& vessel,
                                  const SpinLimits& limits);

struct ManoeuvreLimits {
  double thrust_share = 0.94;       // of each thruster's limits
  double yaw_rate_max_radps = 0.0;  // to be set: at 0 nothing turns
  double speed_max_mps = 1e3;
  double ramp_s = 0.12;       // in which the moment goes from one value to the next
  double drift_mps = 0.3;     // speed left when the arrival's turn begins; 0: it turns at rest
  double surge_ramp_s = 0.3;  // to full ahead, and from full astern to nothing
  double brake_ramp_s = 0.4;  // from ahead to full astern
  double astern_share = 0.9;  // of the force, while braking
  bool settle = false;        // the launch ends its turn before it goes ahead
  double kept_nm = 0.0;       // of the moment, for what turns the drifting hull
  vessel::Disturbance disturbance;  // under which the hull drifts while it turns and brakes
};

struct Manoeuvre {
  std::vector<trajectory::Piece> pieces;
  vessel::FlatPoint joint;  // where it meets the rest of the path, under way
  double duration_s = 0.0;
};

struct EndOptions {
  ManoeuvreLimits limits;
  double arrival_speed_mps = 0.0;      // when full astern begins, at first
  double arrival_speed_max_mps = 0.0;  // and after it was moved
  double turn_least_rad = 0.4;    // turns at the goal narrower than this are made on the way there
  bool careful = false;           // turns at rest, slow arrival
  bool in_load = false;           // firm: bow to it the path begins and ends without a manoeuvre
  bool straight_arrival = false;  // no turn at the goal: the way leads to it on its heading
};

// A manoeuvre with what it was made from, so that it can be made again a little different.
struct End {
  enum class Kind { kUnderWay, kLaunch, kArrival };
  Kind kind = Kind::kUnderWay;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double psi_rad = 0.0;
  ManoeuvreLimits limits;
  double turn_rad = 0.0;
  double speed_mps = 0.0;  // of an arrival
  Manoeuvre manoeuvre;     // none under way
};

struct ChosenEnds {
  End start;
  End goal;
};

// Manoeuvres at ends at rest, chosen so that they point along the path and are clear of obstacles;
// the spline between them moves with them.
class EndChooser {
 public:
  EndChooser(const vessel::Parameters& vessel, const feasibility::SafetyLimits& safety,
             const EndOptions& options)
      : vessel_(vessel), safety_(safety), options_(options) {}

  // `path` has at least two points.
  [[nodiscard]] ChosenEnds choose(const map::DistanceField& field,
                                  const std::vector<Eigen::Vector2d>& path,
                                  const trajectory::Boundary& start,
                                  const trajectory::Boundary& goal) const;
  // The ends' states for the spline between.
  [[nodiscard]] SplineEnds splineEnds(const ChosenEnds& chosen,
                                      const trajectory::Boundary& start) const;
  // Lets the spline's ends move with their manoeuvres, where these were made anew.
  void guide(const ChosenEnds& chosen, Spline& spline) const;
  // Makes the manoeuvres that the spline's ends have moved to, and puts the ends exactly there.
  void follow(Spline& spline, ChosenEnds& chosen) const;

 private:
  [[nodiscard]] End chooseStart(const map::DistanceField& field,
                                const std::vector<Eigen::Vector2d>& path,
                                const trajectory::Boundary& start) const;
  [[nodiscard]] End chooseGoal(const map::DistanceField& field,
                               const std::vector<Eigen::Vector2d>& path,
                               const trajectory::Boundary& goal) const;
  void leaveAlong(const std::vector<Eigen::Vector2d>& path, End& end) const;
  [[nodiscard]] bool liesInLoad(const trajectory::Boundary& end) const;
  [[nodiscard]] bool drifts() const;  // while it turns
  [[nodiscard]] double crabbing(double course_rad) const;
  void leaveDrifting(const std::vector<Eigen::Vector2d>& path, End& end) const;
  void leaveWithin(const std::vector<Eigen::Vector2d>& path, End& end) const;
  void arriveAlong(const std::vector<Eigen::Vector2d>& path, End& end) const;
  void make(End& end) const;
  [[nodiscard]] double slowest() const;  // that an arrival may begin with
  [[nodiscard]] std::optional<EndFamily> familyOf(const End& end) const;
  void follow(Knot& knot, End& end) const;
  [[nodiscard]] bool clear(const map::DistanceField& field, const Manoeuvre& manoeuvre) const;

  const vessel::Parameters& vessel_;
  const feasibility::SafetyLimits& safety_;
  const EndOptions& options_;
};

// The last resort: straight from point to point of a clear polyline, stopping at each to spin.
// Slow, but feasible wherever the polyline is clear.
class StopAndSpin {
 public:
  StopAndSpin(const vessel::Parameters& vessel, const SpinLimits& spin,
              const feasibility::SafetyLimits& safety)
      : vessel_(vessel), spin_(spin), safety_(safety) {}

  // From rest at `start` to rest at `goal`, headings included; the way's ends are replaced by
  // theirs.
  [[nodiscard]] trajectory::Trajectory follow(const std::vector<Eigen::Vector2d>& path,
                                              const trajectory::Boundary& start,
                                              const trajectory::Boundary& goal) const;
  // Another way along `path` with straight and clear legs, from end to end in the least time: stops
  // are points of `path`, or a little farther from what is near. `path` where there is none.
  [[nodiscard]] std::vector<Eigen::Vector2d> quickestStops(const map::DistanceField& field,
                                                           const std::vector<Eigen::Vector2d>& path,
                                                           const trajectory::Boundary& start,
                                                           const trajectory::Boundary& goal) const;
  // Of a leg from rest to rest, ahead or astern, s.
  [[nodiscard]] double legDuration(double length_m) const;

 private:
  void appendStraight(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                      std::vector<trajectory::Piece>& pieces) const;

  vessel::Parameters vessel_;
  SpinLimits spin_;
  feasibility::SafetyLimits safety_;
};

}  // namespace otter_nav::optimizer
