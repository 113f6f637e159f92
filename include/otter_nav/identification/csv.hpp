// Recordings as text: a header line with the columns' names, then a row per sample.
#pragma once

#include <iosfwd>
#include <string>

#include "otter_nav/base/csv.hpp"
#include "otter_nav/base/result.hpp"
#include "otter_nav/identification/data_set.hpp"

namespace otter_nav::identification {

// Columns t (s), x, y (m), psi (rad), u, v (m/s), r (rad/s), f_left, f_right (N), in any order;
// others are ignored. Thrusts hold from their row's time to the next row's. Errors as
// base/csv.hpp's.
[[nodiscard]] Result<Recording> loadCsv(const std::string& path);
// `name`: what messages call it.
[[nodiscard]] Result<Recording> recordingOf(const CsvTable& table, const std::string& name);

void writeCsvHeader(std::ostream& out);
void writeCsvRow(std::ostream& out, double time_s, const vessel::State& state,
                 const vessel::Thrusts& thrusts);

}  // namespace otter_nav::identification
