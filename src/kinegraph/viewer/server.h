#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/geometry/shapes/geometry.h"
#include "kinegraph/viewer/messages/commands.h"
#include "kinegraph/viewer/messages/near_lines.h"
#include "kinegraph/viewer/messages/run_requests.h"
#include "kinegraph/viewer/messages/scene_warnings.h"
#include "kinegraph/viewer/messages/shown.h"
#include "kinegraph/viewer/messages/shown_run.h"

namespace kinegraph::inline viewer_internal {

class ShownScene;

/// A frame in the viewer.
struct ViewItem {
  std::string name;
  int parent = -1;                           ///< index of the parent item, or -1
  Pose pose;                                 ///< in the world
  std::shared_ptr<const Geometry> geometry;  ///< null: nothing visible
  Vector4d color{.8, .8, .8, 1.};            ///< rgba in 0..1
  bool collides = false;                     ///< it counts in collisions
  std::string details;                       ///< further attributes, as in a .g file
};

/// A dof that users can move in the browser.
struct ShownJoint {
  std::string name;
  int frame = 0;                ///< index of the item with the joint
  std::string unit;             ///< rad, m, or nothing
  double lower = 0, upper = 0;  ///< no limits if lower > upper
  bool operator==(const ShownJoint&) const = default;
};

/// An item that dofs move relative to its parent: by steps, each relative to where the previous one led. Pages compute
/// poses from it.
struct MovingItem {
  int item = 0;
  int dof = 0;        ///< first of its dofs
  double scale = 1.;  ///< multiplies dofs of "turn" and "shift"
  std::vector<std::string>
      steps;                 ///< "turn", "shift" (1 dof), "quaternion" (4: w x y z), "circle" (2: cos, sin), "time"
  std::vector<double> axes;  ///< three numbers per step
  bool operator==(const MovingItem&) const = default;
};

/// The dofs of a scene.
struct ShownJoints {
  std::vector<ShownJoint> dofs;
  std::vector<MovingItem> moving{};
  bool operator==(const ShownJoints&) const = default;
};

/// The scene after a command of a browser.
struct EditedScene {
  std::vector<Pose> poses;  ///< of all items, in the world
  VectorXd q;
  std::vector<NearLine> near{};
  std::optional<std::vector<SceneWarning>> warnings{};  ///< if a browser requested them
};

struct ViewerOptions {
  std::string host = "127.0.0.1";  ///< by default this machine only
  int port = 7000;                 ///< first port tried; occupied ports are skipped; 0: any free port
  std::string title = "Kinegraph";
  std::string token{};  ///< required from browsers, part of url(); empty: none on this machine, else a random one
};

/// Shows items in any number of browsers: an HTTP server for the page, and a websocket per browser for changes. It has
/// its own thread; a slow browser misses intermediate poses and never delays the program.
class ViewerServer {
 public:
  /// Throws ValueError for an invalid host or port, and Error if no port is available.
  explicit ViewerServer(const ViewerOptions& options = {});
  ~ViewerServer();  ///< in a forked process, does not close the parent's server
  ViewerServer(const ViewerServer&) = delete;

  /// Returns false in a forked child of the process that created it, which lacks the server's thread.
  bool isOurs() const;

  std::string url() const;
  int clients() const;

  /// Changes the locked scene, and updates browsers if `change` returns true. The methods below are shortcuts for it.
  void show(const std::function<bool(ShownScene&)>& change);

  /// Sends the differences from the last call.
  void update(std::span<const ViewItem> items);
  void update(std::span<const ViewItem> items, std::span<const int> changed);  ///< as ShownScene

  /// Sets the dofs and their values. Browsers send `structure`, the number of the scene, with their commands.
  void setJoints(int structure, const ShownJoints& joints, const VectorXd& q);

  /// Shows a motion of the present items, with a time slider, until `endMotion`.
  void showMotion(const ShownMotion& motion);
  void endMotion();

  /// Sets the lines between near shapes, for browsers that show them.
  void setNear(const std::vector<NearLine>& lines);

  /// Sets the warnings about the scene.
  void setWarnings(const std::vector<SceneWarning>& warnings);

  /// Shows an image on top of the scene; it replaces one with the same id. Throws ValueError for a wrong number of
  /// pixels.
  void setQuad(const Quad& quad);

  void setAppearance(const Appearance& appearance);

  /// Shows the card of an item, with handles to move it.
  void select(int item);

  /// Returns a self-contained HTML page of everything shown, which needs no server. `largest`: see recordedPage.
  std::string recording(std::size_t largest = 0) const;

  /// Records everything shown from now on, until stopRecording writes it to the file; runPage makes a page of it.
  /// Throws FileError if the file cannot be written, and ValueError during a recording.
  void startRecording(const std::string& path);
  void stopRecording();  ///< does nothing without a recording; throws FileError if the file cannot be written

  /// Sets the handler of commands other than keys; it runs on the server's thread and returns nothing for commands that
  /// do not apply. All browsers see the result.
  void onCommand(std::function<std::optional<EditedScene>(const Command&)> answer);

  void setMessage(const std::string& text);  ///< in the corner; may have several lines
  void setError(const std::string& text);    ///< in a box; empty removes it
  void setTitle(const std::string& text);

  void setCamera(const PageCamera& camera);

  /// Returns the camera of the pages: from setCamera, or as a user moved it; nothing without either.
  std::optional<PageCamera> camera() const;

  /// Returns the camera that a user has moved since the last call and the last setCamera; nothing if no user has.
  std::optional<PageCamera> takeViewpoint();

  /// Returns the last key pressed in a browser since the previous call, or 0. Letters are lower-case ASCII, Enter is
  /// 13, Escape 27, space 32; other keys have the codes of GLFW.
  int takeKey();

  /// Waits for a key that is pressed without Shift, Ctrl and Alt, except the left and right arrows, which step through
  /// motions. Returns 0 as soon as `cancellation` (checked every 20 ms) returns true.
  int waitKey(const CancellationToken& cancellation);

  /// Requests events from browsers; with `instead`, mouse and keys have no other effect on the page.
  void requestEvents(bool instead);
  /// Lets the keys 1, 2, 3, 4 and 7 toggle shapes, markers, axes, distances and names in the browser where they are
  /// pressed.
  void requestDigits(bool yes);
  std::vector<std::string> takeEvents();  ///< events since the last call; see eventName

  /// Returns the point under the pointer that moved last in any browser. Browsers report it from the first call on.
  std::optional<Cursor> cursor();

  /// Shows a running simulation, with buttons to control it, until `endRun`.
  void showRun(const ShownRun& run);
  void endRun();

  RunRequests takeRunRequests();        ///< present requests of users; see RunRequests::take
  void waitRunRequest(double seconds);  ///< waits for any message of browsers, up to a duration
  void endRunRequests();                ///< clears all requests: neither paused nor perturbed

  /// Waits until a browser is connected, up to a duration in s.
  bool waitForClient(double seconds);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Opens `url` in the user's browser if there is a display and KINEGRAPH_HEADLESS is not set. Returns at once and never
/// fails.
void openBrowser(const std::string& url);

/// Returns whether the environment variable KINEGRAPH_HEADLESS is set to a value other than 0: no browser is opened,
/// and no call waits.
bool isHeadless();

}  // namespace kinegraph::inline viewer_internal
