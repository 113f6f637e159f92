#include "planner/tree.hpp"

namespace otter_nav::planner {

Tree::Tree(Direction direction, int capacity) : direction_(direction), capacity_(capacity) {
  nodes_.reserve(static_cast<std::size_t>(capacity));
  stack_.reserve(static_cast<std::size_t>(capacity));
}

void Tree::reset(const KinoState& root) {
  nodes_.clear();
  Node node;
  node.state = root;
  nodes_.push_back(node);
}

int Tree::add(const KinoState& state, int parent, const Edge& edge) {
  Node node;
  node.state = state;
  node.edge = edge;
  node.parent = parent;
  node.cost = at(parent).cost + edge.cost;
  node.time_s = at(parent).time_s + edge.duration_s;
  node.next_sibling = at(parent).first_child;
  at(parent).first_child = size();
  nodes_.push_back(node);
  return size() - 1;
}

void Tree::unlink(int index) {
  int* link = &at(at(index).parent).first_child;
  while (*link != index) {
    link = &at(*link).next_sibling;
  }
  *link = at(index).next_sibling;
}

void Tree::rewire(int index, int parent, const Edge& edge) {
  unlink(index);
  Node& moved = at(index);
  moved.parent = parent;
  moved.edge = edge;
  moved.next_sibling = at(parent).first_child;
  at(parent).first_child = index;
  stack_.clear();
  stack_.push_back(index);
  while (!stack_.empty()) {
    Node& node = at(stack_.back());
    stack_.pop_back();
    node.cost = at(node.parent).cost + node.edge.cost;
    node.time_s = at(node.parent).time_s + node.edge.duration_s;
    for (int child = node.first_child; child != kNone; child = at(child).next_sibling) {
      stack_.push_back(child);
    }
  }
}

bool Tree::isBelow(int index, int ancestor) const {
  for (int i = index; i != kNone; i = node(i).parent) {
    if (i == ancestor) {
      return true;
    }
  }
  return false;
}

}  // namespace otter_nav::planner
