// Where the project's shipped files are (config/, maps/, rviz/).
#pragma once

#include <string>

#include "otter_nav/base/result.hpp"

namespace otter_nav::config {

// The environment variable OTTER_NAV_SHARE, else the installed package's share, else the source
// tree the program was built from: the first of them that holds config/vessels.
[[nodiscard]] Result<std::string> shareDirectory();

// A path as given if it exists, else the same below the share directory (`config/planner.yaml`).
[[nodiscard]] Result<std::string> findFile(const std::string& path);

// A file that may be named: a path as above, or the NAME of config/FOLDER/NAME.yaml.
[[nodiscard]] Result<std::string> presetFile(const std::string& folder,
                                             const std::string& name_or_path);

}  // namespace otter_nav::config
