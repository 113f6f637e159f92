// Files of the tracking benchmark: positions over time.
#include "../../../benchmark/tracking/csv_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

namespace otter_nav::benchmark {
namespace {

std::string write(const std::string& text) {
  const std::string path = ::testing::TempDir() + "tracking_path.csv";
  std::ofstream(path) << text;
  return path;
}

// Rows of a circle of 10 m at 1 m/s, each 0.1 s; `change` may spoil one.
std::string circle(const std::function<std::string(int, std::string)>& change) {
  std::string text = "x,y,speed, t\r\n";
  for (int i = 0; i < 300; ++i) {
    const double t = 0.1 * i;
    const std::string row = std::to_string(10.0 * std::cos(0.1 * t)) + "," +
                            std::to_string(10.0 * std::sin(0.1 * t)) + ",1.0," + std::to_string(t);
    text += change(i, row) + "\n";
  }
  return text;
}

TEST(CsvPath, ReadsColumnsByNameAndFitsDerivatives) {
  const auto points = readTimedPoints(write(circle([](int, std::string row) { return row; })));
  ASSERT_TRUE(points) << points.error().message;
  ASSERT_EQ(points->size(), 300U);
  const vessel::FlatPoint z = fitAt(*points, 15.0);
  EXPECT_NEAR(z.velocity.norm(), 1.0, 1e-3);
  EXPECT_NEAR(z.acceleration.norm(), 0.1, 1e-2);
}

TEST(CsvPath, SaysWhatIsWrong) {
  const auto refused = [](const std::string& text, const std::string& why) {
    const auto points = readTimedPoints(write(text));
    ASSERT_FALSE(points) << why;
    EXPECT_NE(points.error().message.find(why), std::string::npos) << points.error().message;
  };
  const auto spoiled = [](int at, const std::string& with) {
    return circle([=](int i, std::string row) { return i == at ? with : row; });
  };
  EXPECT_FALSE(readTimedPoints("/nowhere/path.csv"));
  refused("", "cannot be read");
  refused("t,x\n0,0\n", "column 'y' is missing");
  refused(spoiled(5, "1.0,abc,1.0,0.5"), "line 7");
  refused(spoiled(5, "1.0,2.0m,1.0,0.5"), "line 7");
  refused(spoiled(5, "nan,0.0,1.0,0.5"), "line 7");
  refused(spoiled(5, "1.0"), "line 7");
  refused(spoiled(5, "10.0,0.5,1.0,0.4"), "time does not grow");
  refused(spoiled(5, "900.0,0.5,1.0,0.5"), "moves at");
  refused("t,x,y\n0,0,0\n1,1,0\n", "at least 20");
}

}  // namespace
}  // namespace otter_nav::benchmark
