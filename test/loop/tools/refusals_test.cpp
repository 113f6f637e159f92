// What programs refuse, and that files which are there outlast it.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace {

namespace fs = std::filesystem;

class Refusals : public testing::Test {
 protected:
  void SetUp() override {
    std::string folder = (fs::temp_directory_path() / "refusals_XXXXXX").string();
    ASSERT_NE(mkdtemp(folder.data()), nullptr);
    folder_ = folder;
    setenv("OTTER_NAV_SHARE", OTTER_NAV_SOURCE_DIR, 1);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  [[nodiscard]] std::string textOf(const std::string& name) const {
    std::ifstream file(folder_ / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  // Whether it refuses, and says so with that word.
  [[nodiscard]] bool refuses(const std::string& command, const std::string& word) const {
    const int status = std::system((command + " >/dev/null 2>" + path("said")).c_str());
    return status != 0 && textOf("said").find(word) != std::string::npos;
  }

  fs::path folder_;
};

TEST_F(Refusals, DetectionsAreNotWrittenOverByTheirTracks) {
  const std::string detections = "{\"t\": 1, \"radar\": [[10, 0]]}\n";
  write("d.jsonl", detections);
  fs::create_symlink("d.jsonl", folder_ / "link.jsonl");
  for (const std::string out : {"d.jsonl", "./d.jsonl", "link.jsonl"}) {
    EXPECT_TRUE(refuses(TRACKING_TRAFFIC " --input " + path("d.jsonl") + " --output " + path(out),
                        "written over"))
        << out;
    EXPECT_EQ(textOf("d.jsonl"), detections) << out;
  }
}

TEST_F(Refusals, ScansThatNoNodeTakesAreRefused) {
  for (const std::string figures :
       {"\"range_max\": 1e12, \"ranges\": [5, 5]", "\"range_max\": 40, \"ranges\": [5, -5]"}) {
    write("d.jsonl",
          "{\"t\": 1, \"sensor\": {\"x\": 0, \"y\": 0}, \"scan\": {\"angle_min\": 0, "
          "\"angle_increment\": 0.01, \"range_min\": 0.1, " +
              figures + "}}\n");
    EXPECT_TRUE(refuses(TRACKING_TRAFFIC " --input " + path("d.jsonl"), "line 1: scan: range"))
        << figures;
  }
}

TEST_F(Refusals, RecordingIsNotWrittenOverByItsReplay) {
  const std::string recorded = "t,n_left,n_right\n0,10,10\n1,10,10\n";
  write("run.csv", recorded);
  EXPECT_TRUE(refuses(
      PLANT_REPLAY " --vessel otter --input " + path("run.csv") + " --output " + path("run.csv"),
      "written over"));
  EXPECT_EQ(textOf("run.csv"), recorded);
}

TEST_F(Refusals, CasesStayWhereNothingIsPlanned) {
  write("old.json", "{}\n");
  EXPECT_TRUE(refuses(PLANNER_BENCHMARK " --scenarios " + folder_.string() +
                          " --vessel nosuch --out " + path("old.json"),
                      "planner_benchmark"));
  EXPECT_EQ(textOf("old.json"), "{}\n");
}

TEST_F(Refusals, FoldersAreNotNamedAsScenarios) {
  EXPECT_TRUE(
      refuses(SCENARIO_GENERATOR " --encounters captains --out " + path("mine.yaml"), "--name"));
  EXPECT_FALSE(fs::exists(path("mine.yaml")));
}

TEST_F(Refusals, OthersAreNotPromisedWhereNoneWillSail) {
  for (const std::string water : {"--cylinders", "--encounters imazu"}) {
    const std::string generates = SCENARIO_GENERATOR " --out " + folder_.string() + " " + water;
    EXPECT_TRUE(refuses(generates + " --vessels 3", "--vessels")) << water;
    EXPECT_FALSE(refuses(generates, "")) << water;
  }
}

}  // namespace
