// One of the two trees: states joined by edges that can be sailed, in a pool that is filled anew
// for each query and allocates nothing once it has grown.
#pragma once

#include <vector>

#include "planner/obvp.hpp"

namespace otter_nav::planner {

// Which way its edges are sailed: from the root (the start's tree) or to it (the goal's).
enum class Direction { kFromRoot, kToRoot };

constexpr int kNone = -1;

// How a node is joined to its parent: one quintic of `duration_s`, or pieces in the pool after a
// local repair.
struct Edge {
  double duration_s = 0.0;
  double cost = 0.0;
  int first_piece = kNone;  // in the pool of repaired pieces; kNone for the plain quintic
  int piece_count = 0;
};

struct Node {
  KinoState state;
  Edge edge;            // to the parent; meaningless at the root
  double cost = 0.0;    // of the path to or from the root
  double time_s = 0.0;  // that path takes
  int parent = kNone;
  int first_child = kNone;
  int next_sibling = kNone;
};

class Tree {
 public:
  Tree(Direction direction, int capacity);

  void reset(const KinoState& root);
  [[nodiscard]] Direction direction() const { return direction_; }
  [[nodiscard]] int size() const { return static_cast<int>(nodes_.size()); }
  [[nodiscard]] bool full() const { return size() >= capacity_; }
  [[nodiscard]] const Node& node(int index) const {
    return nodes_[static_cast<std::size_t>(index)];
  }

  // The new node's index; the tree must not be full.
  int add(const KinoState& state, int parent, const Edge& edge);
  // Hangs `index` and all below it under another parent and passes cost and time on. The new parent
  // must not be below it.
  void rewire(int index, int parent, const Edge& edge);
  [[nodiscard]] bool isBelow(int index, int ancestor) const;

  // The ends of the edge between a node and its parent, or a node to be, in sailing order.
  [[nodiscard]] const KinoState& from(const KinoState& parent, const KinoState& child) const {
    return direction_ == Direction::kFromRoot ? parent : child;
  }
  [[nodiscard]] const KinoState& to(const KinoState& parent, const KinoState& child) const {
    return direction_ == Direction::kFromRoot ? child : parent;
  }

 private:
  Node& at(int index) { return nodes_[static_cast<std::size_t>(index)]; }
  void unlink(int index);

  Direction direction_;
  int capacity_;
  std::vector<Node> nodes_;
  std::vector<int> stack_;
};

}  // namespace otter_nav::planner
