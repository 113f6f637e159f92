#include "otter_nav/config/fields.hpp"
#include "otter_nav/identification/identify.hpp"

namespace otter_nav::identification {
namespace {

Status readData(config::Section section, DataOptions& o) {
  section.read("min_duration_s", o.min_duration_s, {10.0, 1e5});
  section.read("sample_interval_s", o.sample_interval_s, {0.001, 1.0});
  section.read("max_gap_s", o.max_gap_s, {0.001, 60.0});
  section.read("command_timeout_s", o.command_timeout_s, {0.01, 1e5});
  return section.finish();
}

Status readSplit(config::Section section, SplitOptions& o) {
  section.read("window_s", o.window_s, {1.0, 120.0});
  section.read("block_s", o.block_s, {10.0, 600.0});
  section.read("validation_every", o.validation_every, {2, 100});
  return section.finish();
}

Status readDeviations(config::Section section, Deviations& o) {
  const config::Range positive{1e-6, 1e3};
  section.read("position_m", o.position_m, positive);
  section.read("heading_rad", o.heading_rad, positive);
  section.read("velocity_mps", o.velocity_mps, positive);
  section.read("yaw_rate_radps", o.yaw_rate_radps, positive);
  return section.finish();
}

Status readProblem(config::Section section, ProblemOptions& o) {
  section.read("free_initial_states", o.free_initial_states);
  section.read("estimate_current", o.estimate_current);
  section.read("max_current_mps", o.max_current_mps, {0.01, 10.0});
  const Status status = readDeviations(section.child("deviations"), o.deviations);
  return status ? section.finish() : status;
}

Status readSolver(config::Section section, SolverOptions& o) {
  section.read("max_iterations", o.max_iterations, {1, 10000});
  section.read("tolerance", o.tolerance, {1e-12, 1e-2});
  return section.finish();
}

Status readPaper(config::Section section, Options& o) {
  section.read("speed_min_mps", o.paper_speed_min_mps, {-100.0, 100.0});
  section.read("speed_max_mps", o.paper_speed_max_mps, {-100.0, 100.0});
  section.read("identifiable_limit", o.identifiable_limit, {0.001, 100.0});
  config::FieldReader bounds(section);
  bounds.group("lower", o.paper_bounds.lower, "");
  bounds.group("upper", o.paper_bounds.upper, "");
  return bounds.groups() ? section.finish() : bounds.groups();
}

Status readManoeuvring(config::Section section, Options& o) {
  section.read("fit", o.fit_manoeuvring);
  section.read("prior_relative", o.prior_relative, {1e-3, 1e3});
  return section.finish();
}

}  // namespace

Result<Options> readOptions(config::Section section) {
  Options options;
  section.read("min_excitation", options.min_excitation, {0.0, 1.0});
  section.read("try_without_lag", options.try_without_lag);
  Status status = readData(section.child("data"), options.data);
  if (status) {
    status = readSplit(section.child("split"), options.split);
  }
  if (status) {
    status = readProblem(section.child("problem"), options.problem);
  }
  if (status) {
    status = readSolver(section.child("solver"), options.solver);
  }
  if (status) {
    status = readPaper(section.child("paper_model"), options);
  }
  if (status) {
    status = readManoeuvring(section.child("manoeuvring_model"), options);
  }
  if (status) {
    status = section.finish();
  }
  if (!status) {
    return failure(status.error().message);
  }
  return options;
}

}  // namespace otter_nav::identification
