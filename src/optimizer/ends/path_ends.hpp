// How a path leaves its start and reaches its goal: manoeuvres at ends at rest, chosen so that they
// point along the path and are clear of obstacles.
#pragma once

#include <optional>
#include <vector>

#include "optimizer/ends/end_manoeuvre.hpp"
#include "optimizer/solve/initial_spline.hpp"
#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/trajectory/boundary.hpp"

namespace otter_nav::optimizer {

struct EndOptions {
  ManoeuvreLimits limits;
  double arrival_speed_mps = 3.0;      // when full astern begins, at first
  double arrival_speed_max_mps = 4.2;  // and after it was moved
  double turn_least_rad = 0.4;    // turns at the goal narrower than this are made on the way there
  bool careful = false;           // turns at rest, slow arrival
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
  // Lets the spline's ends move with their manoeuvres.
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

}  // namespace otter_nav::optimizer
