#include "tracking/oracle/ipopt_solver.hpp"

#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <string>

#include "tracking/oracle/shooting_problem.hpp"

namespace otter_nav::tracker {

class IpoptSolver::Impl {
 public:
  Impl(const OcpOptions& options, const vessel::ManoeuvringModel& model,
       const vessel::Thrusters& thrusters)
      : problem_(new ShootingProblem(options, model, thrusters)),
        application_(IpoptApplicationFactory()) {
    const auto& set = application_->Options();
    set->SetIntegerValue("print_level", 0);
    set->SetStringValue("sb", "yes");
    set->SetNumericValue("tol", 1e-12);
    set->SetNumericValue("dual_inf_tol", 1e-10);
    set->SetNumericValue("compl_inf_tol", 1e-11);
    set->SetNumericValue("acceptable_tol", 1e-9);
    set->SetNumericValue("bound_relax_factor", 0.0);
    set->SetStringValue("nlp_scaling_method", "none");
    set->SetIntegerValue("max_iter", 500);
    initialized_ = application_->Initialize() == Ipopt::Solve_Succeeded;
  }

  Result<IpoptSolution> solve(const vessel::State& measured, const OcpReference& reference,
                              const vessel::Disturbance& disturbance, const IpoptSolution* warm) {
    if (!initialized_) {
      return failure("Ipopt does not initialise");
    }
    problem_->set(measured, reference, disturbance, warm);
    const auto status =
        application_->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(Ipopt::GetRawPtr(problem_)));
    if (status != Ipopt::Solve_Succeeded && status != Ipopt::Solved_To_Acceptable_Level) {
      return failure("Ipopt returns " + std::to_string(static_cast<int>(status)));
    }
    IpoptSolution solution = problem_->solution();
    solution.iterations = application_->Statistics()->IterationCount();
    return solution;
  }

 private:
  Ipopt::SmartPtr<ShootingProblem> problem_;
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application_;
  bool initialized_ = false;
};

IpoptSolver::IpoptSolver(const OcpOptions& options, const vessel::ManoeuvringModel& model,
                         const vessel::Thrusters& thrusters)
    : impl_(std::make_unique<Impl>(options, model, thrusters)) {}
IpoptSolver::~IpoptSolver() = default;
IpoptSolver::IpoptSolver(IpoptSolver&&) noexcept = default;

Result<IpoptSolution> IpoptSolver::solve(const vessel::State& measured,
                                         const OcpReference& reference,
                                         const vessel::Disturbance& disturbance,
                                         const IpoptSolution* warm) {
  return impl_->solve(measured, reference, disturbance, warm);
}

}  // namespace otter_nav::tracker
