// Strict reading of options: every value is present, of its type and within its range, and every
// key that is in the file is one that was asked for. Anything else is an error that names the key,
// the file and the allowed range.
//
//   config::Section section(node, "planner.yaml");
//   Options o;
//   section.read("clearance_m", o.clearance_m, {0.0, 10.0});
//   if (auto status = section.finish(); !status) return failure(status.error().message);
#pragma once

#include <yaml-cpp/yaml.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"

namespace otter_nav::config {

struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

class Section {
 public:
  // `where` is what messages name: a file, or a node's private namespace.
  Section(const YAML::Node& node, std::string where);

  // Required values. Errors are collected; the first is reported by finish().
  void read(const std::string& key, double& value, Range range);
  void read(const std::string& key, int& value, Range range);
  void read(const std::string& key, bool& value);
  void read(const std::string& key, std::string& value);
  // One of `allowed`.
  void read(const std::string& key, std::string& value, const std::vector<std::string>& allowed);
  void read(const std::string& key, std::vector<double>& values, std::size_t size, Range range);
  // A list of numbers of any length, and one of lists of `columns` numbers each.
  void read(const std::string& key, std::vector<double>& values, Range range);
  void read(const std::string& key, std::vector<std::vector<double>>& rows, std::size_t columns,
            Range range);
  // A list of texts of any length.
  void read(const std::string& key, std::vector<std::string>& values);

  [[nodiscard]] bool has(const std::string& key) const;
  // A nested mapping; its finish() is the caller's to call. An absent one is an error.
  Section child(const std::string& key);
  // A list of mappings, each as a section.
  std::vector<Section> children(const std::string& key);

  // The first error, or an unknown key, or success.
  [[nodiscard]] Status finish() const;
  [[nodiscard]] const std::string& where() const { return where_; }

 private:
  [[nodiscard]] YAML::Node find(const std::string& key);
  // What is there, if it is of that shape and such a value: `what` says which.
  template <typename Value>
  [[nodiscard]] std::optional<Value> get(const std::string& key, YAML::NodeType::value shape,
                                         const std::string& what);
  template <typename Number>
  void readNumber(const std::string& key, const std::string& what, Number& value, Range range);
  void fail(const std::string& key, const std::string& what);
  bool areInside(const std::string& key, const std::vector<double>& values, Range range);

  YAML::Node node_;
  std::string where_;
  std::vector<std::string> known_;
  std::string first_error_;
};

// A YAML file's root mapping, or why it can't be read.
[[nodiscard]] Result<YAML::Node> loadFile(const std::string& path);

}  // namespace otter_nav::config
