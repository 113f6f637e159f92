// The report's plots: what they show as text, and gnuplot's part.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "otter_nav/identification/identify.hpp"

namespace otter_nav::identification {

struct ComparedModel {
  std::string name;
  Model model;
};
// The two fits, then the guess's two models.
[[nodiscard]] std::vector<ComparedModel> comparedModels(const Identification& result);

// Measured states and predictions over the validation blocks, which start anew from the measured
// state each ten seconds: t, measured x y psi u v r, then the same six per compared model.
[[nodiscard]] std::string seriesText(const Identification& result);

// Draws series.dat and errors.dat of the folder as PNG.
[[nodiscard]] Status plot(const std::filesystem::path& folder);

}  // namespace otter_nav::identification
