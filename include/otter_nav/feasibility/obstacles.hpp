// What the hull must keep clear of, in space and time: the chart and the lidar's echoes as a
// distance field, and any number of further layers (things that move, soft keep-out areas). Const
// and thread-safe; the one interface through which topology, planner, optimizer, verifier and
// mission ask for clearance.
//
// Every clearance is a lower bound and 1-Lipschitz in the position: nothing is nearer than it says,
// so a walk along a path may advance by clearance / (speed + rateBound()).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <vector>

#include "otter_nav/map/distance_field.hpp"

namespace otter_nav::feasibility {

// One more kind of obstacle. Map frame, m; times in s on the mission's clock.
class ObstacleLayer {
 public:
  virtual ~ObstacleLayer() = default;
  // A lower bound of the distance from `position` to the layer's obstacles at `time_s`.
  [[nodiscard]] virtual double clearance(const Eigen::Vector2d& position, double time_s) const = 0;
  // The same for who has found something at `enough_m`: what is farther off may be told as anything
  // from there on.
  [[nodiscard]] virtual double clearanceWithin(const Eigen::Vector2d& position, double time_s,
                                               double /*enough_m*/) const {
    return clearance(position, time_s);
  }
  // The most by which a clearance at a fixed position may fall in a second, m/s.
  [[nodiscard]] virtual double rateBound() const = 0;
  // Smooth and signed, with its gradient, for optimisation. Not a bound.
  [[nodiscard]] virtual map::DistanceField::Smooth smooth(const Eigen::Vector2d& position,
                                                          double time_s) const = 0;
};

// Times count from `startingAt` on: whoever asks for a trajectory's clearance gets the obstacles
// starting where the trajectory does, and asks with the time from its start.
class Obstacles {
 public:
  // `field` and added layers are not owned and must outlive this.
  // NOLINTNEXTLINE(google-explicit-constructor): a field is the obstacles of still water.
  Obstacles(const map::DistanceField& field) : field_(&field) {}

  void add(const ObstacleLayer& layer) {
    layers_.push_back(&layer);
    rate_bound_mps_ = std::max(rate_bound_mps_, layer.rateBound());
  }

  // The same, with times that count from `start_s` of this one's.
  [[nodiscard]] Obstacles startingAt(double start_s) const {
    Obstacles later = *this;
    later.start_s_ += start_s;
    return later;
  }

  // A field in which what nobody has seen to be free is occupied as well; not owned either. Plans
  // go there on trust, stops never do.
  void setKnownWater(const map::DistanceField& known) { known_ = &known; }
  // The same in known water alone.
  [[nodiscard]] Obstacles inKnownWater() const {
    Obstacles known = *this;
    known.field_ = known_ != nullptr ? known_ : field_;
    return known;
  }

  // The same without the layers that move.
  [[nodiscard]] Obstacles lyingStill() const {
    Obstacles still = *this;
    still.layers_.clear();
    still.rate_bound_mps_ = 0.0;
    for (const ObstacleLayer* layer : layers_) {
      if (layer->rateBound() <= 0.0) {
        still.layers_.push_back(layer);
      }
    }
    return still;
  }
  // To the layers that move alone.
  [[nodiscard]] double movingClearance(const Eigen::Vector2d& position, double time_s) const {
    double least = std::numeric_limits<double>::infinity();
    for (const ObstacleLayer* layer : layers_) {
      if (layer->rateBound() > 0.0) {
        least = std::min(least, layer->clearanceWithin(position, start_s_ + time_s, least));
      }
    }
    return least;
  }

  // What lies still: for what has no time of its own (guide paths, windows of a search).
  [[nodiscard]] const map::DistanceField& field() const { return *field_; }
  [[nodiscard]] double rateBound() const { return rate_bound_mps_; }

  [[nodiscard]] double clearance(const Eigen::Vector2d& position, double time_s) const {
    double least = field_->clearance(position);
    for (const ObstacleLayer* layer : layers_) {
      least = std::min(least, layer->clearanceWithin(position, start_s_ + time_s, least));
    }
    return least;
  }

  [[nodiscard]] map::DistanceField::Smooth smooth(const Eigen::Vector2d& position,
                                                  double time_s) const {
    map::DistanceField::Smooth nearest = field_->smooth(position);
    for (const ObstacleLayer* layer : layers_) {
      const map::DistanceField::Smooth other = layer->smooth(position, start_s_ + time_s);
      if (other.distance_m < nearest.distance_m) {
        nearest = other;
      }
    }
    return nearest;
  }

 private:
  const map::DistanceField* field_;
  const map::DistanceField* known_ = nullptr;  // none: all of the water is known
  std::vector<const ObstacleLayer*> layers_;
  double rate_bound_mps_ = 0.0;
  double start_s_ = 0.0;
};

}  // namespace otter_nav::feasibility
