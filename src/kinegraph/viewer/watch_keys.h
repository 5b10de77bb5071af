#pragma once

#include <functional>
#include <string>

#include "kinegraph/common/random.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph::inline viewer_internal {

/// Handles keys while a file is watched: h shows help, a animates the joints, i reports the scene and the camera; c
/// collisions, r samples random joints, x writes the scene as z.g, z.urdf, z.ply and z.dae, space describes the frame
/// under the pointer, 6 logs mouse and keys.
class WatchKeys {
 public:
  using Report = std::function<void(const std::string&)>;
  WatchKeys(Config& config, ConfigViewer& viewer, Report report, CancellationToken cancellation)
      : config_(config), viewer_(viewer), report_(std::move(report)), cancellation_(std::move(cancellation)) {}

  /// Handles a key. Returns whether the key has a function. Errors are reported.
  bool press(int key);

  /// Reports events, if logging is on.
  void logEvents();

  static std::string help();

 private:
  void report(const std::string& text);
  void reportScene();
  void reportCollisions();
  void writeFiles();
  void reportPicked();

  Config& config_;
  ConfigViewer& viewer_;
  Report report_;
  CancellationToken cancellation_;
  Rng random_;
  bool logs_ = false;
};

}  // namespace kinegraph::inline viewer_internal
