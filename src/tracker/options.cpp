#include "otter_nav/tracker/options.hpp"

namespace otter_nav::tracker {

Result<Options> readOptions(config::Section section) {
  return config::read<Options>(std::move(section));
}

Result<Options> loadOptions(const std::string& path) {
  return config::load<Options>(path);
}

}  // namespace otter_nav::tracker
