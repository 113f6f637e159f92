#include "otter_nav/base/csv.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <istream>

namespace otter_nav {
namespace {

std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t start = 0;
  for (std::size_t comma = 0; comma != std::string::npos; start = comma + 1) {
    comma = line.find(',', start);
    const std::string field = line.substr(start, comma - start);
    const std::size_t first = field.find_first_not_of(" \t\r\"");
    const std::size_t last = field.find_last_not_of(" \t\r\"");
    fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
  }
  return fields;
}

std::string at(const std::string& name, int line) {
  return name + ", line " + std::to_string(line);
}

bool parse(const std::string& text, double& value) {
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value);
}

}  // namespace

Result<CsvTable> CsvTable::read(std::istream& in, std::string name) {
  CsvTable table;
  table.name_ = std::move(name);
  int line = 0;
  for (std::string text; std::getline(in, text);) {
    ++line;
    if (text.find_first_not_of(" \t\r") == std::string::npos) {
      continue;
    }
    Row row{line, fieldsOf(text)};
    if (table.header_.fields.empty()) {
      table.header_ = std::move(row);
    } else if (row.fields.size() != table.header_.fields.size()) {
      return failure(at(table.name_, line) + ": " + std::to_string(row.fields.size()) +
                     " fields, the header has " + std::to_string(table.header_.fields.size()));
    } else {
      table.rows_.push_back(std::move(row));
    }
  }
  if (table.header_.fields.empty()) {
    return failure(table.name_ + ": cannot be read, or is empty");
  }
  return table;
}

Result<CsvTable> CsvTable::load(const std::string& path) {
  std::ifstream in(path);
  return read(in, path);
}

bool CsvTable::has(const std::string& column) const {
  return std::find(header_.fields.begin(), header_.fields.end(), column) != header_.fields.end();
}

Result<Eigen::MatrixXd> CsvTable::numbers(const std::vector<std::string>& columns) const {
  Eigen::MatrixXd values(rows_.size(), columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (!has(columns[k])) {
      return failure(at(name_, header_.line) + ": column '" + columns[k] + "' is missing");
    }
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto place = std::find(header_.fields.begin(), header_.fields.end(), columns[k]) -
                         header_.fields.begin();
      const std::string& text = rows_[i].fields[static_cast<std::size_t>(place)];
      double& value = values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
      if (!parse(text, value)) {
        return failure(at(name_, rows_[i].line) + ", column '" + columns[k] + "': '" + text +
                       "' is not a finite number");
      }
    }
  }
  return values;
}

std::string CsvTable::where(Eigen::Index row) const {
  return at(name_, rows_[static_cast<std::size_t>(row)].line);
}

}  // namespace otter_nav
