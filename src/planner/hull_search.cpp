#include "planner/hull_search.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/parts.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::planner {
namespace {

using vessel::Pose;

constexpr double kCellM = 0.125;
constexpr int kCells = static_cast<int>(2.0 * HullSearch::kReachM / kCellM);
constexpr double kMoveM = 0.15;
constexpr double kCoarseM = 0.125;
constexpr int kCoarse = static_cast<int>(2.0 * HullSearch::kReachM / kCoarseM);
constexpr double kOffGridM = 0.71 * kCoarseM;  // a place of that grid is this near to any other
// What a slow vessel takes: a metre, a turn, and coming to rest for another motion.
constexpr double kLegMps = 0.5;
constexpr double kTurnRadps = 0.35;
constexpr double kRestS = 2.0;
constexpr double kAsternShare = 1.5;  // a metre astern beside one ahead
// Next to obstacles all is dearer, for waves set the hull aside: a metre, a turn and a rest.
constexpr double kRoomyM = 0.25;
constexpr double kTightPrice = 4.0;
constexpr double kGreed = 1.6;  // the weight of what is left
// What lies nearer together than twice this is not looked at between; the slack leaves as much.
constexpr double kBetweenM = 0.01;
constexpr double kStraightToGoalM = 4.0;
constexpr double kSameM = 1e-6;
constexpr float kFar = std::numeric_limits<float>::infinity();

}  // namespace

double HullSearch::psiOf(int heading) const {
  return start_.psi_rad + heading * (2.0 * kPi / headings_);
}

HullRoom HullSearch::roomAt(const feasibility::Obstacles& obstacles, const Pose& pose) const {
  const Eigen::Vector2d bow = unitVector(pose.psi_rad);
  double centre_m = 0.0;
  const double discs = cover_.slack(
      obstacles, pose.position, 0.0, 0.0, [&] { return bow; }, centre_m);
  return {centre_m - 2.0 * kBetweenM, discs - 2.0 * kBetweenM};
}

double HullSearch::slack(const Eigen::Vector2d& position, double psi_rad) const {
  const Eigen::Vector2d bow = unitVector(psi_rad);
  double centre_m = 0.0;
  const double discs = cover_.slack(
      *obstacles_, position, 0.0, 0.0, [&] { return bow; }, centre_m);
  return std::min(discs - room_.beside_m, centre_m - room_.centre_m) - kBetweenM;
}

// Slack falls by no more than the hull moves: two places vouch for what lies between them as far as
// theirs reaches; where it doesn't, the middle is looked at.
bool HullSearch::isClearBetween(const Stand& a, const Stand& b) const {
  const double moves_m =
      (b.position - a.position).norm() + cover_.arm() * std::abs(b.psi_rad - a.psi_rad);
  if (a.slack_m + b.slack_m >= moves_m || moves_m < 2.0 * kBetweenM) {
    return true;
  }
  Stand middle{0.5 * (a.position + b.position), 0.5 * (a.psi_rad + b.psi_rad), 0.0};
  middle.slack_m = slack(middle.position, middle.psi_rad);
  return middle.slack_m >= 0.0 && isClearBetween(a, middle) && isClearBetween(middle, b);
}

double HullSearch::price(double slack_m, double psi_rad) const {
  const double roomy_m = kRoomyM + (room_.swings_m ? room_.swings_m(psi_rad) : 0.0);
  return 1.0 + kTightPrice * std::clamp(1.0 - slack_m / roomy_m, 0.0, 1.0);
}

double HullSearch::turnCost(const Eigen::Vector2d& position, double psi_rad,
                            double turn_rad) const {
  if (std::abs(turn_rad) < kSameM) {
    return 0.0;
  }
  if (!turnIsClear(position, psi_rad, turn_rad)) {
    return std::numeric_limits<double>::infinity();
  }
  const int parts = partsOf(std::abs(turn_rad), 2.0 * kPi / headings_, 1);
  double cost_s = kRestS * price(slack(position, psi_rad), psi_rad);
  for (int k = 0; k < parts; ++k) {
    const double psi = psi_rad + (k + 0.5) / parts * turn_rad;
    cost_s += std::abs(turn_rad) / parts / kTurnRadps * price(slack(position, psi), psi);
  }
  return cost_s;
}

