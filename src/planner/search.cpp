#include "planner/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace otter_nav::planner {
namespace {

constexpr int kPiecesPerNode = 4;
constexpr int kRepairsPerSample = 1;  // and tree
constexpr double kEdgeMaxM = 30.0;    // between two states
constexpr double kWorthRewiring = 1e-6;

}  // namespace

Search::Search(const SearchOptions& options, const vessel::Parameters& vessel)
    : options_(options),
      vessel_(vessel),
      check_(vessel),
      still_(vessel),
      from_start_(Direction::kFromRoot, options.max_nodes),
      to_goal_(Direction::kToRoot, options.max_nodes) {
  pieces_.reserve(static_cast<std::size_t>(options.max_nodes) * kPiecesPerNode);
  meetings_.reserve(static_cast<std::size_t>(options.max_nodes));
}

void Search::reset(const feasibility::Obstacles& obstacles, const feasibility::SafetyLimits& limits,
                   const KinoState& start, const KinoState& goal) {
  // At a fraction of the speed edges keep their shape at its sixth power of sigma: T by its
  // inverse, the integral of squared jerk by its fifth power.
  constexpr double kPower = 6.0;
  sigma_ = options_.sigma * std::pow(feasibility::speedShare(vessel_, limits), kPower);
  check_.begin(obstacles, limits.startingAt(start.velocity.norm(), vessel_));
  still_.begin(obstacles.field(), limits);
  from_start_.reset(start);
  to_goal_.reset(goal);
  pieces_.clear();
  meetings_.clear();
  direct_.reset();
  counts_ = SearchCounts{};
}

Search::Occasion Search::occasionOf(const Tree& tree, int parent) const {
  return tree.direction() == Direction::kFromRoot ? Occasion{check_, tree.node(parent).time_s}
                                                  : Occasion{still_, 0.0};
}

bool Search::joinRoots() {
  const KinoState& start = from_start_.node(0).state;
  const KinoState& goal = to_goal_.node(0).state;
  if ((goal.position - start.position).norm() > kEdgeMaxM) {
    return false;
  }
  const auto steered = steer(start, goal, sigma_);
  if (steered) {
    direct_ = feasibleEdge(start, goal, *steered, occasionOf(from_start_, 0));
  }
  if (direct_) {
    meetings_.push_back({kNone, kNone});
  }
  return direct_.has_value();
}

bool Search::extend(const KinoState& sample) {
  ++counts_.samples;
  if (from_start_.full() || to_goal_.full() || !still_.isFree(sample.position)) {
    return false;
  }
  const double before = bestCost();
  const int in_start = grow(from_start_, sample);
  const int in_goal = grow(to_goal_, sample);
  if (in_start == kNone && in_goal == kNone) {
    return false;
  }
  ++counts_.joined;
  if (in_start != kNone) {
    rewire(from_start_, in_start);
  }
  if (in_goal != kNone) {
    rewire(to_goal_, in_goal);
  }
  if (in_start != kNone && in_goal != kNone) {
    meetings_.push_back({in_start, in_goal});
  }
  return bestCost() < before;
}

// The nodes through which the sample could be reached at least cost, were the sea empty: cost so
// far plus sigma times the time the straight line takes at full speed. A heap holds the best.
int Search::findNeighbours(const Tree& tree, const KinoState& sample) {
  const auto worse = [](const Candidate& a, const Candidate& b) { return a.bound < b.bound; };
  const double per_metre = sigma_ / check_.speedMaxEver();
  int found = 0;
  for (int i = 0; i < tree.size(); ++i) {
    const Node& node = tree.node(i);
    const double distance = (node.state.position - sample.position).norm();
    if (distance > kEdgeMaxM) {
      continue;
    }
    const double bound = node.cost + per_metre * distance;
    if (found == kNeighbours) {
      if (bound >= candidates_[0].bound) {
        continue;
      }
      std::pop_heap(candidates_.begin(), candidates_.begin() + found, worse);
      --found;
    }
    candidates_[static_cast<std::size_t>(found++)] = {i, bound, Steer{}};
    std::push_heap(candidates_.begin(), candidates_.begin() + found, worse);
  }
  return found;
}

// Replaces bounds by costs and sorts.
int Search::steerNeighbours(const Tree& tree, const KinoState& sample, int found) {
  int steered = 0;
  for (int i = 0; i < found; ++i) {
    Candidate candidate = candidates_[static_cast<std::size_t>(i)];
    const Node& node = tree.node(candidate.node);
    const auto best = steer(tree.from(node.state, sample), tree.to(node.state, sample), sigma_);
    if (best) {
      candidate.steer = *best;
      candidate.bound = node.cost + best->cost;
      candidates_[static_cast<std::size_t>(steered++)] = candidate;
    }
  }
  std::sort(candidates_.begin(), candidates_.begin() + steered,
            [](const Candidate& a, const Candidate& b) { return a.bound < b.bound; });
  return steered;
}

// TreeGrow: the cheapest parent whose edge is feasible; if there is none, the cheapest whose edge
// local optimisation can make so.
int Search::grow(Tree& tree, const KinoState& sample) {
  const int found = steerNeighbours(tree, sample, findNeighbours(tree, sample));
  const int repairs = options_.repair_edges ? std::min(found, kRepairsPerSample) : 0;
  for (int i = 0; i < found + repairs; ++i) {
    const bool repair = i >= found;
    counts_.tried += repair ? 1 : 0;
    const Candidate& candidate = candidates_[static_cast<std::size_t>(repair ? i - found : i)];
    const KinoState& state = tree.node(candidate.node).state;
    const auto edge = (this->*(repair ? &Search::repairedEdge : &Search::feasibleEdge))(
        tree.from(state, sample), tree.to(state, sample), candidate.steer,
        occasionOf(tree, candidate.node));
    if (edge) {
      counts_.repairs += repair ? 1 : 0;
      return tree.add(sample, candidate.node, *edge);
    }
  }
  return kNone;
}

