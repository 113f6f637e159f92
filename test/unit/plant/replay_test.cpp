#include "replay/replay.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "plant/otter_model.hpp"

namespace otter_nav::plant {
namespace {

Result<Recording> read(const std::string& text) {
  std::istringstream in(text);
  return readRecording(in, "run.csv");
}

void expectUnreadable(const std::string& text, const std::vector<std::string>& words) {
  const Result<Recording> recording = read(text);
  ASSERT_FALSE(recording) << text;
  for (const std::string& word : words) {
    EXPECT_NE(recording.error().message.find(word), std::string::npos) << recording.error().message;
  }
}

TEST(Recording, ReadsColumnsInAnyOrder) {
  const Result<Recording> recording = read("n_right, t ,n_left,note\n1,0,2,7\r\n3,0.5,4,8\n\n");
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_FALSE(recording->has_motion);
  ASSERT_EQ(recording->rows.size(), 2U);
  EXPECT_EQ(recording->rows[1].time_s, 0.5);
  EXPECT_EQ(recording->rows[1].state[kPropeller], 4.0);
  EXPECT_EQ(recording->rows[1].state[kPropeller + 1], 3.0);
}

TEST(Recording, SurvivesARoundTrip) {
  const OtterModel model({}, false);
  const Recording schedule = read("t,n_left,n_right\n0,50,40\n0.2,50,40\n0.4,-20,40\n").value();
  const Recording run = replay(model, schedule, {});
  std::ostringstream out;
  writeRecording(out, run);
  const Recording again = read(out.str()).value();
  EXPECT_TRUE(again.has_motion);
  EXPECT_LT(worstDifference(run, again).position_m, 1e-9);
  EXPECT_LT(worstDifference(run, again).heading_rad, 1e-9);
}

TEST(Recording, BadFilesAreNamedByLineAndColumn) {
  expectUnreadable("", {"run.csv", "empty"});
  expectUnreadable("t,n_left\n0,1\n1,1\n", {"line 1", "n_right"});
  expectUnreadable("t,u,n_left,n_right\n0,1,1,1\n1,1,1,1\n", {"line 1", "'v'"});
  expectUnreadable("t,n_left,n_right\n0,1,1\n", {"1 rows", "2"});
  expectUnreadable("t,n_left,n_right\n0,1,1\n1,1\n", {"line 3", "2 fields", "3"});
  expectUnreadable("t,n_left,n_right\n0,1,1\n1,fast,1\n", {"line 3", "n_left", "fast"});
  expectUnreadable("t,n_left,n_right\n0,1,1\n1,1,nan\n", {"line 3", "n_right", "nan"});
  expectUnreadable("t,n_left,n_right\n0,1,inf\n1,1,1\n", {"line 2", "n_right", "inf"});
  expectUnreadable("t,n_left,n_right\n0,1,\n1,1,1\n", {"line 2", "n_right"});
  expectUnreadable("t,n_left,n_right\n0,1,1\n1,1,1\n0.5,1,1\n", {"line 4", "'t'", "grow"});
  expectUnreadable("t,n_left,n_right\n0,1,1\n0,1,1\n", {"line 3", "grow"});
  expectUnreadable("t,n_left,n_right\n0,1,1\n1e9,1,1\n", {"line 3", "at most"});
  EXPECT_FALSE(readRecording("/no/such/file.csv"));
}

TEST(Replay, SpeedsHoldFromTheirRowToTheNext) {
  const OtterModel model({}, false);
  // Rows neither even nor on a grid of steps; the last one's speeds have no effect.
  const Recording changing = read("t,n_left,n_right\n0,50,50\n0.015,-50,20\n0.04,70,70\n").value();
  const Recording run = replay(model, changing, {}, 0.005);
  PlantState x = model.settled();
  const auto calm = [](const PlantState& /*x*/) { return Surroundings(); };
  for (int i = 0; i < 3; ++i) x = model.step(x, {50.0, 50.0}, 0.005, calm);
  EXPECT_LT((run.rows[1].state - x).head<12>().norm(), 1e-12);
  for (int i = 0; i < 5; ++i) x = model.step(x, {-50.0, 20.0}, 0.005, calm);
  EXPECT_LT((run.rows[2].state - x).head<12>().norm(), 1e-12);
  EXPECT_EQ(run.rows[1].state[kPropeller], -50.0);
}

TEST(Replay, NotANumberIsTheWorstDifference) {
  Recording a = read("t,n_left,n_right\n0,1,1\n1,1,1\n").value();
  Recording b = a;
  b.rows[1].state[kEast] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(worstDifference(a, b).position_m));
}

}  // namespace
}  // namespace otter_nav::plant
