#include "tracker/ocp/shooting.hpp"

#include <algorithm>

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

StageModel::StageModel(const vessel::ManoeuvringModel& m, const vessel::Thrusters& thrusters)
    : surge_centripetal_(m.surge_centripetal_kg / m.surge_inertia_kg),
      sway_centripetal_(m.sway_centripetal_kg / m.sway_inertia_kg),
      munk_(m.munk_kg / m.yaw_inertia_kgm2),
      surge_drag_(m.surge_drag_kgps / m.surge_inertia_kg),
      sway_drag_(m.sway_drag_kgps / m.sway_inertia_kg),
      yaw_drag_(m.yaw_drag_kgm2ps / m.yaw_inertia_kgm2),
      surge_drag2_(m.surge_drag_quadratic_kgpm / m.surge_inertia_kg),
      sway_drag2_(m.sway_drag_quadratic_kgpm / m.sway_inertia_kg),
      yaw_drag2_(m.yaw_drag_quadratic_kgm2 / m.yaw_inertia_kgm2),
      sway_from_yaw_(m.sway_from_yaw_kgmps / m.sway_inertia_kg),
      yaw_from_sway_(m.yaw_from_sway_kgmps / m.yaw_inertia_kgm2),
      surge_mobility_(1.0 / m.surge_inertia_kg),
      sway_mobility_(1.0 / m.sway_inertia_kg),
      yaw_mobility_(1.0 / m.yaw_inertia_kgm2),
      lever_(thrusters.lever_arm_m),
      wind_surge_(m.wind_surge_kgpm / m.surge_inertia_kg),
      wind_sway_(m.wind_sway_kgpm / m.sway_inertia_kg),
      wind_yaw_(m.wind_yaw_kg / m.yaw_inertia_kgm2) {}

void StageModel::setDisturbance(const vessel::Disturbance& disturbance) {
  current_x_ = disturbance.current_mps.x();
  current_y_ = disturbance.current_mps.y();
  force_x_ = disturbance.force_n.x();
  force_y_ = disturbance.force_n.y();
  moment_ = disturbance.moment_nm;
  wind_x_ = disturbance.wind_mps.x();
  wind_y_ = disturbance.wind_mps.y();
}

// vessel::stateDerivative and its Jacobian, see vessel/model.cpp for the derivation.
void StageModel::differentiate(const Pack (&q)[4], Pack surge_acceleration, Pack yaw_acceleration,
                               Derivative& d) const {
  const Pack r = q[kRowR];
  sinCos(q[kRowPsi], d.sine, d.cosine);
  const Pack current_u = d.cosine * current_x_ + d.sine * current_y_;
  const Pack current_v = d.cosine * current_y_ - d.sine * current_x_;
  const Pack force_u = d.cosine * force_x_ + d.sine * force_y_;
  const Pack force_v = d.cosine * force_y_ - d.sine * force_x_;
  const Pack wind_u = d.cosine * wind_x_ + d.sine * wind_y_;
  const Pack wind_v = d.cosine * wind_y_ - d.sine * wind_x_;
  const Pack gust_u = wind_surge_ * abs(wind_u);
  const Pack gust_v = wind_sway_ * abs(wind_v);
  const Pack u = q[kRowU] - current_u;
  const Pack v = q[kRowV] - current_v;
  const Pack drag2_u = surge_drag2_ * abs(u);
  const Pack drag2_v = sway_drag2_ * abs(v);
  const Pack drag2_r = yaw_drag2_ * abs(r);

  d.rate[0] = d.cosine * q[kRowU] - d.sine * q[kRowV];
  d.rate[1] = d.sine * q[kRowU] + d.cosine * q[kRowV];
  d.rate[2] = r;
  d.rate[3] = surge_centripetal_ * v * r + surge_acceleration + force_u * surge_mobility_ +
              gust_u * wind_u - (surge_drag_ + drag2_u) * u + r * current_v;
  d.rate[4] = force_v * sway_mobility_ + gust_v * wind_v - sway_centripetal_ * u * r -
              (sway_drag_ + drag2_v) * v - sway_from_yaw_ * r - r * current_u;
  d.rate[5] = yaw_acceleration + moment_ * yaw_mobility_ + wind_yaw_ * wind_u * wind_v -
              (yaw_drag_ + drag2_r) * r - munk_ * u * v - yaw_from_sway_ * v;

  d.x_psi = -d.rate[1];
  d.y_psi = d.rate[0];
  d.u[kRowU] = -surge_drag_ - 2.0 * drag2_u;
  d.u[kRowV] = surge_centripetal_ * r;
  d.u[kRowR] = surge_centripetal_ * v + current_v;
  d.u[kRowPsi] = d.u[kRowV] * current_u - d.u[kRowU] * current_v + force_v * surge_mobility_ -
                 r * current_u + 2.0 * gust_u * wind_v;
  d.v[kRowU] = -sway_centripetal_ * r;
  d.v[kRowV] = -sway_drag_ - 2.0 * drag2_v;
  d.v[kRowR] = -sway_centripetal_ * u - sway_from_yaw_ - current_u;
  d.v[kRowPsi] = d.v[kRowV] * current_u - d.v[kRowU] * current_v - force_u * sway_mobility_ -
                 r * current_v - 2.0 * gust_v * wind_u;
  d.r[kRowU] = -munk_ * v;
  d.r[kRowV] = -munk_ * u - yaw_from_sway_;
  d.r[kRowR] = -yaw_drag_ - 2.0 * drag2_r;
  d.r[kRowPsi] = d.r[kRowV] * current_u - d.r[kRowU] * current_v +
                 wind_yaw_ * (wind_v * wind_v - wind_u * wind_u);
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
  rate.q[kRowU][kSurgeForce] += surge_mobility_;
  rate.q[kRowR][kYawMoment] += yaw_mobility_;
}

namespace {

constexpr double kWeights[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
constexpr double kNodes[4] = {0.0, 0.5, 0.5, 1.0};

Pack gather(const vessel::State* states, const int (&index)[kLanes], int row) {
  return Pack{states[index[0]][row], states[index[1]][row], states[index[2]][row],
              states[index[3]][row]};
}

// Four lanes of a row of A and of [B c] go to the four stages.
void scatter(Pack (&a)[4], Pack (&bc)[4], int row, Stage* stages) {
  transpose(a[0], a[1], a[2], a[3]);
  transpose(bc[0], bc[1], bc[2], bc[3]);
  for (int lane = 0; lane < kLanes; ++lane) {
    stages[lane].a[row] = a[lane];
    stages[lane].bc[row] = bc[lane];
  }
}

}  // namespace

void StageModel::linearize(const vessel::State* states, const vessel::Thrusts* thrusts, int count,
                           double step_s, Stage* stages) const {
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
    const Pack surge_acceleration = (left + right) * surge_mobility_;
    const Pack yaw_acceleration = (right - left) * (lever_ * yaw_mobility_);
    Pack start[6];
    for (int row = 0; row < 6; ++row) {
      start[row] = gather(states, index, row);
    }

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
      differentiate(q, surge_acceleration, yaw_acceleration, d);
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
      const Pack yaw_part = lever_ * columns[kYawMoment];
      Pack bc[4] = {columns[kSurgeForce] - yaw_part, columns[kSurgeForce] + yaw_part,
                    start[row] + moved[row] - gather(states, next, row), Pack{}};
      scatter(a, bc, row, stages + first);
    }
  }
}

}  // namespace otter_nav::tracker