std::optional<Edge> Search::feasibleEdge(const KinoState& from, const KinoState& to,
                                         const Steer& steer, const Occasion& occasion) {
  if (occasion.check.check(quinticPiece(from, to, steer.duration_s), occasion.start_s) !=
      feasibility::EdgeFault::kNone) {
    return std::nullopt;
  }
  return Edge{steer.duration_s, steer.cost, kNone, 0};
}

// An edge that asks for too much speed or thrust is first given more time, which leaves it one
// quintic; one that collides is bent.
std::optional<Edge> Search::repairedEdge(const KinoState& from, const KinoState& to,
                                         const Steer& steer, const Occasion& occasion) {
  const auto slower = slowerEdge(from, to, steer, occasion);
  if (slower) {
    return slower;
  }
  const trajectory::Piece failing = quinticPiece(from, to, steer.duration_s);
  if (!local_.repair(occasion.check, failing, occasion.start_s, repaired_)) {
    return std::nullopt;
  }
  if (pieces_.size() + repaired_.pieces.size() > pieces_.capacity()) {
    return std::nullopt;
  }
  double cost = 0.0;
  for (const trajectory::Piece& piece : repaired_.pieces) {
    cost += pieceCost(piece, sigma_);
  }
  const Edge edge{repaired_.duration_s, cost, static_cast<int>(pieces_.size()),
                  optimizer::RepairedEdge::kPieces};
  pieces_.insert(pieces_.end(), repaired_.pieces.begin(), repaired_.pieces.end());
  return edge;
}

std::optional<Edge> Search::slowerEdge(const KinoState& from, const KinoState& to,
                                       const Steer& steer, const Occasion& occasion) {
  constexpr std::array<double, 4> kStretch = {1.1, 1.25, 1.45, 1.75};
  const SteerCost cost(from, to, sigma_);
  for (const double stretch : kStretch) {
    const double duration = stretch * steer.duration_s;
    const feasibility::EdgeFault fault =
        occasion.check.check(quinticPiece(from, to, duration), occasion.start_s);
    if (fault == feasibility::EdgeFault::kNone) {
      return Edge{duration, cost.at(duration), kNone, 0};
    }
    if (fault == feasibility::EdgeFault::kClearance) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

// Neighbours that are reached at less cost through the new node are hung under it.
void Search::rewire(Tree& tree, int added) {
  const KinoState state = tree.node(added).state;
  const double cost = tree.node(added).cost;
  const int found = findNeighbours(tree, state);
  for (int i = 0; i < found; ++i) {
    const int index = candidates_[static_cast<std::size_t>(i)].node;
    const Node& node = tree.node(index);
    const double distance = (node.state.position - state.position).norm();
    const double bound = cost + sigma_ * distance / check_.speedMaxEver();
    if (index == added || node.parent == kNone || bound >= node.cost) {
      continue;
    }
    const KinoState& from = tree.from(state, node.state);
    const KinoState& to = tree.to(state, node.state);
    const auto best = steer(from, to, sigma_);
    if (!best || cost + best->cost >= node.cost - kWorthRewiring || tree.isBelow(added, index)) {
      continue;
    }
    if (const auto edge = feasibleEdge(from, to, *best, occasionOf(tree, added))) {
      tree.rewire(index, added, *edge);
    }
  }
}

double Search::bestCost() const {
  double best = std::numeric_limits<double>::infinity();
  for (const Meeting& m : meetings_) {
    best = std::min(best, m.in_start == kNone
                              ? direct_->cost
                              : from_start_.node(m.in_start).cost + to_goal_.node(m.in_goal).cost);
  }
  return best;
}

void Search::appendEdge(const Tree& tree, int node, std::vector<trajectory::Piece>& pieces) const {
  const Node& child = tree.node(node);
  const Edge& edge = child.edge;
  if (edge.first_piece != kNone) {
    const auto first = pieces_.begin() + edge.first_piece;
    pieces.insert(pieces.end(), first, first + edge.piece_count);
    return;
  }
  const KinoState& parent = tree.node(child.parent).state;
  pieces.push_back(
      quinticPiece(tree.from(parent, child.state), tree.to(parent, child.state), edge.duration_s));
}

std::vector<trajectory::Piece> Search::recall() const {
  std::vector<trajectory::Piece> pieces;
  if (direct_) {
    pieces.push_back(
        quinticPiece(from_start_.node(0).state, to_goal_.node(0).state, direct_->duration_s));
    return pieces;
  }
  const double best = bestCost();
  for (const Meeting& m : meetings_) {
    if (from_start_.node(m.in_start).cost + to_goal_.node(m.in_goal).cost > best) {
      continue;
    }
    std::vector<int> down;
    for (int i = m.in_start; from_start_.node(i).parent != kNone; i = from_start_.node(i).parent) {
      down.push_back(i);
    }
    for (auto i = down.rbegin(); i != down.rend(); ++i) {
      appendEdge(from_start_, *i, pieces);
    }
    for (int i = m.in_goal; to_goal_.node(i).parent != kNone; i = to_goal_.node(i).parent) {
      appendEdge(to_goal_, i, pieces);
    }
    return pieces;
  }
  return pieces;
}

}  // namespace otter_nav::planner
