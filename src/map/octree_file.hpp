// OctoMap's files, looked through before OctoMap reads them: its readers recurse without end on
// truncated ones.
#pragma once

#include <octomap/OcTree.h>

#include <memory>
#include <string>

#include "otter_nav/base/result.hpp"

namespace otter_nav::map {

// A .bt (binary) or .ot (full) file of an OcTree; the error names the file and what is wrong.
[[nodiscard]] Result<std::unique_ptr<octomap::OcTree>> readOctree(const std::string& path);

}  // namespace otter_nav::map
