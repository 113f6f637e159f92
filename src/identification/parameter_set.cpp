#include "otter_nav/identification/parameter_set.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace otter_nav::identification {
namespace {

constexpr int kPaperCount = 5;
using PaperVector = Eigen::Matrix<double, kPaperCount, 1>;

PaperVector vectorOf(const vessel::PaperModel& h) {
  PaperVector v;
  v << h.m1_kg, h.m2_kgm2, h.d1_kgps, h.d2_kgps, h.d3_kgm2ps;
  return v;
}

constexpr std::array<const char*, kPaperCount> kPaperNames = {"m1_kg", "m2_kgm2", "d1_kgps",
                                                              "d2_kgps", "d3_kgm2ps"};

// How far inertias, and anything else per its magnitude, may be off the guess.
constexpr double kInertiaFactor = 4.0;
constexpr double kOtherFactor = 10.0;
// Speeds at which a quadratic drag would equal the guess's linear one, and cross terms act.
constexpr double kReferenceSpeed = 1.0;
constexpr double kReferenceYawRate = 0.5;

Parameter inertia(const char* name, double guess, double prior_relative) {
  return {name,
          guess,
          guess / kInertiaFactor,
          guess * kInertiaFactor,
          guess,
          0.5 * prior_relative * guess};
}

Parameter drag(const char* name, double guess, double magnitude, double prior_relative) {
  return {name,      guess,
          0.0,       std::max(kOtherFactor * magnitude, kOtherFactor * guess),
          magnitude, prior_relative * magnitude};
}

Parameter signedTerm(const char* name, double guess, double magnitude, double prior_relative) {
  const double reach = std::max(kOtherFactor * magnitude, 2.0 * std::abs(guess));
  return {name, guess, -reach, reach, magnitude, prior_relative * magnitude};
}

}  // namespace

Result<ParameterSet> paperSet(const vessel::PaperModel& guess, const PaperBounds& bounds) {
  const PaperVector values = vectorOf(guess);
  const PaperVector lower = vectorOf(bounds.lower);
  const PaperVector upper = vectorOf(bounds.upper);
  ParameterSet set;
  set.map.resize(kCoefficientCount, kPaperCount);
  for (int i = 0; i < kPaperCount; ++i) {
    if (values[i] < lower[i] || values[i] > upper[i]) {
      std::ostringstream out;
      out << "the guess of " << kPaperNames[i] << " is " << values[i] << ", allowed is " << lower[i]
          << " to " << upper[i];
      return failure(out.str());
    }
    Parameter parameter;
    parameter.name = kPaperNames[i];
    parameter.guess = values[i];
    parameter.lower = lower[i];
    parameter.upper = upper[i];
    parameter.scale = values[i];
    set.parameters.push_back(parameter);
    // fromPaper() is linear in h without a constant, so a unit vector gives a column.
    const PaperVector unit = PaperVector::Unit(i);
    set.map.col(i) = coefficientsOf(vessel::ManoeuvringModel::fromPaper(paperOf(unit)));
  }
  return set;
}

ParameterSet manoeuvringSet(const vessel::ManoeuvringModel& g, double prior) {
  const double sway_speed_force = g.sway_inertia_kg * kReferenceSpeed;
  ParameterSet set;
  set.parameters = {
      inertia("surge_inertia_kg", g.surge_inertia_kg, prior),
      inertia("sway_inertia_kg", g.sway_inertia_kg, prior),
      inertia("yaw_inertia_kgm2", g.yaw_inertia_kgm2, prior),
      signedTerm("surge_centripetal_kg", g.surge_centripetal_kg, g.surge_inertia_kg, prior),
      signedTerm("sway_centripetal_kg", g.sway_centripetal_kg, g.sway_inertia_kg, prior),
      signedTerm("munk_kg", g.munk_kg, g.surge_inertia_kg, prior),
      drag("surge_drag_kgps", g.surge_drag_kgps, g.surge_drag_kgps, prior),
      drag("sway_drag_kgps", g.sway_drag_kgps, g.sway_drag_kgps, prior),
      drag("yaw_drag_kgm2ps", g.yaw_drag_kgm2ps, g.yaw_drag_kgm2ps, prior),
      drag("surge_drag_quadratic_kgpm", g.surge_drag_quadratic_kgpm,
           g.surge_drag_kgps / kReferenceSpeed, prior),
      drag("sway_drag_quadratic_kgpm", g.sway_drag_quadratic_kgpm,
           g.sway_drag_kgps / kReferenceSpeed, prior),
      drag("yaw_drag_quadratic_kgm2", g.yaw_drag_quadratic_kgm2,
           g.yaw_drag_kgm2ps / kReferenceYawRate, prior),
      signedTerm("sway_from_yaw_kgmps", g.sway_from_yaw_kgmps, sway_speed_force, prior),
      signedTerm("yaw_from_sway_kgmps", g.yaw_from_sway_kgmps, sway_speed_force, prior)};
  set.map = CoefficientMap::Identity(kCoefficientCount, kCoefficientCount);
  return set;
}

vessel::PaperModel paperOf(const Eigen::VectorXd& values) {
  return {values[0], values[1], values[2], values[3], values[4]};
}

}  // namespace otter_nav::identification