double HullSearch::legCost(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                           double psi_rad) const {
  if (!legIsClear(from, to, psi_rad)) {
    return std::numeric_limits<double>::infinity();
  }
  const Eigen::Vector2d leg = to - from;
  const double length = leg.norm();
  const double share = leg.dot(unitVector(psi_rad)) < 0.0 ? kAsternShare : 1.0;
  const int parts = partsOf(length, kMoveM, 1);
  double cost_s = kRestS * price(slack(from, psi_rad), psi_rad);
  for (int k = 0; k < parts; ++k) {
    const Eigen::Vector2d there = from + (k + 0.5) / parts * leg;
    cost_s += share * length / parts / kLegMps * price(slack(there, psi_rad), psi_rad);
  }
  return cost_s;
}

bool HullSearch::turnIsClear(const Eigen::Vector2d& position, double psi_rad,
                             double turn_rad) const {
  const Stand from{position, psi_rad, slack(position, psi_rad)};
  const Stand to{position, psi_rad + turn_rad, slack(position, psi_rad + turn_rad)};
  return from.slack_m >= 0.0 && to.slack_m >= 0.0 && isClearBetween(from, to);
}

bool HullSearch::legIsClear(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                            double psi_rad) const {
  const Stand first{from, psi_rad, slack(from, psi_rad)};
  const Stand last{to, psi_rad, slack(to, psi_rad)};
  return first.slack_m >= 0.0 && last.slack_m >= 0.0 && isClearBetween(first, last);
}

std::size_t HullSearch::keyOf(const Node& node) const {
  const Eigen::Vector2d cell =
      ((node.position - start_.position).array() + kReachM).matrix() / kCellM;
  const int heading = ((node.heading % headings_) + headings_) % headings_;
  return (static_cast<std::size_t>(cell.y()) * kCells + static_cast<std::size_t>(cell.x())) *
             static_cast<std::size_t>(headings_) +
         static_cast<std::size_t>(heading);
}

// A cell's cost stands once nothing cheaper is left to go on from.
double HullSearch::leftS(const Eigen::Vector2d& position) {
  const Eigen::Vector2d cell = ((position - start_.position).array() + kReachM).matrix() / kCoarseM;
  const float& left =
      left_s_[static_cast<std::size_t>(cell.y()) * kCoarse + static_cast<std::size_t>(cell.x())];
  while (!left_front_.empty() && -left_front_.front().first < left) {
    measureLeft();
  }
  return left;
}

Eigen::Vector2d HullSearch::middleOf(int x, int y) const {
  return start_.position +
         Eigen::Vector2d((x + 0.5) * kCoarseM - kReachM, (y + 0.5) * kCoarseM - kReachM);
}

void HullSearch::beginLeft(const Eigen::Vector2d& goal) {
  left_s_.assign(static_cast<std::size_t>(kCoarse) * kCoarse, kFar);
  left_front_.clear();
  const Eigen::Vector2d first = ((goal - start_.position).array() + kReachM).matrix() / kCoarseM;
  reachLeft(static_cast<int>(first.x()), static_cast<int>(first.y()), 0.0F);
}

void HullSearch::reachLeft(int x, int y, float cost_s) {
  if (x < 0 || y < 0 || x >= kCoarse || y >= kCoarse) {
    return;
  }
  const double clearance_m =
      std::max(room_.centre_m, 0.5 * hull_.beam_m + room_.beside_m) - kOffGridM;
  const int at = y * kCoarse + x;
  if (cost_s < left_s_[static_cast<std::size_t>(at)] &&
      obstacles_->field().isClear(middleOf(x, y), clearance_m)) {
    left_s_[static_cast<std::size_t>(at)] = cost_s;
    left_front_.emplace_back(-cost_s, at);
    std::push_heap(left_front_.begin(), left_front_.end());
  }
}

// One step of Dijkstra's search over a grid.
void HullSearch::measureLeft() {
  constexpr float kStraightS = static_cast<float>(kCoarseM / kLegMps);
  constexpr float kAslantS = static_cast<float>(1.41421356 * kCoarseM / kLegMps);
  std::pop_heap(left_front_.begin(), left_front_.end());
  const auto [minus, at] = left_front_.back();
  left_front_.pop_back();
  if (-minus > left_s_[static_cast<std::size_t>(at)]) {
    return;
  }
  const int x = at % kCoarse;
  const int y = at / kCoarse;
  // No heading leaves the hull more than its middle has.
  const double middle_m = cover_.middle_m + room_.beside_m - kOffGridM;
  const double most_m = obstacles_->field().clearance(middleOf(x, y)) - middle_m;
  const auto tight =
      static_cast<float>(1.0 + kTightPrice * std::clamp(1.0 - most_m / kRoomyM, 0.0, 1.0));
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      if (i != 0 || j != 0) {
        reachLeft(x + i, y + j, -minus + tight * (i != 0 && j != 0 ? kAslantS : kStraightS));
      }
    }
  }
}

