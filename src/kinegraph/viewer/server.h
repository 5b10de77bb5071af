#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/geometry/shapes/geometry.h"
#include "kinegraph/viewer/messages/commands.h"
#include "kinegraph/viewer/messages/look.h"
#include "kinegraph/viewer/messages/near_lines.h"
#include "kinegraph/viewer/messages/run_requests.h"
#include "kinegraph/viewer/messages/scene_notes.h"
#include "kinegraph/viewer/messages/shown_motion.h"
#include "kinegraph/viewer/messages/shown_run.h"

namespace kinegraph {

class ShownScene;

/// What a viewer shows of a frame.
struct ViewItem {
  std::string name;
  int parent = -1;                           ///< index of the parent item, or -1
  Pose pose;                                 ///< in the world
  std::shared_ptr<const Geometry> geometry;  ///< null: nothing to see
  Vector4d color{.8, .8, .8, 1.};            ///< rgba in 0..1
  bool collides = false;                     ///< it counts in collisions
  std::string details;                       ///< what else there is to say, as attributes of a .g file
};

/// A dof that people can move in the browser.
struct ShownJoint {
  std::string name;
  int frame = 0;                ///< index of the item that carries it
  std::string unit;             ///< rad, m, or nothing
  double lower = 0, upper = 0;  ///< no limits if lower > upper
  bool operator==(const ShownJoint&) const = default;
};

/// What a command of a browser makes of the scene.
struct EditedScene {
  std::vector<Pose> poses;  ///< of all items, in the world
  VectorXd q;
  std::vector<NearLine> near{};
  std::optional<std::vector<SceneNote>> notes{};  ///< if somebody asked
};

struct ViewerOptions {
  std::string host = "127.0.0.1";  ///< only this machine, unless told otherwise
  int port = 7000;                 ///< first one tried; those in use are passed over; 0: any free one
  std::string title = "Kinegraph";
  std::string token{};  ///< that browsers have to send, as in url(); empty: none on this machine, else a random one
};

/// Shows items in any number of browsers: an HTTP server for the page, and a websocket each for what changes. It has a
/// thread of its own; a slow browser misses intermediate poses and never holds the program up.
class ViewerServer {
 public:
  /// Throws ValueError for a host or port that cannot be, Error if no port can be had.
  explicit ViewerServer(const ViewerOptions& options = {});
  ~ViewerServer();  ///< in a forked process, leaves the other one's server alone
  ViewerServer(const ViewerServer&) = delete;

  /// False in a process that was forked from the one that made this: the server's thread is not there.
  bool isOurs() const;

  std::string url() const;
  int clients() const;

  /// Changes what is shown, with the scene locked, and tells browsers if `change` returns that there is something to
  /// tell. The methods below say the same in a word.
  void show(const std::function<bool(ShownScene&)>& change);

  /// Sends what differs from the last call: nothing if nothing does.
  void update(std::span<const ViewItem> items);

  /// The dofs, and their values. Browsers send `structure` with their commands: the scene that they refer to.
  void setJoints(int structure, const std::vector<ShownJoint>& joints, const VectorXd& q);

  /// Shows a motion of the items that were given last, with a time slider, until `endMotion`.
  void showMotion(const ShownMotion& motion);
  void endMotion();

  /// Lines between shapes that are near each other, for browsers that show them.
  void setNear(const std::vector<NearLine>& lines);

  /// What there is to say about the scene.
  void setNotes(const std::vector<SceneNote>& notes);

  /// A picture on top of the scene; one with the same id is replaced. Throws ValueError for numbers of pixels that do
  /// not match.
  void setQuad(const Quad& quad);

  void setLook(const Look& look);

  /// Shows the card of an item, with handles to move it.
  void select(int item);

  /// The page with all that is shown inside: an HTML file that opens without this server.
  std::string recording() const;

  /// Answers commands other than keys, on the server's thread; nothing for those that mean nothing. All browsers see
  /// the answer.
  void onCommand(std::function<std::optional<EditedScene>(const Command&)> answer);

  void setMessage(const std::string& text);  ///< in the corner; may have several lines
  void setError(const std::string& text);    ///< in a box; empty removes it
  void setTitle(const std::string& text);

  void setCamera(const PageCamera& camera);

  /// Where pages look from: as setCamera said, or where a person turned one to; nothing if nobody has said anything.
  std::optional<PageCamera> camera() const;

  /// Where a person has turned a page to since the last call, and since the last setCamera; nothing if nobody has.
  std::optional<PageCamera> takeViewpoint();

  /// The last key pressed in a browser since the previous call, or 0. Letters as lower-case ASCII, Enter 13, Escape 27,
  /// space 32; others have the codes of GLFW.
  int takeKey();

  /// Waits for a key that is pressed without Shift, Ctrl and Alt, and that is not the arrow to the left or right, which
  /// step through motions. Returns 0 as soon as `cancellation` (asked every 20 ms) says so.
  int waitKey(const CancellationToken& cancellation);

  /// Browsers send events from now on; with `instead`, mouse and keys do nothing else on the page.
  void requestEvents(bool instead);
  /// The keys 1, 2, 3, 4 and 7 switch shapes, markers, axes, distances and names on and off, in the browser where they
  /// are pressed.
  void requestDigits(bool yes);
  std::vector<std::string> takeEvents();  ///< those since the last call; see eventName

  /// What is under the pointer of the browser in which it moved last. Browsers tell from the first call on.
  std::optional<Cursor> cursor();

  /// Shows that a simulation runs, with buttons to steer it, until `endRun`.
  void showRun(const ShownRun& run);
  void endRun();

  RunRequests takeRunRequests();        ///< what people ask of it now; see RunRequests::take
  void waitRunRequest(double seconds);  ///< for any news from browsers, or for so long
  void endRunRequests();                ///< nobody asks for anything any more: it is not paused, and nothing is pulled

  /// Waits until a browser is connected, for at most so many seconds.
  bool waitForClient(double seconds);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Opens `url` in the user's browser if there is a display and KINEGRAPH_HEADLESS is not set. Never waits, never fails.
void openBrowser(const std::string& url);

/// True if the environment variable KINEGRAPH_HEADLESS is set to anything but 0: no browser is opened, and nothing
/// waits.
bool isHeadless();

}  // namespace kinegraph
