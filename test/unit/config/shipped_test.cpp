// The shipped files against the structs that read them, and docs/parameters.md against both. After
// a change of a parameter: OTTER_NAV_REFRESH=1 ctest --test-dir build -R unit_config
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "field_table.hpp"
#include "nodes/map_node_options.hpp"
#include "nodes/map_options.hpp"
#include "nodes/mission_node_options.hpp"
#include "nodes/planner_node_options.hpp"
#include "nodes/plant_node_options.hpp"
#include "nodes/tracker_node_options.hpp"
#include "nodes/traffic_node_options.hpp"
#include "otter_nav/identification/identify.hpp"
#include "otter_nav/map/occupancy_map.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/planner/options.hpp"
#include "otter_nav/plant/options.hpp"
#include "otter_nav/tracker/options.hpp"
#include "otter_nav/traffic/tracker.hpp"

namespace otter_nav::config {
namespace {

const std::filesystem::path kSource = OTTER_NAV_SOURCE_DIR;

// Beside its options the file names whose they are.
struct MissionFile {
  mission::SupervisorOptions supervisor;
  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields.group("supervisor", o.supervisor, "");
  }
};

// A file of config/ and the struct it is read into.
struct Shipped {
  std::string file;
  Result<std::string> (*read)(const std::string& path);  // then written again
  std::string defaults;
  std::string table;
};

template <typename Options>
Result<std::string> readAndWrite(const std::string& path) {
  return load<Options>(path).map([](const Options& options) { return toYaml(options); });
}

template <typename Options>
Shipped shipped(const std::string& file) {
  const Options defaults;
  FieldTable table;
  Options::describe(defaults, table);
  return {file, readAndWrite<Options>, toYaml(defaults), table.rows()};
}

std::vector<Shipped> allShipped() {
  return {
      shipped<map::OccupancyMapOptions>("map.yaml"),
      shipped<topology::Options>("topology.yaml"),
      shipped<planner::Options>("planner.yaml"),
      shipped<MissionFile>("mission.yaml"),
      shipped<tracker::Options>("tracker.yaml"),
      shipped<plant::Options>("plant.yaml"),
      shipped<traffic::Options>("traffic.yaml"),
      shipped<identification::Options>("identification.yaml"),
      shipped<nodes::MapNodeOptions>("map_node.yaml"),
      shipped<nodes::TopologyNodeOptions>("topology_node.yaml"),
      shipped<nodes::PlannerNodeOptions>("planner_node.yaml"),
      shipped<nodes::TrackerNodeOptions>("tracker_node.yaml"),
      shipped<nodes::PlantNodeOptions>("plant_node.yaml"),
      shipped<nodes::TrafficNodeOptions>("traffic_node.yaml"),
      shipped<nodes::MissionNodeOptions>("mission_node.yaml"),
  };
}

TEST(ShippedConfig, IsWhatTheStructsDefaultTo) {
  for (const Shipped& s : allShipped()) {
    const Result<std::string> read = s.read((kSource / "config" / s.file).string());
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, s.defaults) << s.file;
  }
}

// A list of any length, like the manoeuvres, is one key.
std::size_t leafKeys(const YAML::Node& node) {
  if (!node.IsMap()) {
    return 1;
  }
  std::size_t keys = 0;
  for (const auto& entry : node) {
    keys += leafKeys(entry.second);
  }
  return keys;
}

// Whatever has to be set by hand has to be understood: a new key takes the place of another.
TEST(ShippedConfig, HasFewerThan140Keys) {
  std::size_t keys = 0;
  std::size_t described = 1;  // excitation.yaml is a list of manoeuvres, read elsewhere
  for (const auto& entry : std::filesystem::directory_iterator(kSource / "config")) {
    keys += entry.path().extension() == ".yaml" ? leafKeys(YAML::LoadFile(entry.path())) : 0;
  }
  for (const Shipped& s : allShipped()) {
    described += leafKeys(YAML::LoadFile(kSource / "config" / s.file));
  }
  EXPECT_LT(keys, 140U);
  EXPECT_EQ(keys, described) << "a file of config/ that no struct above describes";
}

TEST(ShippedConfig, IsDocumented) {
  std::string text =
      "# Parameters\n\nWhat can be set, by file of `config/`; generated from the "
      "structs that read them. `excitation.yaml` is a list of manoeuvres, which it explains "
      "itself.\n";
  for (const Shipped& s : allShipped()) {
    text += "\n## " + s.file + "\n| key | default | range | effect |\n| --- | --- | --- | --- |\n" +
            s.table;
  }
  const std::filesystem::path path = kSource / "docs" / "parameters.md";
  if (std::getenv("OTTER_NAV_REFRESH") != nullptr) {
    std::ofstream(path) << text;
  }
  std::ifstream file(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), text)
      << "refresh it: OTTER_NAV_REFRESH=1 ctest -R unit_config";
}

}  // namespace
}  // namespace otter_nav::config
