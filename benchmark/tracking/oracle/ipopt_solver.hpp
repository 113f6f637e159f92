// The tracker's optimal control problem solved to convergence by Ipopt: the oracle of the tests and
// the yardstick of nmpc_benchmark. Discretised and differentiated apart from the tracker's own
// kernels (vessel/model.hpp and base/rk4.hpp), so that a mistake in either shows.
#pragma once

#include <memory>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/vessel/model.hpp"
#include "tracker/ocp/problem.hpp"

namespace otter_nav::tracker {

struct IpoptSolution {
  std::vector<vessel::State> states;     // N + 1
  std::vector<vessel::Thrusts> thrusts;  // N
  int iterations = 0;
};

class IpoptSolver {
 public:
  IpoptSolver(const OcpOptions& options, const vessel::ManoeuvringModel& model,
              const vessel::Thrusters& thrusters);
  ~IpoptSolver();
  IpoptSolver(IpoptSolver&&) noexcept;

  // From the reference, or from `warm` if it isn't null. The Hessian is Gauss and Newton's. Errors
  // carry Ipopt's return code.
  [[nodiscard]] Result<IpoptSolution> solve(const vessel::State& measured,
                                            const OcpReference& reference,
                                            const vessel::Disturbance& disturbance,
                                            const IpoptSolution* warm = nullptr);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace otter_nav::tracker
