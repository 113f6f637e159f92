#include "hoerner.hpp"

#include <algorithm>
#include <array>

namespace otter_nav::plant {
namespace {

struct Point {
  double slenderness;  // B / 2T
  double drag;
};

constexpr std::array<Point, 20> kCurve{
    {{0.0108623, 1.96608}, {0.176606, 1.96573}, {0.353025, 1.89756},  {0.451863, 1.78718},
     {0.472838, 1.58374},  {0.492877, 1.27862}, {0.493252, 1.21082},  {0.558473, 1.08356},
     {0.646401, 0.998631}, {0.833589, 0.87959}, {0.988002, 0.828415}, {1.30807, 0.759941},
     {1.63918, 0.691442},  {1.85998, 0.657076}, {2.31288, 0.630693},  {2.59998, 0.596186},
     {3.00877, 0.586846},  {3.45075, 0.585909}, {3.7379, 0.559877},   {4.00309, 0.559315}}};

}  // namespace

double hoernerDrag(double beam_m, double draft_m) {
  const double s = beam_m / (2.0 * draft_m);
  const auto above = std::lower_bound(kCurve.begin(), kCurve.end(), s,
                                      [](const Point& p, double x) { return p.slenderness < x; });
  if (above == kCurve.begin()) {
    return kCurve.front().drag;
  }
  if (above == kCurve.end()) {
    return kCurve.back().drag;
  }
  const Point& left = *(above - 1);
  const double share = (s - left.slenderness) / (above->slenderness - left.slenderness);
  return left.drag + share * (above->drag - left.drag);
}

}  // namespace otter_nav::plant
