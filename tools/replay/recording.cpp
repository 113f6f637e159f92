#include <array>
#include <iomanip>
#include <ostream>

#include "otter_nav/base/csv.hpp"
#include "replay/replay.hpp"

namespace otter_nav::plant {
namespace {

// The columns in the order they are written, and where they belong in PlantState; time has no row.
struct Column {
  const char* name;
  int row;
};
constexpr int kTimeRow = -1;
constexpr std::array<Column, 15> kColumns{{{"t", kTimeRow},
                                           {"u", kU},
                                           {"v", kV},
                                           {"w", kW},
                                           {"p", kP},
                                           {"q", kQ},
                                           {"r", kR},
                                           {"x", kNorth},
                                           {"y", kEast},
                                           {"z", kDown},
                                           {"phi", kRoll},
                                           {"theta", kPitch},
                                           {"psi", kYaw},
                                           {"n_left", kPropeller},
                                           {"n_right", kPropeller + 1}}};
constexpr double kMaxGap = 100.0;

// Time must grow, row by row.
Status checkTime(const CsvTable& table, const Recording& recording) {
  for (std::size_t i = 1; i < recording.rows.size(); ++i) {
    const double before_s = recording.rows[i - 1].time_s;
    const double gap_s = recording.rows[i].time_s - before_s;
    if (gap_s <= 0.0 || gap_s > kMaxGap) {
      return failure(table.where(static_cast<Eigen::Index>(i)) +
                     ", column 't': " + std::to_string(recording.rows[i].time_s) + " s after " +
                     std::to_string(before_s) + " s; time must grow, by at most " +
                     std::to_string(kMaxGap) + " s a row");
    }
  }
  return {};
}

Result<Recording> recordingOf(const Result<CsvTable>& table) {
  if (!table) {
    return failure(table.error().message);
  }
  // The motion's columns come all or none.
  Recording recording;
  for (const Column& column : kColumns) {
    const bool motion = column.row >= 0 && column.row < kPropeller;
    recording.has_motion = recording.has_motion || (motion && table->has(column.name));
  }
  std::vector<std::string> names;
  std::vector<int> rows;
  for (const Column& column : kColumns) {
    if (recording.has_motion || column.row == kTimeRow || column.row >= kPropeller) {
      names.emplace_back(column.name);
      rows.push_back(column.row);
    }
  }
  const Result<Eigen::MatrixXd> values = table->numbers(names);
  if (!values) {
    return failure(values.error().message);
  }
  for (Eigen::Index i = 0; i < values->rows(); ++i) {
    RecordedRow row;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      (rows[k] == kTimeRow ? row.time_s : row.state[rows[k]]) =
          (*values)(i, static_cast<Eigen::Index>(k));
    }
    recording.rows.push_back(row);
  }
  if (const Status status = checkTime(*table, recording); !status) {
    return failure(status.error().message);
  }
  if (recording.rows.size() < 2) {
    return failure(table->name() + ": " + std::to_string(recording.rows.size()) +
                   " rows of data, at least 2 are needed");
  }
  return recording;
}

}  // namespace

Result<Recording> readRecording(std::istream& in, const std::string& name) {
  return recordingOf(CsvTable::read(in, name));
}

Result<Recording> readRecording(const std::string& path) {
  return recordingOf(CsvTable::load(path));
}

void writeRecording(std::ostream& out, const Recording& recording) {
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    out << (i == 0 ? "" : ",") << kColumns[i].name;
  }
  out << std::setprecision(12) << '\n';
  for (const RecordedRow& row : recording.rows) {
    out << row.time_s;
    for (std::size_t i = 1; i < kColumns.size(); ++i) {
      out << ',' << row.state[kColumns[i].row];
    }
    out << '\n';
  }
}

}  // namespace otter_nav::plant
