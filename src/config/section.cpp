#include "otter_nav/config/section.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace otter_nav::config {
namespace {

std::string describe(const Range& range) {
  std::ostringstream out;
  out << "allowed range [" << range.min << ", " << range.max << "]";
  return out.str();
}

bool inside(double value, const Range& range) {
  return std::isfinite(value) && value >= range.min && value <= range.max;
}

template <typename T>
bool convert(const YAML::Node& node, T& value) {
  try {
    value = node.as<T>();
    return true;
  } catch (const YAML::Exception&) {
    return false;
  }
}

}  // namespace

Section::Section(const YAML::Node& node, std::string where)
    : node_(node), where_(std::move(where)) {
  if (!node_ || !node_.IsMap()) {
    first_error_ = where_ + ": expected a mapping of parameters";
  }
}

bool Section::has(const std::string& key) const {
  return node_ && node_.IsMap() && static_cast<bool>(node_[key]);
}

void Section::fail(const std::string& key, const std::string& what) {
  if (first_error_.empty()) {
    first_error_ = where_ + ": parameter '" + key + "' " + what;
  }
}

bool Section::areInside(const std::string& key, const std::vector<double>& values, Range range) {
  const auto out = std::find_if(values.begin(), values.end(),
                                [&](double value) { return !inside(value, range); });
  if (out == values.end()) {
    return true;
  }
  fail(key, "holds " + std::to_string(*out) + ", outside its " + describe(range));
  return false;
}

YAML::Node Section::find(const std::string& key) {
  known_.push_back(key);
  if (!has(key)) {
    fail(key, "is missing");
    return YAML::Node(YAML::NodeType::Undefined);
  }
  return std::as_const(node_)[key];
}

void Section::read(const std::string& key, double& value, Range range) {
  const YAML::Node found = find(key);
  if (!found) {
    fail(key, "is missing, " + describe(range));
    return;
  }
  double read_value = 0.0;
  if (!found.IsScalar() || !convert(found, read_value)) {
    fail(key, "is not a number, " + describe(range));
  } else if (!inside(read_value, range)) {
    fail(key, "= " + found.as<std::string>() + " is outside its " + describe(range));
  } else {
    value = read_value;
  }
}

void Section::read(const std::string& key, int& value, Range range) {
  const YAML::Node found = find(key);
  if (!found) {
    return;
  }
  int read_value = 0;
  if (!found.IsScalar() || !convert(found, read_value)) {
    fail(key, "is not a whole number, " + describe(range));
  } else if (!inside(read_value, range)) {
    fail(key, "= " + found.as<std::string>() + " is outside its " + describe(range));
  } else {
    value = read_value;
  }
}

void Section::read(const std::string& key, bool& value) {
  const YAML::Node found = find(key);
  if (found && (!found.IsScalar() || !convert(found, value))) {
    fail(key, "is not true or false");
  }
}

void Section::read(const std::string& key, std::string& value) {
  const YAML::Node found = find(key);
  if (found && (!found.IsScalar() || !convert(found, value))) {
    fail(key, "is not a text");
  }
}

void Section::read(const std::string& key, std::string& value,
                   const std::vector<std::string>& allowed) {
  read(key, value);
  if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) {
    return;
  }
  std::string list;
  for (const std::string& name : allowed) {
    list += (list.empty() ? "" : ", ") + name;
  }
  fail(key, "= '" + value + "' is none of: " + list);
}

void Section::read(const std::string& key, std::vector<double>& values, std::size_t size,
                   Range range) {
  const YAML::Node found = find(key);
  if (!found) {
    return;
  }
  std::vector<double> read_values;
  if (!found.IsSequence() || !convert(found, read_values) || read_values.size() != size) {
    fail(key, "is not a list of " + std::to_string(size) + " numbers, " + describe(range));
    return;
  }
  if (areInside(key, read_values, range)) {
    values = std::move(read_values);
  }
}

void Section::read(const std::string& key, std::vector<double>& values, Range range) {
  const YAML::Node found = find(key);
  std::vector<double> read_values;
  if (found && (!found.IsSequence() || !convert(found, read_values))) {
    fail(key, "is not a list of numbers, " + describe(range));
  } else if (found && areInside(key, read_values, range)) {
    values = std::move(read_values);
  }
}

void Section::read(const std::string& key, std::vector<std::vector<double>>& rows,
                   std::size_t columns, Range range) {
  const YAML::Node found = find(key);
  if (!found) {
    return;
  }
  std::vector<std::vector<double>> read_rows;
  const bool lists = found.IsSequence() && convert(found, read_rows);
  if (!lists || std::any_of(read_rows.begin(), read_rows.end(),
                            [&](const auto& row) { return row.size() != columns; })) {
    fail(key, "is not a list of lists of " + std::to_string(columns) + " numbers");
    return;
  }
  for (const std::vector<double>& row : read_rows) {
    if (!areInside(key, row, range)) {
      return;
    }
  }
  rows = std::move(read_rows);
}

void Section::read(const std::string& key, std::vector<std::string>& values) {
  const YAML::Node found = find(key);
  if (found && (!found.IsSequence() || !convert(found, values))) {
    fail(key, "is not a list of texts");
  }
}

Section Section::child(const std::string& key) {
  return {find(key), where_ + "/" + key};
}

std::vector<Section> Section::children(const std::string& key) {
  const YAML::Node found = find(key);
  std::vector<Section> sections;
  if (found && !found.IsSequence()) {
    fail(key, "is not a list of mappings");
  } else if (found) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      sections.emplace_back(found[i], where_ + "/" + key + "[" + std::to_string(i) + "]");
    }
  }
  return sections;
}

Status Section::finish() const {
  if (!first_error_.empty()) {
    return failure(first_error_);
  }
  for (const auto& entry : node_) {
    const std::string key = entry.first.as<std::string>();
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
      return failure(where_ + ": unknown parameter '" + key + "'");
    }
  }
  return {};
}

Result<YAML::Node> loadFile(const std::string& path) {
  try {
    YAML::Node node = YAML::LoadFile(path);
    if (!node.IsMap()) {
      return failure(path + ": expected a YAML mapping");
    }
    return node;
  } catch (const YAML::Exception& e) {
    return failure(path + ": " + e.what());
  }
}

}  // namespace otter_nav::config
