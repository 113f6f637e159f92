#include "otter_nav/identification/identify.hpp"

#include <cmath>
#include <cstdlib>
#include <utility>

#include "otter_nav/base/text.hpp"
#include "otter_nav/vessel/steady_motion.hpp"
#include "otter_nav/vessel/thrusters.hpp"
#include "problem.hpp"
#include "regression.hpp"
#include "solver.hpp"
#include "uncertainty.hpp"
#include "windows.hpp"

namespace otter_nav::identification {
namespace {

// Mean absolute deviation of a quantity from its mean over the samples: unlike the variance it
// makes little of a short transient.
template <typename Quantity>
double deviation(const DataSet& data, Quantity quantity) {
  const double n = static_cast<double>(data.samples.size());
  double mean = 0.0;
  for (const Sample& s : data.samples) {
    mean += quantity(s) / n;
  }
  double sum = 0.0;
  for (const Sample& s : data.samples) {
    sum += std::abs(quantity(s) - mean);
  }
  return sum / n;
}

// Constant input shows a steady state, from which no inertia can be told.
Status checkExcitation(const DataSet& data, const vessel::Thrusters& thrusters, double share) {
  const double least_n = share * thrusters.ahead_max_n;
  const double surge_n = deviation(data, [](const Sample& s) { return s.thrusts.sum(); });
  const double yaw_n = deviation(
      data, [](const Sample& s) { return s.thrusts[vessel::kRight] - s.thrusts[vessel::kLeft]; });
  if (yaw_n >= least_n) {
    return {};
  }
  std::string names = "m2_kgm2, d2_kgps, d3_kgm2ps (the thrusters' difference is constant)";
  if (surge_n < least_n) {
    names = "m1_kg (the thrusters' sum is constant), " + names;
  }
  return failure("the input does not excite " + names + ": they are not identifiable; deviations " +
                 std::to_string(surge_n) + " N and " + std::to_string(yaw_n) + " N, at least " +
                 std::to_string(least_n) + " N needed");
}

std::vector<Stretch> inSpeedRange(const DataSet& data, const std::vector<Stretch>& windows,
                                  double min_mps, double max_mps) {
  std::vector<Stretch> kept;
  for (const Stretch& w : windows) {
    double sum = 0.0;
    for (std::size_t i = w.begin; i < w.end; ++i) {
      sum += data.samples[i].state[vessel::kSurge];
    }
    const double mean = sum / static_cast<double>(w.end - w.begin);
    if (mean >= min_mps && mean <= max_mps) {
      kept.push_back(w);
    }
  }
  return kept;
}

double totalCost(const Problem& problem, const Eigen::VectorXd& variables) {
  double cost = problem.priorCost(variables);
  for (std::size_t w = 0; w < problem.windowCount(); ++w) {
    cost += problem.evaluateWindow(w, variables, nullptr);
  }
  return cost;
}

// The start with the lower cost; one that diverges loses.
Eigen::VectorXd betterStart(const Problem& problem, const Eigen::VectorXd& a,
                            const Eigen::VectorXd& b) {
  return totalCost(problem, b) < totalCost(problem, a) ? b : a;
}

// Digits beyond the standard errors say nothing, and hide that two runs found the same.
double rounded(double value) {
  return std::strtod(text("%.6g", value).c_str(), nullptr);
}

// The barrier keeps a solution a hair's breadth off a bound.
double nearerBound(const Parameter& p, double value) {
  return value - p.lower < p.upper - value ? p.lower : p.upper;
}

Result<Fit> fit(const Problem& problem, const Eigen::VectorXd& start,
                const SolverOptions& options) {
  const Result<Solution> solution = solve(problem, start, options);
  if (!solution) {
    return failure(solution.error().message);
  }
  const Uncertainty errors = uncertainty(problem, solution->variables);
  Fit result;
  result.iterations = solution->iterations;
  result.residual_rms = std::sqrt(2.0 * (solution->cost - problem.priorCost(solution->variables)) /
                                  static_cast<double>(problem.residualCount()));
  Eigen::VectorXd values = solution->variables;
  for (std::size_t i = 0; i < problem.shared().size(); ++i) {
    const Parameter& p = problem.shared()[i];
    const auto k = static_cast<Eigen::Index>(i);
    values[k] = errors.at_bound[i] ? nearerBound(p, values[k]) : rounded(values[k]);
    result.estimates.push_back(
        {p.name, values[k], errors.standard_error[k], p.guess, errors.at_bound[i]});
  }
  result.model = problem.modelAt(values);
  return result;
}

Result<Fit> fitPaper(const Identification& work, const Options& options) {
  const std::vector<Stretch> windows = inSpeedRange(
      work.data, work.split.fit_windows, options.paper_speed_min_mps, options.paper_speed_max_mps);
  if (windows.empty()) {
    return failure("no window's mean surge speed lies within " +
                   std::to_string(options.paper_speed_min_mps) + " to " +
                   std::to_string(options.paper_speed_max_mps) + " m/s");
  }
  const PaperBounds bounds(work.guess.paper);
  const Problem problem(work.data, windows, paperSet(work.guess.paper, bounds),
                        work.guess.thrusters, options.problem);
  const vessel::PaperModel h = regress(work.data, windows, work.guess.thrusters, 1.0, bounds);
  Eigen::VectorXd regressed = problem.startPoint();
  regressed.head<kPaperCount>() = coefficientsOf(h);
  const Eigen::VectorXd start = betterStart(problem, problem.startPoint(), regressed);
  const Status identifiable = checkIdentifiable(problem, start, options.identifiable_limit);
  if (!identifiable) {
    return failure(identifiable.error().message);
  }
  return fit(problem, start, options.solver);
}

Result<Fit> fitManoeuvring(const Identification& work, const Options& options) {
  const Problem problem(work.data, work.split.fit_windows,
                        manoeuvringSet(work.guess.manoeuvring, options.prior_relative),
                        work.guess.thrusters, options.problem);
  Eigen::VectorXd from_paper = problem.startPoint();
  from_paper.head<kCoefficientCount>() = coefficientsOf(work.paper.model.coefficients);
  return fit(problem, betterStart(problem, problem.startPoint(), from_paper), options.solver);
}

// Steady surge under full thrust.
double topSpeed(const vessel::ManoeuvringModel& m, const vessel::Thrusters& thrusters) {
  const double thrust_n = 2.0 * thrusters.ahead_max_n;
  return thrust_n / vessel::steadyDrag(m.surge_drag_kgps, m.surge_drag_quadratic_kgpm, thrust_n);
}

vessel::PaperModel paperFrom(const Fit& fit) {
  Eigen::VectorXd values(kPaperCount);
  for (int i = 0; i < kPaperCount; ++i) {
    values[i] = fit.estimates[static_cast<std::size_t>(i)].value;
  }
  return modelOf<vessel::PaperModel>(values);
}

Result<Identification> identifyWithLag(const Recording& recording, const vessel::Parameters& guess,
                                       const Options& options) {
  Result<DataSet> data = assemble(recording, options.data, guess.thrusters.lag_s);
  if (!data) {
    return failure(data.error().message);
  }
  Identification work;
  work.data = *std::move(data);
  work.guess = guess;
  work.vessel = guess;
  const auto because = [&](const std::string& what) {
    return failure(what + describe(work.data.holes));
  };
  const Status excited = checkExcitation(work.data, guess.thrusters, options.min_excitation);
  if (!excited) {
    return because(excited.error().message);
  }
  Result<Split> parts = split(work.data, options.split);
  if (!parts) {
    return because(parts.error().message);
  }
  work.split = *std::move(parts);

  Result<Fit> paper = fitPaper(work, options);
  if (!paper) {
    return because("paper_model: " + paper.error().message);
  }
  work.paper = *std::move(paper);
  work.vessel.paper = paperFrom(work.paper);
  work.vessel.manoeuvring = vessel::ManoeuvringModel::fromPaper(work.vessel.paper);
  work.manoeuvring.model = work.paper.model;
  if (options.fit_manoeuvring) {
    Result<Fit> manoeuvring = fitManoeuvring(work, options);
    if (!manoeuvring) {
      return because("manoeuvring_model: " + manoeuvring.error().message);
    }
    work.manoeuvring = *std::move(manoeuvring);
    work.vessel.manoeuvring = work.manoeuvring.model.coefficients;
  }
  // Wind loads are not estimated: the guess's stay.
  work.vessel.manoeuvring = modelOf(coefficientsOf(work.vessel.manoeuvring), guess.manoeuvring);
  work.vessel.top_speed_mps = rounded(topSpeed(work.vessel.manoeuvring, guess.thrusters));
  return work;
}

// Root mean square of the richer fit's residuals.
double residualOf(const Identification& result) {
  return result.manoeuvring.estimates.empty() ? result.paper.residual_rms
                                              : result.manoeuvring.residual_rms;
}

}  // namespace

Result<Identification> identify(const Recording& recording, const vessel::Parameters& guess,
                                const Options& options) {
  Result<Identification> result = identifyWithLag(recording, guess, options);
  if (!result || !options.try_without_lag || guess.thrusters.lag_s <= 0.0) {
    return result;
  }
  vessel::Parameters prompt = guess;
  prompt.thrusters.lag_s = 0.0;
  Result<Identification> other = identifyWithLag(recording, prompt, options);
  return other && residualOf(*other) < residualOf(*result) ? other : result;
}

}  // namespace otter_nav::identification
