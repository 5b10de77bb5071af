#include "kinegraph/common/file_paths.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "kinegraph/common/text.h"

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

/// Whether `folder` is the package, by its name or its package.xml.
bool isPackage(const fs::path& folder, const std::string& name) {
  if (folder.filename() == name) return true;
  std::ifstream stream(folder / "package.xml", std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str().find(cat("<name>", name, "</name>")) != std::string::npos;
}

/// Finds the file NAME/rest of a package: in `folder` or above it, or below the folders of the environment.
std::string findInPackages(const std::string& path, const std::string& folder) {
  const std::size_t slash = std::min(path.find('/'), path.size());
  const std::string name = path.substr(0, slash), rest = path.substr(std::min(slash + 1, path.size()));
  std::error_code error;
  for (fs::path above = folder; !above.empty(); above = above.parent_path()) {
    if (fs::exists(above / path, error)) return (above / path).string();
    if (isPackage(above, name) && fs::exists(above / rest, error)) return (above / rest).string();
    if (above == above.root_path()) break;
  }
  for (const char* variable : {"KINEGRAPH_PACKAGE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"}) {
    std::stringstream folders(environment(variable));
    for (std::string entry; std::getline(folders, entry, ':');) {
      if (entry.empty()) continue;
      for (const fs::path& base : {fs::path(entry), fs::path(entry) / "share"}) {
        if (fs::exists(base / path, error)) return (base / path).string();
      }
      if (isPackage(entry, name) && fs::exists(fs::path(entry) / rest, error)) {
        return (fs::path(entry) / rest).string();
      }
    }
  }
  return "";
}

/// Resolves paths of scenes that refer to a folder rai-robotModels: RAI_PATH replaces a missing one.
std::string inModels(const std::string& path) {
  const std::string models = "rai-robotModels/", folder = environment("RAI_PATH");
  const std::size_t at = path.rfind("/" + models);
  std::error_code error;
  if (folder.empty() || at == std::string::npos || fs::exists(path, error)) return path;
  const fs::path model = fs::path(folder) / path.substr(at + 1 + models.size());
  return fs::exists(model, error) ? model.lexically_normal().string() : path;
}

}  // namespace

std::string resolvePath(const std::string& path, const std::string& folder) {
  for (const std::string scheme : {"package://", "model://"}) {
    if (path.starts_with(scheme)) return findInPackages(path.substr(scheme.size()), folder);
  }
  const std::string file_scheme = "file://";
  const fs::path expanded = expandEnvironment(path.starts_with(file_scheme) ? path.substr(file_scheme.size()) : path);
  return inModels((expanded.is_absolute() ? expanded : fs::path(folder) / expanded).lexically_normal().string());
}

std::string missingPackageMessage(const std::string& path) {
  const std::size_t scheme = path.find("://"), first = scheme == std::string::npos ? 0 : scheme + 3;
  const std::string package = path.substr(first, path.find('/', first) - first);
  return cat(
      "'", path,
      "' is in none of the folders of KINEGRAPH_PACKAGE_PATH, ROS_PACKAGE_PATH and AMENT_PREFIX_PATH; is the package '",
      package, "' installed? (pip install ", package, ")");
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

std::string lowerExtension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

}  // namespace kinegraph
