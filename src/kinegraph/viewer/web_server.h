#pragma once

#include <functional>
#include <memory>
#include <string>

#include "kinegraph/viewer/viewer_state.h"

namespace kinegraph::inline viewer_internal {

/// Serves the page by HTTP, and each browser by a websocket, on a thread of its own. Only the implementation includes
/// Boost.Beast, which is slow to compile.
class WebServer {
 public:
  using OnCommand = std::function<void(const Command&)>;

  /// `on_command` is called on the server's thread. Throws ValueError for an invalid host or port, and Error if no port
  /// is available.
  WebServer(const ViewerOptions& options, std::shared_ptr<ViewerState> state, OnCommand on_command);
  ~WebServer();
  WebServer(const WebServer&) = delete;

  const std::string& url() const;

  /// Lets browsers fetch changes. Thread-safe.
  void wake();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kinegraph::inline viewer_internal
