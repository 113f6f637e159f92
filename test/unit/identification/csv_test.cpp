#include "otter_nav/identification/csv.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "expect_names.hpp"

namespace otter_nav::identification {
namespace {

using testing::expectNames;

Result<Recording> readCsv(std::istream& in, const std::string& name) {
  const Result<CsvTable> table = CsvTable::read(in, name);
  return table ? recordingOf(*table, name) : failure(table.error().message);
}

std::string errorOf(const std::string& text) {
  std::istringstream in(text);
  const Result<Recording> recording = readCsv(in, "run.csv");
  return recording ? "" : recording.error().message;
}

TEST(Csv, ReadsWhatItWrites) {
  std::stringstream text;
  writeCsvHeader(text);
  vessel::State state;
  state << 1.0, 2.0, 0.1, 0.3, -0.2, 0.05;
  writeCsvRow(text, 0.25, state, {12.5, -3.0});
  const Result<Recording> recording = readCsv(text, "run.csv");
  ASSERT_TRUE(recording) << recording.error().message;
  ASSERT_EQ(recording->odometry.size(), 1U);
  EXPECT_EQ(recording->odometry[0].stamp_s, 0.25);
  EXPECT_EQ(recording->odometry[0].state, state);
  EXPECT_EQ(recording->commands[0].thrusts, vessel::Thrusts(12.5, -3.0));
}

TEST(Csv, TakesColumnsInAnyOrderAndIgnoresOthers) {
  std::istringstream in("f_right,f_left,note,r,v,u,psi,y,x,t\r\n1,2,hello,3,4,5,6,7,8,9\r\n");
  const Result<Recording> recording = readCsv(in, "run.csv");
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->odometry[0].stamp_s, 9.0);
  EXPECT_EQ(recording->odometry[0].state[vessel::kX], 8.0);
  EXPECT_EQ(recording->commands[0].thrusts[vessel::kRight], 1.0);
}

TEST(Csv, NamesTheMissingColumn) {
  expectNames(errorOf("t,x,y,psi,u,v,f_left,f_right\n"), "column 'r' is missing");
  expectNames(errorOf(""), "run.csv: cannot be read, or is empty");
}

TEST(Csv, NamesRowAndColumnOfWhatIsNoNumber) {
  const std::string header = "t,x,y,psi,u,v,r,f_left,f_right\n";
  const std::string good = "0,0,0,0,0,0,0,1,1\n";
  const std::string message = errorOf(header + good + "0.1,0,0,zero,0,0,0,1,1\n");
  expectNames(message, "line 3");
  expectNames(message, "'psi': 'zero'");
  expectNames(errorOf(header + good + "0.1,0,0,0,0,0,0,1\n"), "line 3: 8 fields");
}

TEST(Csv, NamesTheFileThatIsNotThere) {
  const Result<Recording> recording = loadCsv("no/such/file.csv");
  ASSERT_FALSE(recording);
  expectNames(recording.error().message, "no/such/file.csv");
}

}  // namespace
}  // namespace otter_nav::identification
