#include "otter_nav/vessel/parameters.hpp"

#include "otter_nav/config/fields.hpp"

namespace otter_nav::vessel {

Result<Parameters> readParameters(config::Section section) {
  const bool has_manoeuvring = section.has("manoeuvring_model");
  Result<Parameters> parameters = config::read<Parameters>(std::move(section));
  if (parameters && !has_manoeuvring) {
    parameters->manoeuvring = ManoeuvringModel::fromPaper(parameters->paper);
  }
  return parameters;
}

Result<Parameters> loadParameters(const std::string& path) {
  const Result<YAML::Node> node = config::loadFile(path);
  if (!node) {
    return failure(node.error().message);
  }
  return readParameters(config::Section(*node, path));
}

std::string toYaml(const Parameters& parameters) {
  return config::toYaml(parameters);
}

}  // namespace otter_nav::vessel
