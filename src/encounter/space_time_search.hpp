// A search in space and time for a way among many who move: what the helm is told in the next
// seconds, such that the goal comes nearer and nobody does.
//
// A beam search: from each state kept, every order to the helm is followed for a while by the
// hull's own motion (helmsman.hpp), slowing down, stopping, turning on the spot and going astern
// among them; the best of what comes of it are kept, of those that are alike one. The price in
// seconds: how probable contact is along the way, sooner counting more, for later there is another
// decision; and what is left to the goal.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "encounter/foretold.hpp"
#include "encounter/helmsman.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::encounter {

// What is told to the helm and for how long.
struct Order {
  enum class Kind { kHelm, kHome, kPark };
  Kind kind = Kind::kHelm;
  Helm helm;  // of kHelm; the others steer by what they see
};

// Where the search leads: points of the way to the goal that can be reached straight from here,
// the farthest first, and what is left of the way from each.
struct Aim {
  std::vector<Eigen::Vector2d> points;
  std::vector<double> left_m;
  vessel::Pose goal;
  double arrival_m = 0.0;  // from the goal, at rest: what comes then is no matter of the search's
  double arrival_rad = 0.0;
};

class SpaceTimeSearch {
 public:
  static constexpr double kHorizonS = 8.4;

  // From `start`, at the foretold's first step. What is handed over must outlive this.
  SpaceTimeSearch(const vessel::Hull& hull, const Helmsman& helmsman, const Aim& aim,
                  const Foretold& foretold, const map::DistanceField& still, const Hull& start);

  struct Leg {
    Order order;
    double duration_s = 0.0;
  };
  struct Way {
    std::vector<Leg> legs;
    double price = 0.0;        // s
    Foretold::Nearness worst;  // the least gap, the most danger on the way
  };
  [[nodiscard]] Way find() const;

  // What the helm is told at a moment of an order.
  [[nodiscard]] Helm helmOf(const Order& order, const Hull& hull) const;
  // What is left from a state, s, as the price counts it.
  [[nodiscard]] double left(const Hull& hull) const;
  // Whether it is over there. What is left then, at step k: less the sooner it is, for the horizon
  // goes on.
  [[nodiscard]] bool arrives(const Hull& hull) const;
  [[nodiscard]] static double leftArrived(int k) { return k * Foretold::kStepS - kHorizonS; }
  // The price of being there at step k for one step, `worst` being what was on the way until then;
  // infinite where something lies.
  [[nodiscard]] double priceAt(const Hull& hull, int k, const std::vector<int>& near,
                               Foretold::Nearness& worst) const;

 private:
  [[nodiscard]] double slackAt(const Hull& hull) const;
  [[nodiscard]] std::size_t aimedAt(const Eigen::Vector2d& position) const;

  const Helmsman& helmsman_;
  const Aim& aim_;
  const Foretold& foretold_;
  const map::DistanceField& still_;
  HullDiscs discs_;
  Hull start_;
  double slack_least_m_ = 0.0;  // off what lies still; less where it begins with less
  std::vector<Order> orders_;
};

}  // namespace otter_nav::encounter
