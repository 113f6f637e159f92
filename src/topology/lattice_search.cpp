#include "topology/lattice_search.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::topology {
namespace {

// The heap's order: nearer first, then the lower number, so that ties fall alike everywhere.
struct Farther {
  template <typename Open>
  bool operator()(const Open& a, const Open& b) const {
    return a.total != b.total ? a.total > b.total : a.node > b.node;
  }
};

}  // namespace

void LatticeSearch::begin(const map::DistanceField& field, const LatticeQuery& query) {
  field_ = &field;
  query_ = query;
  const map::GridGeometry& g = field.geometry();
  columns_ = (g.width + query.block - 1) / query.block;
  rows_ = (g.height + query.block - 1) / query.block;
  start_ = columns_ * rows_;
  goal_ = start_ + 1;
  const auto count = static_cast<std::size_t>(goal_) + 1;
  if (slots_.size() < count) {
    slots_.resize(count);
  }
  pool_.clear();
  makeRoom();
  open_.clear();
  expansions_ = 0;
  const auto settle_end = [&](std::int32_t id, const Eigen::Vector2d& p, int& column, int& row) {
    const Eigen::Vector2i cell = g.cellAt(p);
    column = cell.x() / query.block;
    row = cell.y() / query.block;
    add(id) = {id, State::kUnseen, -1, 0.0F, field.clearance(p), p};
  };
  settle_end(start_, query.start, start_column_, start_row_);
  settle_end(goal_, query.goal, goal_column_, goal_row_);
}

// For the ends, or for the blocks around one: meanwhile no node moves.
void LatticeSearch::makeRoom() {
  constexpr std::size_t kAround = 9;
  if (pool_.capacity() < pool_.size() + kAround) {
    pool_.reserve(2 * pool_.capacity() + kAround);
  }
}

LatticeSearch::Node& LatticeSearch::add(std::int32_t id) {
  slots_[static_cast<std::size_t>(id)] = static_cast<std::uint32_t>(pool_.size());
  pool_.emplace_back();
  pool_.back().block = id;
  return pool_.back();
}

void LatticeSearch::place(Node& node, int column, int row) {
  const map::GridGeometry& g = field_->geometry();
  const int x0 = column * query_.block;
  const int y0 = row * query_.block;
  int x = std::min(x0 + query_.block / 2, g.width);
  int y = std::min(y0 + query_.block / 2, g.height);
  double clearance = field_->cornerClearance(x, y);
  if (clearance < query_.clearance_m) {
    for (int cy = y0; cy < std::min(y0 + query_.block, g.height); ++cy) {
      for (int cx = x0; cx < std::min(x0 + query_.block, g.width); ++cx) {
        const double here = field_->cornerClearance(cx, cy);
        if (here > clearance) {
          clearance = here;
          x = cx;
          y = cy;
        }
      }
    }
  }
  node.parent = -1;
  node.clearance_m = clearance;
  node.position = g.origin + g.resolution_m * Eigen::Vector2d(x, y);
  const bool inside = (node.position.array() >= query_.low.array()).all() &&
                      (node.position.array() <= query_.high.array()).all();
  node.state = inside && clearance >= query_.clearance_m ? State::kUnseen : State::kBlocked;
}

LatticeSearch::Node& LatticeSearch::touch(int column, int row) {
  const std::int32_t id = row * columns_ + column;
  const std::uint32_t slot = slots_[static_cast<std::size_t>(id)];
  if (slot < pool_.size() && pool_[slot].block == id) {
    return pool_[slot];
  }
  Node& node = add(id);
  place(node, column, row);
  return node;
}

bool LatticeSearch::edgeIsClear(const Node& a, const Node& b) const {
  const double needed = query_.clearance_m * query_.clearance_m;
  const double length = (a.position - b.position).norm();
  return map::leastSquaredBetween(a.clearance_m * a.clearance_m, b.clearance_m * b.clearance_m,
                                  length) >= needed ||
         map::segmentIsClear(*field_, a.position, b.position, query_.clearance_m);
}

