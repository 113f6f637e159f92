#include "otter_nav/config/section.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "otter_nav/base/text.hpp"

namespace otter_nav::config {
namespace {

std::string describe(const Range& range) {
  return text("allowed range [%g, %g]", range.min, range.max);
}

bool inside(double value, const Range& range) {
  return std::isfinite(value) && value >= range.min && value <= range.max;
}

// Refuses keys that are no text, and those given twice: yaml-cpp takes both, and of two the first.
// `walked` says by their places what has been looked at: an alias leads back to it.
Status checkKeys(const YAML::Node& node, std::set<int>& walked) {
  if ((!node.IsMap() && !node.IsSequence()) || !walked.insert(node.Mark().pos).second) {
    return {};
  }
  std::set<std::string> keys;
  for (const auto& entry : node) {
    if (node.IsMap()) {
      const YAML::Node& key = entry.first;
      const std::string place = "line " + std::to_string(key.Mark().line + 1) + ": ";
      if (!key.IsScalar()) {
        return failure(place + "a key has to be a text");
      }
      if (!keys.insert(key.Scalar()).second) {
        return failure(place + "'" + key.Scalar() + "' is there twice");
      }
    }
    const YAML::Node& value = node.IsMap() ? entry.second : entry;
    if (Status below = checkKeys(value, walked); !below) {
      return below;
    }
  }
  return {};
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

template <typename Value>
std::optional<Value> Section::get(const std::string& key, YAML::NodeType::value shape,
                                  const std::string& what) {
  const YAML::Node found = find(key);
  if (!found) {
    return std::nullopt;
  }
  try {
    if (found.Type() == shape) {
      return found.as<Value>();
    }
  } catch (const YAML::Exception&) {
  }
  fail(key, "is not " + what);
  return std::nullopt;
}

template <typename Number>
void Section::readNumber(const std::string& key, const std::string& what, Number& value,
                         Range range) {
  const auto found = get<Number>(key, YAML::NodeType::Scalar, what + ", " + describe(range));
  if (found && inside(*found, range)) {
    value = *found;
  } else if (found) {
    fail(key, "= " + node_[key].template as<std::string>() + " is outside its " + describe(range));
  }
}

void Section::read(const std::string& key, double& value, Range range) {
  readNumber(key, "a number", value, range);
}

void Section::read(const std::string& key, int& value, Range range) {
  readNumber(key, "a whole number", value, range);
}

void Section::read(const std::string& key, bool& value) {
  value = get<bool>(key, YAML::NodeType::Scalar, "true or false").value_or(value);
}

void Section::read(const std::string& key, std::string& value) {
  value = get<std::string>(key, YAML::NodeType::Scalar, "a text").value_or(value);
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
  const std::string what = "a list of " + std::to_string(size) + " numbers, " + describe(range);
  auto found = get<std::vector<double>>(key, YAML::NodeType::Sequence, what);
  if (found && found->size() != size) {
    fail(key, "is not " + what);
  } else if (found && areInside(key, *found, range)) {
    values = *std::move(found);
  }
}

void Section::read(const std::string& key, std::vector<double>& values, Range range) {
  auto found = get<std::vector<double>>(key, YAML::NodeType::Sequence,
                                        "a list of numbers, " + describe(range));
  if (found && areInside(key, *found, range)) {
    values = *std::move(found);
  }
}

void Section::read(const std::string& key, std::vector<std::vector<double>>& rows,
                   std::size_t columns, Range range) {
  const std::string what = "a list of lists of " + std::to_string(columns) + " numbers";
  auto found = get<std::vector<std::vector<double>>>(key, YAML::NodeType::Sequence, what);
  if (!found) {
    return;
  }
  for (const std::vector<double>& row : *found) {
    if (row.size() != columns) {
      return fail(key, "is not " + what);
    }
  }
  if (std::all_of(found->begin(), found->end(),
                  [&](const auto& row) { return areInside(key, row, range); })) {
    rows = *std::move(found);
  }
}

void Section::read(const std::string& key, std::vector<std::string>& values) {
  values = get<std::vector<std::string>>(key, YAML::NodeType::Sequence, "a list of texts")
               .value_or(values);
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
    if (!entry.first.IsScalar()) {
      return failure(where_ + ": a key has to be a text");
    }
    const std::string& key = entry.first.Scalar();
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
      return failure(where_ + ": unknown parameter '" + key + "'");
    }
  }
  return {};
}

Result<YAML::Node> loadFile(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return failure(path + ": a folder, not a YAML file");
  }
  try {
    YAML::Node node = YAML::LoadFile(path);
    if (!node.IsMap()) {
      return failure(path + ": expected a YAML mapping");
    }
    std::set<int> walked;
    if (const Status keys = checkKeys(node, walked); !keys) {
      return failure(path + ": " + keys.error().message);
    }
    return node;
  } catch (const YAML::Exception& e) {
    return failure(path + ": " + e.what());
  }
}

}  // namespace otter_nav::config
