#include "optimizer/objective/spline_problem.hpp"

#include <algorithm>

#include "optimizer/objective/clearance_cost.hpp"
#include "optimizer/objective/limit_costs.hpp"
#include "optimizer/objective/travel_costs.hpp"
#include "otter_nav/trajectory/polynomial/quadrature.hpp"

namespace otter_nav::optimizer {
namespace {

// Of both thrusters' force: |w| below this is treated as this.
constexpr double kForceFloorShare = 0.03;
constexpr double kReach = 1.0;      // an end moved by its reach counts as this
constexpr double kEvenness = 0.02;  // of squared seconds that neighbours differ by

// Pieces last about as long as their neighbours.
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

// Of a symmetric matrix whose lower triangle is known.
template <typename Lower>
auto whole(const Lower& lower) {
  return typename Lower::PlainObject(lower.template selfadjointView<Eigen::Lower>());
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

// Ends that move with their manoeuvres.
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

SplineProblem::SplineProblem(const vessel::Parameters& vessel)
    : vessel_(vessel),
      dynamics_(vessel),
      force_floor_n_(2.0 * kForceFloorShare * vessel.thrusters.ahead_max_n) {
  for (std::size_t i = 0; i < lobatto_.size(); ++i) {
    lobatto_[i] = trajectory::septicBasis(trajectory::kLobatto.at[i]);
  }
  const auto fill = [](auto& inside) {
    for (std::size_t i = 0; i < inside.size(); ++i) {
      inside[i] = trajectory::septicBasis((static_cast<double>(i) + 0.5) /
                                          static_cast<double>(inside.size()));
    }
  };
  fill(between_);
  fill(dense_);
  // A cost or constraint is a class of this folder and a line here.
  const double force_n = vessel.thrusters.ahead_max_n;
  costs_.push_back(std::make_unique<TimeCost>());
  costs_.push_back(std::make_unique<SmoothnessCost>());
  costs_.push_back(std::make_unique<LengthCost>());
  costs_.push_back(std::make_unique<OriginalCost>());
  costs_.push_back(std::make_unique<ThrustLimit>(vessel.thrusters));
  costs_.push_back(std::make_unique<YawRateLimit>());
  costs_.push_back(std::make_unique<SpeedLimit>());
  costs_.push_back(std::make_unique<HeadingForceLimit>(force_n));
  between_costs_.push_back(std::make_unique<ClearanceCost>());
}

void SplineProblem::addPiece(PieceModel& piece) const {
  const auto add = [&](const auto& costs, const trajectory::SepticBasis& basis, std::size_t number,
                       double at, double share) {
    Point point(basis, number, at, share, dynamics_, force_floor_n_, piece);
    for (const std::unique_ptr<Cost>& cost : costs) {
      cost->add(targets, point);
    }
  };
  for (std::size_t i = 0; i < lobatto_.size(); ++i) {
    add(costs_, lobatto_[i], i, trajectory::kLobatto.at[i], trajectory::kLobatto.weight[i]);
  }
  const bool meets = mayMeetMoving(piece);
  piece.obstacles = targets.still != nullptr && !meets ? targets.still : targets.obstacles;
  const auto add_inside = [&](const auto& inside) {
    const auto count = static_cast<double>(inside.size());
    for (std::size_t i = 0; i < inside.size(); ++i) {
      add(between_costs_, inside[i], i, (static_cast<double>(i) + 0.5) / count, 1.0 / count);
    }
  };
  if (meets) {
    add_inside(dense_);  // both move: between the usual points they pass each other unseen
  } else {
    add_inside(between_);
  }
}

// By how far both may get from where they are at the piece's beginning.
bool SplineProblem::mayMeetMoving(const PieceModel& piece) const {
  constexpr double kDetour = 1.5;  // of a piece, on what its ends and their speeds say
  if (targets.still == nullptr) {
    return false;
  }
  const Eigen::Vector2d from = piece.ends.col(0);
  const double sailed = std::max({piece.duration_s * piece.ends.col(1).norm(),
                                  piece.duration_s * piece.ends.col(5).norm(),
                                  (piece.ends.col(4) - piece.ends.col(0)).norm()});
  const double moved = targets.obstacles->rateBound() * piece.duration_s * piece.clock;
  return targets.obstacles->movingClearance(from, piece.start_s) <=
         targets.limits.reach_m() + kDetour * sailed + moved;
}

double SplineProblem::evaluate(const Spline& spline, System* system) const {
  PieceModel piece;
  piece.wanted = system != nullptr;
  piece.start_s = targets.start_s;
  piece.clock = targets.clock;
  if (system != nullptr) {
    system->reset(spline.knots.size());
  }
  for (std::size_t i = 0; i < spline.spans.size(); ++i) {
    piece.index = i;
    piece.ends << spline.knots[i].state, spline.knots[i + 1].state;
    piece.duration_s = spline.spans[i].duration_s;
    piece.gradient.setZero();
    piece.hessian.setZero();
    addPiece(piece);
    piece.start_s += piece.duration_s * piece.clock;
    if (system == nullptr) {
      continue;
    }
    system->diagonal[i] += whole(piece.hessian.topLeftCorner<9, 9>());
    system->diagonal[i + 1].topLeftCorner<8, 8>() += whole(piece.hessian.bottomRightCorner<8, 8>());
    system->below[i].topRows<8>() += piece.hessian.bottomLeftCorner<8, 9>();
    system->right[i] -= piece.gradient.head<9>();
    system->right[i + 1].head<8>() -= piece.gradient.tail<8>();
  }
  addEvenness(spline, piece.cost, system);
  addFamilies(spline, targets.weights.time, piece.cost, system);
  if (system != nullptr) {
    pinAll(spline, *system);
  }
  return piece.cost;
}

void SplineProblem::apply(const std::vector<System::Vector>& step, double scale, Spline& spline) {
  for (std::size_t k = 0; k < spline.knots.size(); ++k) {
    Knot& knot = spline.knots[k];
    Eigen::Matrix<double, 8, 1> change = scale * step[k].head<8>();
    if (knot.family) {
      knot.family->moved += scale * step[k].head<2>();
      change = knot.family->state * (scale * step[k].head<2>());
    }
    for (int m = 0; m < 4; ++m) {
      knot.state.col(m) += change.segment<2>(2 * m);
    }
    if (k < spline.spans.size()) {
      double& duration = spline.spans[k].duration_s;
      duration = std::clamp(duration + scale * step[k][8], 0.6 * duration, 1.6 * duration);
    }
  }
}

}  // namespace otter_nav::optimizer
