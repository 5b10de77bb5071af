#include "kinegraph/common/packages.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <vector>

namespace kinegraph::inline common_internal {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kMaxPackageDepth = 20, kMaxCrawledFolders = 50000;
constexpr std::chrono::seconds kCrawlAge(1);  // after that a failed search looks again

using PackageMap = std::multimap<std::string, std::string>;  // folders by name

std::vector<std::string> packagePathEntries() {
  std::vector<std::string> entries;
  for (const char* variable : {"KINEGRAPH_PACKAGE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"}) {
    const char* const value = std::getenv(variable);
    std::stringstream list(value ? value : "");
    for (std::string entry; std::getline(list, entry, ':');) {
      if (!entry.empty()) entries.push_back(entry);
    }
  }
  return entries;
}

/// Collects the packages below a folder.
class PackageCrawler {
 public:
  PackageMap packages;

  void crawl(const fs::path& folder, int depth) {
    if (depth > kMaxPackageDepth || ++visited_ > kMaxCrawledFolders) return;
    std::error_code error;
    for (const char* mark : {"CATKIN_IGNORE", "COLCON_IGNORE", "AMENT_IGNORE"}) {
      if (fs::exists(folder / mark, error)) return;
    }
    if (fs::exists(folder / "package.xml", error)) {
      packages.emplace(packageNameOf(folder.string()), folder.string());
      return;
    }
    if (fs::exists(folder / "manifest.xml", error)) {  // of rosbuild; named after its folder
      packages.emplace(folder.filename().string(), folder.string());
      return;
    }
    if (fs::exists(folder / "rospack_nosubdirs", error)) return;
    std::vector<fs::path> inner;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (!entry.path().filename().string().starts_with(".") && entry.is_directory(error))
        inner.push_back(entry.path());
    }
    std::sort(inner.begin(), inner.end());
    for (const fs::path& path : inner) crawl(path, depth + 1);
  }

 private:
  int visited_ = 0;
};

/// The packages below a folder. The result of a search is kept; `again` repeats a search that is older than kCrawlAge.
PackageMap packagesBelow(const std::string& folder, bool again) {
  struct Crawl {
    PackageMap packages;
    Clock::time_point time;
  };
  static std::mutex mutex;
  static std::map<std::string, Crawl> crawls;
  const std::lock_guard lock(mutex);
  const auto known = crawls.find(folder);
  const auto now = Clock::now();
  if (known != crawls.end() && (!again || now - known->second.time < kCrawlAge)) return known->second.packages;
  PackageCrawler crawler;
  crawler.crawl(folder, 0);
  crawls[folder] = {crawler.packages, now};
  return crawler.packages;
}

}  // namespace

std::string packageNameOf(const std::string& folder) {
  std::ifstream stream(fs::path(folder) / "package.xml", std::ios::binary);
  std::stringstream bytes;
  bytes << stream.rdbuf();
  const std::string text = bytes.str();
  const std::size_t tag = text.find("<name"), begin = text.find('>', tag), end = text.find("</name>", begin);
  if (tag == std::string::npos || begin == std::string::npos || end == std::string::npos) return "";
  const std::string name = text.substr(begin + 1, end - begin - 1);
  const std::size_t first = name.find_first_not_of(" \t\r\n"), last = name.find_last_not_of(" \t\r\n");
  return first == std::string::npos ? "" : name.substr(first, last - first + 1);
}

bool visitPackageFolders(const std::string& name, const std::string& folder,
                         const std::function<bool(const std::string& candidate)>& visit) {
  const std::vector<std::string> entries = packagePathEntries();
  std::vector<std::string> roots = entries;  // of crawls
  for (fs::path above = folder; !above.empty(); above = above.parent_path()) {
    if (visit((above / name).string())) return true;
    if ((above.filename() == name || packageNameOf(above.string()) == name) && visit(above.string())) return true;
    if (above.filename() == "src") roots.push_back(above.string());
    if (above == above.root_path()) break;
  }
  for (const fs::path entry : entries) {
    if (visit((entry / name).string()) || visit((entry / "share" / name).string())) return true;
    if ((entry.filename() == name || packageNameOf(entry.string()) == name) && visit(entry.string())) return true;
  }
  for (const bool again : {false, true}) {
    for (const std::string& root : roots) {
      const PackageMap packages = packagesBelow(root, again);
      const auto [begin, end] = packages.equal_range(name);
      for (auto package = begin; package != end; ++package) {
        if (visit(package->second)) return true;
      }
    }
  }
  return false;
}

}  // namespace kinegraph::inline common_internal
