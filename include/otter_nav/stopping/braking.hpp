// From a sailed trajectory to rest, and how far it stays clear. Obstacles start where the sailed
// trajectory does.
#pragma once

#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/stopping/watch.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::stopping {

struct Braking {
  trajectory::Trajectory trajectory;  // starts at the sailed trajectory's `at_s`, ends at rest
  bool clear = false;                 // keeps the clearance, within the thrusters' limits
  double clearance_m = 0.0;           // the least along it, sampled
};

// What a stop keeps: the hull's centre `clearance_m`, and the discs that cover the hull
// `hull_margin_m`, which is what the vessel may be off its trajectory.
struct StopLimits {
  double clearance_m = 0.0;
  double hull_margin_m = 0.0;
  vessel::Disturbance disturbance = {};  // that the sailed trajectory was planned with
  vessel::Disturbance felt = {};         // and what it leans into besides
  // At rest wind and waves swing a hull that has no thruster against them: a stop that ends with so
  // much beside the outline is preferred, and with more where `rest_load` sets it aside.
  double rest_room_m = 0.0;
  vessel::Disturbance rest_load = {};
  // How the hull lies off the sailed trajectory: no stop may touch on its way back either.
  Off off = {};
};

// A stop, usual rather than hard, from `at_s` (s from the trajectory's start) that keeps to its
// limits and asks for no more than the thrusters give: along the sailed way, slowed down in time,
// or straightened out and then ahead in a line; where there is no room for these, along more of the
// way, at last to a rest that the way itself comes to. A hull without a side thruster can't brake
// harder than its drag in a curve (its heading would have to swing across, docs/model.md), so a
// hard stop straightens first. A hull that a firm load carries on a heading of its own, as where it
// sets out to leeward, has no stop along that way: it turns bow or stern to the load and brakes, by
// its own motion under its thrusts (the accelerations jump). No stop gathers more way than an
// acceleration that dies out does. Stops are preferred on whose place nothing comes soon after. If
// none keeps to the limits, the one that is slowest when it touches something or does so last, and
// comes least near otherwise, with `clear` false.
[[nodiscard]] Braking brakingTrajectory(const trajectory::Trajectory& sailed, double at_s,
                                        const feasibility::Obstacles& obstacles,
                                        const vessel::Parameters& vessel, const StopLimits& stop);

// The most that the hull's corners swing at rest in a light wind and waves.
constexpr double kSwingsM = 0.3;

// What is left beside the hull's outline where `stop` comes to rest, m.
[[nodiscard]] double roomAtRest(const trajectory::Trajectory& stop,
                                const feasibility::Obstacles& obstacles,
                                const vessel::Parameters& vessel);

}  // namespace otter_nav::stopping
