#include "kinegraph/common/file_paths.h"

#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <vector>

#include "kinegraph/common/packages.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline common_internal {

namespace fs = std::filesystem;

namespace {

/// Whether a file or folder exists. Most of the files that scenes name are optional, and missing: path objects would
/// take most of the time of loading.
bool isThere(const std::string& path) {
  struct stat status;
  return ::stat(path.c_str(), &status) == 0;
}

/// Replaces $NAME and ${NAME} by the environment variable; a name that is none remains.
std::string expandEnvironment(const std::string& path) {
  std::string out;
  for (std::size_t i = 0; i < path.size();) {
    if (path[i] != '$') {
      out += path[i++];
      continue;
    }
    const bool braced = path.compare(i, 2, "${") == 0;
    const std::size_t begin = i + (braced ? 2 : 1);
    std::size_t end = begin;
    while (end < path.size() && (std::isalnum(static_cast<unsigned char>(path[end])) || path[end] == '_')) ++end;
    const char* const value = std::getenv(path.substr(begin, end - begin).c_str());
    if (braced && end < path.size() && path[end] == '}') ++end;
    out += value ? std::string(value) : path.substr(i, end - i);
    i = end;
  }
  return out;
}

/// Replaces %20 by a blank, and so on.
std::string percentDecoded(const std::string& path) {
  std::string out;
  const auto isHex = [&](std::size_t i) {
    return i < path.size() && std::isxdigit(static_cast<unsigned char>(path[i]));
  };
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '%' && isHex(i + 1) && isHex(i + 2)) {
      out += char(std::stoi(path.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      out += path[i];
    }
  }
  return out;
}

/// The readings of a file name, the likeliest first: as written, with environment variables, as part of an URI, and
/// with the separators of Windows.
std::vector<std::string> readingsOf(const std::string& path) {
  std::vector<std::string> readings = {path};
  if (path.find_first_of("$%\\") == std::string::npos) return readings;
  const auto addEach = [&](const auto& change) {
    for (std::size_t i = 0, count = readings.size(); i < count; ++i) {
      std::string changed = change(readings[i]);
      if (changed.find('\0') == std::string::npos && changed != readings[i]) readings.push_back(std::move(changed));
    }
  };
  addEach(expandEnvironment);
  addEach(percentDecoded);
  addEach([](std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    return name;
  });
  return readings;
}

/// An existing path that differs from `path` in capitals only; empty if there is none, or more than one.
fs::path ignoringCase(const fs::path& path) {
  const auto lower = [](std::string text) {
    for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
    return text;
  };
  std::error_code error;
  fs::path found = path.root_path();
  for (const fs::path& part : path.relative_path()) {
    if (isThere((found / part).string())) {
      found /= part;
      continue;
    }
    if (!isThere(found.string())) return {};
    const std::string wanted = lower(part.string());
    std::vector<fs::path> matches;
    for (const auto& entry : fs::directory_iterator(found, error)) {
      if (lower(entry.path().filename().string()) == wanted) matches.push_back(entry.path());
    }
    if (matches.size() != 1) return {};
    found = matches[0];
  }
  return found;
}

/// Returns the first existing file of all readings in a folder, or "".
std::string existingIn(const std::string& folder, const std::vector<std::string>& readings) {
  for (const std::string& reading : readings) {
    if (reading.starts_with('/') ? isThere(reading) : isThere(folder + "/" + reading))
      return (fs::path(folder) / reading).lexically_normal().string();
  }
  return "";
}

/// Finds the file NAME/rest of a package.
LocatedFile inPackages(const std::string& path, const std::string& folder) {
  const std::size_t slash = std::min(path.find('/'), path.size());
  const std::string name = path.substr(0, slash), rest = path.substr(std::min(slash + 1, path.size()));
  const std::vector<std::string> readings = readingsOf(rest);
  LocatedFile found;
  std::vector<std::string> candidates;
  const auto has = [&](const std::string& candidate) {
    candidates.push_back(candidate);
    found.path = existingIn(candidate, readings);
    return !found.path.empty();
  };
  if (visitPackageFolders(name, folder, has) || rest.empty()) return found;
  for (const std::string& candidate : candidates) {
    if (!isThere(candidate)) continue;
    const fs::path other = ignoringCase(fs::path(candidate) / readings.back());
    if (!other.empty()) return {other.string(), cat("'", other.filename().string(), "' is read instead")};
  }
  for (std::string above = folder; above.size() > 1; above.resize(above.rfind('/') + 1 > 1 ? above.rfind('/') : 0)) {
    found.path = existingIn(above, readings);
    if (!found.path.empty()) {
      found.assumption = cat("package '", name, "' is not found; '", found.path, "' is read");
      return found;
    }
  }
  return found;
}

/// Resolves paths of scenes that refer to a folder rai-robotModels: RAI_PATH replaces a missing one.
std::string inModels(const std::string& path) {
  const std::string models = "rai-robotModels/", folder = expandEnvironment("$RAI_PATH");
  const std::size_t at = path.rfind("/" + models);
  std::error_code error;
  if (folder == "$RAI_PATH" || at == std::string::npos || fs::exists(path, error)) return path;
  const fs::path model = fs::path(folder) / path.substr(at + 1 + models.size());
  return fs::exists(model, error) ? model.lexically_normal().string() : path;
}

}  // namespace

