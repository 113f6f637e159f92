// Tables as text: a line with the columns' names, then a line a row, fields between commas. Blank
// lines are skipped, blanks and quotes around a field too.
#pragma once

#include <Eigen/Core>
#include <iosfwd>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"

namespace otter_nav {

class CsvTable {
 public:
  // Errors name the file: one that is empty, and the line whose fields are not as many as the
  // header's.
  [[nodiscard]] static Result<CsvTable> read(std::istream& in, std::string name);
  [[nodiscard]] static Result<CsvTable> load(const std::string& path);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool has(const std::string& column) const;
  // A row of the table each, the columns in the order asked for. Errors name the file, the line and
  // the column that is missing or holds something else than a finite number.
  [[nodiscard]] Result<Eigen::MatrixXd> numbers(const std::vector<std::string>& columns) const;
  // "run.csv, line 3", for messages about a row (from 0 on) of the matrix.
  [[nodiscard]] std::string where(Eigen::Index row) const;

 private:
  struct Row {
    int line = 0;
    std::vector<std::string> fields;
  };

  std::string name_;
  Row header_;
  std::vector<Row> rows_;
};

}  // namespace otter_nav
