#include "optimizer/objective/spline_problem.hpp"

#include <algorithm>
#include <cmath>

#include "optimizer/objective/flat_gradient.hpp"
#include "optimizer/objective/spline_couplings.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kForceScaleN = 50.0;  // a thrust exceeded by this counts as one
constexpr double kForceKnee = 0.3;     // exceeded by more than this share, it counts linearly
constexpr double kMotionKnee = 1.0;    // of speed, m/s, and yaw rate, rad/s
constexpr double kClearanceKneeM = 1.0;
constexpr double kForceFloorN = 3.0;  // |w| below this is treated as this
constexpr double kSlowMps = 0.5;      // below it the length's curvature is bounded

using Rows = Eigen::Matrix<double, 2, kOrders>;  // derivatives by position ... snap

}  // namespace

// One piece's share: unknowns are 8 of the first knot, the duration, 8 of the second.
struct SplineProblem::Local {
  static constexpr int kUnknowns = 17;
  static constexpr int kDuration = 8;
  using Vector = Eigen::Matrix<double, kUnknowns, 1>;

  Eigen::Matrix<double, 2, kEndValues> ends;
  double duration_s = 1.0;
  bool model = false;  // gradient and Hessian wanted
  double cost = 0.0;
  Vector gradient;
  Eigen::Matrix<double, kUnknowns, kUnknowns> hessian;  // lower triangle

  ScaledBasis basis;
  Rows slope;  // of the point's derivatives with respect to the duration

  [[nodiscard]] Rows at(const BasisMatrix& unit_basis) {
    basis = trajectory::scaleBasis(unit_basis, duration_s);
    slope.noalias() = ends * basis.slope.transpose();
    return ends * basis.value.transpose();
  }

  // d scalar / d unknowns from d scalar / d derivatives.
  [[nodiscard]] Vector chain(const Rows& rows) const {
    const Eigen::Matrix<double, 2, kEndValues> by_ends = rows * basis.value;
    Vector j;
    for (int m = 0; m < 4; ++m) {
      j.segment<2>(2 * m) = by_ends.col(m);
      j.segment<2>(9 + 2 * m) = by_ends.col(m + 4);
    }
    j[kDuration] = rows.cwiseProduct(slope).sum();
    return j;
  }

  void addSquare(double weight, double residual, const Vector& j) {
    gradient += 2.0 * weight * residual * j;
    addCurvature(2.0 * weight, j);
  }
  void addCurvature(double curvature, const Vector& j) {
    for (int c = 0; c < kUnknowns; ++c) {
      hessian.col(c).noalias() += (curvature * j[c]) * j;
    }
  }
  // weight * max(0, excess)^2, growing linearly from `knee` on (Huber), so that a bad first guess
  // does not drown all else; `rows` is the derivative of excess.
  template <typename MakeRows>
  void hinge(double weight, double excess, double knee, const MakeRows& rows) {
    if (excess <= 0.0) {
      return;
    }
    const double held = std::min(excess, knee);
    cost += weight * held * (2.0 * excess - held);
    if (model) {
      addSquare(weight * held / excess, excess, chain(rows()));
    }
  }
};

SplineProblem::SplineProblem(const vessel::Parameters& vessel) : vessel_(vessel) {
  for (std::size_t i = 0; i < quadrature_.size(); ++i) {
    quadrature_[i] = trajectory::hermiteBasis(trajectory::quadraturePoints()[i]);
  }
  for (std::size_t i = 0; i < clearance_.size(); ++i) {
    clearance_[i] = trajectory::hermiteBasis((static_cast<double>(i) + 0.5) / kClearancePoints);
  }
}

