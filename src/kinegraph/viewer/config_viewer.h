#pragma once

#include <optional>
#include <string>

#include "kinegraph/scene/config.h"
#include "kinegraph/scene/visual_meshes.h"
#include "kinegraph/viewer/server.h"

namespace kinegraph {

/// Shows a configuration in the browser. The server starts, and a browser opens, when there is first something to show.
class ConfigViewer {
 public:
  explicit ConfigViewer(ViewerOptions options = {}) : options_(std::move(options)) {}

  /// Shows the configuration as it is now. Returns the key pressed since the last call, or 0. With `pause`, waits for a new
  /// key: in the browser, or Enter on the terminal. `stop` is asked while waiting; it may throw. Nothing waits where
  /// KINEGRAPH_HEADLESS is set; without a terminal, nothing waits for more than 5 s in which no browser is connected.
  int view(const Config& config, bool pause, const std::optional<std::string>& message, const std::function<bool()>& stop);

  /// Shows, without looking at keys.
  void update(const Config& config);

  void setMessage(const std::string& text) { server().setMessage(text); }
  void setError(const std::string& text) { server().setError(text); }
  void setTitle(const std::string& text) { server().setTitle(text); }
  void setCamera(const Vector3d& position, const Vector3d& target) { server().setCamera(position, target); }
  std::string url() { return server().url(); }
  int clients() const { return server_ ? server_->clients() : 0; }
  int takeKey() { return server_ ? server_->takeKey() : 0; }
  bool isOpen() const { return server_ != nullptr; }
  void close() { server_.reset(); }

  ViewerServer& server();

 private:
  int waitKey(const std::string& prompt, const std::function<bool()>& stop);

  ViewerOptions options_;
  std::unique_ptr<ViewerServer> server_;
  std::vector<ViewItem> items_;
  VisualMeshes visual_meshes_;
};

/// True if Enter was pressed on the terminal since the last call.
bool enterWasPressed();

}  // namespace kinegraph
