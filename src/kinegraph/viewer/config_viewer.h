#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/viewer/messages/shown.h"
#include "kinegraph/viewer/programmable_viewer.h"

namespace kinegraph::inline api_internal {
class ViewerPictures;
}

namespace kinegraph::inline viewer_internal {
class ViewerServer;
struct ViewerOptions;
}

namespace kinegraph {

class Config;
class Frame;
class ViewerRecording;
struct Camera;
struct CameraImage;
struct ShownMotion;

/// Shows a configuration in the browser. The server starts, and a browser opens, at the first call that shows
/// something.
class ConfigViewer : public ProgrammableViewer {
 public:
  ConfigViewer();
  explicit ConfigViewer(ViewerOptions options);
  ~ConfigViewer() override;

  /// Applies the changes that users made in browsers (see `takeEdits`), and shows the resulting configuration. Returns
  /// the key pressed since the last call, or 0. With `pause`, waits for a new key: in the browser, or Enter on the
  /// terminal. It does not wait if KINEGRAPH_HEADLESS is set, or for more than 5 s without a connected browser. At a
  /// terminal or over ssh, it waits without limit for the first browser.
  int view(Config& config, bool pause, const std::optional<std::string>& message,
           const CancellationToken& cancellation);

  /// Shows a message and, with `pause`, waits for a key like view. Changes nothing else.
  int wait(bool pause, const std::optional<std::string>& message, const CancellationToken& cancellation);

  /// Shows the configuration without reading keys and edits.
  void update(const Config& config);

  /// Applies joint values and poses that users set in browsers to the configuration, if it is the shown one with the
  /// same structure. Returns whether there were any.
  bool takeEdits(Config& config);

  /// The structure number of the shown scene, as in SceneItems.
  int structure() const;

  /// Returns whether users made changes that takeEdits has not applied yet.
  bool hasEdits() const;

  /// Shows a motion of the configuration, with a time slider. Waits until an automatically played motion has ended,
  /// then, with `pause`, for a key; a key ends both. Waits under the conditions of view. Returns the key, or 0.
  int showMotion(const Config& config, const ShownMotion& motion, bool pause, const std::optional<std::string>& message,
                 const CancellationToken& cancellation);

  /// Shows a text in the corner of the page, and starts the page if necessary.
  void setMessage(const std::string& text);
  /// Sets the text in the corner without starting the page; a page that starts later shows it.
  void storeMessage(const std::string& text);
  std::string message() const;
  void setError(const std::string& text);
  void setTitle(const std::string& text);
  void select(int frame);  ///< shows the card of a frame, with handles to move it
  /// Returns a self-contained HTML page of everything shown. `largest`: see recordedPage.
  std::string recording(std::size_t largest = 0);
  /// Saves `recording()` as a file for any browser. With `client`, the path of a file with the script of all such
  /// pages, the page loads it from there; the file is written if it does not exist. Throws FileError.
  void saveHtml(const std::string& path, const std::string& client = "");
  /// Records whatever is shown and logged from now on, until the returned object is stopped or destroyed. The file then
  /// plays on a page: `kinegraph view run.kgr`. Times are those of a shown simulation, else of the clock; a motion
  /// takes its duration. Starts the page if necessary. Throws FileError if the file cannot be written, and ValueError
  /// during another recording of this viewer.
  [[nodiscard]] ViewerRecording record(const std::string& path);
  void setCamera(const PageCamera& camera);  ///< of all pages, including later ones
  /// Returns the camera that a user has moved since the last call and the last setCamera; nothing if no user has.
  std::optional<PageCamera> takeViewpoint();
  /// Shows an image on top of the scene, on all pages and in pictures, at a place in heights of the window. `id`
  /// replaces an image; -1 adds one. Returns its id. Throws ValueError for a wrong number of pixels or place.
  int setQuad(int id, const PageImage& image, double x, double y, double height);
  const std::map<int, Quad>& quads() const;

  /// Requests events of mouse and keys from the page; with `instead`, they have no other effect there.
  void setupEventHandler(bool instead);
  std::vector<std::string> getEvents();  ///< since the last call, such as "click down left", "key up a", "scroll up"
  /// Returns the point under the pointer, the surface's normal and the frame; nothing until it was on a surface.
  std::optional<Cursor> getEventCursor();

  /// Renders the scene as the page shows it, with the program's drawings and the message, without a browser. The depth
  /// is empty. Throws ValueError before the viewer has a scene, and FileError without EGL or a driver.
  CameraImage getRgb();
  /// Renders with the depth (m along the camera's z axis; -1: background), which has no drawings.
  CameraImage getDepth();
  /// Saves a picture as PNG, and creates missing folders. `path` is the file, if it ends in .png; else the prefix of a
  /// six-digit number and .png: `count`, or counted up from 0. Returns the file. Throws ValueError for files that end
  /// in .jpg or another format, and FileError.
  std::string savePng(const std::string& path = "z.vid/", int count = -1);

