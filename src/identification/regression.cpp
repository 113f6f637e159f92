#include "regression.hpp"

#include <Eigen/Cholesky>

#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::identification {
namespace {

using vessel::kSurge;
using vessel::kSway;
using vessel::kYawRate;

// Normal equations of an ordinary least-squares problem with N unknowns.
template <int N>
struct Normal {
  Eigen::Matrix<double, N, N> matrix = 1e-9 * Eigen::Matrix<double, N, N>::Identity();
  Eigen::Matrix<double, N, 1> right = Eigen::Matrix<double, N, 1>::Zero();

  void add(const Eigen::Matrix<double, N, 1>& row, double value) {
    matrix += row * row.transpose();
    right += row * value;
  }
  [[nodiscard]] Eigen::Matrix<double, N, 1> solve() const { return matrix.ldlt().solve(right); }
};

// Trapezoidal integrals over one interval.
struct Integrals {
  double u = 0.0;
  double v = 0.0;
  double r = 0.0;
  double vr = 0.0;
  double ur = 0.0;
  double surge_n = 0.0;
  double yaw_nm = 0.0;

  void add(const Sample& a, const Sample& b, const vessel::Thrusters& thrusters) {
    const double dt = b.time_s - a.time_s;
    const vessel::State mean = 0.5 * (a.state + b.state);
    const vessel::Tau tau = vessel::tauFromThrusts(a.thrusts, thrusters);
    u += dt * mean[kSurge];
    v += dt * mean[kSway];
    r += dt * mean[kYawRate];
    vr += dt * mean[kSway] * mean[kYawRate];
    ur += dt * mean[kSurge] * mean[kYawRate];
    surge_n += dt * tau.surge_n;
    yaw_nm += dt * tau.yaw_nm;
  }
};

}  // namespace

vessel::PaperModel regress(const DataSet& data, const std::vector<Stretch>& windows,
                           const vessel::Thrusters& thrusters, double interval_s,
                           const PaperBounds& bounds) {
  Normal<3> plane;  // m1, d1, d2
  Normal<2> yaw;    // m2, d3
  for (const Stretch& w : windows) {
    std::size_t begin = w.begin;
    Integrals sum;
    for (std::size_t i = w.begin; i + 1 < w.end; ++i) {
      sum.add(data.samples[i], data.samples[i + 1], thrusters);
      if (data.samples[i + 1].time_s - data.samples[begin].time_s < interval_s) {
        continue;
      }
      const vessel::State change = data.samples[i + 1].state - data.samples[begin].state;
      plane.add({change[kSurge] - sum.vr, sum.u, 0.0}, sum.surge_n);
      plane.add({change[kSway] + sum.ur, 0.0, sum.v}, 0.0);
      yaw.add({change[kYawRate], sum.r}, sum.yaw_nm);
      begin = i + 1;
      sum = Integrals();
    }
  }
  const Eigen::Vector3d p = plane.solve();
  const Eigen::Vector2d y = yaw.solve();
  const vessel::PaperModel free{p[0], y[0], p[1], p[2], y[1]};
  return modelOf<vessel::PaperModel>(coefficientsOf(free)
                                         .cwiseMax(coefficientsOf(bounds.lower))
                                         .cwiseMin(coefficientsOf(bounds.upper)));
}

}  // namespace otter_nav::identification
