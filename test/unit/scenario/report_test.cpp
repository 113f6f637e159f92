#include "otter_nav/scenario/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "otter_nav/base/progress_line.hpp"

namespace otter_nav::scenario {
namespace {

// A meter a second east for ten seconds, the reference `error_m` to port, the coast 3 m off at t=5.
Recorder sailEast(double error_m) {
  Recorder recorder;
  for (int k = 0; k <= 100; ++k) {
    MotionSample sample;
    sample.t_s = 20.0 + 0.1 * k;
    sample.state[vessel::kX] = 0.1 * k;
    sample.clearance_m = 3.0 + std::abs(k - 50) * 0.1;
    if (k > 50) {
      sample.reference = Eigen::Vector3d(0.1 * k, k == 100 ? 2.0 * error_m : error_m, 0.0);
    }
    recorder.addMotion(sample);
  }
  return recorder;
}

TEST(Recorder, GathersTheFigures) {
  Recorder recorder = sailEast(0.2);
  for (const double ms : {3.0, 1.0, 2.0}) {
    recorder.addPlanning(ms);
  }
  for (int k = 1; k <= 100; ++k) {
    recorder.addTracking(k);
  }
  const MissionResult result = recorder.result({}, Outcome::kArrived, {}, 4);
  EXPECT_NEAR(result.duration_s, 10.0, 1e-9);
  EXPECT_NEAR(result.distance_m, 10.0, 1e-9);
  EXPECT_NEAR(result.min_clearance_m, 3.0, 1e-9);
  EXPECT_NEAR(result.tracking_error_mean_m, (49 * 0.2 + 0.4) / 50, 1e-9);
  EXPECT_NEAR(result.tracking_error_max_m, 0.4, 1e-9);
  EXPECT_EQ(result.replans, 4);
  EXPECT_EQ(result.planning_ms_median, 2.0);
  EXPECT_EQ(result.planning_ms_max, 3.0);
  EXPECT_EQ(result.tracker_ms_p99, 99.0);
}

TEST(Recorder, OfNothingIsZero) {
  const MissionResult result = Recorder().result({}, Outcome::kError, "why", 0);
  EXPECT_EQ(result.duration_s, 0.0);
  EXPECT_EQ(result.planning_ms_median, 0.0);
}

TEST(Json, HasTheKeysOthersRead) {
  MissionResult result = sailEast(0.1).result({"archipelago", 10, "otter", "paper", 7},
                                              Outcome::kStopped, "walled off", 1);
  result.track = "track.csv";
  const auto json = nlohmann::json::parse(toJson({result}));
  const auto& mission = json.at("missions").at(0);
  for (const char* key :
       {"scenario", "mission", "vessel", "disturbance", "seed", "outcome", "duration_s",
        "distance_m", "min_clearance_m", "tracking_error_mean_m", "tracking_error_max_m", "replans",
        "replans_for_weather", "planning_ms_median", "planning_ms_max", "tracker_ms_p99", "track",
        "reason"}) {
    EXPECT_TRUE(mission.contains(key)) << key;
  }
  EXPECT_EQ(mission.at("outcome"), "stopped");
  EXPECT_EQ(mission.at("mission"), 10);
  EXPECT_FALSE(saveJson(OTTER_NAV_SOURCE_DIR "/package.xml/result.json", {result}).has_value());
}

TEST(Track, HasARowASample) {
  const auto path = std::filesystem::temp_directory_path() / "otter_nav_track_test.csv";
  auto track = TableWriter::open(path.string(), kTrackColumns);
  ASSERT_TRUE(track.has_value());
  MotionSample sample;
  sample.t_s = 1.5;
  sample.state << 1.0, 2.0, 0.5, 3.0, -0.25, 0.125;
  sample.thrusts_n = {10.0, -20.0};
  track->write(trackRow(sample));
  sample.reference = Eigen::Vector3d(1.5, 2.5, 0.25);
  track->write(trackRow(sample));
  ASSERT_TRUE(track->close().has_value());
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "t,x,y,psi,u,v,r,roll,pitch,f_left,f_right,x_ref,y_ref,psi_ref");
  std::getline(file, line);
  EXPECT_EQ(line,
            "1.500,1.0000,2.0000,0.50000,3.0000,-0.2500,0.12500,0.00000,0.00000,10.000,-20.000,"
            "1.0000,2.0000,0.50000");
  std::getline(file, line);
  EXPECT_NE(line.find("1.5000,2.5000,0.25000"), std::string::npos);
  std::filesystem::remove(path);
  EXPECT_FALSE(
      TableWriter::open(OTTER_NAV_SOURCE_DIR "/package.xml/track.csv", kTrackColumns).has_value());
}

TEST(ProgressLine, IsOneRefreshedLineOnATerminal) {
  std::ostringstream out;
  ProgressLine line(out, true);
  Progress progress{1.0, 20.0, 3.0, 4.0, 0.1, "replanning", "something in the way"};
  line.show(progressText(progress), progress.state, progress.t_s);
  progress.state = "sailing";
  progress.detail.clear();
  line.show(progressText(progress), progress.state, progress.t_s);
  line.finish();
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 2);
  // The shorter second line covers the first.
  const std::size_t second = text.rfind('\r');
  EXPECT_EQ(text.size() - second - 2, second - 1);
}

TEST(ProgressLine, IsTerseElsewhere) {
  std::ostringstream out;
  ProgressLine line(out, false, 10.0);
  for (int k = 0; k <= 20; ++k) {
    line.show("3.0 m/s", k < 15 ? "sailing" : "arrived", k);
  }
  line.finish();
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);  // at 0 s, 10 s and the change at 15 s
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(ProgressLine, CountsInTenthsElsewhere) {
  std::ostringstream out;
  ProgressLine line(out, false);
  for (int k = 1; k <= 40; ++k) {
    line.show(k, 40);
  }
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 11);  // the first, and each tenth
  EXPECT_EQ(text.substr(text.size() - 6), "40/40\n");
}

TEST(Summary, SaysWhatHappened) {
  const std::string text = summaryText(sailEast(0.1).result(
      {"archipelago", 10, "otter", "paper", 7}, Outcome::kStopped, "walled off", 1));
  EXPECT_NE(text.find("archipelago mission 10"), std::string::npos);
  EXPECT_NE(text.find("stopped: walled off"), std::string::npos);
}

}  // namespace
}  // namespace otter_nav::scenario
