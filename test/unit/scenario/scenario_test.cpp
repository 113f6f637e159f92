#include "otter_nav/scenario/scenario.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "../mission/waters.hpp"

namespace otter_nav::scenario {
namespace {

namespace fs = std::filesystem;

class ScenarioFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / (std::string("otter_nav_scenario_") + info->name());
    fs::create_directories(folder_);
    std::ofstream(folder_ / "c.yaml") << "image: c.pgm\n";
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& text) {
    const fs::path path = folder_ / "test.yaml";
    std::ofstream(path) << text;
    return path.string();
  }
  // The message must name what is wrong.
  void expectError(const std::string& text, const std::string& offender) {
    const auto scenario = loadScenario(write(text));
    ASSERT_FALSE(scenario.has_value()) << text;
    EXPECT_NE(scenario.error().message.find(offender), std::string::npos)
        << scenario.error().message;
  }

  fs::path folder_;
};

const char* const kHead = "chart: c.yaml\nworld: c.yaml\n";
const char* const kMission =
    "missions:\n  - {kind: local, start: [1, 2, 0.5], goal: [3.5, -4, -1]}\n";

TEST_F(ScenarioFile, LoadsWhatItSays) {
  const auto scenario = loadScenario(write(std::string(kHead) + kMission));
  ASSERT_TRUE(scenario.has_value()) << scenario.error().message;
  EXPECT_EQ(scenario->name, "test");
  EXPECT_EQ(scenario->chart_path, (folder_ / "c.yaml").string());
  ASSERT_EQ(scenario->missions.size(), 1U);
  EXPECT_EQ(scenario->missions[0].kind, "local");
  EXPECT_EQ(scenario->missions[0].goal.position, Eigen::Vector2d(3.5, -4.0));
  EXPECT_EQ(scenario->missions[0].start.psi_rad, 0.5);
  EXPECT_FALSE(missionOf(*scenario, 1).has_value());
  EXPECT_FALSE(missionOf(*scenario, -1).has_value());
  EXPECT_TRUE(missionOf(*scenario, 0).has_value());
}

TEST_F(ScenarioFile, IsFoundInAFolderAmongMaps) {
  fs::create_directory(folder_ / "folder.yaml");
  EXPECT_FALSE(scenarioFiles(folder_.string()).has_value());  // only maps, and a folder
  EXPECT_FALSE(scenarioFiles((folder_ / "none").string()).has_value());
  const std::string path = write("missions: broken");
  EXPECT_EQ(scenarioFiles(folder_.string()).value(), std::vector<std::string>{path});
  EXPECT_EQ(scenarioFiles(path).value(), std::vector<std::string>{path});
}

TEST_F(ScenarioFile, NamesWhatIsWrong) {
  const std::string head = kHead;
  expectError("world: c.yaml\n" + std::string(kMission), "'chart'");
  expectError("chart: none.yaml\nworld: c.yaml\n" + std::string(kMission), "none.yaml");
  expectError(head, "'missions'");
  expectError(head + "missions: []\n", "'missions'");
  expectError(head + "missions: 3\n", "'missions'");
  expectError(head + "extra: 1\n" + kMission, "'extra'");
  expectError(head + "missions:\n  - {kind: far, start: [1, 2, 0], goal: [1, 2, 0]}\n", "far");
  expectError(head + "missions:\n  - {kind: local, start: [1, 2], goal: [1, 2, 0]}\n", "'start'");
  expectError(head + "missions:\n  - {kind: local, start: [1, 2, 0], goal: [1, .nan, 0]}\n",
              "mission 0");
  expectError(head + "missions:\n  - {kind: local, start: [1, 2, 0]}\n", "'goal'");
  expectError(head + "missions:\n  - {kind: local, start: [1, 2, 0], goal: [1, 2, 0], via: 1}\n",
              "'via'");
  expectError(head + "? [1, 2]\n: 3\n" + kMission, "test.yaml: line 3: a key");
  expectError(head + kMission + kMission, "test.yaml: line 5: 'missions' is there twice");
  expectError(
      head + "missions:\n  - {kind: local, start: [1, 2, 0], goal: [1, 2, 0], start: [0, 0, 0]}\n",
      "'start' is there twice");
  expectError("[1, 2", "test.yaml");
  EXPECT_FALSE(loadScenario((folder_ / "absent.yaml").string()).has_value());
}

const char* const kVessels =
    "vessels:\n"
    "  - {id: 1, length_m: 6, beam_m: 2, waypoints: [[0, 0], [10, 0], [10, 20]], speeds_mps: [2, "
    "1]}\n"
    "  - {id: 7, length_m: 4.5, beam_m: 1.5, ais: false, waypoints: [[-500, 3], [9, 9]], "
    "speeds_mps: [0.5]}\n";

