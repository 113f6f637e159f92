// What a decision is made on.
#pragma once

#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/mission/supervisor.hpp"

namespace otter_nav::mission {

struct Moment {
  double now_s;
  const Situation& situation;
  const feasibility::Obstacles& obstacles;
};

}  // namespace otter_nav::mission
