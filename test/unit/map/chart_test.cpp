#include "otter_nav/map/chart.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <fstream>

namespace otter_nav::map {
namespace {

namespace fs = std::filesystem;

const std::string kYaml =
    "image: chart.pgm\nresolution: 0.5\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

class ChartTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        (std::string("chart_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  // What loadChart() says of this YAML and picture.
  std::string complaint(const std::string& yaml, const std::string& picture) const {
    write("chart.pgm", picture);
    const auto chart = loadChart(write("chart.yaml", yaml));
    return chart ? "" : chart.error().message;
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  }

  fs::path folder_;
};

void expectNames(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << "'" << message << "' lacks '" << part << "'";
}

TEST_F(ChartTest, ReadsPlainPgmWithComments) {
  write("chart.pgm", "P2 # plain\n# a comment\n3 2\n255\n0 254 205\n254 254 # more\n0\n");
  const auto chart = loadChart(write("chart.yaml", kYaml));
  ASSERT_TRUE(chart) << chart.error().message;
  EXPECT_EQ(chart->geometry.width, 3);
  EXPECT_EQ(chart->geometry.height, 2);
  EXPECT_EQ(chart->geometry.origin, Eigen::Vector2d(-1.0, 2.0));
  EXPECT_EQ(chart->at(0, 1), Cell::kOccupied);  // the picture's top is north
  EXPECT_EQ(chart->at(1, 1), Cell::kFree);
  EXPECT_EQ(chart->at(2, 1), Cell::kUnknown);
  EXPECT_EQ(chart->at(2, 0), Cell::kOccupied);
}

TEST_F(ChartTest, ReadsRawPgmOf8And16BitsAndNegated) {
  const std::string raw8 = std::string("P5\n2 1\n255\n") + '\x00' + '\xfe';
  const std::string raw16 = std::string("P5\n2 1\n65535\n") + '\x00' + '\x00' + '\xfe' + '\x00';
  for (const std::string& picture : {raw8, raw16}) {
    write("chart.pgm", picture);
    const auto chart = loadChart(write("chart.yaml", kYaml));
    ASSERT_TRUE(chart) << chart.error().message;
    EXPECT_EQ(chart->at(0, 0), Cell::kOccupied);
    EXPECT_EQ(chart->at(1, 0), Cell::kFree);
    const auto negated = loadChart(write("not.yaml", replaced(kYaml, "negate: 0", "negate: 1")));
    ASSERT_TRUE(negated) << negated.error().message;
    EXPECT_EQ(negated->at(0, 0), Cell::kFree);
    EXPECT_EQ(negated->at(1, 0), Cell::kOccupied);
  }
}

TEST_F(ChartTest, ReadsPng) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 2;
  image.height = 1;
  image.format = PNG_FORMAT_RGBA;
  const png_byte pixels[] = {0, 0, 0, 255, 254, 254, 254, 0};
  ASSERT_NE(png_image_write_to_file(&image, (folder_ / "chart.png").c_str(), 0, pixels, 0, nullptr),
            0);
  const std::string yaml = write("chart.yaml", replaced(kYaml, "chart.pgm", "chart.png"));
  const auto chart = loadChart(yaml);
  ASSERT_TRUE(chart) << chart.error().message;
  EXPECT_EQ(chart->at(0, 0), Cell::kOccupied);
  EXPECT_EQ(chart->at(1, 0), Cell::kFree);
  fs::resize_file(folder_ / "chart.png", fs::file_size(folder_ / "chart.png") / 2);
  const auto broken = loadChart(yaml);
  ASSERT_FALSE(broken);
  expectNames(broken.error().message, "chart.png");
}

TEST_F(ChartTest, SavedReadsBackTheSame) {
  OccupancyGrid grid;
  grid.geometry = {3, 2, 0.1, {1.0 / 3.0, -7.25}};
  grid.cells = {Cell::kFree,    Cell::kOccupied, Cell::kUnknown,
                Cell::kUnknown, Cell::kFree,     Cell::kOccupied};
  const std::string path = (folder_ / "saved.yaml").string();
  ASSERT_TRUE(saveChart(grid, path));
  const auto again = loadChart(path);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->cells, grid.cells);
  EXPECT_EQ(again->geometry.origin, grid.geometry.origin);
  EXPECT_EQ(again->geometry.resolution_m, grid.geometry.resolution_m);
  EXPECT_FALSE(saveChart(grid, (folder_ / "absent" / "saved.yaml").string()));
}

TEST_F(ChartTest, PictureErrorsNameTheFileAndTheFault) {
  const std::string good = "P2\n2 1\n255\n0 254\n";
  EXPECT_EQ(complaint(kYaml, good), "");
  for (const auto& [picture, part] : std::vector<std::pair<std::string, std::string>>{
           {"", "empty"},
           {"GIF89a", "neither PGM"},
           {"P5\n2 1\n255\na", "truncated"},
           {"P5\n2 1\n255\nabc", "too long"},
           {"P2\n2 1\n255\n0\n", "pixel is missing"},
           {"P2\n2 1\n255\n0 1 2\n", "too long"},
           {"P2\n2 1\n255\n0 256\n", "above 255"},
           {"P2\n2 x\n255\n0 1\n", "line 2: height is not a whole number"},
           {"P2\n0 1\n255\n", "0 by 1"},
           {"P2\n30000 1\n255\n0\n", "30000 by 1"},
           {"P2\n99999999999 1\n255\n0\n", "width is above"},
           {"P5\n20000 20000\n255\nab", "truncated"},
           {"P2\n2 1\n70000\n0 1\n", "value of white is above 65535"},
           {"P2\n2 1\n0\n0 0\n", "value of white is 0"},
           {"P2\n2", "height is missing"}}) {
    const std::string message = complaint(kYaml, picture);
    expectNames(message, "chart.pgm");
    expectNames(message, part);
  }
}

TEST_F(ChartTest, YamlErrorsNameTheFileAndTheKey) {
  const std::string good = "P2\n2 1\n255\n0 254\n";
  const auto fault = [&](const std::string& from, const std::string& to, const std::string& part) {
    const std::string message = complaint(replaced(kYaml, from, to), good);
    expectNames(message, "chart.yaml");
    expectNames(message, part);
  };
  fault("resolution: 0.5", "resolution: -0.5", "'resolution'");
  fault("resolution: 0.5\n", "", "'resolution' is missing");
  fault("2.0, 0.0]", "2.0, 0.3]", "yaw");
  fault("2.0, 0.0]", "2.0]", "'origin'");
  fault("2.0, 0.0]", ".nan, 0.0]", "'origin'");
  fault("negate: 0", "negate: 2", "'negate'");
  fault("free_thresh: 0.196", "free_thresh: 0.8", "'free_thresh'");
  fault("negate: 0", "negate: 0\nmode: raw", "'mode'");
  fault("negate: 0", "negate: 0\ncolour: 1", "unknown parameter 'colour'");
  fault("negate: 0", "negate: 0\nresolution: 0.1", "'resolution' is there twice");
  fault("negate: 0", "negate: 0\n? [1, 2]\n: 3", "a key has to be a text");
  fault("image: chart.pgm", "image: gone.pgm", "gone.pgm: no such file");
  fault("image: chart.pgm", "- [", "chart.yaml");
  EXPECT_FALSE(loadChart((folder_ / "absent.yaml").string()));
}

}  // namespace
}  // namespace otter_nav::map
