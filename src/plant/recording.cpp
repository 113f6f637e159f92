#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <istream>
#include <ostream>

#include "otter_nav/plant/replay.hpp"

namespace otter_nav::plant {
namespace {

// The columns in the order they are written, and where they belong in PlantState; time has no row.
struct Column {
  const char* name;
  int row;
};
constexpr int kTimeRow = -1;
constexpr int kMotionColumns = 12;
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

std::string trimmed(const std::string& text) {
  constexpr const char* kBlank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string::npos) {
    return "";
  }
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t start = 0;
  for (std::size_t comma = 0; comma != std::string::npos; start = comma + 1) {
    comma = line.find(',', start);
    fields.push_back(trimmed(line.substr(start, comma - start)));
  }
  return fields;
}

bool parse(const std::string& text, double& value) {
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value);
}

// Reads one file line by line, keeping what error messages need.
class Reader {
 public:
  Reader(std::istream& in, std::string name) : in_(in), name_(std::move(name)) {}

  Result<Recording> read() {
    if (Status status = readHeader(); !status) {
      return failure(status.error().message);
    }
    std::string line;
    while (nextLine(line)) {
      if (Status status = readRow(line); !status) {
        return failure(status.error().message);
      }
    }
    if (recording_.rows.size() < 2) {
      return failure(name_ + ": " + std::to_string(recording_.rows.size()) +
                     " rows of data, at least 2 are needed");
    }
    return std::move(recording_);
  }

 private:
  // Blank lines are skipped.
  bool nextLine(std::string& line) {
    while (std::getline(in_, line)) {
      ++line_;
      if (!trimmed(line).empty()) {
        return true;
      }
    }
    return false;
  }
  [[nodiscard]] std::string here() const { return name_ + ", line " + std::to_string(line_); }

  Status readHeader() {
    std::string line;
    if (!nextLine(line)) {
      return failure(name_ + ": empty, expected a header with t, n_left and n_right");
    }
    header_ = fieldsOf(line);
    int motion = 0;
    std::string missing;
    for (const Column& column : kColumns) {
      const std::size_t place = columnIndex(column.name);
      const bool found = place < header_.size();
      places_.push_back(place);
      if (column.row >= 0 && column.row < kPropeller) {
        motion += found ? 1 : 0;
        missing = found || !missing.empty() ? missing : column.name;
      } else if (!found) {
        return failure(here() + ": column '" + column.name + "' is missing");
      }
    }
    if (motion != 0 && motion != kMotionColumns) {
      return failure(here() + ": column '" + missing +
                     "' is missing; the motion's twelve columns come all or none");
    }
    recording_.has_motion = motion == kMotionColumns;
    return {};
  }

  [[nodiscard]] std::size_t columnIndex(const std::string& name) const {
    std::size_t place = 0;
    while (place < header_.size() && header_[place] != name) {
      ++place;
    }
    return place;
  }

  Status readRow(const std::string& line) {
    const std::vector<std::string> fields = fieldsOf(line);
    if (fields.size() != header_.size()) {
      return failure(here() + ": " + std::to_string(fields.size()) + " fields, the header has " +
                     std::to_string(header_.size()));
    }
    RecordedRow row;
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      if (places_[i] == header_.size()) {
        continue;
      }
      double value = 0.0;
      if (!parse(fields[places_[i]], value)) {
        return failure(here() + ", column '" + kColumns[i].name + "': '" + fields[places_[i]] +
                       "' is not a finite number");
      }
      (kColumns[i].row == kTimeRow ? row.time_s : row.state[kColumns[i].row]) = value;
    }
    if (Status status = checkTime(row.time_s); !status) {
      return status;
    }
    recording_.rows.push_back(row);
    return {};
  }

  [[nodiscard]] Status checkTime(double time_s) const {
    if (recording_.rows.empty()) {
      return {};
    }
    const double gap = time_s - recording_.rows.back().time_s;
    if (gap <= 0.0 || gap > kMaxGap) {
      return failure(here() + ", column 't': " + std::to_string(time_s) + " s after " +
                     std::to_string(recording_.rows.back().time_s) +
                     " s; time must grow, by at most " + std::to_string(kMaxGap) + " s a row");
    }
    return {};
  }

  std::istream& in_;
  std::string name_;
  int line_ = 0;
  std::vector<std::string> header_;
  std::vector<std::size_t> places_;  // of kColumns in the header; its size where absent
  Recording recording_;
};

}  // namespace

Result<Recording> readRecording(std::istream& in, const std::string& name) {
  return Reader(in, name).read();
}

Result<Recording> readRecording(const std::string& path) {
  std::ifstream in(path);
  if (!in || in.peek() == std::ifstream::traits_type::eof()) {
    return failure(path + ": cannot be read, or is empty");
  }
  return readRecording(in, path);
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
