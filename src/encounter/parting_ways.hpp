// What each of several times tells of how somebody goes on, made few ways: times that go on alike
// are one, each off by itself; where they part each way may be hers.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace otter_nav::encounter {

// One time that somebody went there.
struct Told {
  std::vector<Eigen::Vector2d> places;  // at even times
  std::size_t known = 0;                // so many of them; the others are straight ahead
  double variance_m2 = 0.0;             // of the known ones, each axis
  double likely = 0.0;                  // that she is on it, beside the others'
};

struct Way {
  std::vector<Eigen::Vector2d> places;
  double share = 0.0;        // how probable it is among the ways
  double variance_m2 = 0.0;  // of the places where they are known, each axis
};

// The likeliest first; their shares make one. All must have as many places.
[[nodiscard]] std::vector<Way> partingWays(std::vector<Told> told);

}  // namespace otter_nav::encounter
