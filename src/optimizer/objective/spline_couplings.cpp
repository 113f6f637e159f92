#include "optimizer/objective/spline_couplings.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kReach = 1.0;      // an end moved by its reach counts as this
constexpr double kEvenness = 0.02;  // of squared seconds that neighbours differ by

void addEvenness(const Spline& spline, double& cost, System* system) {
  for (std::size_t i = 0; i + 1 < spline.spans.size(); ++i) {
    const Span& a = spline.spans[i];
    const Span& b = spline.spans[i + 1];
    if (!a.duration_free || !b.duration_free) {
      continue;
    }
    const double off = a.duration_s - b.duration_s;
    cost += kEvenness * off * off;
    if (system != nullptr) {
      system->right[i][8] -= 2.0 * kEvenness * off;
      system->right[i + 1][8] += 2.0 * kEvenness * off;
      system->diagonal[i](8, 8) += 2.0 * kEvenness;
      system->diagonal[i + 1](8, 8) += 2.0 * kEvenness;
      system->below[i](8, 8) -= 2.0 * kEvenness;
    }
  }
}

// What is not free does not move.
void pin(System& system, std::size_t block, int row) {
  system.diagonal[block].row(row).setZero();
  system.diagonal[block].col(row).setZero();
  system.diagonal[block](row, row) = 1.0;
  system.right[block][row] = 0.0;
  system.below[block].col(row).setZero();
  if (block > 0) {
    system.below[block - 1].row(row).setZero();
  }
}

// An end that moves with its manoeuvre: two unknowns take the place of its state's eight.
void guide(const EndFamily& family, std::size_t k, System& system) {
  System::Block map = System::Block::Zero();
  map.topLeftCorner<8, 2>() = family.state;
  map(8, 8) = 1.0;
  system.diagonal[k] = (map.transpose() * system.diagonal[k] * map).eval();
  system.right[k] = (map.transpose() * system.right[k]).eval();
  system.below[k] = (system.below[k] * map).eval();
  if (k > 0) {
    system.below[k - 1] = (map.transpose() * system.below[k - 1]).eval();
  }
}

void addFamilies(const Spline& spline, double time_weight, double& cost, System* system) {
  for (std::size_t k = 0; k < spline.knots.size(); ++k) {
    if (!spline.knots[k].family) {
      continue;
    }
    const EndFamily& family = *spline.knots[k].family;
    const Eigen::Vector2d stretch = family.moved.cwiseQuotient(family.reach);
    cost += time_weight * family.duration_s.dot(family.moved) + kReach * stretch.squaredNorm();
    if (system != nullptr) {
      guide(family, k, *system);
      system->right[k].head<2>() -=
          time_weight * family.duration_s + 2.0 * kReach * stretch.cwiseQuotient(family.reach);
      system->diagonal[k].diagonal().head<2>() +=
          2.0 * kReach * family.reach.cwiseAbs2().cwiseInverse();
    }
  }
}

void pinAll(const Spline& spline, System& system) {
  for (std::size_t k = 0; k < spline.knots.size(); ++k) {
    const Knot& knot = spline.knots[k];
    for (int row = knot.family ? 2 : 0; row < 8 && !knot.free; ++row) {
      pin(system, k, row);
    }
    if (k == spline.spans.size() || !spline.spans[k].duration_free) {
      pin(system, k, 8);
    }
  }
}

}  // namespace

double addCouplings(const Spline& spline, double time_weight, System* system) {
  double cost = 0.0;
  addEvenness(spline, cost, system);
  addFamilies(spline, time_weight, cost, system);
  if (system != nullptr) {
    pinAll(spline, *system);
  }
  return cost;
}

}  // namespace otter_nav::optimizer
