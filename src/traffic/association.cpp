#include "association.hpp"

#include <algorithm>
#include <numeric>

namespace otter_nav::traffic {
namespace {

// More than this many ways to give out detections: only each track's best links are kept.
constexpr double kMostEvents = 20000.0;
constexpr std::size_t kFewLinks = 2;

// Tracks that share detections, directly or through others.
std::vector<std::vector<std::size_t>> groupsOf(const std::vector<std::vector<Link>>& links,
                                               std::size_t detections) {
  std::vector<std::size_t> root(links.size() + detections);
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t k) {
    while (root[k] != k) {
      k = root[k] = root[root[k]];
    }
    return k;
  };
  for (std::size_t t = 0; t < links.size(); ++t) {
    for (const Link& link : links[t]) {
      root[find(t)] = find(links.size() + link.detection);
    }
  }
  std::vector<std::vector<std::size_t>> by_root(root.size());
  for (std::size_t t = 0; t < links.size(); ++t) {
    by_root[find(t)].push_back(t);
  }
  by_root.erase(std::remove_if(by_root.begin(), by_root.end(),
                               [](const auto& group) { return group.empty(); }),
                by_root.end());
  return by_root;
}

class Enumeration {
 public:
  Enumeration(const std::vector<double>& none, const std::vector<std::vector<Link>>& links,
              std::size_t detections, Marginals& out)
      : none_(none), links_(links), used_(detections, false), out_(out) {}

  void run(const std::vector<std::size_t>& group) {
    group_ = &group;
    double events = 1.0;
    for (const std::size_t t : group) {
      events *= static_cast<double>(links_[t].size() + 1);
    }
    limit_ = events > kMostEvents ? kFewLinks : static_cast<std::size_t>(-1);
    const double sum = visit(0, 1.0);
    for (const std::size_t t : group) {
      out_.none[t] /= sum;
      for (double& link : out_.links[t]) {
        link /= sum;
      }
    }
  }

 private:
  // The sum over all that can follow; every event adds itself to the marginals it belongs to.
  double visit(std::size_t place, double product) {
    if (place == group_->size()) {
      return product;
    }
    const std::size_t t = (*group_)[place];
    const double without = visit(place + 1, product * none_[t]);
    out_.none[t] += without;
    double sum = without;
    for (std::size_t k = 0; k < std::min(links_[t].size(), limit_); ++k) {
      const Link& link = links_[t][k];
      if (used_[link.detection]) {
        continue;
      }
      used_[link.detection] = true;
      const double with = visit(place + 1, product * link.weight);
      used_[link.detection] = false;
      out_.links[t][k] += with;
      sum += with;
    }
    return sum;
  }

  const std::vector<double>& none_;
  const std::vector<std::vector<Link>>& links_;
  std::vector<bool> used_;
  Marginals& out_;
  const std::vector<std::size_t>* group_ = nullptr;
  std::size_t limit_ = 0;
};

}  // namespace

Marginals jointMarginals(const std::vector<double>& none,
                         const std::vector<std::vector<Link>>& links, std::size_t detections) {
  Marginals out;
  out.none.assign(none.size(), 0.0);
  for (const std::vector<Link>& of_track : links) {
    out.links.emplace_back(of_track.size(), 0.0);
  }
  Enumeration enumeration(none, links, detections, out);
  for (const std::vector<std::size_t>& group : groupsOf(links, detections)) {
    enumeration.run(group);
  }
  return out;
}

}  // namespace otter_nav::traffic