// The blocks around `id` (around its block for start and goal), and start and goal where they are
// in or beside it.
template <typename Visit>
void LatticeSearch::forEachNeighbour(std::int32_t id, const Visit& visit) {
  int column = id % columns_;
  int row = id / columns_;
  if (id >= start_) {
    column = id == start_ ? start_column_ : goal_column_;
    row = id == start_ ? start_row_ : goal_row_;
  }
  for (int y = std::max(0, row - 1); y <= std::min(rows_ - 1, row + 1); ++y) {
    for (int x = std::max(0, column - 1); x <= std::min(columns_ - 1, column + 1); ++x) {
      const std::int32_t neighbour = y * columns_ + x;
      if (neighbour != id && touch(x, y).state != State::kBlocked) {
        visit(neighbour);
      }
    }
  }
  if (std::abs(start_column_ - column) <= 1 && std::abs(start_row_ - row) <= 1 && id != start_) {
    visit(start_);
  }
  if (std::abs(goal_column_ - column) <= 1 && std::abs(goal_row_ - row) <= 1 && id != goal_) {
    visit(goal_);
  }
}

float LatticeSearch::totalOf(const Node& node) const {
  return node.length +
         static_cast<float>(query_.heuristic_weight * (query_.goal - node.position).norm());
}

void LatticeSearch::push(std::int32_t id) {
  Node& node = nodeOf(id);
  if (node.length + (query_.goal - node.position).norm() >= query_.longest_m) {
    node.state = State::kUnseen;
    return;
  }
  node.state = State::kOpen;
  open_.push_back({totalOf(node), id});
  std::push_heap(open_.begin(), open_.end(), Farther{});
}

// The straight line to its parent was only assumed free; where it isn't, the best closed
// neighbour takes the parent's place. False if there is none.
bool LatticeSearch::settle(std::int32_t id) {
  Node& node = nodeOf(id);
  if (node.parent < 0 || edgeIsClear(nodeOf(node.parent), node)) {
    return true;
  }
  node.parent = -1;
  forEachNeighbour(id, [&](std::int32_t other_id) {
    const Node& other = nodeOf(other_id);
    if (other.state != State::kClosed) {
      return;
    }
    const float length = other.length + static_cast<float>((other.position - node.position).norm());
    if ((node.parent < 0 || length < node.length) && edgeIsClear(other, node)) {
      node.parent = other_id;
      node.length = length;
    }
  });
  return node.parent >= 0;
}

void LatticeSearch::expand(std::int32_t id) {
  const Node& node = nodeOf(id);
  const std::int32_t parent_id = node.parent < 0 ? id : node.parent;
  const Node& parent = nodeOf(parent_id);
  forEachNeighbour(id, [&](std::int32_t other_id) {
    Node& other = nodeOf(other_id);
    if (other.state == State::kClosed) {
      return;
    }
    const float length =
        parent.length + static_cast<float>((other.position - parent.position).norm());
    if (other.state == State::kOpen && length >= other.length) {
      return;
    }
    if (!edgeIsClear(node, other)) {
      return;
    }
    other.parent = parent_id;
    other.length = length;
    push(other_id);
  });
}

void LatticeSearch::collect(std::vector<Eigen::Vector2d>& path) const {
  path.clear();
  for (std::int32_t id = goal_; id >= 0; id = nodeOf(id).parent) {
    path.push_back(nodeOf(id).position);
  }
  std::reverse(path.begin(), path.end());
}

LatticeSearch::Outcome LatticeSearch::run(const map::DistanceField& field,
                                          const LatticeQuery& query,
                                          std::vector<Eigen::Vector2d>& path) {
  begin(field, query);
  push(start_);
  while (!open_.empty()) {
    makeRoom();
    std::pop_heap(open_.begin(), open_.end(), Farther{});
    const auto [total, id] = open_.back();
    open_.pop_back();
    Node& node = nodeOf(id);
    if (node.state != State::kOpen || total != totalOf(node)) {
      continue;  // done, or a later entry holds it
    }
    const float assumed = node.length;
    if (!settle(id)) {
      node.state = State::kUnseen;
      continue;
    }
    if (node.length > assumed) {  // its turn comes later
      push(id);
      continue;
    }
    node.state = State::kClosed;
    if (id == goal_) {
      collect(path);
      return Outcome::kFound;
    }
    if (++expansions_ > query.max_expansions) {
      return Outcome::kLimit;
    }
    expand(id);
  }
  return Outcome::kExhausted;
}

}  // namespace otter_nav::topology