// There are 47 MB of it: what the last search reached is put back, and nothing else.
void HullSearch::forgetLast() {
  if (least_s_.empty()) {
    least_s_.assign(static_cast<std::size_t>(kCells) * kCells * *std::rbegin(kHeadings), kFar);
  }
  for (const Node& node : nodes_) {
    least_s_[keyOf(node)] = kFar;
  }
  nodes_.clear();
}

void HullSearch::push(const Node& node) {
  const Eigen::Vector2d off = node.position - start_.position;
  if (off.cwiseAbs().maxCoeff() >= kReachM) {
    return;
  }
  const double left = leftS(node.position);
  float& least = least_s_[keyOf(node)];
  if (!std::isfinite(left) || node.cost_s >= least) {
    return;
  }
  least = node.cost_s;
  nodes_.push_back(node);
  front_.emplace_back(-(node.cost_s + static_cast<float>(kGreed * left)),
                      static_cast<int>(nodes_.size()) - 1);
  std::push_heap(front_.begin(), front_.end());
}

void HullSearch::expand(int k) {
  const Node from = nodes_[static_cast<std::size_t>(k)];
  const double from_slack = slack(from.position, psiOf(from.heading));
  for (const Motion motion : {Motion::kTurn, Motion::kAhead, Motion::kAstern}) {
    for (const int side : {-1, 1}) {
      if (motion != Motion::kTurn && side != (motion == Motion::kAhead ? 1 : -1)) {
        continue;
      }
      Node to = from;
      to.from = k;
      to.motion = motion;
      double takes_s = from.motion == motion ? 0.0 : kRestS;
      if (motion == Motion::kTurn) {
        to.heading += side;
        takes_s += 2.0 * kPi / headings_ / kTurnRadps;
      } else {
        to.position += side * kMoveM * unitVector(psiOf(from.heading));
        takes_s += (side > 0 ? 1.0 : kAsternShare) * kMoveM / kLegMps;
      }
      const double left = slack(to.position, psiOf(to.heading));
      if (left < 0.0 || !isClearBetween({from.position, psiOf(from.heading), from_slack},
                                        {to.position, psiOf(to.heading), left})) {
        continue;
      }
      to.cost_s += static_cast<float>(price(left, psiOf(to.heading)) * takes_s);
      push(to);
    }
  }
}

// A turn, a leg ahead and a turn to the goal's heading.
void HullSearch::tryToGoal(int k) {
  const Node& at = nodes_[static_cast<std::size_t>(k)];
  const Eigen::Vector2d leg = goal_.position - at.position;
  if (leg.norm() > kStraightToGoalM) {
    return;
  }
  const double psi = psiOf(at.heading);
  const double course = leg.norm() < kSameM ? psi : angleOf(leg);
  if (turnIsClear(at.position, psi, wrapAngle(course - psi)) &&
      legIsClear(at.position, goal_.position, course) &&
      turnIsClear(goal_.position, course, wrapAngle(goal_.psi_rad - course))) {
    found_ = k;
  }
}

std::vector<Pose> HullSearch::posesTo(int k) const {
  std::vector<Pose> poses;
  for (int i = k; i >= 0; i = nodes_[static_cast<std::size_t>(i)].from) {
    const Node& node = nodes_[static_cast<std::size_t>(i)];
    poses.push_back({node.position, psiOf(node.heading)});
  }
  std::reverse(poses.begin(), poses.end());
  const Eigen::Vector2d leg = goal_.position - poses.back().position;
  if (leg.norm() >= kSameM) {
    const double course = poses.back().psi_rad + wrapAngle(angleOf(leg) - poses.back().psi_rad);
    poses.push_back({poses.back().position, course});
    poses.push_back({goal_.position, course});
  }
  poses.push_back(
      {goal_.position, poses.back().psi_rad + wrapAngle(goal_.psi_rad - poses.back().psi_rad)});
  return poses;
}

