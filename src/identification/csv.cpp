#include "otter_nav/identification/csv.hpp"

#include <array>
#include <cstdlib>
#include <fstream>
#include <istream>
#include <limits>
#include <ostream>
#include <sstream>

namespace otter_nav::identification {
namespace {

constexpr std::size_t kColumnCount = 9;
constexpr std::array<const char*, kColumnCount> kColumns = {"t", "x", "y",      "psi",    "u",
                                                            "v", "r", "f_left", "f_right"};

std::vector<std::string> cells(std::string line) {
  if (!line.empty() && line.back() == '\r') {
    line.pop_back();
  }
  std::vector<std::string> result;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) {
    const std::size_t first = cell.find_first_not_of(" \t\"");
    const std::size_t last = cell.find_last_not_of(" \t\"");
    result.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return result;
}

using Positions = std::array<std::size_t, kColumnCount>;

Result<Positions> findColumns(const std::vector<std::string>& header, const std::string& name) {
  Positions positions{};
  for (std::size_t i = 0; i < kColumnCount; ++i) {
    std::size_t k = 0;
    while (k < header.size() && header[k] != kColumns[i]) {
      ++k;
    }
    if (k == header.size()) {
      return failure(name + ": column '" + kColumns[i] +
                     "' is missing; needed are t, x, y, psi, u, v, r, f_left, f_right");
    }
    positions[i] = k;
  }
  return positions;
}

// NaN and infinity are numbers here; assemble() refuses them with their stamp.
bool parse(const std::string& text, double& value) {
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0';
}

Status readRow(const std::vector<std::string>& row, const Positions& positions,
               const std::string& where, Recording& recording) {
  std::array<double, kColumnCount> values{};
  for (std::size_t i = 0; i < kColumnCount; ++i) {
    if (positions[i] >= row.size()) {
      return failure(where + ": column '" + kColumns[i] + "' has no value");
    }
    if (!parse(row[positions[i]], values[i])) {
      return failure(where + ": column '" + kColumns[i] + "' holds '" + row[positions[i]] +
                     "', not a number");
    }
  }
  OdometryRecord odometry;
  odometry.stamp_s = values[0];
  odometry.state << values[1], values[2], values[3], values[4], values[5], values[6];
  recording.odometry.push_back(odometry);
  recording.commands.push_back({values[0], vessel::Thrusts(values[7], values[8])});
  return {};
}

}  // namespace

Result<Recording> readCsv(std::istream& in, const std::string& name) {
  std::string line;
  if (!std::getline(in, line)) {
    return failure(name + ": the file is empty");
  }
  const Result<Positions> positions = findColumns(cells(line), name);
  if (!positions) {
    return failure(positions.error().message);
  }
  Recording recording;
  recording.odometry_name = name;
  recording.command_name = name;
  recording.first_row = 2;
  for (int row = 2; std::getline(in, line); ++row) {
    const std::vector<std::string> row_cells = cells(line);
    if (row_cells.empty()) {
      return failure(name + ", row " + std::to_string(row) + ": empty");
    }
    const Status status =
        readRow(row_cells, *positions, name + ", row " + std::to_string(row), recording);
    if (!status) {
      return failure(status.error().message);
    }
  }
  return recording;
}

Result<Recording> loadCsv(const std::string& path) {
  std::ifstream in(path);
  if (!in) {
    return failure(path + ": cannot be opened");
  }
  return readCsv(in, path);
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
