// The fields of a struct as rows of a Markdown table: key, default, range, effect.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "otter_nav/config/fields.hpp"

namespace otter_nav::config {

class FieldTable {
 public:
  explicit FieldTable(std::string prefix = "") : prefix_(std::move(prefix)) {}

  template <typename Number>
  void operator()(const char* key, const Number& value, Range range, const char* effect) {
    row(key, text(value), text(range), effect);
  }
  template <typename Number>
  void optional(const char* key, const Number& value, Range range, const char* effect) {
    row(key, text(value), text(range), effect);
  }
  void operator()(const char* key, const bool& value, const char* effect) {
    row(key, value ? "true" : "false", "true, false", effect);
  }
  void operator()(const char* key, const std::string& value, const char* effect) {
    row(key, value.empty() ? "\"\"" : value, "text", effect);
  }
  void list(const char* key, const std::vector<double>& values, std::size_t /*size*/, Range range,
            const char* effect) {
    row(key, joined(values), text(range), effect);
  }
  template <typename Vector>
  void vector(const char* key, const Vector& value, Range range, const char* effect) {
    list(key, std::vector<double>(value.data(), value.data() + value.size()), 0, range, effect);
  }
  void optionalText(const char* key, const std::string& value,
                    const std::vector<std::string>& allowed, const char* effect) {
    row(key, value, joined(allowed), effect);
  }
  void texts(const char* key, const std::vector<std::string>& values, const char* effect) {
    row(key, joined(values), "texts", effect);
  }
  template <typename Enum>
  void choice(const char* key, const Enum& value, const Choices<Enum>& choices,
              const char* effect) {
    std::string chosen;
    std::vector<std::string> names;
    for (const auto& entry : choices) {
      chosen = entry.second == value ? entry.first : chosen;
      names.push_back(entry.first);
    }
    row(key, chosen, joined(names), effect);
  }
  template <typename Group>
  void group(const char* key, const Group& options, const char* /*effect*/) {
    FieldTable table(prefix_ + key + '.');
    Group::describe(options, table);
    text_ << table.rows();
  }

  template <typename Group>
  void optionalGroup(const char* key, const Group& options, const char* effect) {
    group(key, options, effect);
  }
  template <typename Group>
  void groups(const char* key, const std::vector<Group>& /*list_of*/, const char* effect) {
    FieldTable table(prefix_ + key + "[].");
    const Group defaults;
    Group::describe(defaults, table);
    row(key, "", "list", effect);
    text_ << table.rows();
  }

  [[nodiscard]] std::string rows() const { return text_.str(); }

 private:
  template <typename Value>
  static std::string text(const Value& value) {
    std::ostringstream out;
    out << value;
    return out.str();
  }
  static std::string text(const Range& range) { return text(range.min) + " to " + text(range.max); }
  template <typename Value>
  static std::string joined(const std::vector<Value>& values) {
    std::string all;
    for (const Value& value : values) {
      all += (all.empty() ? "" : ", ") + text(value);
    }
    return all;
  }
  void row(const char* key, const std::string& value, const std::string& range,
           const char* effect) {
    text_ << "| `" << prefix_ << key << "` | " << value << " | " << range << " | " << effect
          << " |\n";
  }

  std::string prefix_;
  std::ostringstream text_;
};

}  // namespace otter_nav::config
