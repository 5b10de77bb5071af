#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "kinegraph/viewer/messages/input_events.h"
#include "kinegraph/viewer/messages/run_requests.h"
#include "kinegraph/viewer/run_recorder.h"
#include "kinegraph/viewer/shown_scene.h"

namespace kinegraph::inline viewer_internal {

/// The state that the program's threads share with the server's thread. The methods lock; direct access to the fields
/// requires a lock on `mutex`.
struct ViewerState {
  mutable std::mutex mutex;
  std::condition_variable changed;  ///< a key was pressed, or a browser connected
  ShownScene scene;
  int key = 0;
  bool key_releases = false;  ///< the key ends waitKey
  int clients = 0;
  InputEvents events;
  std::optional<Cursor> cursor;
  std::optional<PageCamera> camera;  ///< camera of the pages: set by the program, or moved by a user
  bool camera_moved = false;         ///< by a user, since the program read it
  RunRequests run;
  std::unique_ptr<RunRecorder> recorder;  ///< null: nothing is recorded

  void press(const KeyCommand& key);
  void addEvent(const EventCommand& event);
  void moveCursor(const CursorCommand& cursor);
  void moveCamera(const ViewpointCommand& viewpoint);
  void click(const ClickCommand& click);
  void steerRun(const RunCommand& command);
  void perturb(const PerturbCommand& command);
  void addClient();
  void removeClient();

  /// Returns the messages that update a browser to the present.
  std::vector<Outgoing> messagesSince(ShownScene::Seen& seen) const;

  /// Returns a page with everything shown now. `largest`: see recordedPage.
  std::string recording(std::size_t largest = 0) const;
};

}  // namespace kinegraph::inline viewer_internal