void SplineProblem::addFree(const Rows& z, Local& local) const {
  vessel::FlatPoint flat;
  flat.velocity = z.col(1);
  flat.acceleration = z.col(2);
  flat.jerk = z.col(3);
  flat.snap = z.col(4);
  const FlatGradient g = flatGradient(flat, vessel_, kForceFloorN);
  const auto widen = [](const FlatRow& row, double scale) {
    Rows rows;
    rows.col(0).setZero();
    rows.rightCols<4>() = scale * row;
    return rows;
  };
  for (const double side : {-1.0, 1.0}) {
    const double thrust = 0.5 * (g.surge_n + side * g.difference_n);
    const FlatRow row = 0.5 * (g.surge + side * g.difference);
    local.hinge(weights.dynamics, (thrust - limits.thrust_ahead_n) / kForceScaleN, kForceKnee,
                [&] { return widen(row, 1.0 / kForceScaleN); });
    local.hinge(weights.dynamics, (-thrust - limits.thrust_astern_n) / kForceScaleN, kForceKnee,
                [&] { return widen(row, -1.0 / kForceScaleN); });
  }
  local.hinge(weights.dynamics, std::abs(g.yaw_rate_radps) - limits.yaw_rate_radps, kMotionKnee,
              [&] { return widen(g.yaw_rate, g.yaw_rate_radps < 0.0 ? -1.0 : 1.0); });
  const double speed = flat.velocity.norm();
  local.hinge(weights.dynamics, speed - limits.speed_mps, kMotionKnee, [&] {
    Rows rows = Rows::Zero();
    rows.col(1) = flat.velocity / speed;
    return rows;
  });
  // |w| by its component along the course: a heading against the course counts as missing it all.
  if (speed > 1e-3) {
    const Eigen::Vector2d course = flat.velocity / speed;
    const vessel::PaperModel& m = vessel_.paper;
    const double ahead = m.m1_kg * course.dot(flat.acceleration) + m.d2_kgps * speed;
    local.hinge(weights.dynamics, (limits.heading_force_n - ahead) / kForceScaleN, kForceKnee, [&] {
      Rows rows = Rows::Zero();
      const Eigen::Vector2d turn = across(course);
      rows.col(1) = -(m.d2_kgps * course +
                      m.m1_kg * turn.dot(flat.acceleration) / std::max(speed, kSlowMps) * turn) /
                    kForceScaleN;
      rows.col(2) = -m.m1_kg / kForceScaleN * course;
      return rows;
    });
  }
}

void SplineProblem::addQuadraturePoint(std::size_t i, int point, Local& local) const {
  const auto index = static_cast<std::size_t>(point);
  const Rows z = local.at(quadrature_[index]);
  const double share = trajectory::quadratureWeights()[index];
  const double dt = local.duration_s * share;
  const double half_inverse = 0.5 / local.duration_s;

  const double speed = z.col(1).norm();
  local.cost += weights.smooth * dt * z.col(3).squaredNorm() + weights.length * dt * speed;
  if (local.model) {
    for (int axis = 0; axis < 2; ++axis) {
      Rows rows = Rows::Zero();
      rows(axis, 3) = 1.0;
      Local::Vector j = local.chain(rows);
      j[Local::kDuration] += half_inverse * z(axis, 3);
      local.addSquare(weights.smooth * dt, z(axis, 3), j);
    }
    if (speed > 1e-6) {
      Rows rows = Rows::Zero();
      rows.col(1) = z.col(1) / speed;
      local.gradient += weights.length * dt * local.chain(rows);
      local.gradient[Local::kDuration] += weights.length * share * speed;
      rows.col(1) = across(rows.col(1));
      local.addCurvature(weights.length * dt / std::max(speed, kSlowMps), local.chain(rows));
    }
  }
  if (originals != nullptr && weights.original > 0.0) {
    const Eigen::Vector2d off = z.col(0) - (*originals)[i][index];
    local.cost += weights.original * share * off.squaredNorm();
    if (local.model) {
      for (int axis = 0; axis < 2; ++axis) {
        Rows rows = Rows::Zero();
        rows(axis, 0) = 1.0;
        local.addSquare(weights.original * share, off[axis], local.chain(rows));
      }
    }
  }
  addFree(z, local);
}

