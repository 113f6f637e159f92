// What identification leaves behind: the vessel file and the report.
#pragma once

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/identification/identify.hpp"

namespace otter_nav::identification {

// A vessel file (config/vessels) with the standard errors as comments. `origin` says in one line
// what it was found from.
[[nodiscard]] std::string vesselFileText(const Identification& result, const std::string& origin);

// Parameters with standard errors and guesses, and the errors of 1, 5 and 10 s predictions on the
// validation blocks, for the fits and the guess.
[[nodiscard]] std::string reportText(const Identification& result, const std::string& origin);

// Writes report.txt, the series the plots show (*.dat) and, with gnuplot, velocities.png,
// track.png, residuals.png and prediction_error.png into `directory`, which is made if missing. An
// error names the file or says that gnuplot failed; the text is written before the plots.
[[nodiscard]] Status writeReport(const Identification& result, const std::string& origin,
                                 const std::string& directory);

}  // namespace otter_nav::identification
