#include "encounter/parting_ways.hpp"

#include <algorithm>
#include <utility>

namespace otter_nav::encounter {
namespace {

// Times that go on alike.
class Alike {
 public:
  explicit Alike(Told leads)
      : leads_(std::move(leads)),
        sums_(leads_.places.size(), Eigen::Vector2d::Zero()),
        weights_(leads_.places.size(), 0.0) {
    add(leads_, leads_.places.size());
  }

  [[nodiscard]] double likely() const { return likely_; }
  // As far as it is known.
  [[nodiscard]] bool isLike(const Told& told) const {
    constexpr double kAlikeM = 4.0;
    for (std::size_t k = 0; k < told.known; ++k) {
      if ((told.places[k] - leads_.places[k]).norm() > kAlikeM) {
        return false;
      }
    }
    return true;
  }
  void join(const Told& told) { add(told, told.known); }
  // Of one of the times, and not of their mean: what cuts a corner does so each time.
  [[nodiscard]] double variance() const { return times_ / certainty_; }
  [[nodiscard]] std::vector<Eigen::Vector2d> mean() const {
    std::vector<Eigen::Vector2d> mean = sums_;
    for (std::size_t k = 0; k < mean.size(); ++k) {
      mean[k] /= weights_[k];
    }
    return mean;
  }

 private:
  void add(const Told& told, std::size_t places) {
    constexpr double kLeastM2 = 0.04;
    constexpr double kLeastVarianceM2 = 1e-4;
    const double weight = 1.0 / (kLeastM2 + told.variance_m2);
    for (std::size_t k = 0; k < places; ++k) {
      sums_[k] += weight * told.places[k];
      weights_[k] += weight;
    }
    likely_ += told.likely;
    times_ += 1.0;
    certainty_ += 1.0 / std::max(kLeastVarianceM2, told.variance_m2);
  }

  Told leads_;
  std::vector<Eigen::Vector2d> sums_;
  std::vector<double> weights_;
  double likely_ = 0.0;
  double times_ = 0.0;
  double certainty_ = 0.0;
};

}  // namespace

std::vector<Way> partingWays(std::vector<Told> told) {
  constexpr std::size_t kMost = 3;
  constexpr double kLeastShare = 0.1;
  // Those that tell most lead: what breaks off says nothing of how she goes on then.
  std::stable_sort(told.begin(), told.end(), [](const Told& a, const Told& b) {
    return a.known != b.known ? a.known > b.known : a.likely > b.likely;
  });
  std::vector<Alike> all;
  double likely = 0.0;
  for (Told& one : told) {
    likely += one.likely;
    const auto like =
        std::find_if(all.begin(), all.end(), [&](const Alike& alike) { return alike.isLike(one); });
    if (like != all.end()) {
      like->join(one);
    } else {
      all.emplace_back(std::move(one));
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Alike& a, const Alike& b) { return a.likely() > b.likely(); });
  std::vector<Way> ways;
  double shares = 0.0;
  for (const Alike& alike : all) {
    const double share = alike.likely() / likely;
    if (ways.size() == kMost || (!ways.empty() && share < kLeastShare)) {
      break;
    }
    ways.push_back({alike.mean(), share, alike.variance()});
    shares += share;
  }
  for (Way& way : ways) {
    way.share /= shares;
  }
  return ways;
}

}  // namespace otter_nav::encounter
