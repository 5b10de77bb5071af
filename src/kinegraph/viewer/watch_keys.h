#pragma once

#include <functional>
#include <string>

#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph {

/// What keys do while a file is watched: h help, a animate the joints, i a report with the camera, c collisions, r
/// random joints, x write the scene as z.g, z.urdf, z.ply and z.dae, space tell what the pointer is on, 6 log mouse and
/// keys.
class WatchKeys {
 public:
  using Report = std::function<void(const std::string&)>;
  WatchKeys(Config& config, ConfigViewer& viewer, Report report, CancellationToken cancellation)
      : config_(config), viewer_(viewer), report_(std::move(report)), cancellation_(std::move(cancellation)) {}

  /// True if the key means something. Mistakes are reported.
  bool press(int key);

  /// Reports events, if they are logged.
  void logEvents();

  static std::string help();

 private:
  void say(const std::string& text);
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

}  // namespace kinegraph
