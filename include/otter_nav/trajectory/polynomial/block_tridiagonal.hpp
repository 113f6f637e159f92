// A symmetric positive definite block-tridiagonal system, solved by Cholesky's method in time
// linear in the number of blocks. Its storage grows once and is reused.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace otter_nav::trajectory {

template <int Size>
class BlockTridiagonal {
 public:
  using Block = Eigen::Matrix<double, Size, Size>;
  using Vector = Eigen::Matrix<double, Size, 1>;

  // `blocks` zero blocks on the diagonal, one less below it, and as many right-hand sides.
  void reset(std::size_t blocks) {
    diagonal.assign(blocks, Block::Zero());
    below.assign(blocks, Block::Zero());
    right.assign(blocks, Vector::Zero());
    factor_.resize(blocks);
    coupling_.resize(blocks);
    solution_.resize(blocks);
  }

  // Solves with `damping` times the diagonal (and `floor`) added to it; false if the matrix is not
  // positive definite. solution() then holds the result.
  [[nodiscard]] bool solve(double damping, double floor) {
    const std::size_t n = diagonal.size();
    for (std::size_t k = 0; k < n; ++k) {
      Block pivot = diagonal[k];
      pivot.diagonal() += (damping * diagonal[k].diagonal()).array().max(floor).matrix();
      Vector rhs = right[k];
      if (k > 0) {
        pivot.noalias() -= coupling_[k - 1] * coupling_[k - 1].transpose();
        rhs.noalias() -= coupling_[k - 1] * solution_[k - 1];
      }
      factor_[k].compute(pivot);
      if (factor_[k].info() != Eigen::Success) {
        return false;
      }
      solution_[k] = factor_[k].matrixL().solve(rhs);
      if (k + 1 < n) {
        coupling_[k] = factor_[k].matrixL().solve(below[k].transpose()).transpose();
      }
    }
    for (std::size_t k = n; k-- > 0;) {
      if (k + 1 < n) {
        solution_[k].noalias() -= coupling_[k].transpose() * solution_[k + 1];
      }
      factor_[k].matrixU().solveInPlace(solution_[k]);
    }
    return true;
  }

  [[nodiscard]] const std::vector<Vector>& solution() const { return solution_; }

  std::vector<Block> diagonal;
  std::vector<Block> below;  // below[k] is the block of row k + 1 and column k; the last is unused
  std::vector<Vector> right;

 private:
  std::vector<Eigen::LLT<Block>> factor_;
  std::vector<Block> coupling_;  // below[k] times the inverse transpose of the factor
  std::vector<Vector> solution_;
};

}  // namespace otter_nav::trajectory
