#include "otter_nav/planner/options.hpp"

#include "otter_nav/planner/search.hpp"

namespace otter_nav::planner {
namespace {

// One file through a room's reader: its root, or the mapping `key` of it.
template <typename Reader>
auto loadWith(const std::string& path, const std::string& key, const Reader& reader)
    -> decltype(reader(config::Section(YAML::Node(), ""))) {
  const auto root = config::loadFile(path);
  if (!root) {
    return failure(root.error().message);
  }
  if (key.empty()) {
    return reader(config::Section(*root, path));
  }
  if (!root->IsMap() || !(*root)[key]) {
    return failure(path + ": no mapping '" + key + "'");
  }
  return reader(config::Section((*root)[key], path + ": " + key));
}

}  // namespace

Result<Options> readOptions(config::Section section) {
  Options o;
  section.read("clearance_m", o.clearance_m, {0.0, 20.0});
  section.read("clearance_margin_m", o.clearance_margin_m, {0.0, 5.0});
  section.read("sigma", o.sigma, {1e-3, 1e3});
  section.read("speed_share", o.speed_share, {0.1, 1.0});
  section.read("force_share", o.force_share, {0.1, 1.0});
  section.read("sample_speed_share", o.sample_speed_share, {0.05, 1.0});
  section.read("sample_accel_mps2", o.sample_accel_mps2, {0.0, 5.0});
  section.read("key_spacing_m", o.key_spacing_m, {1.0, 50.0});
  section.read("uniform_share", o.uniform_share, {0.0, 1.0});
  section.read("corridor_m", o.corridor_m, {0.5, 50.0});
  section.read("edge_max_m", o.edge_max_m, {5.0, 200.0});
  section.read("neighbours", o.neighbours, {1, kMaxNeighbours});
  section.read("max_nodes", o.max_nodes, {16, 100000});
  section.read("improve_samples", o.improve_samples, {0, 100000});
  section.read("attempt_samples", o.attempt_samples, {10, 100000});
  section.read("max_attempts", o.max_attempts, {1, 100});
  section.read("improve_attempts", o.improve_attempts, {0, 1000});
  section.read("local_optimization", o.local_optimization);
  section.read("global_optimization", o.global_optimization);
  section.read("keep_trees", o.keep_trees);
  if (auto status = section.finish(); !status) {
    return failure(status.error().message);
  }
  return o;
}

Result<Options> loadOptions(const std::string& folder) {
  auto options = loadWith(folder + "/planner.yaml", "", readOptions);
  if (!options) {
    return options;
  }
  const auto topology = loadWith(folder + "/topology.yaml", "",
                                 [](const config::Section& s) { return topology::readOptions(s); });
  const auto local = loadWith(folder + "/optimizer.yaml", "local", [](const config::Section& s) {
    return optimizer::readLocalOptions(s);
  });
  const auto global = loadWith(folder + "/optimizer.yaml", "global", [](const config::Section& s) {
    return optimizer::readGlobalOptions(s);
  });
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
