#include "solver.hpp"

#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>
#include <cmath>
#include <string>
#include <vector>

namespace otter_nav::identification {
namespace {

using Ipopt::Index;
using Ipopt::Number;
using vessel::kStateSize;

// The problem as Ipopt sees it: variables divided by their scales, cost per residual, no
// constraints but the bounds, and the arrow-shaped Gauss-Newton Hessian J^T J (a dense block of
// the shared variables, a border and a 6 by 6 block per window).
class LeastSquares : public Ipopt::TNLP {
 public:
  LeastSquares(const Problem& problem, const Eigen::VectorXd& start)
      : problem_(problem),
        shared_(problem.sharedCount()),
        scale_(scales(problem)),
        start_(start.cwiseQuotient(scale_)),
        per_residual_(1.0 / static_cast<double>(problem.residualCount())),
        terms_(problem.windowCount()) {}

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac_g, Index& nnz_h_lag,
                    IndexStyleEnum& index_style) override {
    n = problem_.variableCount();
    m = 0;
    nnz_jac_g = 0;
    const int local = problem_.windowVariables();
    nnz_h_lag = triangle(shared_) +
                static_cast<int>(problem_.windowCount()) * (local * shared_ + triangle(local));
    index_style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* lower, Number* upper, Index /*m*/, Number* /*g_l*/,
                       Number* /*g_u*/) override {
    for (Index i = 0; i < n; ++i) {
      lower[i] = -kUnbounded;
      upper[i] = kUnbounded;
    }
    for (int i = 0; i < shared_; ++i) {
      const Parameter& p = problem_.shared()[static_cast<std::size_t>(i)];
      lower[i] = p.lower / scale_[i];
      upper[i] = p.upper / scale_[i];
    }
    return true;
  }

  bool get_starting_point(Index n, bool /*init_x*/, Number* x, bool /*init_z*/, Number* /*z_l*/,
                          Number* /*z_u*/, Index /*m*/, bool /*init_lambda*/,
                          Number* /*lambda*/) override {
    Eigen::Map<Eigen::VectorXd>(x, n) = start_;
    return true;
  }

  bool eval_f(Index n, const Number* x, bool /*new_x*/, Number& value) override {
    const Eigen::VectorXd variables = unscaled(x, n);
    value = problem_.priorCost(variables);
    for (std::size_t w = 0; w < problem_.windowCount(); ++w) {
      value += problem_.evaluateWindow(w, variables, nullptr);
    }
    value *= per_residual_;
    return std::isfinite(value);
  }

  bool eval_grad_f(Index n, const Number* x, bool /*new_x*/, Number* gradient) override {
    const Eigen::VectorXd variables = update(x, n);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(n);
    g.head(shared_) = problem_.priorGradient(variables);
    const int local = problem_.windowVariables();
    for (std::size_t w = 0; w < terms_.size(); ++w) {
      g.head(shared_) += terms_[w].gradient.head(shared_);
      g.segment(shared_ + local * static_cast<int>(w), local) += terms_[w].gradient.tail(local);
    }
    Eigen::Map<Eigen::VectorXd>(gradient, n) = per_residual_ * g.cwiseProduct(scale_);
    return g.allFinite();
  }

  bool eval_g(Index /*n*/, const Number* /*x*/, bool /*new_x*/, Index /*m*/,
              Number* /*g*/) override {
    return true;
  }

  bool eval_jac_g(Index /*n*/, const Number* /*x*/, bool /*new_x*/, Index /*m*/, Index /*nele*/,
                  Index* /*rows*/, Index* /*columns*/, Number* /*values*/) override {
    return true;
  }

  bool eval_h(Index n, const Number* x, bool /*new_x*/, Number factor, Index /*m*/,
              const Number* /*lambda*/, bool /*new_lambda*/, Index /*nele*/, Index* rows,
              Index* columns, Number* values) override {
    if (values == nullptr) {
      eachEntry([&](int k, int row, int column, double /*value*/) {
        rows[k] = row;
        columns[k] = column;
      });
      return true;
    }
    update(x, n);
    eachEntry([&](int k, int row, int column, double value) {
      values[k] = factor * per_residual_ * scale_[row] * scale_[column] * value;
    });
    return true;
  }

  void finalize_solution(Ipopt::SolverReturn /*status*/, Index n, const Number* x,
                         const Number* /*z_l*/, const Number* /*z_u*/, Index /*m*/,
                         const Number* /*g*/, const Number* /*lambda*/, Number value,
                         const Ipopt::IpoptData* /*data*/,
                         Ipopt::IpoptCalculatedQuantities* /*quantities*/) override {
    solution_.variables = unscaled(x, n);
    solution_.cost = value / per_residual_;
  }

