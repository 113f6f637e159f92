#include "csv_path.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace otter_nav::benchmark {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    const auto first = cell.find_first_not_of(" \t\r\"");
    const auto last = cell.find_last_not_of(" \t\r\"");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

int columnOf(const std::vector<std::string>& header, const std::string& name) {
  const auto at = std::find(header.begin(), header.end(), name);
  return at == header.end() ? -1 : static_cast<int>(at - header.begin());
}

bool parse(const std::vector<std::string>& cells, int column, double& value) {
  if (column >= static_cast<int>(cells.size())) {
    return false;
  }
  const std::string& text = cells[static_cast<std::size_t>(column)];
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' && std::isfinite(value);
}

}  // namespace

Result<std::vector<TimedPoint>> readTimedPoints(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!file || !std::getline(file, line)) {
    return failure(path + ": cannot be read");
  }
  const std::vector<std::string> header = split(line);
  const int columns[3] = {columnOf(header, "t"), columnOf(header, "x"), columnOf(header, "y")};
  if (*std::min_element(columns, columns + 3) < 0) {
    return failure(path + ": the header lacks one of the columns t, x, y");
  }
  std::vector<TimedPoint> points;
  for (int row = 2; std::getline(file, line); ++row) {
    if (line.empty() || line == "\r") {
      continue;
    }
    const std::vector<std::string> cells = split(line);
    TimedPoint p{};
    if (!parse(cells, columns[0], p.t_s) || !parse(cells, columns[1], p.position.x()) ||
        !parse(cells, columns[2], p.position.y())) {
      return failure(path + ", line " + std::to_string(row) + ": t, x and y must be numbers");
    }
    if (!points.empty() && p.t_s <= points.back().t_s) {
      return failure(path + ", line " + std::to_string(row) + ": time does not grow");
    }
    points.push_back(p);
  }
  constexpr double kFastestMps = 20.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double speed =
        (points[i].position - points[i - 1].position).norm() / (points[i].t_s - points[i - 1].t_s);
    if (speed > kFastestMps) {
      return failure(path + ": moves at " + std::to_string(speed) +
                     " m/s at t = " + std::to_string(points[i].t_s) + " (at most " +
                     std::to_string(kFastestMps) + ")");
    }
  }
  if (points.size() < 20) {
    return failure(path + ": " + std::to_string(points.size()) + " rows, at least 20 are needed");
  }
  return points;
}

vessel::FlatPoint fitAt(const std::vector<TimedPoint>& points, double t_s) {
  constexpr double kHalfWindowS = 0.3;
  constexpr int kLeastPoints = 10;
  constexpr int kTerms = 6;
  const auto earlier = [](const TimedPoint& p, double t) { return p.t_s < t; };
  auto first = std::lower_bound(points.begin(), points.end(), t_s - kHalfWindowS, earlier);
  auto last = std::lower_bound(points.begin(), points.end(), t_s + kHalfWindowS, earlier);
  while (last - first < kLeastPoints && (first != points.begin() || last != points.end())) {
    first -= first != points.begin() ? 1 : 0;
    last += last != points.end() ? 1 : 0;
  }
  const auto rows = last - first;
  Eigen::MatrixXd basis(rows, kTerms);
  Eigen::MatrixXd values(rows, 2);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const TimedPoint& p = *(first + i);
    double power = 1.0;
    for (int k = 0; k < kTerms; ++k, power *= p.t_s - t_s) {
      basis(i, k) = power;
    }
    values.row(i) = p.position.transpose();
  }
  const Eigen::MatrixXd c = basis.colPivHouseholderQr().solve(values);
  vessel::FlatPoint z;
  z.position = c.row(0).transpose();
  z.velocity = c.row(1).transpose();
  z.acceleration = 2.0 * c.row(2).transpose();
  z.jerk = 6.0 * c.row(3).transpose();
  return z;
}

}  // namespace otter_nav::benchmark