TEST_F(ScenarioFile, LoadsVesselsAndASpeedLimit) {
  const auto scenario = loadScenario(
      write(std::string(kHead) +
            "missions:\n  - {kind: encounter, start: [1, 2, 0.5], goal: [3.5, -4, -1], "
            "speed_mps: 2.5}\n" +
            kVessels));
  ASSERT_TRUE(scenario.has_value()) << scenario.error().message;
  EXPECT_EQ(scenario->missions[0].kind, "encounter");
  EXPECT_EQ(scenario->missions[0].speed_mps, 2.5);
  ASSERT_EQ(scenario->vessels.size(), 2U);
  EXPECT_TRUE(scenario->vessels[0].ais);
  EXPECT_EQ(scenario->vessels[0].hull.length_m, 6.0);
  EXPECT_EQ(scenario->vessels[0].waypoints[2], Eigen::Vector2d(10.0, 20.0));
  EXPECT_EQ(scenario->vessels[0].speeds_mps, (std::vector<double>{2.0, 1.0}));
  EXPECT_EQ(scenario->vessels[1].id, 7);
  EXPECT_FALSE(scenario->vessels[1].ais);
}

TEST_F(ScenarioFile, NamesWhatIsWrongWithAVessel) {
  const std::string head = std::string(kHead) + kMission + "vessels:\n  - ";
  const auto vessel = [&](const std::string& text) { return head + "{id: 42, " + text + "}\n"; };
  const std::string hull = "length_m: 6, beam_m: 2, ";
  const std::string way = "waypoints: [[0, 0], [5, 5]], ";
  expectError(vessel(hull + "waypoints: [[0, 0]], speeds_mps: [1]"), "vessel 42: 'waypoints'");
  expectError(vessel(hull + "waypoints: [[0, 0], [1]], speeds_mps: [1]"), "'waypoints'");
  expectError(vessel(hull + "waypoints: [[0, 0], [1, .inf]], speeds_mps: [1]"), "'waypoints'");
  expectError(vessel(hull + way + "speeds_mps: [0]"), "vessel 42: parameter 'speeds_mps'");
  expectError(vessel(hull + way + "speeds_mps: [-1]"), "'speeds_mps'");
  expectError(vessel(hull + way + "speeds_mps: []"), "'speeds_mps'");
  expectError(vessel(hull + way + "speeds_mps: [1, 1]"), "'speeds_mps'");
  expectError(vessel(hull + way + "speeds_mps: 2"), "'speeds_mps'");
  expectError(vessel(hull + "waypoints: [[0, 0], [5, 5]]"), "'speeds_mps'");
  expectError(vessel(hull + way + "speeds_mps: [1], colour: 3"), "'colour'");
  expectError(vessel("beam_m: 2, " + way + "speeds_mps: [1]"), "'length_m'");
  expectError(vessel("length_m: 0, beam_m: 2, " + way + "speeds_mps: [1]"), "'length_m'");
  expectError(vessel(hull + way + "speeds_mps: [1], ais: 3"), "'ais'");
  expectError(head + "{" + hull + way + "speeds_mps: [1]}\n", "vessel #0: parameter 'id'");
  expectError(
      vessel(hull + way + "speeds_mps: [1]") + "  - {id: 42, " + hull + way + "speeds_mps: [1]}\n",
      "vessel 42: 'id' is there twice");
  expectError(std::string(kHead) + kMission + "vessels: 3\n", "'vessels'");
  expectError(head + "3\n", "vessel #0");
  expectError(std::string(kHead) +
                  "missions:\n  - {kind: local, start: [1, 2, 0], goal: [1, 2, 0], speed_mps: 0}\n",
              "mission 0: parameter 'speed_mps'");
}

TEST_F(ScenarioFile, IsReadBackAsSaved) {
  map::OccupancyGrid chart = mission::test::openWater(20.0);
  mission::test::block(chart, {2.0, 3.0}, {4.0, 5.0});
  const std::vector<Mission> missions = {
      {"cross", {{1.25, -2.5}, 0.125}, {{-3.0, 4.0}, -1.5}, 1.5}};
  const std::vector<vessel::ScriptedVessel> vessels = {
      {3, {5.25, 1.5}, false, {{1.0, 2.0}, {-3.5, 4.25}, {6.0, 7.0}}, {0.75, 2.0}}};
  ASSERT_TRUE(saveScenario(folder_.string(), "saved", chart, chart, missions, vessels).has_value());
  const auto scenario = loadScenario((folder_ / "saved.yaml").string());
  ASSERT_TRUE(scenario.has_value()) << scenario.error().message;
  ASSERT_EQ(scenario->missions.size(), 1U);
  EXPECT_EQ(scenario->missions[0].kind, "cross");
  EXPECT_EQ(scenario->missions[0].start.position, missions[0].start.position);
  EXPECT_NEAR(scenario->missions[0].goal.psi_rad, -1.5, 1e-12);
  EXPECT_EQ(scenario->missions[0].speed_mps, 1.5);
  ASSERT_EQ(scenario->vessels.size(), 1U);
  EXPECT_EQ(scenario->vessels[0].id, 3);
  EXPECT_EQ(scenario->vessels[0].hull.length_m, 5.25);
  EXPECT_FALSE(scenario->vessels[0].ais);
  EXPECT_EQ(scenario->vessels[0].waypoints, vessels[0].waypoints);
  EXPECT_EQ(scenario->vessels[0].speeds_mps, vessels[0].speeds_mps);
  EXPECT_FALSE(saveScenario((folder_ / "c.yaml" / "x").string(), "saved", chart, chart, missions)
                   .has_value());
}

}  // namespace
}  // namespace otter_nav::scenario
