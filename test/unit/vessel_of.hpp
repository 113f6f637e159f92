// The vessels that ship, by the names of their files.
#pragma once

#include <string>

#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::vessel::test {

inline Parameters vesselOf(const std::string& name) {
  return loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/" + name + ".yaml")
      .value();
}

}  // namespace otter_nav::vessel::test
