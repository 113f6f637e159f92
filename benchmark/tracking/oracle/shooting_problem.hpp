// The optimal control problem as Ipopt wants it. Variables: x_0 .. x_N, then F_0 .. F_{N-1};
// constraints: x_{k+1} - RK4(x_k, F_k) = 0; x_0 is fixed by its bounds.
#pragma once

#include <IpTNLP.hpp>

#include "tracking/oracle/ipopt_solver.hpp"

namespace otter_nav::tracker {

class ShootingProblem : public Ipopt::TNLP {
 public:
  using Index = Ipopt::Index;
  using Number = Ipopt::Number;

  ShootingProblem(const OcpOptions& options, const vessel::ManoeuvringModel& model,
                  const vessel::Thrusters& thrusters);

  void set(const vessel::State& measured, const OcpReference& reference,
           const vessel::Disturbance& disturbance, const IpoptSolution* warm);
  [[nodiscard]] const IpoptSolution& solution() const { return solution_; }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian_entries, Index& hessian_entries,
                    IndexStyleEnum& style) override;
  bool get_bounds_info(Index n, Number* lower, Number* upper, Index m, Number* g_lower,
                       Number* g_upper) override;
  bool get_starting_point(Index n, bool init_x, Number* x, bool init_z, Number* z_lower,
                          Number* z_upper, Index m, bool init_lambda, Number* lambda) override;
  bool eval_f(Index n, const Number* x, bool fresh, Number& value) override;
  bool eval_grad_f(Index n, const Number* x, bool fresh, Number* gradient) override;
  bool eval_g(Index n, const Number* x, bool fresh, Index m, Number* g) override;
  bool eval_jac_g(Index n, const Number* x, bool fresh, Index m, Index entries, Index* rows,
                  Index* columns, Number* values) override;
  bool eval_h(Index n, const Number* x, bool fresh, Number factor, Index m, const Number* lambda,
              bool fresh_lambda, Index entries, Index* rows, Index* columns,
              Number* values) override;
  void finalize_solution(Ipopt::SolverReturn status, Index n, const Number* x,
                         const Number* z_lower, const Number* z_upper, Index m, const Number* g,
                         const Number* lambda, Number value, const Ipopt::IpoptData* data,
                         Ipopt::IpoptCalculatedQuantities* quantities) override;

 private:
  // RK4 and its Jacobians with respect to state and thrusts.
  struct Step {
    vessel::State end;
    vessel::StateJacobian by_state;
    vessel::InputJacobian by_thrusts;
  };
  [[nodiscard]] Step step(const vessel::State& x, const vessel::Thrusts& thrusts) const;
  [[nodiscard]] vessel::State stateAt(const Number* x, int k) const;
  [[nodiscard]] vessel::Thrusts thrustsAt(const Number* x, int k) const;
  [[nodiscard]] Index thrustIndex(int k) const { return 6 * (options_.stages + 1) + 2 * k; }
  [[nodiscard]] vessel::State weight(int k) const;

  OcpOptions options_;
  vessel::ManoeuvringModel model_;
  vessel::Thrusters thrusters_;
  vessel::Disturbance disturbance_;
  vessel::State measured_;
  OcpReference reference_;
  const IpoptSolution* warm_ = nullptr;
  IpoptSolution solution_;
};

}  // namespace otter_nav::tracker