void SplineProblem::addClearance(int point, Local& local) const {
  const BasisMatrix& unit = clearance_[static_cast<std::size_t>(point)];
  // Position first, the rest only near obstacles.
  Eigen::Vector2d p = Eigen::Vector2d::Zero();
  double power = 1.0;
  for (int m = 0; m < 4; ++m) {
    p += power * (unit(0, m) * local.ends.col(m) + unit(0, m + 4) * local.ends.col(m + 4));
    power *= local.duration_s;
  }
  const map::DistanceField::Smooth centre = field->smooth(p);
  const double reach =
      std::max(limits.clearance_m,
               limits.hull_offset_m > 0.0 ? limits.hull_offset_m + limits.hull_clearance_m : 0.0);
  if (centre.distance_m > reach) {
    return;
  }
  const Rows z = local.at(unit);
  local.hinge(weights.clearance, limits.clearance_m - centre.distance_m, kClearanceKneeM, [&] {
    Rows rows = Rows::Zero();
    rows.col(0) = -centre.gradient;
    return rows;
  });
  if (limits.hull_offset_m <= 0.0) {
    return;
  }
  const vessel::PaperModel& m = vessel_.paper;
  const Eigen::Vector2d w = m.m1_kg * z.col(2) + m.d2_kgps * z.col(1);
  const double norm = std::max(w.norm(), kForceFloorN);
  const Eigen::Vector2d bow = w / norm;
  for (const double offset : {-limits.hull_offset_m, limits.hull_offset_m}) {
    const map::DistanceField::Smooth end = field->smooth(p + offset * bow);
    local.hinge(weights.clearance, limits.hull_clearance_m - end.distance_m, kClearanceKneeM, [&] {
      Rows rows = Rows::Zero();
      rows.col(0) = -end.gradient;
      const Eigen::Vector2d turn = -offset / norm * (end.gradient - end.gradient.dot(bow) * bow);
      rows.col(1) = m.d2_kgps * turn;
      rows.col(2) = m.m1_kg * turn;
      return rows;
    });
  }
}

void SplineProblem::addPiece(const Spline& spline, std::size_t i, Local& local) const {
  const Span& span = spline.spans[i];
  local.ends << spline.knots[i].state, spline.knots[i + 1].state;
  local.duration_s = span.duration_s;
  local.gradient.setZero();
  local.hessian.setZero();
  local.cost += weights.time * span.duration_s;
  if (local.model) {
    local.gradient[Local::kDuration] += weights.time;
    local.hessian(Local::kDuration, Local::kDuration) += 0.5 * weights.time / span.duration_s;
  }
  for (int point = 0; point < kQuadraturePoints; ++point) {
    addQuadraturePoint(i, point, local);
  }
  if (field != nullptr) {
    for (int point = 0; point < kClearancePoints; ++point) {
      addClearance(point, local);
    }
  }
}

double SplineProblem::evaluate(const Spline& spline, System* system) const {
  Local local;
  local.model = system != nullptr;
  if (system != nullptr) {
    system->reset(spline.knots.size());
  }
  for (std::size_t i = 0; i < spline.spans.size(); ++i) {
    addPiece(spline, i, local);
    if (system == nullptr) {
      continue;
    }
    system->diagonal[i] += local.hessian.topLeftCorner<9, 9>();
    system->diagonal[i + 1].topLeftCorner<8, 8>() += local.hessian.bottomRightCorner<8, 8>();
    system->below[i].topRows<8>() += local.hessian.bottomLeftCorner<8, 9>();
    system->right[i] -= local.gradient.head<9>();
    system->right[i + 1].head<8>() -= local.gradient.tail<8>();
  }
  return local.cost + addCouplings(spline, weights.time, system);
}

void SplineProblem::apply(const std::vector<System::Vector>& step, double scale, Spline& spline) {
  for (std::size_t k = 0; k < spline.knots.size(); ++k) {
    Knot& knot = spline.knots[k];
    Eigen::Matrix<double, 8, 1> change = scale * step[k].head<8>();
    if (knot.family) {
      knot.family->moved += scale * step[k].head<2>();
      change = knot.family->state * (scale * step[k].head<2>());
    }
    for (int m = 0; m < 4; ++m) {
      knot.state.col(m) += change.segment<2>(2 * m);
    }
    if (k < spline.spans.size()) {
      double& duration = spline.spans[k].duration_s;
      duration = std::clamp(duration + scale * step[k][8], 0.6 * duration, 1.6 * duration);
    }
  }
}

}  // namespace otter_nav::optimizer