LocatedFile locateFile(const std::string& path, const std::string& folder) {
  for (const std::string scheme : {"package://", "model://"}) {
    if (path.starts_with(scheme)) return inPackages(path.substr(scheme.size()), folder);
  }
  if (const std::size_t end = path.find(')'); path.starts_with("$(find ") && end != std::string::npos)
    return inPackages(path.substr(7, end - 7) + path.substr(end + 1), folder);
  const std::size_t scheme = path.starts_with("file://") ? 7 : path.starts_with("file:/") ? 5 : 0;
  const std::vector<std::string> readings = readingsOf(path.substr(scheme));
  if (std::string found = existingIn(folder, readings); !found.empty()) return {std::move(found), ""};
  const fs::path expected = (fs::path(folder) / readings.back()).lexically_normal();
  if (const std::string model = inModels(expected.string()); model != expected) return {model, ""};
  if (const fs::path other = ignoringCase(expected); !other.empty() && expected.is_absolute())
    return {other.string(), cat("'", other.filename().string(), "' is read instead")};
  return {expected.string(), ""};
}

std::string resolvePath(const std::string& path, const std::string& folder) { return locateFile(path, folder).path; }

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

std::string shippedFile(const std::string& path) {
  const std::string folder = expandEnvironment("$RAI_PATH");
  const bool is_relative = !path.empty() && !fs::path(path).is_absolute() && path.find("..") == std::string::npos;
  if (folder == "$RAI_PATH" || !is_relative || !isThere(folder + "/" + path)) return "";
  return (fs::path(folder) / path).lexically_normal().string();
}

std::string shippedFilesHint(const std::string& path) {
  const fs::path folder = expandEnvironment("$RAI_PATH");
  const std::string wanted = fs::path(path).filename().string(), extension = lowerExtension(path);
  std::error_code error;
  if (wanted.empty() || extension.empty() || !fs::is_directory(folder, error)) return "";
  std::map<std::string, std::vector<std::string>> places;  // by file name
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (lowerExtension(entry->path().string()) != extension) continue;
    places[entry->path().filename().string()].push_back(entry->path().lexically_relative(folder).generic_string());
  }
  std::vector<std::string> names, found;
  for (const auto& [name, where] : places) names.push_back(name);
  for (const std::string& name : places.contains(wanted) ? std::vector{wanted} : similarNames(wanted, names))
    for (const std::string& place : places[name])
      if (found.size() < 3) found.push_back(cat("<$RAI_PATH/", place, ">"));
  std::sort(found.begin(), found.end());
  return found.empty() ? "" : cat("; the shipped models have ", join(found, ", "));
}

std::string lowerExtension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

}  // namespace kinegraph::inline common_internal
