// The numbers of a struct with describe() (fields.hpp) as a list, for those that set them one by
// one.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "otter_nav/config/fields.hpp"

namespace otter_nav::config {

struct NumberField {
  std::string path;  // keys and, in lists, indices from 0, joined by slashes
  double value = 0.0;
  Range range;
  std::string effect;
};

class FieldLister {
 public:
  FieldLister(std::string prefix, std::vector<NumberField>& fields)
      : prefix_(std::move(prefix)), fields_(fields) {}

  template <typename Number>
  void operator()(const char* key, const Number& value, Range range, const char* effect) {
    fields_.push_back({prefix_ + key, static_cast<double>(value), range, effect});
  }
  template <typename Number>
  void optional(const char* key, const Number& value, Range range, const char* effect) {
    (*this)(key, value, range, effect);
  }
  void operator()(const char* /*key*/, const bool& /*value*/, const char* /*effect*/) {}
  void operator()(const char* /*key*/, const std::string& /*value*/, const char* /*effect*/) {}
  void list(const char* key, const std::vector<double>& values, std::size_t /*size*/, Range range,
            const char* effect) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      fields_.push_back({prefix_ + key + '/' + std::to_string(i), values[i], range, effect});
    }
  }
  template <typename Enum>
  void choice(const char* /*key*/, const Enum& /*value*/, const Choices<Enum>& /*choices*/,
              const char* /*effect*/) {}
  template <typename Group>
  void group(const char* key, const Group& options, const char* /*effect*/) {
    FieldLister lister(prefix_ + key + '/', fields_);
    Group::describe(options, lister);
  }

 private:
  std::string prefix_;
  std::vector<NumberField>& fields_;
};

// `prefix` as a path, empty or with a slash at its end.
template <typename Options>
[[nodiscard]] std::vector<NumberField> numbersOf(const Options& options,
                                                 const std::string& prefix) {
  std::vector<NumberField> fields;
  FieldLister lister(prefix, fields);
  Options::describe(options, lister);
  return fields;
}

}  // namespace otter_nav::config
