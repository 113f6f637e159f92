// Any-angle A* over the blocks of a distance field (lazy Theta*: Nash, Koenig and Tovey 2010): a
// block's node is its middle, or its clearest corner where the middle is too near an obstacle.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "otter_nav/map/distance_field.hpp"

namespace otter_nav::topology {

struct LatticeQuery {
  Eigen::Vector2d start, goal;
  double clearance_m = 0.8;  // of every edge
  int block = 4;             // cells a side
  // Only nodes within this box, m; and only paths shorter than this.
  Eigen::Vector2d low, high;
  double longest_m = 1e9;
  double heuristic_weight =
      1.0;  // weight of the distance still to go; the path is at most this much too long
  int max_expansions = 0;
};

class LatticeSearch {
 public:
  enum class Outcome { kFound, kExhausted, kLimit };

  // Start to goal into `path`, where each segment keeps the clearance. Start and goal must.
  Outcome run(const map::DistanceField& field, const LatticeQuery& query,
              std::vector<Eigen::Vector2d>& path);

 private:
  enum class State : std::uint8_t { kBlocked, kUnseen, kOpen, kClosed };
  struct Node {
    std::int32_t block = -1;  // whose node it is
    State state = State::kUnseen;
    std::int32_t parent = -1;
    float length = 0.0F;  // from the start
    double clearance_m = 0.0;
    Eigen::Vector2d position;
  };
  struct Open {
    float total;
    std::int32_t node;
  };

  void begin(const map::DistanceField& field, const LatticeQuery& query);
  Node& nodeOf(std::int32_t id) { return pool_[slots_[static_cast<std::size_t>(id)]]; }
  [[nodiscard]] const Node& nodeOf(std::int32_t id) const {
    return pool_[slots_[static_cast<std::size_t>(id)]];
  }
  void makeRoom();
  Node& add(std::int32_t id);
  void place(Node& node, int column, int row);
  Node& touch(int column, int row);
  [[nodiscard]] bool edgeIsClear(const Node& a, const Node& b) const;
  template <typename Visit>
  void forEachNeighbour(std::int32_t id, const Visit& visit);
  [[nodiscard]] float totalOf(const Node& node) const;
  void push(std::int32_t id);
  bool settle(std::int32_t id);
  void expand(std::int32_t id);
  void collect(std::vector<Eigen::Vector2d>& path) const;

  const map::DistanceField* field_ = nullptr;
  LatticeQuery query_;
  int columns_ = 0, rows_ = 0;
  int start_column_ = 0, start_row_ = 0, goal_column_ = 0, goal_row_ = 0;
  int expansions_ = 0;
  // The nodes that a search has met, and where in there a block's is: blocks row by row, then start
  // and goal. A slot counts where the pool's node says so, so that nothing of the map's size is
  // cleared for a search.
  std::vector<Node> pool_;
  std::vector<std::uint32_t> slots_;
  std::int32_t start_ = 0, goal_ = 0;
  std::vector<Open> open_;
};

}  // namespace otter_nav::topology
