#include "kinegraph/api/names.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace fs = std::filesystem;

namespace {

/// Returns the file with this function: the shared library, or the program if it is linked statically.
fs::path ownBinary() {
  Dl_info info;
  std::error_code error;
  if (!dladdr(reinterpret_cast<const void*>(&ownBinary), &info) || !info.dli_fname) return {};
  return fs::canonical(info.dli_fname, error);
}

/// Returns PREFIX/share/kinegraph/models, where PREFIX is the nearest folder above the binary that contains it. Build
/// folders do, too.
fs::path shippedModels() {
  std::error_code error;
  for (fs::path above = ownBinary().parent_path(); !above.empty(); above = above.parent_path()) {
    const fs::path models = above / "share" / "kinegraph" / "models";
    if (fs::is_directory(models, error)) return models;
    if (above == above.root_path()) break;
  }
  return {};
}

std::vector<fs::path> modelFolders(const std::string& shipped) {
  std::vector<fs::path> folders;
  if (const char* rai_path = std::getenv("RAI_PATH"); rai_path && *rai_path) folders.emplace_back(rai_path);
  if (const fs::path beside = shippedModels(); !beside.empty()) folders.push_back(beside);
  if (!shipped.empty()) folders.emplace_back(shipped);
  return folders;
}

std::vector<std::string> sceneFiles(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::recursive_directory_iterator file(folder, error), end; !error && file != end; file.increment(error)) {
    if (file->path().extension() == ".g") names.push_back(fs::relative(file->path(), folder, error).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::string modelPath(const std::string& path, const std::string& shipped) {
  const std::vector<fs::path> folders = modelFolders(shipped);
  if (folders.empty()) {
    throw FileError(cat("modelPath: there is no folder share/kinegraph/models above '", ownBinary().string(),
                        "'; set RAI_PATH to the models' folder"));
  }
  std::error_code error;
  for (const fs::path& folder : folders) {
    if (fs::exists(folder / path, error)) return fs::absolute(folder / path).lexically_normal().string();
  }
  const std::vector<std::string> known = sceneFiles(folders.back());
  const std::string hint = similarHint(path, known);
  throw FileError(cat("modelPath: there is no model '", path, "' in ", folders.front().string(),
                      hint.empty() ? cat("; models: ", join(known)) : hint));
}

std::string raiPath(const std::string& path) {
  for (const std::string prefix : {"../rai-robotModels/", "rai-robotModels/"}) {
    if (path.starts_with(prefix)) return modelPath(path.substr(prefix.size()));
  }
  return modelPath(path);
}

}  // namespace kinegraph
