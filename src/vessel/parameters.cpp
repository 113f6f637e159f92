#include "otter_nav/vessel/parameters.hpp"

#include "otter_nav/config/fields.hpp"
#include "otter_nav/config/share.hpp"

namespace otter_nav::vessel {

Result<Parameters> readParameters(config::Section section) {
  const std::string where = section.where();
  const bool has_manoeuvring = section.has("manoeuvring_model");
  Result<Parameters> parameters = config::read<Parameters>(std::move(section));
  if (parameters && parameters->name.empty()) {
    return failure(where + ": parameter 'name' is empty");
  }
  if (parameters && !has_manoeuvring) {
    parameters->manoeuvring = ManoeuvringModel::fromPaper(parameters->paper);
  }
  return parameters;
}

Result<Parameters> loadParameters(const std::string& name_or_path) {
  return config::presetFile("vessels", name_or_path).and_then([](const std::string& path) {
    return config::loadFile(path).and_then(
        [&](const YAML::Node& node) { return readParameters(config::Section(node, path)); });
  });
}

std::string toYaml(const Parameters& parameters) {
  return config::toYaml(parameters);
}

}  // namespace otter_nav::vessel