  /// Returns the camera of pictures and pages: as set, or as a user has moved the page's since.
  Camera camera();
  void setCamera(const Camera& camera);
  void setCamera(const Frame& frame);  ///< follows a frame with its attributes of a camera; see `cameraOf`
  void setCamera(const Vector3d& position, const Vector3d& target);  ///< m
  /// Turns the camera to a point (m), and moves it such that `height` m fit into the picture there.
  void focus(const Vector3d& position, double height = 1.);
  /// Moves the camera along its line of sight such that the visible scene fills the picture. Returns the scene's
  /// center, m; 0 without a visible shape.
  Vector3d fit();
  void setWindow(const std::string& title, int width, int height);  ///< size of pictures, pixels
  void visualsOnly(bool yes = true);  ///< omits markers, transparent shapes and the message from pictures and pages
  void setAppearance(const Appearance& appearance);  ///< of pictures and pages, including later ones
  const Appearance& appearance() const;
  std::string url();
  int clients() const;
  int takeKey();  ///< also runs the callbacks that are due
  bool isOpen() const;
  void close();

  ViewerServer& server();

  /// Sets the address of the page: "0.0.0.0" allows browsers on other machines, which then need the token in `url()`. A
  /// page at another address is closed. With a `token`, all browsers need this one. Throws ValueError for an invalid
  /// address, and for a token with other characters than letters, digits, '-' and '_'.
  void serveAt(const std::string& host, int port, const std::string& token = "");

  /// With false, no call waits for users, as with KINEGRAPH_HEADLESS; pages are still shown.
  void setWaits(bool waits);
  bool waits() const;

 protected:
  void contentChanged() override;
  /// Returns the scene of pictures: that of the last `update` or `setScene`, in its present state; null without one.
  virtual std::shared_ptr<SceneTree> pictured() const;
  ViewerPictures& pictures();

 private:
  friend class api_internal::ViewerPictures;
  friend class Config;

  void setScene(const std::shared_ptr<SceneTree>& scene);
  /// Shows the message with a request for a key, and waits for one.
  int promptKey(const std::optional<std::string>& message, const CancellationToken& cancellation);
  int waitKey(const std::string& prompt, const CancellationToken& cancellation);
  void remember(const std::string& text);

  struct Impl;
  std::unique_ptr<Impl> impl_;
  std::shared_ptr<ViewerPictures> pictures_;  ///< null until needed
  std::function<void()> reset_pictures_;      ///< sets the initial camera
};

/// A running recording of a viewer, which must outlive it. Closing the viewer ends it, too.
class ViewerRecording {
 public:
  explicit ViewerRecording(ConfigViewer& viewer) : viewer_(&viewer) {}
  ViewerRecording(ViewerRecording&& other) noexcept : viewer_(std::exchange(other.viewer_, nullptr)) {}
  ViewerRecording& operator=(ViewerRecording&&) = delete;
  ~ViewerRecording();  ///< stops; logs errors

  /// Ends the recording and writes the file. Throws FileError if that fails. Does nothing at a second call.
  void stop();

 private:
  ConfigViewer* viewer_;
};

/// Returns whether a user may still connect: at a terminal, or over ssh, where the port has to be forwarded first.
bool isPatient();

/// Returns whether Enter was pressed on the terminal since the last call.
bool enterWasPressed();

/// Samples joint values uniformly within the limits, without limits within .5 of the present; quaternions have norm
/// one.
VectorXd randomJointState(const Config& config, Rng& rng);

/// Returns the motion through the rows of `path` (T x n) with equal time steps. Throws ValueError for another width.
ShownMotion motionAlong(const Config& config, const MatrixXd& path, double seconds);

/// Returns a motion that sweeps every dof, from the last to the first, through its limits and back in one second; dofs
/// without limits by .5 around their present value. Texts name the dof.
ShownMotion jointSweep(const Config& config);

/// Returns a smooth motion of points + 1 seconds that starts and ends at the present q: a cubic B-spline whose control
/// points are `points` random joint states. It stays within the limits, because it stays in the hull of its control
/// points.
ShownMotion randomSpline(const Config& config, int points, Rng& rng);

/// Loads a scene file into `config`, shows it, and reloads it whenever the file or an included one changes, until q or
/// Escape is pressed in the browser, or Enter on the terminal. Other keys: see WatchKeys. With an invalid file, the
/// last valid scene stays; the message appears in the browser and is passed to `report`. `cancellation` is checked
/// every 20 ms and ends the call. If KINEGRAPH_HEADLESS is set, so that no key can be pressed, it loads and shows once.
void watchFile(Config& config, ConfigViewer& viewer, const std::string& path,
               const std::function<void(const std::string&)>& report, const CancellationToken& cancellation);

}  // namespace kinegraph
