// The vessels that ship, by the names of their files.
#pragma once

#include <string>

#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::plant::test {

inline vessel::Parameters vesselOf(const std::string& name) {
  return vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/" + name +
                                ".yaml")
      .value();
}

}  // namespace otter_nav::plant::test
