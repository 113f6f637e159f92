// Identification as a whole: from a recording to a vessel file's numbers.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/fields.hpp"
#include "otter_nav/identification/data_set.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::identification {

// A vessel in a steady current, as it is fitted and as it predicts.
struct Model {
  vessel::ManoeuvringModel coefficients;
  vessel::Thrusters thrusters;
  Eigen::Vector2d current_mps = Eigen::Vector2d::Zero();
};

struct SplitOptions {
  double window_s = 8.0;
  double block_s = 24.0;  // stretches are cut into blocks of this length
  int validation_every = 3;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("window_s", o.window_s, {1.0, 120.0}, "length of one rollout of the fit");
    fields("validation_every", o.validation_every, {2, 100},
           "every n-th block of 24 s is kept back for validation");
  }
};

struct Split {
  std::vector<Stretch> fit_windows;  // windows share their border samples
  std::vector<Stretch> validation_blocks;
};

// The weights Omega are inverse squares of these.
struct Deviations {
  double position_m = 0.02;
  double heading_rad = 0.005;
  double velocity_mps = 0.02;
  double yaw_rate_radps = 0.01;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    const config::Range positive{1e-6, 1e3};
    fields("position_m", o.position_m, positive, "of the odometry, as below");
    fields("heading_rad", o.heading_rad, positive, "");
    fields("velocity_mps", o.velocity_mps, positive, "");
    fields("yaw_rate_radps", o.yaw_rate_radps, positive, "");
  }
};

struct ProblemOptions {
  Deviations deviations;
  bool free_initial_states = true;  // estimated beside the parameters; else as measured
  bool estimate_current = false;    // one steady current over the whole recording
  double max_current_mps = 2.0;
};

struct SolverOptions {
  int max_iterations = 200;
  double tolerance = 1e-6;  // on the scaled optimality error
};

struct Options {
  DataOptions data;
  SplitOptions split;
  ProblemOptions problem;
  SolverOptions solver;
  // The paper's model is fitted to windows whose mean surge speed lies in this range: five numbers
  // can't hold the whole envelope of a real hull, so they are spent where it sails.
  double paper_speed_min_mps = -20.0;
  double paper_speed_max_mps = 20.0;
  bool try_without_lag = true;  // fit with the guess's thruster lag and with none, keep the better
  bool fit_manoeuvring = true;
  double prior_relative = 1.0;
  double identifiable_limit = 0.5;  // largest relative standard error of h that passes
  // Least mean deviation of the thrusters' difference, share of the limit ahead.
  double min_excitation = 0.02;

  // config/identification.yaml: what depends on the data at hand.
  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields.group("data", o.data, "what is taken from a recording");
    fields.group("split", o.split, "what is fitted, what judges the fit");
    fields.group("deviations", o.problem.deviations, "residuals are weighted with these");
    fields("fit_manoeuvring", o.fit_manoeuvring,
           "false: the paper's model in the manoeuvring model's form");
    fields("prior_relative", o.prior_relative, {1e-3, 1e3},
           "width of the manoeuvring model's priors, in the guess's magnitudes");
  }
};

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
