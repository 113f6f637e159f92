#include "parameter_set.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::identification {
namespace {

// How far inertias, and anything else per its magnitude, may be off the guess.
constexpr double kInertiaFactor = 4.0;
constexpr double kOtherFactor = 10.0;
// And the paper's five numbers, which have no priors.
constexpr double kPaperFactor = 20.0;
// Speeds at which a quadratic drag would equal the guess's linear one, and cross terms act.
constexpr double kReferenceSpeed = 1.0;
constexpr double kReferenceYawRate = 0.5;

// What a coefficient of the range's kind may become; `magnitude` is how much of it matters.
Parameter parameterOf(const char* name, const config::Range& range, double guess, double magnitude,
                      double prior_relative) {
  const double prior_sigma = prior_relative * magnitude;
  if (range.min > 0.0) {
    return {name, guess, guess / kInertiaFactor, guess * kInertiaFactor, guess, 0.5 * prior_sigma};
  }
  if (range.min == 0.0) {
    return {name, guess, 0.0, kOtherFactor * std::max(magnitude, guess), magnitude, prior_sigma};
  }
  const double reach = std::max(kOtherFactor * magnitude, 2.0 * std::abs(guess));
  return {name, guess, -reach, reach, magnitude, prior_sigma};
}

// Magnitudes are the guess's own numbers, for terms that may be zero those that they act beside.
vessel::ManoeuvringModel magnitudesOf(const vessel::ManoeuvringModel& guess) {
  vessel::ManoeuvringModel m = guess;
  m.surge_centripetal_kg = guess.surge_inertia_kg;
  m.sway_centripetal_kg = guess.sway_inertia_kg;
  m.munk_kg = guess.surge_inertia_kg;
  m.surge_drag_quadratic_kgpm = guess.surge_drag_kgps / kReferenceSpeed;
  m.sway_drag_quadratic_kgpm = guess.sway_drag_kgps / kReferenceSpeed;
  m.yaw_drag_quadratic_kgm2 = guess.yaw_drag_kgm2ps / kReferenceYawRate;
  m.sway_from_yaw_kgmps = guess.sway_inertia_kg * kReferenceSpeed;
  m.yaw_from_sway_kgmps = guess.sway_inertia_kg * kReferenceSpeed;
  return m;
}

}  // namespace

PaperBounds::PaperBounds(const vessel::PaperModel& guess)
    : lower(modelOf<vessel::PaperModel>(coefficientsOf(guess) / kPaperFactor)),
      upper(modelOf<vessel::PaperModel>(coefficientsOf(guess) * kPaperFactor)) {}

ParameterSet paperSet(const vessel::PaperModel& guess, const PaperBounds& bounds) {
  const auto values = coefficientsOf(guess);
  const auto lower = coefficientsOf(bounds.lower);
  const auto upper = coefficientsOf(bounds.upper);
  const std::vector<const char*> names = coefficientNames<vessel::PaperModel>();
  ParameterSet set;
  set.map.resize(kCoefficientCount, kPaperCount);
  for (int i = 0; i < kPaperCount; ++i) {
    Parameter parameter;
    parameter.name = names[static_cast<std::size_t>(i)];
    parameter.guess = values[i];
    parameter.lower = lower[i];
    parameter.upper = upper[i];
    parameter.scale = values[i];
    set.parameters.push_back(parameter);
    // fromPaper() is linear in h without a constant, so a unit vector gives a column.
    const auto unit = modelOf<vessel::PaperModel>(Eigen::VectorXd::Unit(kPaperCount, i));
    set.map.col(i) = coefficientsOf(vessel::ManoeuvringModel::fromPaper(unit));
  }
  return set;
}

ParameterSet manoeuvringSet(const vessel::ManoeuvringModel& guess, double prior_relative) {
  const Coefficients values = coefficientsOf(guess);
  const Coefficients magnitudes = coefficientsOf(magnitudesOf(guess));
  ParameterSet set;
  vessel::ManoeuvringModel model;
  forEachCoefficient(model, [&](const char* key, double&, const config::Range& range) {
    const auto i = static_cast<int>(set.parameters.size());
    set.parameters.push_back(parameterOf(key, range, values[i], magnitudes[i], prior_relative));
  });
  set.map = CoefficientMap::Identity(kCoefficientCount, kCoefficientCount);
  return set;
}

}  // namespace otter_nav::identification
