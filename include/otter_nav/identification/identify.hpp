// Identification as a whole: from a recording to a vessel file's numbers.
#pragma once

#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/identification/data_set.hpp"
#include "otter_nav/identification/prediction.hpp"
#include "otter_nav/identification/problem.hpp"
#include "otter_nav/identification/solver.hpp"
#include "otter_nav/identification/windows.hpp"

namespace otter_nav::identification {

struct Options {
  DataOptions data;
  SplitOptions split;
  ProblemOptions problem;
  SolverOptions solver;
  PaperBounds paper_bounds;
  // The paper's model is fitted to windows whose mean surge speed lies in this range: five numbers
  // can't hold the whole envelope of a real hull, so they are spent where it sails.
  double paper_speed_min_mps = -20.0;
  double paper_speed_max_mps = 20.0;
  bool try_without_lag = true;  // fit with the guess's thruster lag and with none, keep the better
  bool fit_manoeuvring = true;  // else the manoeuvring model is the paper's
  double prior_relative = 1.0;  // width of the manoeuvring priors, in the guess's magnitudes
  double identifiable_limit = 0.5;  // largest relative standard error of h that passes
  double min_excitation = 0.02;  // least mean deviation of the thrusters' difference, share of the
  // limit ahead
};

// config/identification.yaml.
[[nodiscard]] Result<Options> readOptions(config::Section section);

struct Estimate {
  std::string name;
  double value = 0.0;
  double standard_error = 0.0;
  double guess = 0.0;
  bool at_bound = false;
};

struct Fit {
  std::vector<Estimate> estimates;  // parameters, then the current if estimated
  Model model;
  int iterations = 0;
  double residual_rms = 0.0;  // in deviations
};

struct Identification {
  DataSet data;
  Split split;
  vessel::Parameters guess;
  vessel::Parameters vessel;  // the result
  Fit paper;
  Fit manoeuvring;
};

// `guess` gives thrusters, hull and name, the start of the fits, the scale of the sway equation and
// what the result is compared with.
[[nodiscard]] Result<Identification> identify(const Recording& recording,
                                              const vessel::Parameters& guess,
                                              const Options& options);

}  // namespace otter_nav::identification
