#include "tracker/ocp/shooting.hpp"

#include <algorithm>

#include "otter_nav/vessel/motion_law.hpp"

namespace otter_nav::tracker {
namespace {

// Rows of the coupled part q = (psi, u, v, r) and the columns of its sensitivities.
enum Row : int { kRowPsi, kRowU, kRowV, kRowR };
constexpr int kColumns = 6;  // psi, u, v, r, surge force, yaw moment
constexpr int kSurgeForce = 4;
constexpr int kYawMoment = 5;

}  // namespace

// Rates of x, y and q, and their Jacobians with respect to q.
struct StageModel::Derivative {
  Pack rate[6];
  Pack x_psi, y_psi, cosine, sine;
  Pack u[4], v[4], r[4];
};

// d(x, y, q) / d(columns).
struct StageModel::Sensitivity {
  Pack x[kColumns], y[kColumns], q[4][kColumns];
};

// Velocity and acceleration, earth frame.
struct StageModel::Water {
  Pack x, y, x_rate, y_rate;
};

StageModel::Water StageModel::waterOf(const int (&index)[kLanes]) const {
  Water water;
  for (int lane = 0; lane < kLanes; ++lane) {
    const WaterMotion& moved = water_[static_cast<std::size_t>(index[lane])];
    water.x[lane] = moved.velocity_mps.x();
    water.y[lane] = moved.velocity_mps.y();
    water.x_rate[lane] = moved.acceleration_mps2.x();
    water.y_rate[lane] = moved.acceleration_mps2.y();
  }
  return water;
}

// The law on dual numbers: what it does not depend on costs nothing.
void StageModel::differentiate(const Pack (&q)[4], Pack surge_n, Pack yaw_nm, const Water& water,
                               Derivative& d) const {
  sinCos(q[kRowPsi], d.sine, d.cosine);
  const vessel::Turned<kRowPsi, Pack> psi(d.cosine, d.sine);
  const auto u = variable<kRowU>(q[kRowU]);
  const auto v = variable<kRowV>(q[kRowV]);
  const auto r = variable<kRowR>(q[kRowR]);
  const Eigen::Vector2d& current = disturbance_.current_mps;
  const auto position = vessel::positionRate(psi.cosine, psi.sine, u, v);
  const auto acceleration = vessel::bodyAcceleration(
      model_, mobility_, psi.cosine, psi.sine,
      vessel::outsideForce(psi.cosine, psi.sine, model_, disturbance_), current.x() + water.x,
      current.y() + water.y, u, v, r, surge_n, yaw_nm);
  const auto taken_ahead = vessel::aheadPart(psi.cosine, psi.sine, water.x_rate, water.y_rate);
  const auto taken_to_port = vessel::portPart(psi.cosine, psi.sine, water.x_rate, water.y_rate);
  d.rate[0] = position.x.value;
  d.rate[1] = position.y.value;
  d.rate[2] = q[kRowR];
  d.rate[3] = acceleration.surge.value + taken_ahead.value;
  d.rate[4] = acceleration.sway.value + taken_to_port.value;
  d.rate[5] = acceleration.yaw.value;
  d.x_psi = slope<kRowPsi>(position.x);
  d.y_psi = slope<kRowPsi>(position.y);
  const auto setRow = [](const auto& rate, Pack(&row)[4]) {
    row[kRowPsi] = slope<kRowPsi>(rate);
    row[kRowU] = slope<kRowU>(rate);
    row[kRowV] = slope<kRowV>(rate);
    row[kRowR] = slope<kRowR>(rate);
  };
  setRow(acceleration.surge, d.u);
  setRow(acceleration.sway, d.v);
  setRow(acceleration.yaw, d.r);
  d.u[kRowPsi] += slope<kRowPsi>(taken_ahead);
  d.v[kRowPsi] += slope<kRowPsi>(taken_to_port);
  if (finite_turn_rad_ > 0.0 && model_.wind_sway_kgpm != 0.0) {
    d.v[kRowPsi] += bowInWind(d.cosine, d.sine);
  }
}

// What a turn adds to the sway's rate, per radian, beyond the slope. A load that goes with the
// square of what comes from abeam has none there, and the plan would see no way of getting abeam
// by turning.
Pack StageModel::bowInWind(const Pack& cosine, const Pack& sine) const {
  const Eigen::Vector2d& wind = disturbance_.wind_mps;
  const Pack ahead = vessel::aheadPart(cosine, sine, wind.x(), wind.y());
  const Pack twice = 2.0 * abs(vessel::portPart(cosine, sine, wind.x(), wind.y()));
  const Pack finite = broadcast(finite_turn_rad_ * wind.norm());
  return twice < finite ? -mobility_.sway * model_.wind_sway_kgpm * (finite - twice) * ahead
                        : Pack{};
}

void StageModel::propagate(const Derivative& d, const Sensitivity& s, Sensitivity& rate) const {
  for (int c = 0; c < kColumns; ++c) {
    const Pack psi = s.q[kRowPsi][c];
    const Pack u = s.q[kRowU][c];
    const Pack v = s.q[kRowV][c];
    const Pack r = s.q[kRowR][c];
    rate.x[c] = d.x_psi * psi + d.cosine * u - d.sine * v;
    rate.y[c] = d.y_psi * psi + d.sine * u + d.cosine * v;
    rate.q[kRowPsi][c] = r;
    rate.q[kRowU][c] = d.u[kRowPsi] * psi + d.u[kRowU] * u + d.u[kRowV] * v + d.u[kRowR] * r;
    rate.q[kRowV][c] = d.v[kRowPsi] * psi + d.v[kRowU] * u + d.v[kRowV] * v + d.v[kRowR] * r;
    rate.q[kRowR][c] = d.r[kRowPsi] * psi + d.r[kRowU] * u + d.r[kRowV] * v + d.r[kRowR] * r;
  }
  rate.q[kRowU][kSurgeForce] += mobility_.surge;
  rate.q[kRowR][kYawMoment] += mobility_.yaw;
}

namespace {

constexpr double kWeights[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
constexpr double kNodes[4] = {0.0, 0.5, 0.5, 1.0};

Pack gather(const vessel::State* states, const int (&index)[kLanes], int row) {
  return Pack{states[index[0]][row], states[index[1]][row], states[index[2]][row],
              states[index[3]][row]};
}

// Four lanes of a row of A and of [B c] go to the four stages.
void scatter(Pack (&a)[4], Pack (&bc)[4], int row, qp::Stage* stages) {
  transpose(a[0], a[1], a[2], a[3]);
  transpose(bc[0], bc[1], bc[2], bc[3]);
  for (int lane = 0; lane < kLanes; ++lane) {
    stages[lane].a[row] = a[lane];
    stages[lane].bc[row] = bc[lane];
  }
}

}  // namespace

void StageModel::linearize(const vessel::State* states, const vessel::Thrusts* thrusts, int count,
                           double step_s, qp::Stage* stages) const {
  for (int first = 0; first < count; first += kLanes) {
    // Lanes past the end repeat the last stage.
    int index[kLanes];
    int next[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
      index[lane] = std::min(first + lane, count - 1);
      next[lane] = index[lane] + 1;
    }
    const Pack left = {thrusts[index[0]][0], thrusts[index[1]][0], thrusts[index[2]][0],
                       thrusts[index[3]][0]};
    const Pack right = {thrusts[index[0]][1], thrusts[index[1]][1], thrusts[index[2]][1],
                        thrusts[index[3]][1]};
    const Pack surge_n = left + right;
    const Pack yaw_nm = (right - left) * lever_m_;
    Pack start[6];
    for (int row = 0; row < 6; ++row) {
      start[row] = gather(states, index, row);
    }

    const Water water = waterOf(index);
    Derivative d;
    Sensitivity rate;
    Sensitivity sum{};
    Pack moved[6] = {};
    for (int k = 0; k < 4; ++k) {
      const double node = kNodes[k] * step_s;
      Pack q[4];
      Sensitivity s;
      for (int row = 0; row < 4; ++row) {
        q[row] = k == 0 ? start[row + 2] : start[row + 2] + node * d.rate[row + 2];
        for (int c = 0; c < kColumns; ++c) {
          const Pack unit = broadcast(row == c ? 1.0 : 0.0);
          s.q[row][c] = k == 0 ? unit : unit + node * rate.q[row][c];
        }
      }
      differentiate(q, surge_n, yaw_nm, water, d);
      propagate(d, s, rate);
      const double weight = kWeights[k] * step_s;
      for (int row = 0; row < 6; ++row) {
        moved[row] += weight * d.rate[row];
      }
      for (int c = 0; c < kColumns; ++c) {
        sum.x[c] += weight * rate.x[c];
        sum.y[c] += weight * rate.y[c];
        for (int row = 0; row < 4; ++row) {
          sum.q[row][c] += weight * rate.q[row][c];
        }
      }
    }

    for (int row = 0; row < 6; ++row) {
      const Pack* columns = row == 0 ? sum.x : row == 1 ? sum.y : sum.q[row - 2];
      Pack a[4] = {columns[0], columns[1], columns[2], columns[3]};
      if (row >= 2) {
        a[row - 2] += 1.0;
      }
      const Pack yaw_part = lever_m_ * columns[kYawMoment];
      Pack bc[4] = {columns[kSurgeForce] - yaw_part, columns[kSurgeForce] + yaw_part,
                    start[row] + moved[row] - gather(states, next, row), Pack{}};
      scatter(a, bc, row, stages + first);
    }
  }
}

}  // namespace otter_nav::tracker
