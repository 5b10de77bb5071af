#include "kinegraph/viewer/config_viewer.h"

#include <thread>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/loading/scene_source.h"
#include "kinegraph/viewer/file_changes.h"
#include "kinegraph/viewer/server.h"
#include "kinegraph/viewer/watch_keys.h"

namespace kinegraph {

namespace {

/// The content of a scene file at one time: its frames, or the error.
struct LoadedScene {
  Config config;
  std::string error;
  FileStamps stamps;
  bool torn = false;  ///< it was written while it was read
};

/// Returns the stamps of the file and all files that it includes, as far as they exist.
FileStamps stampsOfScene(const std::string& path) {
  const std::vector<std::string> files = sourceFiles(path);
  return stampsOf(files.empty() ? std::vector{path} : files);
}

LoadedScene readScene(const std::string& path) {
  LoadedScene loaded;
  loaded.stamps = stampsOfScene(path);
  try {
    loaded.config.addFile(path);
  } catch (const Error& error) {
    loaded.error = error.what();
  }
  loaded.torn = stampsOfScene(path) != loaded.stamps;
  return loaded;
}

}  // namespace

void watchFile(Config& config, ConfigViewer& viewer, const std::string& path,
               const std::function<void(const std::string&)>& report, const CancellationToken& cancellation) {
  FileChanges changes;
  const auto load = [&] {
    LoadedScene loaded = readScene(path);
    if (loaded.torn) return;  // the next check sees the change
    if (loaded.error.empty()) {
      config.clear();
      config.addConfigurationCopy(loaded.config);
      viewer.setError("");
      viewer.setMessage(cat(path, "\nwaiting for changes of the file; h: help, q: quit"));
      report(config.report());
      for (const std::string& warning : loaded.config.takeWarnings()) report(warning);
    } else {
      viewer.setError(loaded.error);
      viewer.setMessage(cat(path, "\nthe last valid scene; waiting for a corrected file; h: help, q: quit"));
      report(loaded.error);
    }
    viewer.update(config);
    changes.setRead(std::move(loaded.stamps));
  };
  viewer.setTitle(cat("ConfigView <", path, ">"));
  changes.setRead({{path, {}}});  // as if the file had not existed before
  load();
  viewer.server().cursor();  // lets browsers report the pointer's position
  WatchKeys keys(config, viewer, report, cancellation);
  viewer.server().requestDigits(true);
  while (viewer.waits() && !cancellation()) {
    if (viewer.takeEdits(config)) viewer.update(config);
    keys.logEvents();
    const int key = viewer.takeKey();
    if (key == 'q' || key == 27 || enterWasPressed()) break;
    if (keys.press(key)) continue;
    if (key == 13 || changes.settled(stampsOf(changes.files()), std::chrono::steady_clock::now())) load();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  viewer.server().requestDigits(false);
  viewer.setMessage("");
  viewer.setError("");
}

}  // namespace kinegraph
