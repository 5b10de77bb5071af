#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "kinegraph/geometry/geometry.h"

namespace kinegraph {

/// What a viewer shows of a frame.
struct ViewItem {
  std::string name;
  int parent = -1;                           ///< index of the parent item, or -1
  Pose pose;                                 ///< in the world
  std::shared_ptr<const Geometry> geometry;  ///< null: nothing to see
  Vector4d color{.8, .8, .8, 1.};            ///< rgba in 0..1
};

struct ViewerOptions {
  std::string host = "127.0.0.1";  ///< only this machine, unless told otherwise
  int port = 7000;                 ///< first one tried; those in use are passed over; 0: any free one
  std::string title = "Kinegraph";
};

/// Shows items in any number of browsers: an HTTP server for the page, and a websocket each for what changes. It has a
/// thread of its own; a slow browser misses intermediate poses and never holds the program up.
class ViewerServer {
 public:
  /// Throws ValueError for a host or port that cannot be, Error if no port can be had.
  explicit ViewerServer(const ViewerOptions& options = {});
  ~ViewerServer();
  ViewerServer(const ViewerServer&) = delete;

  std::string url() const;
  int clients() const;

  /// Sends what differs from the last call: nothing if nothing does.
  void update(std::span<const ViewItem> items);
  void setMessage(const std::string& text);  ///< in the corner; may have several lines
  void setError(const std::string& text);    ///< in a box; empty removes it
  void setTitle(const std::string& text);
  void setCamera(const Vector3d& position, const Vector3d& target);

  /// The last key pressed in a browser since the previous call, or 0. Letters as lower-case ASCII, Enter 13, Escape 27, space
  /// 32; others have the codes of GLFW.
  int takeKey();

  /// Waits for a key. Returns 0 as soon as `stop` (asked every 20 ms) says so.
  int waitKey(const std::function<bool()>& stop);

  /// Waits until a browser is connected, for at most so many seconds.
  bool waitForClient(double seconds);

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;
};

/// Opens `url` in the user's browser if there is a display and KINEGRAPH_HEADLESS is not set. Never waits, never fails.
void openBrowser(const std::string& url);

/// True if the environment variable KINEGRAPH_HEADLESS is set to anything but 0: no browser is opened, and nothing waits.
bool isHeadless();

}  // namespace kinegraph
