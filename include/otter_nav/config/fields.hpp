// One description of a struct's parameters, from which they are read, written and documented:
//
//   struct Options {
//     double horizon_s = 6.0;
//     bool enabled = true;
//     Weights weights;
//     template <typename Self, typename Fields>
//     static void describe(Self& o, Fields& fields) {
//       fields("horizon_s", o.horizon_s, {0.1, 20.0}, "of the plan");
//       fields("enabled", o.enabled, "whether it does anything");
//       fields.group("weights", o.weights, "per second of horizon");
//     }
//   };
//   const Result<Options> options = config::load<Options>(path);
//
// The key carries the unit; the text says what the parameter does. The struct's defaults are what
// ships: a test compares every file of config/ with them.
#pragma once

#include <cstddef>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"

namespace otter_nav::config {

// The names of an enumeration's values, as files spell them.
template <typename Enum>
using Choices = std::vector<std::pair<std::string, Enum>>;

// Strict: every key is required.
class FieldReader {
 public:
  explicit FieldReader(Section& section) : section_(section) {}

  template <typename Number>
  void operator()(const char* key, Number& value, Range range, const char* /*effect*/) {
    section_.read(key, value, range);
  }
  // What a file may leave out keeps its default.
  template <typename Number>
  void optional(const char* key, Number& value, Range range, const char* /*effect*/) {
    if (section_.has(key)) {
      section_.read(key, value, range);
    }
  }
  void operator()(const char* key, bool& value, const char* /*effect*/) {
    section_.read(key, value);
  }
  void operator()(const char* key, std::string& value, const char* /*effect*/) {
    section_.read(key, value);
  }
  void list(const char* key, std::vector<double>& values, std::size_t size, Range range,
            const char* /*effect*/) {
    section_.read(key, values, size, range);
  }
  void optionalText(const char* key, std::string& value, const std::vector<std::string>& allowed,
                    const char* /*effect*/) {
    if (section_.has(key)) {
      section_.read(key, value, allowed);
    }
  }
  // An Eigen vector of fixed size, as a list.
  template <typename Vector>
  void vector(const char* key, Vector& value, Range range, const char* effect) {
    std::vector<double> values;
    list(key, values, static_cast<std::size_t>(value.size()), range, effect);
    for (std::size_t i = 0; i < values.size(); ++i) {
      value[static_cast<int>(i)] = values[i];
    }
  }
  void texts(const char* key, std::vector<std::string>& values, const char* /*effect*/) {
    section_.read(key, values);
  }
  template <typename Enum>
  void choice(const char* key, Enum& value, const Choices<Enum>& choices, const char* /*effect*/) {
    std::vector<std::string> names;
    for (const auto& entry : choices) {
      names.push_back(entry.first);
    }
    std::string name;
    section_.read(key, name, names);
    for (const auto& entry : choices) {
      value = entry.first == name ? entry.second : value;
    }
  }
  template <typename Group>
  void group(const char* key, Group& options, const char* /*effect*/) {
    Section child = section_.child(key);
    readGroup(child, options);
  }

  // A list of groups, of any length.
  template <typename Group>
  void groups(const char* key, std::vector<Group>& list_of, const char* /*effect*/) {
    list_of.clear();
    for (Section& child : section_.children(key)) {
      list_of.emplace_back();
      readGroup(child, list_of.back());
    }
  }

  template <typename Group>
  void optionalGroup(const char* key, Group& options, const char* effect) {
    if (section_.has(key)) {
      group(key, options, effect);
    }
  }

  // The first fault of a group, if any; the section's own come from Section::finish().
  [[nodiscard]] const Status& status() const { return status_; }

 private:
  template <typename Group>
  void readGroup(Section& section, Group& options) {
    FieldReader reader(section);
    Group::describe(options, reader);
    if (const Status own = section.finish(); status_ && (!own || !reader.status())) {
      status_ = own ? reader.status() : own;
    }
  }

