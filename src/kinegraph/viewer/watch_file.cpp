#include "kinegraph/viewer/watch_file.h"

#include <thread>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/loading/scene_source.h"
#include "kinegraph/viewer/file_changes.h"
#include "kinegraph/viewer/watch_keys.h"

namespace kinegraph {

namespace {

/// A scene file as it was at one time: its frames, or what is wrong with it.
struct Reading {
  Config config;
  std::string error;
  FileStamps stamps;
  bool torn = false;  ///< somebody wrote while it was read
};

/// The file and those that it includes, as far as they can be found.
FileStamps stampsOfScene(const std::string& path) {
  const std::vector<std::string> files = sourceFiles(path);
  return stampsOf(files.empty() ? std::vector{path} : files);
}

Reading readScene(const std::string& path) {
  Reading reading;
  reading.stamps = stampsOfScene(path);
  try {
    reading.config.addFile(path);
  } catch (const Error& error) {
    reading.error = error.what();
  }
  reading.torn = stampsOfScene(path) != reading.stamps;
  return reading;
}

}  // namespace

void watchFile(Config& config, ConfigViewer& viewer, const std::string& path,
               const std::function<void(const std::string&)>& report, const CancellationToken& cancellation) {
  FileChanges changes;
  const auto load = [&] {
    Reading reading = readScene(path);
    if (reading.torn) return;  // the change is seen at the next look
    if (reading.error.empty()) {
      config.clear();
      config.addConfigurationCopy(reading.config);
      viewer.setError("");
      viewer.setMessage(cat(path, "\nwaiting for changes of the file; h: help, q: quit"));
      report(config.report());
      for (const std::string& warning : reading.config.takeWarnings()) report(warning);
    } else {
      viewer.setError(reading.error);
      viewer.setMessage(
          cat(path, "\nthe last scene without a mistake; waiting for the file to be mended; h: help, q: quit"));
      report(reading.error);
    }
    viewer.update(config);
    changes.setRead(std::move(reading.stamps));
  };
  viewer.setTitle(cat("ConfigView <", path, ">"));
  changes.setRead({{path, {}}});  // as if it had been missing so far
  load();
  viewer.server().cursor();  // so that browsers tell where the pointer is
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