// What a turn, a leg and a turn do at less cost put in the place of many steps, and those of the
// same motion joined.
std::vector<Pose> HullSearch::shortened(const std::vector<Pose>& way) const {
  const auto isTurn = [&](std::size_t a, std::size_t b) {
    return (way[b].position - way[a].position).norm() < kSameM;
  };
  std::vector<double> reached_s(way.size(), 0.0);
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Pose& from = way[i - 1];
    const bool turns = isTurn(i - 1, i);
    const double takes_s =
        turns ? turnCost(from.position, from.psi_rad, way[i].psi_rad - from.psi_rad)
              : legCost(from.position, way[i].position, from.psi_rad);
    const bool goes_on = i > 1 && isTurn(i - 2, i - 1) == turns && takes_s > 0.0;
    const double rest_s =
        goes_on ? kRestS * price(slack(from.position, from.psi_rad), from.psi_rad) : 0.0;
    reached_s[i] = reached_s[i - 1] + takes_s - rest_s;
  }
  std::vector<Pose> shorter = {way.front()};
  std::size_t at = 0;
  while (at + 1 < way.size()) {
    const Pose here = shorter.back();
    std::size_t next = at + 1;
    for (std::size_t to = way.size() - 1; to > at + 1; --to) {
      const Eigen::Vector2d leg = way[to].position - here.position;
      if (leg.norm() < kSameM) {
        continue;
      }
      const double turn = wrapAngle(angleOf(leg) - here.psi_rad);
      const double course = here.psi_rad + turn;
      const double turn_on = wrapAngle(way[to].psi_rad - course);
      const double kept_s = reached_s[to] - reached_s[at];
      // What takes longer in open water needn't be looked at.
      if (leg.norm() / kLegMps + (std::abs(turn) + std::abs(turn_on)) / kTurnRadps >= kept_s) {
        continue;
      }
      const double takes_s = turnCost(here.position, here.psi_rad, turn) +
                             legCost(here.position, way[to].position, course) +
                             turnCost(way[to].position, course, turn_on);
      if (takes_s < kept_s) {
        shorter.push_back({here.position, course});
        shorter.push_back({way[to].position, course});
        next = to;
        break;
      }
    }
    // The same heading as the way's, but for whole turns.
    const double psi =
        shorter.back().psi_rad + wrapAngle(way[next].psi_rad - shorter.back().psi_rad);
    shorter.push_back({way[next].position, psi});
    at = next;
  }
  // Steps that go on in the same motion are one.
  std::vector<Pose> joined = {shorter.front()};
  for (std::size_t i = 1; i < shorter.size(); ++i) {
    const Pose& to = shorter[i];
    const bool turns = (to.position - joined.back().position).norm() < kSameM;
    if (turns && std::abs(to.psi_rad - joined.back().psi_rad) < kSameM) {
      continue;
    }
    if (joined.size() > 1) {
      const Pose& before = joined[joined.size() - 2];
      const Eigen::Vector2d leg = joined.back().position - before.position;
      const bool turned = leg.norm() < kSameM;
      const bool goes_on = !turned && leg.dot(to.position - joined.back().position) > 0.0;
      const bool turns_on =
          turned &&
          (joined.back().psi_rad - before.psi_rad) * (to.psi_rad - joined.back().psi_rad) > 0.0;
      if (turns == turned && (turns ? turns_on : goes_on)) {
        joined.back() = to;
        continue;
      }
    }
    joined.push_back(to);
  }
  return joined;
}

std::vector<Pose> HullSearch::find(const feasibility::Obstacles& obstacles, const Pose& start,
                                   const Pose& goal, const HullRoom& room, int expansions_most,
                                   const std::function<bool()>& is_late) {
  forgetLast();  // by its own start and headings
  obstacles_ = &obstacles;
  room_ = room;
  start_ = start;
  goal_ = goal;
  found_ = -1;
  if ((goal.position - start.position).cwiseAbs().maxCoeff() >= kReachM ||
      slack(start.position, start.psi_rad) < 0.0 || slack(goal.position, goal.psi_rad) < 0.0) {
    return {};
  }
  beginLeft(goal.position);
  for (const int headings : kHeadings) {
    forgetLast();
    headings_ = headings;
    look(expansions_most, is_late);
    if (found_ >= 0) {
      return shortened(posesTo(found_));
    }
  }
  return {};
}

void HullSearch::look(int expansions_most, const std::function<bool()>& is_late) {
  constexpr int kLookEach = 256;
  front_.clear();
  push({start_.position, 0, Motion::kTurn, 0.0F, -1});
  for (int looked = 0; found_ < 0 && !front_.empty() && looked < expansions_most; ++looked) {
    std::pop_heap(front_.begin(), front_.end());
    const int k = front_.back().second;
    front_.pop_back();
    if (nodes_[static_cast<std::size_t>(k)].cost_s >
        least_s_[keyOf(nodes_[static_cast<std::size_t>(k)])]) {
      continue;
    }
    if (looked % kLookEach == kLookEach - 1 && is_late && is_late()) {
      break;
    }
    tryToGoal(k);
    if (found_ < 0) {
      expand(k);
    }
  }
}

}  // namespace otter_nav::planner
