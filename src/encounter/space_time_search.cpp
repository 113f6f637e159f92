#include "encounter/space_time_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_set>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/rest.hpp"

namespace otter_nav::encounter {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Steps of Foretold each: short where the next decision is near.
constexpr std::array<int, 9> kLayers = {3, 3, 4, 4, 5, 5, 6, 6, 6};
constexpr double horizonOf(const std::array<int, 9>& layers) {
  int steps = 0;
  for (const int of_layer : layers) {
    steps += of_layer;
  }
  return steps * Foretold::kStepS;
}
static_assert(horizonOf(kLayers) > SpaceTimeSearch::kHorizonS - 1e-9 &&
              horizonOf(kLayers) < SpaceTimeSearch::kHorizonS + 1e-9);
constexpr std::size_t kBeam = 64;
constexpr std::size_t kOfEach = 3;  // of those that begin with the same order, at least

constexpr double kSureContactS = 60.0;  // a second of sure contact, in seconds
constexpr double kTouchedS = 40.0;      // and that it comes to one, however brief
constexpr double kThirdS = 6.0;         // in which what is foretold counts a third
constexpr double kBesideM = 0.15;       // off what lies still
constexpr double kRoomM = 0.6;          // preferred there
constexpr double kNoRoomPerS = 0.5;

// Near the goal.
constexpr double kApproachM = 8.0;
constexpr double kApproachPerS = 0.45;  // of what is left, a second
constexpr double kThereM = 0.5;

struct Node {
  Hull hull;
  double price = 0.0;  // so far
  double rank = 0.0;   // and what is left
  Foretold::Nearness worst;
  int arrived = -1;  // at this step
  int parent = -1;
  int order = -1;
  int first = -1;    // order of all
  bool held = true;  // and it was the only one
};
bool ranksBefore(const Node& a, const Node& b) {
  return a.rank < b.rank;
}

// Nodes that are alike: to a metre, a quarter of a right angle, 0.8 m/s ahead and abeam.
std::uint64_t cellOf(const Hull& hull) {
  const auto part = [](double value, double step) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value / step)) & 0xFFF);
  };
  return part(hull.position.x(), 1.0) | part(hull.position.y(), 1.0) << 12U |
         part(wrapAngle(hull.psi_rad) + kPi, kPi / 8.0) << 24U | part(hull.surge_mps, 0.8) << 36U |
         part(hull.sway_mps, 0.8) << 48U;
}

}  // namespace

SpaceTimeSearch::SpaceTimeSearch(const vessel::Hull& hull, const Helmsman& helmsman, const Aim& aim,
                                 const Foretold& foretold, const map::DistanceField& still,
                                 const Hull& start)
    : helmsman_(helmsman),
      aim_(aim),
      foretold_(foretold),
      still_(still),
      discs_(hull),
      start_(start) {
  slack_least_m_ = std::min(kBesideM, slackAt(start) - 0.02);
  orders_.push_back({Order::Kind::kHome, {}});
  orders_.push_back({Order::Kind::kPark, {}});
  const double v = helmsman.speedMost();
  const double w = helmsman.turnMost();
  for (const double turn : {0.0, 0.35, -0.35, 1.0, -1.0}) {
    orders_.push_back({Order::Kind::kHelm, {v, turn * w}});
  }
  for (const double turn : {0.0, 0.6, -0.6}) {
    orders_.push_back({Order::Kind::kHelm, {0.5 * v, turn * w}});
  }
  for (const double turn : {0.0, 1.0, -1.0}) {
    orders_.push_back({Order::Kind::kHelm, {0.0, turn * w}});
  }
  for (const double turn : {0.0, 0.5, -0.5}) {
    orders_.push_back({Order::Kind::kHelm, {-0.6 * v, turn * w}});
  }
  orders_.push_back({Order::Kind::kHelm, {-v, 0.0}});
}

std::size_t SpaceTimeSearch::aimedAt(const Eigen::Vector2d& position) const {
  std::size_t best = 0;
  double least = kInfinity;
  for (std::size_t k = 0; k < aim_.points.size(); ++k) {
    const double left = (aim_.points[k] - position).norm() + aim_.left_m[k];
    if (left < least) {
      least = left;
      best = k;
    }
  }
  return best;
}

