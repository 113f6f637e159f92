// Which numbers of a model are estimated, where they start and how far they may go.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/identification/identify.hpp"
#include "sensitivity.hpp"

namespace otter_nav::identification {

struct Parameter {
  std::string name;
  double guess = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  double scale = 1.0;  // the solver works on value / scale
  // Standard deviation of the knowledge that is in the guess; infinite when there is none.
  double prior_sigma = std::numeric_limits<double>::infinity();
};

// The model's coefficients are `map` times the parameters' values.
struct ParameterSet {
  std::vector<Parameter> parameters;
  CoefficientMap map;
};

// Bounds h_l <= h <= h_u of the paper's equation 8: so many times the guess, and its inverse.
struct PaperBounds {
  explicit PaperBounds(const vessel::PaperModel& guess);
  vessel::PaperModel lower, upper;
};

// h = [m1, m2, d1, d2, d3].
[[nodiscard]] ParameterSet paperSet(const vessel::PaperModel& guess, const PaperBounds& bounds);

// The fourteen coefficients. Their bounds and priors are multiples of the guess's magnitudes
// (docs/identification.md): no sway force is known in the data, so the scale of the sway equation
// is the guess's, and the priors are what holds it.
[[nodiscard]] ParameterSet manoeuvringSet(const vessel::ManoeuvringModel& guess,
                                          double prior_relative);

}  // namespace otter_nav::identification
