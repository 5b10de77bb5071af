#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "kinegraph/base/text.h"
#include "kinegraph/scene/scene_source.h"

namespace kinegraph {

namespace fs = std::filesystem;

namespace {

std::string environment(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value ? value : "";
}

std::string expandEnvironment(const std::string& path) {
  std::string out;
  for (std::size_t i = 0; i < path.size();) {
    if (path[i] != '$') {
      out += path[i++];
      continue;
    }
    std::size_t end = i + 1;
    while (end < path.size() && (std::isalnum(static_cast<unsigned char>(path[end])) || path[end] == '_')) ++end;
    out += environment(path.substr(i + 1, end - i - 1));
    i = end;
  }
  return out;
}

std::string findInPackages(const std::string& rest) {
  for (const char* variable : {"KINEGRAPH_PACKAGE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"}) {
    std::stringstream folders(environment(variable));
    for (std::string folder; std::getline(folders, folder, ':');) {
      for (const fs::path& base : {fs::path(folder), fs::path(folder) / "share"}) {
        std::error_code error;
        if (!folder.empty() && fs::exists(base / rest, error)) return (base / rest).string();
      }
    }
  }
  return "";
}

}  // namespace

std::string resolvePath(const std::string& path, const std::string& folder) {
  const std::string package = "package://";
  if (path.starts_with(package)) return findInPackages(path.substr(package.size()));
  const fs::path expanded = expandEnvironment(path);
  return expanded.is_absolute() ? expanded.lexically_normal().string()
                                : (fs::path(folder) / expanded).lexically_normal().string();
}

std::string similarFilesHint(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  if (!fs::is_directory(folder, error)) return cat("; there is no folder '", folder.string(), "'");
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (names.size() < 10000) names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return similarHint(fs::path(path).filename().string(), names);
}

}  // namespace kinegraph
