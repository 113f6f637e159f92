#include "otter_nav/identification/csv.hpp"

#include <limits>
#include <ostream>

#include "otter_nav/base/csv.hpp"

namespace otter_nav::identification {

Result<Recording> loadCsv(const std::string& path) {
  const Result<CsvTable> table = CsvTable::load(path);
  return table ? recordingOf(*table, path) : failure(table.error().message);
}

Result<Recording> recordingOf(const CsvTable& table, const std::string& name) {
  const auto rows = table.numbers({"t", "x", "y", "psi", "u", "v", "r", "f_left", "f_right"});
  if (!rows) {
    return failure(rows.error().message);
  }
  Recording recording;
  recording.odometry_name = name;
  recording.command_name = name;
  recording.first_row = 2;
  for (const auto& row : rows->rowwise()) {
    recording.odometry.push_back({row[0], row.segment<vessel::kStateSize>(1).transpose()});
    recording.commands.push_back({row[0], row.tail<vessel::kInputSize>().transpose()});
  }
  return recording;
}

void writeCsvHeader(std::ostream& out) {
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "t,x,y,psi,u,v,r,f_left,f_right\n";
}

void writeCsvRow(std::ostream& out, double time_s, const vessel::State& state,
                 const vessel::Thrusts& thrusts) {
  out << time_s;
  for (int i = 0; i < vessel::kStateSize; ++i) {
    out << ',' << state[i];
  }
  out << ',' << thrusts[vessel::kLeft] << ',' << thrusts[vessel::kRight] << '\n';
}

}  // namespace otter_nav::identification
