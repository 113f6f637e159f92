// The tracker's optimal control problem (paper, section V-B):
//
//   min  sum_{k<N} 1/2 c_k |x_k - xr_k|_Q^2 + 1/2 |F_k - Fr_k|_R^2  +  1/2 c_N |x_N - xr_N|_QN^2
//   s.t. x_0 measured, x_{k+1} = RK4(x_k, F_k), lower <= F_k <= upper
//
// c_k is 1, but falls along the horizon where it is hardly foreseen what will push the hull: else
// the hull is set off now against where it is thought to be carried later.
//
// Position errors e cost far_m^2 (sqrt(1 + (e / far_m)^2) - 1) times their weight instead
// (Charbonnier's loss): as e^2 / 2 when near, in proportion when far, so that a vessel blown off
// its path does not make the problem ever stiffer. x and y weigh alike, but for errors abeam that a
// reference at rest leaves free.
#pragma once

#include <array>
#include <limits>

#include "otter_nav/tracker/limits.hpp"
#include "otter_nav/tracker/near_obstacles.hpp"
#include "otter_nav/vessel/types.hpp"
#include "tracker/ocp/hull_room.hpp"
#include "tracker/qp/box_qp.hpp"

namespace otter_nav::tracker {

// Q, R and QN as they stand in the sum above.
struct OcpWeights {
  vessel::State state = vessel::State::Ones();
  vessel::State terminal = vessel::State::Ones();
  vessel::Thrusts thrusts = vessel::Thrusts::Ones();
};

struct OcpOptions {
  int stages = 20;
  double step_s = 0.1;
  OcpWeights weights;
  vessel::Thrusts lower_n = vessel::Thrusts::Constant(-50.0);
  vessel::Thrusts upper_n = vessel::Thrusts::Constant(50.0);
  double far_m = 1e3;
  double overspeed = 3e4;   // per (m/s)^2 and second, as the weights before their step
  double astray = 400.0;    // per rad^2 and second, of a heading outside its corridor
  double crowded = 1e4;     // per m^2 and second, of what is missing beside the outline
  double room_m = 0.25;     // that counts there, where the reference has so much
  double crowded_s = 2.0;   // how far ahead; what comes into sight farther off is the planner's
  double free_share = 0.3;  // of the position's weight, within what the reference leaves free
  double length_m = 0.0;    // of the hull
  double beam_m = 0.0;
};

// Headings that are to be kept to, whatever the reference says.
struct HeadingCorridor {
  double psi_rad = 0.0;
  double half_width_rad = std::numeric_limits<double>::infinity();
  bool is_sterns = false;  // they are those with the stern to the wind
};

// psi of all states is continuous along the horizon and near the measured one. `attitude` in [0, 1]
// scales the weights of a stage's heading, surge and sway: how far the reference means them.
struct OcpReference {
  OcpReference() {
    attitude.fill(1.0);
    speed_max_mps.fill(std::numeric_limits<double>::infinity());
  }

  std::array<vessel::State, kMaxStages + 1> states;
  std::array<double, kMaxStages + 1> attitude;
  std::array<double, kMaxStages + 1> speed_max_mps;  // over ground; beyond it costs
  std::array<vessel::Thrusts, kMaxStages> thrusts;
  HeadingCorridor corridor;
  double fading_per_s = 0.0;            // c falls so fast, by itself
  double free_abeam_m = 0.0;            // from the bow's line to either side: not worth turning for
  const NearObstacles* near = nullptr;  // to keep off; none: nothing is known to be near
};

// States and thrusts over the horizon.
struct Plan {
  std::array<vessel::State, kMaxStages + 1> states;
  std::array<vessel::Thrusts, kMaxStages> thrusts;
};

// c_k Q of a stage's state, c_N QN of the last, as far as the reference means attitude and speed.
[[nodiscard]] vessel::State stateWeights(const OcpOptions& options, const OcpReference& reference,
                                         int stage);

// What the loss above leaves of the position's weight at an error, 0 to 1.
[[nodiscard]] double nearness(const vessel::State& x, const vessel::State& reference, double far_m);

class ControlProblem {
 public:
  explicit ControlProblem(const OcpOptions& options);

  [[nodiscard]] const OcpOptions& options() const { return options_; }
  void setWeights(const OcpWeights& weights) { options_.weights = weights; }
  // Narrows each stage's bounds to what the thrusts can reach by its middle from `acting` at
  // `rate_nps`. The differences between later stages stay free: the tube holds all plans that keep
  // the rate, and the first stage, the one that is commanded, keeps it. A box, so the problem keeps
  // its shape.
  void limitRates(const vessel::Thrusts& acting, double rate_nps);
  [[nodiscard]] vessel::Thrusts clampToBounds(int stage, const vessel::Thrusts& thrusts) const;
  // Gauss and Newton's quadratic costs about `plan`, and the bounds seen from it.
  void expand(const Plan& plan, const OcpReference& reference, qp::BoxQp& qp) const;

 private:
  // The position's weight as a share of the one in the options, in the earth frame.
  [[nodiscard]] Eigen::Matrix2d positionShare(const vessel::State& state,
                                              const vessel::State& reference,
                                              double free_abeam_m) const;
  void keepOff(const vessel::State& state, const vessel::State& reference,
               const NearObstacles& near, qp::StateCost& cost) const;

  OcpOptions options_;
  HullRoom hull_;
  std::array<vessel::Thrusts, kMaxStages> lower_;
  std::array<vessel::Thrusts, kMaxStages> upper_;
};

}  // namespace otter_nav::tracker
