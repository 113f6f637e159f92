// A trajectory as a table, for checks from outside.
#pragma once

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::benchmark {

// CSV with a row each 0.02 s and one at the last instant: t,x,y,psi,u,v,r,tau_u,tau_r (s, m, rad,
// m/s, rad/s, N, N m; ENU, psi in [-pi, pi]).
[[nodiscard]] Status dumpTrajectory(const trajectory::Trajectory& trajectory,
                                    const vessel::Parameters& vessel, const std::string& path);

}  // namespace otter_nav::benchmark
