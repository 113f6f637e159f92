#include "otter_nav/identification/data_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "expect_names.hpp"
#include "identification/thrust_history.hpp"
#include "identification/windows.hpp"

namespace otter_nav::identification {
namespace {

using testing::expectNames;

Recording steady(double duration_s, double dt) {
  Recording recording;
  recording.odometry_name = "/odom";
  recording.command_name = "/thruster_command";
  for (int i = 0; i * dt <= duration_s; ++i) {
    recording.odometry.push_back({i * dt, vessel::State::Zero()});
    recording.commands.push_back({i * dt, vessel::Thrusts(10.0, 20.0)});
  }
  return recording;
}

std::string errorOf(const Recording& recording) {
  const Result<DataSet> data = assemble(recording, DataOptions(), 0.0);
  return data ? "" : data.error().message;
}

TEST(Assemble, NamesTheStreamThatIsMissing) {
  Recording recording = steady(60.0, 0.1);
  recording.commands.clear();
  expectNames(errorOf(recording), "/thruster_command");
  recording = steady(60.0, 0.1);
  recording.odometry.clear();
  expectNames(errorOf(recording), "/odom");
}

TEST(Assemble, RefusesTooShortRecordings) {
  expectNames(errorOf(steady(20.0, 0.1)), "too short");
  Recording apart = steady(60.0, 0.1);
  for (CommandRecord& command : apart.commands) {
    command.stamp_s += 1000.0;
  }
  expectNames(errorOf(apart), "overlap for 0 s");
}

TEST(Assemble, NamesTheStampOfWhatIsNotFinite) {
  Recording recording = steady(60.0, 0.1);
  recording.odometry[12].state[vessel::kYawRate] = std::numeric_limits<double>::quiet_NaN();
  std::string message = errorOf(recording);
  expectNames(message, "/odom, message 13 (stamp 1.2 s)");
  expectNames(message, "r is not a finite number");
  recording = steady(60.0, 0.1);
  recording.first_row = 2;
  recording.commands[5].thrusts[vessel::kRight] = std::numeric_limits<double>::infinity();
  message = errorOf(recording);
  expectNames(message, "row 7");
  expectNames(message, "f_right");
}

TEST(Assemble, NamesTheStampWhereTimeGoesBackwards) {
  Recording recording = steady(60.0, 0.1);
  recording.odometry[20].stamp_s = 1.5;
  expectNames(errorOf(recording), "/odom, message 21 (stamp 1.5 s): time goes backwards");
  recording = steady(60.0, 0.1);
  recording.commands[20].stamp_s = 1.5;
  expectNames(errorOf(recording), "/thruster_command, message 21");
}

TEST(Assemble, SkipsWhatIsSentTwiceButNotTwoStatesOfOneTime) {
  Recording recording = steady(60.0, 0.1);
  const Result<DataSet> once = assemble(recording, DataOptions(), 0.0);
  ASSERT_TRUE(once) << once.error().message;
  const auto place = recording.odometry.begin() + 20;
  recording.odometry.insert(place, *place);
  recording.odometry.push_back(recording.odometry.back());
  const Result<DataSet> twice = assemble(recording, DataOptions(), 0.0);
  ASSERT_TRUE(twice) << twice.error().message;
  ASSERT_EQ(twice->samples.size(), once->samples.size());
  EXPECT_EQ(twice->samples[21].time_s, once->samples[21].time_s);
  recording.odometry[21].state[vessel::kX] = 1.0;
  expectNames(errorOf(recording), "/odom, message 22 (stamp 2 s): time goes backwards or stands");
}

TEST(Assemble, ThinsFastOdometry) {
  DataOptions options;
  options.sample_interval_s = 0.05;
  const Result<DataSet> data = assemble(steady(60.0, 0.01), options, 0.0);
  ASSERT_TRUE(data) << data.error().message;
  ASSERT_GT(data->samples.size(), 1000U);
  EXPECT_NEAR(data->samples[1].time_s - data->samples[0].time_s, 0.05, 1e-9);
  const Result<DataSet> slow = assemble(steady(60.0, 0.06), options, 0.0);
  ASSERT_TRUE(slow) << slow.error().message;
  EXPECT_NEAR(slow->samples[1].time_s - slow->samples[0].time_s, 0.06, 1e-9);
}

TEST(Assemble, SplitsAtGapsAndUnwrapsTheHeading) {
  Recording recording = steady(80.0, 0.1);
  for (std::size_t i = 0; i < recording.odometry.size(); ++i) {
    const double psi = 0.05 * static_cast<double>(i);
    recording.odometry[i].state[vessel::kPsi] = std::remainder(psi, 2.0 * M_PI);
  }
  recording.odometry.erase(recording.odometry.begin() + 400, recording.odometry.begin() + 420);
  const Result<DataSet> data = assemble(recording, DataOptions(), 0.0);
  ASSERT_TRUE(data) << data.error().message;
  ASSERT_EQ(data->stretches.size(), 2U);
  EXPECT_EQ(data->stretches[0].end, 400U);
  EXPECT_EQ(data->stretches[1].begin, 400U);
  EXPECT_NEAR(data->samples[399].state[vessel::kPsi], 0.05 * 399, 1e-9);
}

TEST(Assemble, LeavesOutWhereCommandsPause) {
  Recording recording = steady(80.0, 0.1);
  auto& commands = recording.commands;
  const auto lost = [](const CommandRecord& c) { return c.stamp_s > 40.05 && c.stamp_s < 42.05; };
  commands.erase(std::remove_if(commands.begin(), commands.end(), lost), commands.end());
  const Result<DataSet> data = assemble(recording, DataOptions(), 0.0);
  ASSERT_TRUE(data) << data.error().message;
  ASSERT_EQ(data->stretches.size(), 2U);
  EXPECT_NEAR(data->samples[data->stretches[0].end - 1].time_s, 40.0, 1e-9);
  EXPECT_NEAR(data->samples[data->stretches[1].begin].time_s, 42.1, 1e-9);
  for (const Stretch& s : data->stretches) {
    for (std::size_t i = s.begin; i + 1 < s.end; ++i) {
      EXPECT_GT(data->samples[i].thrusts[0], 1.0) << data->samples[i].time_s;
    }
  }
}

TEST(Assemble, SaysOfShortRecordingsWhereTheirHolesAre) {
  Recording recording = steady(33.0, 0.1);
  recording.odometry.erase(recording.odometry.begin() + 100, recording.odometry.begin() + 150);
  const Result<DataSet> data = assemble(recording, DataOptions(), 0.0);
  ASSERT_FALSE(data);
  EXPECT_NE(data.error().message.find("holes in /odom: 1"), std::string::npos)
      << data.error().message;
}

TEST(Assemble, NamesHoles) {
  Recording recording = steady(80.0, 0.1);
  EXPECT_TRUE(assemble(recording, DataOptions(), 0.0)->holes.empty());
  recording.odometry.erase(recording.odometry.begin() + 400, recording.odometry.begin() + 420);
  recording.odometry.erase(recording.odometry.begin() + 100, recording.odometry.begin() + 103);
  const Result<DataSet> data = assemble(recording, DataOptions(), 0.0);
  ASSERT_EQ(data->holes.size(), 1U);
  const Holes& holes = data->holes[0];
  EXPECT_EQ(holes.stream, "/odom");
  EXPECT_EQ(holes.count, 2);
  EXPECT_NEAR(holes.missing_s, 2.3, 1e-9);
  EXPECT_NEAR(holes.longest_from_s, 39.9, 1e-9);
  EXPECT_NEAR(holes.longest_to_s, 42.0, 1e-9);
}

TEST(ThrustHistory, AveragesCommandsWithinAnInterval) {
  ThrustHistory history({{0.0, {10.0, 0.0}}, {0.03, {20.0, 0.0}}}, 0.0, 1.0);
  EXPECT_NEAR(history.mean(0.0, 0.04)[vessel::kLeft], 12.5, 1e-12);
  EXPECT_NEAR(history.mean(0.04, 0.1)[vessel::kLeft], 20.0, 1e-12);
}

TEST(ThrustHistory, FallsToZeroWhenNoCommandComes) {
  ThrustHistory history({{0.0, {10.0, 10.0}}, {5.0, {30.0, 30.0}}}, 0.0, 0.5);
  EXPECT_NEAR(history.mean(0.0, 1.0)[vessel::kLeft], 5.0, 1e-12);
  EXPECT_NEAR(history.mean(1.0, 4.0)[vessel::kLeft], 0.0, 1e-12);
  EXPECT_NEAR(history.mean(5.0, 5.2)[vessel::kLeft], 30.0, 1e-12);
}

// T' = (c - T) / lag from rest: T = c (1 - exp(-t / lag)).
TEST(ThrustHistory, FollowsWithTheLag) {
  const double lag_s = 0.1;
  ThrustHistory history({{0.0, {10.0, 10.0}}}, lag_s, 100.0);
  const double end_s = 0.25;
  const double integral = 10.0 * (end_s - lag_s * (1.0 - std::exp(-end_s / lag_s)));
  EXPECT_NEAR(history.mean(0.0, end_s)[vessel::kLeft], integral / end_s, 1e-12);
  const double late = history.mean(0.25, 0.250001)[vessel::kLeft];
  EXPECT_NEAR(late, 10.0 * (1.0 - std::exp(-end_s / lag_s)), 1e-3);
}

TEST(Split, KeepsValidationApartFromTheFit) {
  const Result<DataSet> data = assemble(steady(240.0, 0.1), DataOptions(), 0.0);
  ASSERT_TRUE(data);
  const Result<Split> parts = split(*data, SplitOptions());
  ASSERT_TRUE(parts) << parts.error().message;
  EXPECT_GE(parts->validation_blocks.size(), 3U);
  for (const Stretch& block : parts->validation_blocks) {
    for (const Stretch& window : parts->fit_windows) {
      EXPECT_TRUE(window.end - 1 <= block.begin || window.begin >= block.end - 1);
    }
  }
}

TEST(Split, SaysWhenNothingIsLeftToFit) {
  Recording recording = steady(60.0, 0.1);
  const Result<DataSet> data = assemble(recording, DataOptions(), 0.0);
  ASSERT_TRUE(data);
  SplitOptions options;
  options.window_s = 100.0;
  const Result<Split> parts = split(*data, options);
  ASSERT_FALSE(parts);
  expectNames(parts.error().message, "window_s");
}

}  // namespace
}  // namespace otter_nav::identification
