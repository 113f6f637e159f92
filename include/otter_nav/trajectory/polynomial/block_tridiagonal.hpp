// A symmetric positive definite block-tridiagonal system, solved by Cholesky's method in time
// linear in the number of blocks. Its storage grows once and is reused, or is given by `Capacity`
// and never allocates. Right-hand sides have `Columns`.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace otter_nav::trajectory {

template <int Size, int Columns = 1, std::size_t Capacity = 0>
class BlockTridiagonal {
 public:
  using Block = Eigen::Matrix<double, Size, Size>;
  using Vector = Eigen::Matrix<double, Size, Columns>;
  template <typename Item>
  using Storage = std::conditional_t<Capacity == 0, std::vector<Item>, std::array<Item, Capacity>>;

  // `blocks` zero blocks on the diagonal, one less below it, and as many right-hand sides.
  void reset(std::size_t blocks) {
    blocks_ = blocks;
    if constexpr (Capacity == 0) {
      diagonal.resize(blocks);
      below.resize(blocks);
      right.resize(blocks);
      factor_.resize(blocks);
      coupling_.resize(blocks);
      solution_.resize(blocks);
    }
    for (std::size_t k = 0; k < blocks; ++k) {
      diagonal[k].setZero();
      below[k].setZero();
      right[k].setZero();
    }
  }

  // Solves with `damping` times the diagonal (and `floor`) added to it; false if the matrix is not
  // positive definite. solution() then holds the result.
  [[nodiscard]] bool solve(double damping, double floor) {
    const std::size_t n = blocks_;
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

  [[nodiscard]] const Storage<Vector>& solution() const { return solution_; }

  Storage<Block> diagonal;
  Storage<Block> below;  // below[k] is the block of row k + 1 and column k; the last is unused
  Storage<Vector> right;

 private:
  std::size_t blocks_ = 0;
  Storage<Eigen::LLT<Block>> factor_;
  Storage<Block> coupling_;  // below[k] times the inverse transpose of the factor
  Storage<Vector> solution_;
};

}  // namespace otter_nav::trajectory
