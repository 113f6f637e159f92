// The vessel under a given turn and a given surge force, by the model its plans are made with, in
// the frame of the turn's first heading, turning left; and the trajectory's pieces that follow it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimizer/ends/turn_profile.hpp"
#include "otter_nav/trajectory/piece.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::optimizer {

// The surge force goes from one value to another, with continuous slope.
struct SurgeRamp {
  double from_s = 0.0;
  double to_s = 0.0;
  double from_n = 0.0;
  double to_n = 0.0;
};

class ForcedMotion {
 public:
  struct Motion {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  };

  // `turn` may be null: no turn. Ramps in order of time; before and between them the force is held.
  // `disturbance` as seen from that frame.
  ForcedMotion(const vessel::Parameters& vessel, const vessel::Disturbance& disturbance,
               const TurnProfile* turn, std::vector<SurgeRamp> ramps)
      : inverse_(vessel, disturbance),
        manoeuvring_(vessel.manoeuvring),
        disturbance_(disturbance),
        paper_holds_(vessel::paperHolds(vessel)),
        turn_(turn),
        ramps_(std::move(ramps)) {}

  void clearRamps() { ramps_.clear(); }
  void addFirst(const SurgeRamp& ramp) { ramps_.insert(ramps_.begin(), ramp); }
  // The motion at `to_s`, later or earlier.
  [[nodiscard]] Motion integrate(const Motion& motion, double from_s, double to_s) const;
  [[nodiscard]] vessel::FlatPoint flat(const Motion& motion, double t_s) const;
  // Where the equations change between two times, both included, and no farther apart than a
  // piece of degree 7 can follow.
  [[nodiscard]] std::vector<double> joints(double from_s, double to_s) const;
  // The piece between two joints, given the motion at both.
  [[nodiscard]] trajectory::Piece piece(const Motion& from, double from_s, const Motion& to,
                                        double to_s) const;

 private:
  struct Surge {
    double force_n;
    double slope_nps;
  };
  [[nodiscard]] Surge surge(double t_s) const;
  // [psi, r, r', r'']
  [[nodiscard]] Eigen::Vector4d heading(double t_s, double within_s) const;
  [[nodiscard]] vessel::FlatPoint pushed(const Motion& motion, double t_s, double within_s) const;

  vessel::InverseDynamics inverse_;
  vessel::ManoeuvringModel manoeuvring_;
  vessel::Disturbance disturbance_;
  bool paper_holds_;
  const TurnProfile* turn_;
  std::vector<SurgeRamp> ramps_;
};

}  // namespace otter_nav::optimizer
