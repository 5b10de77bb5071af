#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>

#include "kinegraph/viewer/messages/input_events.h"
#include "kinegraph/viewer/messages/run_requests.h"
#include "kinegraph/viewer/shown_scene.h"

namespace kinegraph {

/// What the program's threads and the server's thread share. The methods lock; whoever touches the fields locks
/// `mutex`.
struct ViewerState {
  mutable std::mutex mutex;
  std::condition_variable changed;  ///< a key was pressed, a client came
  ShownScene scene;
  int key = 0;
  bool key_releases = false;  ///< it ends the waiting for a key
  int clients = 0;
  InputEvents events;
  std::optional<Cursor> cursor;
  std::optional<PageCamera> camera;  ///< where pages look from: as the program said, or where a person turned one to
  bool camera_moved = false;         ///< by a person, since the program was told
  RunRequests run;

  void press(const KeyCommand& key);
  void addEvent(const EventCommand& event);
  void moveCursor(const CursorCommand& cursor);
  void moveCamera(const ViewpointCommand& viewpoint);
  void steerRun(const RunCommand& command);
  void pull(const PerturbCommand& command);
  void addClient();
  void removeClient();

  /// The messages that bring a browser to the present.
  std::vector<Outgoing> messagesSince(ShownScene::Seen& seen) const;

  /// The page with all that is shown now.
  std::string recording() const;
};

}  // namespace kinegraph
