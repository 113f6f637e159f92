// A model's coefficients as a vector, so that estimation can index them by number and name them in
// messages. Keys and order are the vessel file's (vessel/parameters.hpp); the wind's, which a file
// may leave out, are not estimated and not among them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::identification {

// The fields that every file has, as visit(key, value, range).
template <typename Visit>
struct RequiredFields {
  Visit visit;
  template <typename Number>
  constexpr void operator()(const char* key, Number& value, config::Range range, const char*) {
    visit(key, value, range);
  }
  template <typename Number>
  constexpr void optional(const char*, Number&, config::Range, const char*) {}
};

template <typename Model, typename Visit>
constexpr void forEachCoefficient(Model& model, Visit visit) {
  RequiredFields<Visit&> fields{visit};
  Model::describe(model, fields);
}

template <typename Model>
constexpr int coefficientCount() {
  int count = 0;
  Model model;
  forEachCoefficient(model, [&](const char*, auto&, const config::Range&) { ++count; });
  return count;
}
constexpr int kCoefficientCount = coefficientCount<vessel::ManoeuvringModel>();
constexpr int kPaperCount = coefficientCount<vessel::PaperModel>();

template <typename Model>
[[nodiscard]] Eigen::Matrix<double, coefficientCount<Model>(), 1> coefficientsOf(Model model) {
  Eigen::Matrix<double, coefficientCount<Model>(), 1> values;
  int i = 0;
  forEachCoefficient(
      model, [&](const char*, double& value, const config::Range&) { values[i++] = value; });
  return values;
}
// What a file may leave out stays as it is in `model`.
template <typename Model>
[[nodiscard]] Model modelOf(const Eigen::Ref<const Eigen::VectorXd>& values, Model model = {}) {
  int i = 0;
  forEachCoefficient(
      model, [&](const char*, double& value, const config::Range&) { value = values[i++]; });
  return model;
}
template <typename Model>
[[nodiscard]] std::vector<const char*> coefficientNames() {
  std::vector<const char*> names;
  Model model;
  forEachCoefficient(model,
                     [&](const char* key, double&, const config::Range&) { names.push_back(key); });
  return names;
}

using Coefficients = Eigen::Matrix<double, kCoefficientCount, 1>;

}  // namespace otter_nav::identification
