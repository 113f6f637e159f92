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

TEST_F(MissionBenchmark, DoesNotResumeFromAnythingElse) {
  std::ofstream(out()) << "{\"missions\": [{\"mission\": 0";
  EXPECT_EQ(exitCode(start({"--missions", "0", "--resume"})), 2);
}

}  // namespace