  Section& section_;
  Status status_;
};

// The fields as YAML with their effects as comments; FieldReader reads it back to the same values.
class FieldWriter {
 public:
  explicit FieldWriter(std::size_t indent = 0) : indent_(indent, ' ') {}

  template <typename Number>
  void operator()(const char* key, const Number& value, Range /*range*/, const char* effect) {
    line(key, text(value), effect);
  }
  template <typename Number>
  void optional(const char* key, const Number& value, Range range, const char* effect) {
    (*this)(key, value, range, effect);
  }
  void operator()(const char* key, const bool& value, const char* effect) {
    line(key, value ? "true" : "false", effect);
  }
  void operator()(const char* key, const std::string& value, const char* effect) {
    line(key, '"' + value + '"', effect);
  }
  void list(const char* key, const std::vector<double>& values, std::size_t /*size*/,
            Range /*range*/, const char* effect) {
    std::string all;
    for (const double value : values) {
      all += (all.empty() ? "" : ", ") + text(value);
    }
    line(key, '[' + all + ']', effect);
  }
  void optionalText(const char* key, const std::string& value,
                    const std::vector<std::string>& /*allowed*/, const char* effect) {
    line(key, value, effect);
  }
  template <typename Vector>
  void vector(const char* key, const Vector& value, Range range, const char* effect) {
    list(key, std::vector<double>(value.data(), value.data() + value.size()), 0, range, effect);
  }
  void texts(const char* key, const std::vector<std::string>& values, const char* effect) {
    std::string all;
    for (const std::string& value : values) {
      all += (all.empty() ? "" : ", ") + value;
    }
    line(key, '[' + all + ']', effect);
  }
  template <typename Enum>
  void choice(const char* key, const Enum& value, const Choices<Enum>& choices,
              const char* effect) {
    for (const auto& entry : choices) {
      if (entry.second == value) {
        line(key, entry.first, effect);
      }
    }
  }
  template <typename Group>
  void group(const char* key, const Group& options, const char* effect) {
    line(key, "", effect);
    FieldWriter writer(indent_.size() + 2);
    Group::describe(options, writer);
    text_ << writer.str();
  }
  template <typename Group>
  void optionalGroup(const char* key, const Group& options, const char* effect) {
    group(key, options, effect);
  }

  template <typename Group>
  void groups(const char* key, const std::vector<Group>& list_of, const char* effect) {
    line(key, list_of.empty() ? "[]" : "", effect);
    for (const Group& options : list_of) {
      FieldWriter writer(indent_.size() + 4);
      Group::describe(options, writer);
      std::string lines = writer.str();
      lines[indent_.size() + 2] = '-';
      text_ << lines;
    }
  }

  [[nodiscard]] std::string str() const { return text_.str(); }

 private:
  static std::string text(double value);  // the shortest that reads back to the same number
  void line(const std::string& key, const std::string& value, const std::string& effect) {
    text_ << indent_ << key << ':' << (value.empty() ? "" : " ") << value
          << (effect.empty() ? "" : "  # ") << effect << '\n';
  }

  std::string indent_;
  std::ostringstream text_;
};

// Reads `options`' fields from a section that may hold more.
template <typename Options>
[[nodiscard]] Status readFields(Section& section, Options& options) {
  FieldReader reader(section);
  Options::describe(options, reader);
  return reader.status();
}

// All of a section: what is missing, unknown or out of range is an error that names it.
template <typename Options>
[[nodiscard]] Result<Options> read(Section section) {
  Options options;
  const Status groups = readFields(section, options);
  if (const Status status = section.finish(); !status) {
    return failure(status.error().message);
  }
  if (!groups) {
    return failure(groups.error().message);
  }
  return options;
}

template <typename Options>
[[nodiscard]] Result<Options> load(const std::string& path) {
  const Result<YAML::Node> node = loadFile(path);
  if (!node) {
    return failure(node.error().message);
  }
  return read<Options>(Section(*node, path));
}

template <typename Options>
[[nodiscard]] std::string toYaml(const Options& options) {
  FieldWriter writer;
  Options::describe(options, writer);
  return writer.str();
}

}  // namespace otter_nav::config
