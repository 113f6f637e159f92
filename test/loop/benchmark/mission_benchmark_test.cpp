// A campaign of missions that is cut off: what it leaves, and how it is taken up again.
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class MissionBenchmark : public testing::Test {
 protected:
  void SetUp() override {
    std::string folder = (fs::temp_directory_path() / "mission_benchmark_XXXXXX").string();
    ASSERT_NE(mkdtemp(folder.data()), nullptr);
    folder_ = folder;
    const fs::path data = fs::path(OTTER_NAV_SOURCE_DIR) / "test/rostest/data";
    for (const char* name :
         {"pond_chart.yaml", "pond_chart.png", "pond_world.yaml", "pond_world.png"}) {
      fs::copy(data / name, folder_ / name);
    }
    write({"cross", "local", "cross"});
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Short missions in open water.
  void write(const std::vector<std::string>& kinds) const {
    std::ofstream file(folder_ / "pond.yaml");
    file << "chart: pond_chart.yaml\nworld: pond_world.yaml\nmissions:\n";
    for (const std::string& kind : kinds) {
      file << "  - {kind: " << kind << ", start: [-22, -8, 0.2], goal: [-12, -8, 0]}\n";
    }
  }

  [[nodiscard]] pid_t start(std::vector<std::string> options) const {
    std::vector<std::string> words = {
        MISSION_BENCHMARK, "--scenarios", (folder_ / "pond.yaml").string(), "--disturbance", "none",
        "--out",           out().string()};
    words.insert(words.end(), options.begin(), options.end());
    std::vector<char*> arguments;
    for (std::string& word : words) {
      arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      execv(arguments[0], arguments.data());
      _exit(127);
    }
    return child;
  }
  [[nodiscard]] static int exitCode(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] fs::path out() const { return folder_ / "result.json"; }
  [[nodiscard]] json missions() const {
    std::ifstream file(out());
    return json::parse(file).at("missions");
  }
  void save(const json& missions) const { std::ofstream(out()) << json{{"missions", missions}}; }

  fs::path folder_;
};

std::vector<int> numbersOf(const json& missions) {
  std::vector<int> numbers;
  for (const json& mission : missions) {
    numbers.push_back(mission.at("mission"));
  }
  return numbers;
}

TEST_F(MissionBenchmark, DefaultMissionsFitTheScenario) {
  EXPECT_EQ(exitCode(start({})), 0);
  EXPECT_EQ(numbersOf(missions()), (std::vector<int>{0, 2}));
  write({"local"});
  EXPECT_EQ(exitCode(start({})), 0);
  EXPECT_EQ(numbersOf(missions()), (std::vector<int>{0}));
}

TEST_F(MissionBenchmark, ResumesWhatWasCutOff) {
  const pid_t child = start({"--missions", "0-2"});
  for (int k = 0; k < 6000 && !fs::exists(out()); ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  kill(child, SIGKILL);
  EXPECT_EQ(exitCode(child), -1) << "ended before it could be cut off";
  json left = missions();
  ASSERT_GE(left.size(), 1U);
  ASSERT_LT(left.size(), 3U);
  left[0]["duration_s"] = 1234.5;  // a mark that sailing it again would wipe out
  save(left);

  EXPECT_EQ(exitCode(start({"--missions", "0-2", "--resume"})), 0);
  const json all = missions();
  EXPECT_EQ(numbersOf(all), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(all[0], left[0]);
  EXPECT_EQ(all[2].at("outcome"), "arrived");

  // Another seed is another mission; what was there stays.
  EXPECT_EQ(exitCode(start({"--missions", "0", "--seed", "2", "--resume"})), 0);
  EXPECT_EQ(numbersOf(missions()), (std::vector<int>{0, 1, 2, 0}));
}

TEST_F(MissionBenchmark, ShardsAndJobsSailEachMissionOnce) {
  write({"local", "local", "local", "local", "local"});
  EXPECT_EQ(exitCode(start({"--shard", "2/3", "--jobs", "2"})), 0);
  EXPECT_EQ(numbersOf(missions()), (std::vector<int>{1, 4}));
  const json alone = missions();
  EXPECT_EQ(exitCode(start({"--missions", "0-4", "--jobs", "3"})), 0);
  EXPECT_EQ(numbersOf(missions()), (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(missions()[4].at("duration_s"), alone[1].at("duration_s"));
  EXPECT_EQ(missions()[4].at("tracking_error_max_m"), alone[1].at("tracking_error_max_m"));
  for (const char* wrong : {"0/3", "4/3", "3", "a/3", "1/3x"}) {
    EXPECT_EQ(exitCode(start({"--shard", wrong})), 2) << wrong;
  }
}

TEST_F(MissionBenchmark, WritesWhereOtherVesselsWere) {
  write({"local"});
  std::ofstream(folder_ / "pond.yaml", std::ios::app)
      << "vessels:\n  - {id: 5, length_m: 6, beam_m: 2, waypoints: [[300, 200], [400, 200]], "
         "speeds_mps: [2]}\n";
  EXPECT_EQ(exitCode(start({"--tracks", folder_.string()})), 0);
  const json mission = missions()[0];
  ASSERT_EQ(mission.at("vessels"), (folder_ / "pond_0_vessels.csv").string());
  std::ifstream file(mission.at("vessels").get<std::string>());
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "t,id,x,y,psi,speed_mps");
  double before = 0.0;
  int rows = 0;
  for (; std::getline(file, line); ++rows) {
    double t = 0.0;
    double x = 0.0;
    double y = 0.0;
    double psi = 0.0;
    double speed = 0.0;
    int id = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%d,%lf,%lf,%lf,%lf", &t, &id, &x, &y, &psi, &speed),
              6);
    EXPECT_EQ(id, 5);
    EXPECT_NEAR(x, 300.0 + 2.0 * t, 2e-3);
    EXPECT_EQ(speed, 2.0);
    EXPECT_LE(t - before, 0.1 + 1e-6);
    before = t;
  }
  EXPECT_GT(rows, 50);
  EXPECT_NEAR(before, mission.at("duration_s").get<double>(), 0.2);
}

TEST_F(MissionBenchmark, DoesNotResumeFromAnythingElse) {
  std::ofstream(out()) << "{\"missions\": [{\"mission\": 0";
  EXPECT_EQ(exitCode(start({"--missions", "0", "--resume"})), 2);
  fs::remove(out());
  fs::create_directory(out());
  EXPECT_EQ(exitCode(start({"--missions", "0", "--resume"})), 2);
}

}  // namespace
