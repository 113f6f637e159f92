#include "identify/report.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "identification/prediction.hpp"
#include "identify/plots.hpp"

namespace otter_nav::identification {
namespace {

constexpr std::array<double, 3> kHorizons = {1.0, 5.0, 10.0};
constexpr double kSpacing = 1.0;  // s between the starts of predictions

template <typename... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

std::string estimateTable(const char* title, const Fit& fit) {
  std::string text = formatted(
      "%s: %d iterations, residuals %.3g deviations (rms)\n  %-28s %12s %12s %12s\n", title,
      fit.iterations, fit.residual_rms, "parameter", "value", "std. error", "guess");
  for (const Estimate& e : fit.estimates) {
    text += formatted("  %-28s %12.5g %12.3g %12.5g%s\n", e.name.c_str(), e.value, e.standard_error,
                      e.guess, e.at_bound ? "  at its bound" : "");
  }
  return text + "\n";
}

std::string errorTable(const Identification& r) {
  std::string text = "Prediction errors on the validation blocks (root mean square)\n";
  text += formatted("  %-24s %9s %12s %13s %12s %6s\n", "model", "horizon s", "position m",
                    "heading rad", "speed m/s", "count");
  for (const ComparedModel& m : comparedModels(r)) {
    for (const double horizon_s : kHorizons) {
      const PredictionError e =
          predictionError(r.data, r.split.validation_blocks, m.model, horizon_s, kSpacing);
      text += formatted("  %-24s %9.0f %12.4f %13.4f %12.4f %6d\n", m.name.c_str(), e.horizon_s,
                        e.position_m, e.heading_rad, e.speed_mps, e.count);
    }
  }
  return text;
}

void appendErrors(std::ostringstream& out, const Fit& fit) {
  for (const Estimate& e : fit.estimates) {
    out << "#   " << e.name << ": " << formatted("%.5g", e.standard_error)
        << (e.at_bound ? " (held at its bound)" : "") << "\n";
  }
}

Status writeText(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path);
  out << text;
  out.close();
  if (!out) {
    return failure(path.string() + ": cannot be written");
  }
  return {};
}

std::string errorSeries(const Identification& r) {
  std::ostringstream out;
  out << "# horizon s, then position error m of each model\n";
  for (const double horizon_s : kHorizons) {
    out << horizon_s;
    for (const ComparedModel& m : comparedModels(r)) {
      out << ' '
          << predictionError(r.data, r.split.validation_blocks, m.model, horizon_s, kSpacing)
                 .position_m;
    }
    out << '\n';
  }
  return out.str();
}

}  // namespace

std::vector<ComparedModel> comparedModels(const Identification& r) {
  const auto of = [&](const vessel::ManoeuvringModel& m, const Model& water) {
    return Model{m, r.guess.thrusters, water.current_mps};
  };
  return {{"paper", r.paper.model},
          {"manoeuvring", r.manoeuvring.model},
          {"guess, paper", of(vessel::ManoeuvringModel::fromPaper(r.guess.paper), r.paper.model)},
          {"guess, manoeuvring", of(r.guess.manoeuvring, r.manoeuvring.model)}};
}

std::string vesselFileText(const Identification& r, const std::string& origin) {
  std::ostringstream out;
  out << "# Identified from " << origin << ".\n# Standard errors, paper_model:\n";
  appendErrors(out, r.paper);
  if (!r.manoeuvring.estimates.empty()) {
    out << "# Standard errors, manoeuvring_model:\n";
    appendErrors(out, r.manoeuvring);
  }
  out << vessel::toYaml(r.vessel);
  return out.str();
}

std::string reportText(const Identification& r, const std::string& origin) {
  std::string text = "Identification of " + r.vessel.name + " from " + origin + "\n\n";
  text +=
      formatted("%zu samples over %.1f s, %zu windows fitted, %zu blocks for validation\n\n",
                r.data.samples.size(), r.data.samples.back().time_s - r.data.samples.front().time_s,
                r.split.fit_windows.size(), r.split.validation_blocks.size());
  if (!r.data.holes.empty()) {
    text += describe(r.data.holes).substr(1) + "\n\n";
  }
  text += formatted("thruster lag %.3g s\n\n", r.vessel.thrusters.lag_s);
  text += estimateTable("paper_model", r.paper);
  if (!r.manoeuvring.estimates.empty()) {
    text += estimateTable("manoeuvring_model", r.manoeuvring);
  }
  return text + errorTable(r);
}

Status writeReport(const Identification& r, const std::string& origin,
                   const std::string& directory) {
  const std::filesystem::path folder(directory);
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) {
    return failure(directory + ": cannot be made: " + code.message());
  }
  Status status = writeText(folder / "report.txt", reportText(r, origin));
  if (status) {
    status = writeText(folder / "series.dat", seriesText(r));
  }
  if (status) {
    status = writeText(folder / "errors.dat", errorSeries(r));
  }
  return status ? plot(folder) : status;
}

}  // namespace otter_nav::identification
