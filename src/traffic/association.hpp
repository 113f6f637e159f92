// Which detection is whose: joint integrated probabilistic data association (Musicki and Evans,
// Joint integrated probabilistic data association: JIPDA, IEEE TAES 2004).
#pragma once

#include <cstddef>
#include <vector>

namespace otter_nav::traffic {

// A detection that may be a track's, weighted against clutter: r P_D l / lambda.
struct Link {
  std::size_t detection = 0;
  double weight = 0.0;
};

// Each track's probability that none of the detections is its own, and that each of its links is.
struct Marginals {
  std::vector<double> none;
  std::vector<std::vector<double>> links;
};

// All ways in which detections are given out, no detection to two tracks: of each the product of
// its links' weights and of `none[t]` (1 - r P_D) for tracks without. Tracks that share no
// detection are dealt with apart.
[[nodiscard]] Marginals jointMarginals(const std::vector<double>& none,
                                       const std::vector<std::vector<Link>>& links,
                                       std::size_t detections);

}  // namespace otter_nav::traffic