  [[nodiscard]] const Solution& solution() const { return solution_; }

 private:
  static constexpr double kUnbounded = 2e19;  // Ipopt's infinity

  static int triangle(int n) { return n * (n + 1) / 2; }

  static Eigen::VectorXd scales(const Problem& problem) {
    Eigen::VectorXd scale(problem.variableCount());
    for (int i = 0; i < problem.sharedCount(); ++i) {
      scale[i] = problem.shared()[static_cast<std::size_t>(i)].scale;
    }
    for (int i = problem.sharedCount(); i < problem.variableCount(); i += kStateSize) {
      scale.segment<kStateSize>(i) = problem.initialDeviation();
    }
    return scale;
  }

  Eigen::VectorXd unscaled(const Number* x, Index n) const {
    return Eigen::Map<const Eigen::VectorXd>(x, n).cwiseProduct(scale_);
  }

  // The windows' derivatives at x; kept, since gradient and Hessian ask for the same point.
  Eigen::VectorXd update(const Number* x, Index n) {
    Eigen::VectorXd variables = unscaled(x, n);
    if (point_.size() != n || point_ != variables) {
      for (std::size_t w = 0; w < terms_.size(); ++w) {
        problem_.evaluateWindow(w, variables, &terms_[w]);
      }
      point_ = variables;
    }
    return variables;
  }

  // Calls visit(k, row, column, value) for the lower triangle's entries, in a fixed order. The
  // values are those of the last update().
  template <typename Visitor>
  void eachEntry(Visitor visit) const {
    const int local = problem_.windowVariables();
    Eigen::MatrixXd block = problem_.priorHessian().asDiagonal();
    for (const WindowTerms& t : terms_) {
      if (t.hessian.size() > 0) {
        block += t.hessian.topLeftCorner(shared_, shared_);
      }
    }
    int k = 0;
    for (int i = 0; i < shared_; ++i) {
      for (int j = 0; j <= i; ++j) {
        visit(k++, i, j, block(i, j));
      }
    }
    for (std::size_t w = 0; w < terms_.size(); ++w) {
      const Eigen::MatrixXd& h = terms_[w].hessian;
      const int first = shared_ + local * static_cast<int>(w);
      for (int i = 0; i < local; ++i) {
        for (int j = 0; j < shared_ + i + 1; ++j) {
          const int column = j < shared_ ? j : first + j - shared_;
          visit(k++, first + i, column, h.size() > 0 ? h(shared_ + i, j) : 0.0);
        }
      }
    }
  }

  const Problem& problem_;
  int shared_;
  Eigen::VectorXd scale_;
  Eigen::VectorXd start_;
  double per_residual_;
  std::vector<WindowTerms> terms_;
  Eigen::VectorXd point_;
  Solution solution_;
};

std::string reasonOf(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Maximum_Iterations_Exceeded:
      return "no convergence within max_iterations";
    case Ipopt::Invalid_Number_Detected:
      return "a rollout left the finite numbers";
    case Ipopt::Search_Direction_Becomes_Too_Small:
    case Ipopt::Restoration_Failed:
      return "no step lowers the cost any more";
    default:
      return "Ipopt ended with status " + std::to_string(static_cast<int>(status));
  }
}

}  // namespace

Result<Solution> solve(const Problem& problem, const Eigen::VectorXd& start,
                       const SolverOptions& options) {
  const Ipopt::SmartPtr<LeastSquares> nlp = new LeastSquares(problem, start);
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt = IpoptApplicationFactory();
  ipopt->Options()->SetIntegerValue("print_level", 0);
  ipopt->Options()->SetStringValue("sb", "yes");
  ipopt->Options()->SetIntegerValue("max_iter", options.max_iterations);
  ipopt->Options()->SetNumericValue("tol", options.tolerance);
  ipopt->Options()->SetStringValue("nlp_scaling_method", "none");
  // The start lies well inside the bounds: a barrier as low as the optimum needs.
  ipopt->Options()->SetNumericValue("mu_init", 1e-4);
  ipopt->Options()->SetNumericValue("bound_relax_factor", 0.0);
  if (ipopt->Initialize() != Ipopt::Solve_Succeeded) {
    return failure("Ipopt cannot be set up");
  }
  const Ipopt::ApplicationReturnStatus status = ipopt->OptimizeTNLP(nlp);
  if (status != Ipopt::Solve_Succeeded && status != Ipopt::Solved_To_Acceptable_Level) {
    return failure("the fit did not succeed: " + reasonOf(status));
  }
  Solution solution = nlp->solution();
  solution.iterations = ipopt->Statistics()->IterationCount();
  return solution;
}

}  // namespace otter_nav::identification
