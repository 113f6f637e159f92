// Fields described once: read, written, and refused by name.
#include "otter_nav/config/fields.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace otter_nav::config {
namespace {

enum class Colour { kRed, kGreen };

struct Inner {
  int count = 3;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("count", o.count, {1.0, 9.0}, "of things");
  }
};

struct Outer {
  double length_m = 0.1;
  bool enabled = true;
  Colour colour = Colour::kGreen;
  std::vector<double> place = {1.0, -2.5};
  Inner inner;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("length_m", o.length_m, {0.0, 5.0}, "of it");
    fields("enabled", o.enabled, "whether it is");
    fields.choice("colour", o.colour,
                  Choices<Colour>{{"red", Colour::kRed}, {"green", Colour::kGreen}}, "of it");
    fields.list("place", o.place, 2, {-10.0, 10.0}, "where it is");
    fields.group("inner", o.inner, "within");
  }
};

Result<Outer> readText(const std::string& text) {
  return read<Outer>(Section(YAML::Load(text), "outer.yaml"));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(Fields, ComeBackAsWritten) {
  Outer written;
  written.length_m = 1.0 / 3.0;
  written.enabled = false;
  written.colour = Colour::kRed;
  written.place = {0.1, 7.0};
  written.inner.count = 8;
  const Result<Outer> back = readText(toYaml(written));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->length_m, written.length_m);
  EXPECT_EQ(back->enabled, written.enabled);
  EXPECT_EQ(back->colour, written.colour);
  EXPECT_EQ(back->place, written.place);
  EXPECT_EQ(back->inner.count, written.inner.count);
}

TEST(Fields, RefuseByName) {
  const std::string good = toYaml(Outer());
  const auto message = [](const std::string& text) {
    const Result<Outer> result = readText(text);
    return result ? std::string("accepted") : result.error().message;
  };
  EXPECT_NE(message(replaced(good, "0.1", "7")).find("'length_m' = 7 is outside"),
            std::string::npos);
  EXPECT_NE(message(replaced(good, "green", "blue")).find("'colour' = 'blue' is none of"),
            std::string::npos);
  EXPECT_NE(message(replaced(good, "  count: 3", "  count: 10")).find("'count' = 10 is outside"),
            std::string::npos);
  EXPECT_NE(message(replaced(good, "  count: 3", "  number: 3")).find("'count' is missing"),
            std::string::npos);
  EXPECT_NE(message(good + "extra: 1\n").find("unknown parameter 'extra'"), std::string::npos);
  EXPECT_NE(message(good + "? [a]\n: 1\n").find("outer.yaml: a key has to be a text"),
            std::string::npos);
}

TEST(Files, AreNoFolders) {
  const std::string folder = std::filesystem::temp_directory_path().string();
  const Result<YAML::Node> node = loadFile(folder);
  ASSERT_FALSE(node.has_value());
  EXPECT_EQ(node.error().message, folder + ": a folder, not a YAML file");
}

TEST(Files, AreRefusedByTheLineOfAWrongKey) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / "otter_nav_wrong_keys.yaml";
  const auto message = [&](const std::string& text) {
    std::ofstream(path) << text;
    const Result<YAML::Node> node = loadFile(path.string());
    return node ? std::string("accepted") : node.error().message;
  };
  const std::string at = path.string() + ": line ";
  EXPECT_EQ(message("a: 1\nb: 2\na: 3\n"), at + "3: 'a' is there twice");
  EXPECT_EQ(message("a: {b: 1,\n  b: 1}\n"), at + "2: 'b' is there twice");
  EXPECT_EQ(message("a:\n- - b: 1\n    c: 2\n    \"b\": 1\n"), at + "4: 'b' is there twice");
  EXPECT_EQ(message("a: 1\n? [1, 2]\n: 3\n"), at + "2: a key has to be a text");
  EXPECT_EQ(message("[a]: 1\n"), at + "1: a key has to be a text");
  EXPECT_EQ(message("a:\n  - {? {b: 1} : 2}\n"), at + "2: a key has to be a text");
  EXPECT_EQ(message("~: 1\n"), at + "1: a key has to be a text");
  EXPECT_EQ(message("a: {c: 1}\nb: {c: 1, d: [{c: 1}, {c: 1}]}\n"), "accepted");
  EXPECT_EQ(message("a: &x [*x, *x]\nb: *x\n"), "accepted");  // and walked once
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace otter_nav::config
