#include "otter_nav/config/share.hpp"

#include <array>
#include <cstdlib>
#include <filesystem>

namespace otter_nav::config {
namespace {

namespace fs = std::filesystem;

bool isFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool holdsConfig(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path / "config" / "vessels", error);
}

// Programs are installed to <prefix>/lib/otter_nav, shared files to <prefix>/share/otter_nav.
fs::path besideProgram() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path() : program.parent_path() / ".." / ".." / "share" / "otter_nav";
}

}  // namespace

Result<std::string> shareDirectory() {
  const char* given = std::getenv("OTTER_NAV_SHARE");
  if (given != nullptr && *given != '\0') {
    if (!holdsConfig(given)) {
      return failure(std::string("OTTER_NAV_SHARE=") + given + " has no config/vessels");
    }
    return std::string(given);
  }
  const std::array<fs::path, 2> candidates = {besideProgram(), fs::path(OTTER_NAV_SOURCE_DIR)};
  for (const fs::path& candidate : candidates) {
    if (!candidate.empty() && holdsConfig(candidate)) {
      return candidate.lexically_normal().string();
    }
  }
  return failure(
      "the shared files (config/vessels) are neither installed beside the program nor in its "
      "source tree; set OTTER_NAV_SHARE to the package's directory");
}

Result<std::string> findFile(const std::string& path) {
  if (isFile(path)) {
    return path;
  }
  const auto share = shareDirectory();
  if (share && isFile(fs::path(*share) / path)) {
    return (fs::path(*share) / path).string();
  }
  return failure("no file '" + path + "'" + (share ? ", nor below " + *share : ""));
}

Result<std::string> presetFile(const std::string& folder, const std::string& name_or_path) {
  const auto share = shareDirectory();
  if (!share || findFile(name_or_path)) {
    return findFile(name_or_path);
  }
  const fs::path presets = fs::path(*share) / "config" / folder;
  const fs::path named = presets / (name_or_path + ".yaml");
  if (isFile(named)) {
    return named.string();
  }
  std::string known;
  for (const auto& entry : fs::directory_iterator(presets)) {
    known += (known.empty() ? "" : ", ") + entry.path().stem().string();
  }
  return failure("'" + name_or_path + "' is neither a YAML file nor one of config/" + folder +
                 ": " + known);
}

}  // namespace otter_nav::config
