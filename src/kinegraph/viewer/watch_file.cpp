#include "kinegraph/viewer/watch_file.h"

#include <chrono>
#include <filesystem>
#include <map>
#include <thread>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/scene/scene_source.h"

namespace kinegraph {

namespace fs = std::filesystem;

namespace {

/// When a file was last written, and its size; a missing one has neither.
using Stamp = std::pair<fs::file_time_type, std::uintmax_t>;

Stamp stampOf(const std::string& file) {
  std::error_code error;
  const auto time = fs::last_write_time(file, error);
  return {error ? fs::file_time_type::min() : time, error ? 0 : fs::file_size(file, error)};
}

using Stamps = std::map<std::string, Stamp>;

Stamps stampsOf(const std::vector<std::string>& files) {
  Stamps stamps;
  for (const std::string& file : files) stamps[file] = stampOf(file);
  return stamps;
}

}  // namespace

void watchFile(Config& config, ConfigViewer& viewer, const std::string& path, const std::function<void(const std::string&)>& report,
               const std::function<bool()>& stop) {
  const std::string hint = cat(path, "\nwaiting for changes of the file; q: quit");
  Stamps stamps = stampsOf({path});
  viewer.setTitle(cat("ConfigView <", path, ">"));
  const auto load = [&] {
    try {
      Config fresh;
      fresh.addFile(path);
      config.clear();
      config.addConfigurationCopy(fresh);
      viewer.setError("");
      viewer.setMessage(hint);
      report(config.report());
      for (const std::string& warning : fresh.takeWarnings()) report(warning);
    } catch (const Error& error) {
      viewer.setError(error.what());
      viewer.setMessage(cat(path, "\nthe last scene without a mistake; waiting for the file to be mended; q: quit"));
      report(error.what());
    }
    viewer.update(config);
    Stamps fresh_stamps = stampsOf(sourceFiles(path));
    for (auto& [file, stamp] : fresh_stamps) {
      if (const auto before = stamps.find(file); before != stamps.end()) stamp = before->second;  // it may have changed meanwhile
    }
    stamps = fresh_stamps;
  };
  load();
  while (!isHeadless() && !stop()) {
    const int key = viewer.takeKey();
    if (key == 'q' || key == 27 || enterWasPressed()) break;
    Stamps now = stamps;
    for (auto& [file, stamp] : now) stamp = stampOf(file);
    if (now != stamps || key == 13) {
      stamps = now;
      load();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  viewer.setMessage("");
  viewer.setError("");
}

}  // namespace kinegraph