Helm SpaceTimeSearch::helmOf(const Order& order, const Hull& hull) const {
  if (order.kind == Order::Kind::kHelm) {
    return order.helm;
  }
  constexpr double kTurnPerS = 1.5;
  const double most = helmsman_.turnMost();
  const Eigen::Vector2d to = aim_.points[aimedAt(hull.position)] - hull.position;
  if (order.kind == Order::Kind::kHome) {
    // What drifts to the side is steered against.
    const Eigen::Vector2d v = hull.velocity();
    const Eigen::Vector2d wanted = helmsman_.speedMost() * to.normalized();
    const Eigen::Vector2d push = wanted + 0.5 * (wanted - v);
    const double off = wrapAngle(angleOf(push) - hull.psi_rad);
    const double ahead = std::max(0.2, std::cos(off));
    return {ahead * helmsman_.speedMost(), std::clamp(kTurnPerS * off, -most, most)};
  }
  const Eigen::Vector2d to_goal = aim_.goal.position - hull.position;
  const double distance = to_goal.norm();
  if (distance < kThereM) {
    const double off = wrapAngle(aim_.goal.psi_rad - hull.psi_rad);
    return {0.4 * hull.ahead.dot(to_goal), std::clamp(kTurnPerS * off, -most, most)};
  }
  const double off = wrapAngle(angleOf(to_goal) - hull.psi_rad);
  return {std::max(0.0, std::cos(off)) * std::min(helmsman_.speedMost(), kApproachPerS * distance),
          std::clamp(kTurnPerS * off, -most, most)};
}

double SpaceTimeSearch::left(const Hull& hull) const {
  const std::size_t k = aimedAt(hull.position);
  const Eigen::Vector2d to = aim_.points[k] - hull.position;
  const double distance = to.norm() + aim_.left_m[k];
  const double cruise = helmsman_.speedMost();
  const Eigen::Vector2d dir = to / std::max(1e-6, to.norm());
  const double wanted = std::min(cruise, kApproachPerS * distance);
  const Eigen::Vector2d lacks = wanted * dir - hull.velocity();
  // Getting up to speed, and turning before that.
  double seconds = distance / cruise + helmsman_.speedLag() * lacks.norm() / cruise;
  if (distance > kApproachM) {
    seconds += 0.5 * (1.0 - dir.dot(hull.ahead)) / helmsman_.turnMost();
  } else {
    seconds += std::max(0.0, 1.0 - distance / kApproachM) * 0.6 *
               std::abs(wrapAngle(aim_.goal.psi_rad - hull.psi_rad)) / helmsman_.turnMost();
  }
  return seconds;
}

bool SpaceTimeSearch::arrives(const Hull& hull) const {
  constexpr double kShare = 0.8;  // of what is allowed: it is not followed to the last bit
  return (hull.position - aim_.goal.position).norm() < kShare * aim_.arrival_m &&
         std::abs(wrapAngle(hull.psi_rad - aim_.goal.psi_rad)) < kShare * aim_.arrival_rad &&
         hull.velocity().norm() < kShare * vessel::kRestMps;
}

double SpaceTimeSearch::slackAt(const Hull& hull) const {
  const double reach = discs_.ahead_m + discs_.radius_m;
  const double centre = still_.clearance(hull.position);
  if (centre > reach + kRoomM) {
    return kRoomM;
  }
  const Eigen::Vector2d ahead = discs_.ahead_m * hull.ahead;
  return std::min(still_.clearance(hull.position + ahead),
                  still_.clearance(hull.position - ahead)) -
         discs_.radius_m;
}

double SpaceTimeSearch::priceAt(const Hull& hull, int k, const std::vector<int>& near,
                                Foretold::Nearness& worst) const {
  const double slack = slackAt(hull);
  if (slack < slack_least_m_) {
    return kInfinity;
  }
  double price = slack < kRoomM ? kNoRoomPerS * (1.0 - slack / kRoomM) : 0.0;
  double touched = 0.0;
  if (!near.empty()) {
    const Foretold::Nearness nearness = foretold_.at(hull.position, hull.ahead, k, near);
    const double soon = std::exp(-k * Foretold::kStepS / kThirdS);
    const double rises = std::max(0.0, nearness.danger - worst.danger);
    worst.gap_m = std::min(worst.gap_m, nearness.gap_m);
    worst.danger += rises;
    price += kSureContactS * nearness.danger * soon;
    touched = kTouchedS * rises * soon;
  }
  return Foretold::kStepS * price + touched;
}

