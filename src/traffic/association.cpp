#include "association.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace otter_nav::traffic {
namespace {

// More than this many ways to give out detections in a group, and weak links are left out, those
// first that are below a thousandth of a track's best, then more: where many pass close by, one in
// a chain of improbable links would tie all of them together.
constexpr double kMostEvents = 2000.0;
constexpr double kWeak[] = {0.0, 1e-3, 1e-2, 0.1, 0.5, 1.0};

using Groups = std::vector<std::vector<std::size_t>>;

// Of `tracks`, those that share detections, directly or through others.
Groups groupsOf(const std::vector<std::size_t>& tracks, const std::vector<std::vector<Link>>& links,
                std::size_t detections) {
  std::vector<std::size_t> root(links.size() + detections);
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t k) {
    while (root[k] != k) {
      k = root[k] = root[root[k]];
    }
    return k;
  };
  for (const std::size_t t : tracks) {
    for (const Link& link : links[t]) {
      if (link.weight > 0.0) {
        root[find(t)] = find(links.size() + link.detection);
      }
    }
  }
  Groups by_root(root.size());
  for (const std::size_t t : tracks) {
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
    for (std::size_t k = 0; k < links_[t].size(); ++k) {
      const Link& link = links_[t][k];
      if (used_[link.detection] || link.weight <= 0.0) {
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
};

double eventsOf(const std::vector<std::size_t>& group,
                const std::vector<std::vector<Link>>& links) {
  double events = 1.0;
  for (const std::size_t t : group) {
    events *=
        1.0 + static_cast<double>(std::count_if(links[t].begin(), links[t].end(),
                                                [](const Link& l) { return l.weight > 0.0; }));
  }
  return events;
}

// Links that are weak beside the track's best one no longer count; the best one always does.
void leaveOutWeak(std::vector<Link>& links, double weak) {
  double best = 0.0;
  for (const Link& link : links) {
    best = std::max(best, link.weight);
  }
  for (Link& link : links) {
    link.weight = link.weight < weak * best ? 0.0 : link.weight;
  }
}

}  // namespace

Marginals jointMarginals(const std::vector<double>& none,
                         const std::vector<std::vector<Link>>& links, std::size_t detections) {
  Marginals out;
  out.none.assign(none.size(), 0.0);
  for (const std::vector<Link>& of_track : links) {
    out.links.emplace_back(of_track.size(), 0.0);
  }
  std::vector<std::vector<Link>> kept = links;
  Enumeration enumeration(none, kept, detections, out);
  std::vector<std::size_t> left(links.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  for (const double weak : kWeak) {
    for (const std::size_t t : left) {
      leaveOutWeak(kept[t], weak);
    }
    std::vector<std::size_t> tied;
    for (const std::vector<std::size_t>& group : groupsOf(left, kept, detections)) {
      if (weak < 1.0 && eventsOf(group, kept) > kMostEvents) {
        tied.insert(tied.end(), group.begin(), group.end());
      } else {
        enumeration.run(group);
      }
    }
    left = std::move(tied);
  }
  return out;
}

}  // namespace otter_nav::traffic
