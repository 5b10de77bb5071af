#pragma once

#include <functional>
#include <memory>
#include <string>

#include "kinegraph/viewer/viewer_state.h"

namespace kinegraph {

/// Serves the page by HTTP, and each browser that shows it by a websocket, on a thread of its own. Nothing else knows of
/// the network, and only the implementation of Boost.Beast, which is slow to compile.
class WebServer {
 public:
  using OnCommand = std::function<void(const Command&)>;

  /// `on_command` is called on the server's thread. Throws ValueError for a host or port that cannot be, Error if no port
  /// can be had.
  WebServer(const ViewerOptions& options, std::shared_ptr<ViewerState> state, OnCommand on_command);
  ~WebServer();
  WebServer(const WebServer&) = delete;

  const std::string& url() const;

  /// Lets browsers look what has changed. From any thread.
  void wake();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kinegraph
