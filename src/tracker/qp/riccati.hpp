// The Riccati recursion of the tracker's quadratic problem, written out for its shape: six states
// of which x and y feed nothing back, two thrusters, every matrix a few rows of one Pack.
//
//   min  sum 1/2 dx'Q dx + q'dx + 1/2 du'R du + r'du   s.t.  dx+ = A dx + B du + c
//
// A thruster of a stage is free or held at a value; held ones leave the minimisation, so that one
// recursion serves every strategy for the bounds.
#pragma once

#include "tracker/qp/pack.hpp"

namespace otter_nav::tracker::qp {

// dx+ = A dx + B du + c. The columns of A for x and y are the identity's, so only those for psi, u,
// v, r are kept, row by row.
struct alignas(32) Stage {
  Pack a[6];   // columns psi, u, v, r
  Pack bc[6];  // columns F_left, F_right, c, 0
};

// 1/2 dx'P dx + p'dx, split into (x, y) and q = (psi, u, v, r).
struct alignas(32) Value {
  Pack qq[4];
  Pack pq[2];
  Pack p_q;
  double pp[2][2];
  double p_p[2];
};

// Cost of a stage's state: Q is diagonal.
struct alignas(32) StateCost {
  Pack weight_q;
  Pack gradient_q;
  double weight_p[2];
  double gradient_p[2];
};

struct InputCost {
  double weight[2];
  double gradient[2];
};

enum class Hold : unsigned char { kFree, kLower, kUpper };

// du = -K dx - k for the free thrusters, and the stage's Hessian rows for the multipliers of held
// ones: gradient_i = hessian_i du + g_i dx + h_i.
struct alignas(32) Feedback {
  Pack k_q[2];
  Pack g_q[2];
  double k_p[2][2];
  double g_p[2][2];
  double k_0[2];
  double h[2];
  double hessian[2][2];
  double inverse[2][2];  // of the free part
  Pack pc_q;             // P c of the next value, for updateGradient()
  double pc_p[2];
};

// What a slope `g` by the next stage's state is by this one's (psi, u, v, r; x and y keep theirs),
// and by the columns of bc: A'g and bc'g.
struct Backward {
  Pack state;
  Pack input;
};
[[nodiscard]] inline Backward throughStage(const Stage& stage, const double (&g)[6]) {
  Backward back{g[0] * stage.a[0], g[0] * stage.bc[0]};
  for (int row = 1; row < 6; ++row) {
    back.state += g[row] * stage.a[row];
    back.input += g[row] * stage.bc[row];
  }
  return back;
}

// V(dx) at the end of the horizon.
void terminalValue(const StateCost& cost, Value& value);

// One stage backwards. `held` is du of the thrusters that aren't free. False when the free part of
// the Hessian is not positive definite (or not finite).
[[nodiscard]] bool riccatiStep(const Stage& stage, const StateCost& state, const InputCost& input,
                               const Hold (&hold)[2], const double (&held)[2], const Value& next,
                               Value& value, Feedback& feedback);

// The part of riccatiStep() that changes with input.gradient and next's gradient only.
void updateGradient(const Stage& stage, const StateCost& state, const InputCost& input,
                    const Value& next, Value& value, Feedback& feedback);

// du of the stage at dx.
void applyFeedback(const Feedback& feedback, const double (&dx)[6], double (&du)[2]);
// dx of the next stage.
void advance(const Stage& stage, const double (&dx)[6], const double (&du)[2],
             double (&dx_next)[6]);

}  // namespace otter_nav::tracker::qp
