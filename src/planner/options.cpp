#include "otter_nav/planner/options.hpp"

#include "otter_nav/config/fields.hpp"

namespace otter_nav::planner {
namespace {

// The mapping `key` of a file, by a room's reader.
template <typename Reader>
auto loadMapping(const std::string& path, const std::string& key, const Reader& reader)
    -> decltype(reader(config::Section(YAML::Node(), ""))) {
  const auto root = config::loadFile(path);
  if (!root) {
    return failure(root.error().message);
  }
  if (!root->IsMap() || !(*root)[key]) {
    return failure(path + ": no mapping '" + key + "'");
  }
  return reader(config::Section((*root)[key], path + ": " + key));
}

}  // namespace

Result<Options> loadOptions(const std::string& folder) {
  auto options = config::load<Options>(folder + "/planner.yaml");
  if (!options) {
    return options;
  }
  const auto topology = config::load<topology::Options>(folder + "/topology.yaml");
  const auto local = loadMapping(
      folder + "/optimizer.yaml", "local",
      [](const config::Section& section) { return optimizer::readLocalOptions(section); });
  const auto global = loadMapping(
      folder + "/optimizer.yaml", "global",
      [](const config::Section& section) { return optimizer::readGlobalOptions(section); });
  if (!topology) {
    return failure(topology.error().message);
  }
  if (!local) {
    return failure(local.error().message);
  }
  if (!global) {
    return failure(global.error().message);
  }
  options->topology = *topology;
  options->local = *local;
  options->global = *global;
  return options;
}

}  // namespace otter_nav::planner
