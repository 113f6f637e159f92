// Cycles of the optimal control problem for timing: a vessel on a circle at 3 m/s, the model being
// its own plant at 100 Hz.
#pragma once

#include "otter_nav/vessel/model.hpp"
#include "tracker/ocp/problem.hpp"

namespace otter_nav::benchmark {

enum class NmpcCase {
  kNominal,    // on the reference, a constant force known to the solver
  kSaturated,  // the reference steps sideways by 3 m each two seconds: bounds are active
};

class NmpcCycles {
 public:
  NmpcCycles(NmpcCase which, int stages, double horizon_s, const vessel::Parameters& vessel);

  [[nodiscard]] const tracker::OcpOptions& ocp() const { return ocp_; }
  [[nodiscard]] const vessel::Disturbance& disturbance() const { return disturbance_; }
  [[nodiscard]] const vessel::State& state() const { return state_; }
  // The reference of the present cycle.
  void fill(tracker::OcpReference& reference) const;
  // 10 ms under `thrusts`.
  void advance(const vessel::Thrusts& thrusts);
  [[nodiscard]] static double period() { return 0.01; }

 private:
  NmpcCase which_;
  vessel::Parameters vessel_;
  tracker::OcpOptions ocp_;
  vessel::Disturbance disturbance_;
  vessel::State state_;
  double time_s_ = 0.0;
};

}  // namespace otter_nav::benchmark
