#include "tracker/qp/riccati.hpp"

namespace otter_nav::tracker::qp {
namespace {

// P [A_q B c] + [0 0 p], row by row of (x, y, psi, u, v, r).
struct alignas(32) Products {
  Pack a[6];
  Pack bc[6];
};

// The Hessian of V(A dx + B du + c) in (dx, du), and its gradient in lane 2 of the bc rows.
struct alignas(32) Hessian {
  Pack qq[4];
  Pack q_bc[4];  // lanes: F_left, F_right, gradient
  Pack u_q[2];
  Pack u_bc[2];
};

Products multiply(const Stage& s, const Value& v) {
  Products m;
  for (int i = 0; i < 2; ++i) {
    m.a[i] = v.pp[i][0] * s.a[0] + v.pp[i][1] * s.a[1];
    m.bc[i] = v.pp[i][0] * s.bc[0] + v.pp[i][1] * s.bc[1];
    for (int j = 0; j < 4; ++j) {
      m.a[i] += v.pq[i][j] * s.a[j + 2];
      m.bc[i] += v.pq[i][j] * s.bc[j + 2];
    }
    m.bc[i][2] += v.p_p[i];
  }
  for (int i = 0; i < 4; ++i) {
    m.a[i + 2] = v.pq[0][i] * s.a[0] + v.pq[1][i] * s.a[1];
    m.bc[i + 2] = v.pq[0][i] * s.bc[0] + v.pq[1][i] * s.bc[1];
    for (int j = 0; j < 4; ++j) {
      m.a[i + 2] += v.qq[i][j] * s.a[j + 2];
      m.bc[i + 2] += v.qq[i][j] * s.bc[j + 2];
    }
    m.bc[i + 2][2] += v.p_q[i];
  }
  return m;
}

Hessian project(const Stage& s, const Products& m) {
  Hessian h;
  for (int col = 0; col < 4; ++col) {
    h.qq[col] = s.a[0][col] * m.a[0];
    h.q_bc[col] = s.a[0][col] * m.bc[0];
    for (int row = 1; row < 6; ++row) {
      h.qq[col] += s.a[row][col] * m.a[row];
      h.q_bc[col] += s.a[row][col] * m.bc[row];
    }
  }
  for (int col = 0; col < 2; ++col) {
    h.u_q[col] = s.bc[0][col] * m.a[0];
    h.u_bc[col] = s.bc[0][col] * m.bc[0];
    for (int row = 1; row < 6; ++row) {
      h.u_q[col] += s.bc[row][col] * m.a[row];
      h.u_bc[col] += s.bc[row][col] * m.bc[row];
    }
  }
  return h;
}

// The inverse of the Hessian's free part, zero in rows and columns of held thrusters.
bool invertFree(const double (&hessian)[2][2], const Hold (&hold)[2], double (&inverse)[2][2]) {
  const bool left = hold[0] == Hold::kFree;
  const bool right = hold[1] == Hold::kFree;
  inverse[0][1] = inverse[1][0] = 0.0;
  if (left && right) {
    const double determinant = hessian[0][0] * hessian[1][1] - hessian[0][1] * hessian[0][1];
    const double scale = 1.0 / determinant;
    inverse[0][0] = hessian[1][1] * scale;
    inverse[1][1] = hessian[0][0] * scale;
    inverse[0][1] = inverse[1][0] = -hessian[0][1] * scale;
    return determinant > 0.0 && hessian[0][0] > 0.0;
  }
  inverse[0][0] = left ? 1.0 / hessian[0][0] : 0.0;
  inverse[1][1] = right ? 1.0 / hessian[1][1] : 0.0;
  return (!left || hessian[0][0] > 0.0) && (!right || hessian[1][1] > 0.0);
}

void setGains(const Hold (&hold)[2], const double (&held)[2], Feedback& f) {
  const auto& inverse = f.inverse;
  // A held thruster's known du shifts the gradient of the free one.
  const double du0 = hold[0] == Hold::kFree ? 0.0 : held[0];
  const double du1 = hold[1] == Hold::kFree ? 0.0 : held[1];
  const double h0 = f.h[0] + f.hessian[0][1] * du1;
  const double h1 = f.h[1] + f.hessian[1][0] * du0;
  for (int i = 0; i < 2; ++i) {
    f.k_q[i] = inverse[i][0] * f.g_q[0] + inverse[i][1] * f.g_q[1];
    f.k_p[i][0] = inverse[i][0] * f.g_p[0][0] + inverse[i][1] * f.g_p[1][0];
    f.k_p[i][1] = inverse[i][0] * f.g_p[0][1] + inverse[i][1] * f.g_p[1][1];
    f.k_0[i] = inverse[i][0] * h0 + inverse[i][1] * h1;
  }
  f.k_0[0] -= du0;
  f.k_0[1] -= du1;
}

// V = cost + projected Hessian - G'K; the gradient follows u = -k_0 at dx = 0.
void setValue(const StateCost& cost, const Hessian& h, const Products& m, const Value& next,
              const Feedback& f, Value& value) {
  const Pack weight_rows[4] = {
      Pack{cost.weight_q[0], 0.0, 0.0, 0.0}, Pack{0.0, cost.weight_q[1], 0.0, 0.0},
      Pack{0.0, 0.0, cost.weight_q[2], 0.0}, Pack{0.0, 0.0, 0.0, cost.weight_q[3]}};
  for (int i = 0; i < 4; ++i) {
    value.qq[i] = weight_rows[i] + h.qq[i] - f.g_q[0][i] * f.k_q[0] - f.g_q[1][i] * f.k_q[1];
  }
  for (int i = 0; i < 2; ++i) {
    value.pq[i] = m.a[i] - f.g_p[0][i] * f.k_q[0] - f.g_p[1][i] * f.k_q[1];
    for (int j = 0; j < 2; ++j) {
      value.pp[i][j] = next.pp[i][j] - f.g_p[0][i] * f.k_p[0][j] - f.g_p[1][i] * f.k_p[1][j];
    }
    value.pp[i][i] += cost.weight_p[i];
    value.p_p[i] =
        cost.gradient_p[i] + m.bc[i][2] - f.g_p[0][i] * f.k_0[0] - f.g_p[1][i] * f.k_0[1];
  }
  const Pack gradient = {h.q_bc[0][2], h.q_bc[1][2], h.q_bc[2][2], h.q_bc[3][2]};
  value.p_q = cost.gradient_q + gradient - f.k_0[0] * f.g_q[0] - f.k_0[1] * f.g_q[1];
}

}  // namespace

void terminalValue(const StateCost& cost, Value& value) {
  for (int i = 0; i < 4; ++i) {
    value.qq[i] = Pack{};
    value.qq[i][i] = cost.weight_q[i];
  }
  for (int i = 0; i < 2; ++i) {
    value.pq[i] = Pack{};
    value.pp[i][i] = cost.weight_p[i];
    value.pp[i][1 - i] = 0.0;
    value.p_p[i] = cost.gradient_p[i];
  }
  value.p_q = cost.gradient_q;
}

bool riccatiStep(const Stage& stage, const StateCost& state, const InputCost& input,
                 const Hold (&hold)[2], const double (&held)[2], const Value& next, Value& value,
                 Feedback& f) {
  const Products m = multiply(stage, next);
  const Hessian h = project(stage, m);
  for (int i = 0; i < 2; ++i) {
    f.g_q[i] = h.u_q[i];
    f.h[i] = h.u_bc[i][2] + input.gradient[i];
    for (int j = 0; j < 2; ++j) {
      f.g_p[i][j] = m.bc[j][i];
      f.hessian[i][j] = h.u_bc[i][j] + (i == j ? input.weight[i] : 0.0);
    }
  }
  f.pc_q = Pack{m.bc[2][2], m.bc[3][2], m.bc[4][2], m.bc[5][2]} - next.p_q;
  f.pc_p[0] = m.bc[0][2] - next.p_p[0];
  f.pc_p[1] = m.bc[1][2] - next.p_p[1];
  const bool definite = invertFree(f.hessian, hold, f.inverse);
  setGains(hold, held, f);
  setValue(state, h, m, next, f, value);
  return definite;
}

void updateGradient(const Stage& s, const StateCost& state, const InputCost& input,
                    const Value& next, Value& value, Feedback& f) {
  const Pack q = next.p_q + f.pc_q;
  const double g[6] = {next.p_p[0] + f.pc_p[0], next.p_p[1] + f.pc_p[1], q[0], q[1], q[2], q[3]};
  const auto [back, input_part] = throughStage(s, g);
  for (int i = 0; i < 2; ++i) {
    f.h[i] = input_part[i] + input.gradient[i];
  }
  for (int i = 0; i < 2; ++i) {
    f.k_0[i] = f.inverse[i][0] * f.h[0] + f.inverse[i][1] * f.h[1];
  }
  for (int i = 0; i < 2; ++i) {
    value.p_p[i] = state.gradient_p[i] + g[i] - f.g_p[0][i] * f.k_0[0] - f.g_p[1][i] * f.k_0[1];
  }
  value.p_q = state.gradient_q + back - f.k_0[0] * f.g_q[0] - f.k_0[1] * f.g_q[1];
}

void applyFeedback(const Feedback& f, const double (&dx)[6], double (&du)[2]) {
  for (int i = 0; i < 2; ++i) {
    const double from_q =
        f.k_q[i][0] * dx[2] + f.k_q[i][1] * dx[3] + f.k_q[i][2] * dx[4] + f.k_q[i][3] * dx[5];
    du[i] = -(f.k_0[i] + f.k_p[i][0] * dx[0] + f.k_p[i][1] * dx[1] + from_q);
  }
}

void advance(const Stage& stage, const double (&dx)[6], const double (&du)[2],
             double (&dx_next)[6]) {
  for (int row = 0; row < 6; ++row) {
    const Pack& a = stage.a[row];
    const Pack& bc = stage.bc[row];
    const double held = row < 2 ? dx[row] : 0.0;
    dx_next[row] = (held + bc[2] + a[0] * dx[2] + a[1] * dx[3]) + (a[2] * dx[4] + a[3] * dx[5]) +
                   (bc[0] * du[0] + bc[1] * du[1]);
  }
}

}  // namespace otter_nav::tracker::qp
