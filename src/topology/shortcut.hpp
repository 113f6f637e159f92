// Shortens a path: vertices dropped, pulled inwards and cut until the length no longer falls, so
// that it is near the shortest of its kind (of those that pass obstacles on the same sides).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "otter_nav/map/distance_field.hpp"

namespace otter_nav::topology {

using Polyline = std::vector<Eigen::Vector2d>;

class Shortener {
 public:
  // Every segment of `path` must keep the clearance, and does afterwards. Ends stay.
  void run(const map::DistanceField& field, double clearance_m, Polyline& path);

 private:
  void shortcut(Polyline& path);
  void pull(Polyline& path) const;
  void cut(Polyline& path);
  [[nodiscard]] bool clear(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;

  const map::DistanceField* field_ = nullptr;
  double clearance_m_ = 0.0;
  Polyline scratch_;
};

}  // namespace otter_nav::topology
