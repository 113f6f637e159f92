#include "csv_path.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "otter_nav/base/csv.hpp"

namespace otter_nav::benchmark {

Result<std::vector<TimedPoint>> readTimedPoints(const std::string& path) {
  const Result<CsvTable> table = CsvTable::load(path);
  if (!table) {
    return failure(table.error().message);
  }
  const Result<Eigen::MatrixXd> rows = table->numbers({"t", "x", "y"});
  if (!rows) {
    return failure(rows.error().message);
  }
  std::vector<TimedPoint> points;
  for (Eigen::Index i = 0; i < rows->rows(); ++i) {
    points.push_back({(*rows)(i, 0), {(*rows)(i, 1), (*rows)(i, 2)}});
    if (i > 0 && (*rows)(i, 0) <= (*rows)(i - 1, 0)) {
      return failure(table->where(i) + ": time does not grow");
    }
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