SpaceTimeSearch::Way SpaceTimeSearch::find() const {
  std::vector<std::vector<Node>> layers;
  layers.reserve(kLayers.size() + 1);
  Node first;
  first.hull = start_;
  layers.push_back({first});
  std::vector<int> near;
  std::vector<Node> grown;
  std::unordered_set<std::uint64_t> taken;
  std::vector<std::size_t> of_each;
  int k0 = 0;
  for (const int steps : kLayers) {
    grown.clear();
    const std::vector<Node>& before = layers.back();
    for (std::size_t n = 0; n < before.size(); ++n) {
      const Node& node = before[n];
      foretold_.whoIsNear(node.hull.position, k0, steps, helmsman_.speedMost(), near);
      const bool near_goal = (node.hull.position - aim_.goal.position).norm() < 2.0 * kApproachM;
      for (std::size_t o = 0; o < orders_.size(); ++o) {
        const Order& order = orders_[o];
        const bool parks = order.kind == Order::Kind::kPark;
        if (parks ? !near_goal : node.arrived >= 0) {
          continue;
        }
        Node next = node;
        next.parent = static_cast<int>(n);
        next.order = static_cast<int>(o);
        next.first = node.first < 0 ? next.order : node.first;
        next.held = node.held && next.order == next.first;
        for (int s = 1; s <= steps; ++s) {
          constexpr double kHalfS = 0.5 * Foretold::kStepS;
          helmsman_.step(next.hull, helmOf(order, next.hull), kHalfS);
          helmsman_.step(next.hull, helmOf(order, next.hull), kHalfS);
          if (next.arrived >= 0) {
            continue;
          }
          next.price += priceAt(next.hull, k0 + s, near, next.worst);
          if (std::isinf(next.price)) {
            break;
          }
          next.arrived = arrives(next.hull) ? k0 + s : -1;
        }
        if (std::isinf(next.price)) {
          continue;
        }
        next.rank = next.price + (next.arrived < 0 ? left(next.hull) : leftArrived(next.arrived));
        grown.push_back(next);
      }
    }
    if (grown.empty()) {
      break;
    }
    std::stable_sort(grown.begin(), grown.end(), ranksBefore);
    // What begins in another way is kept though it seems worse: it may be the only way out.
    taken.clear();
    of_each.assign(orders_.size(), 0);
    std::vector<Node> kept;
    for (const Node& node : grown) {
      if (node.held) {
        kept.push_back(node);
        taken.insert(cellOf(node.hull));
      }
    }
    for (const std::size_t most : {kOfEach, kBeam}) {
      for (Node& node : grown) {
        std::size_t& count = of_each[static_cast<std::size_t>(node.first)];
        if (kept.size() >= kBeam) {
          break;
        }
        if (node.order >= 0 && count < most && taken.insert(cellOf(node.hull)).second) {
          kept.push_back(node);
          node.order = -1;
          ++count;
        }
      }
    }
    std::stable_sort(kept.begin(), kept.end(), ranksBefore);
    layers.push_back(std::move(kept));
    k0 += steps;
  }
  Way way;
  way.price = kInfinity;
  if (layers.size() < 2) {
    return way;
  }
  const Node& best = layers.back().front();
  way.price = best.rank;
  way.worst = best.worst;
  int index = 0;
  for (std::size_t l = layers.size() - 1; l > 0; --l) {
    const Node& node = layers[l][static_cast<std::size_t>(index)];
    way.legs.push_back(
        {orders_[static_cast<std::size_t>(node.order)], kLayers[l - 1] * Foretold::kStepS});
    index = node.parent;
  }
  std::reverse(way.legs.begin(), way.legs.end());
  return way;
}

}  // namespace otter_nav::encounter
