#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings.h"
#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/rendering/picture_renderer.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/viewer/config_viewer.h"
#include "kinegraph/viewer/page_content.h"
#include "kinegraph/viewer/server.h"

namespace kinegraph::python {

/// A fixed camera, or one that follows a frame.
class ViewCamera {
 public:
  explicit ViewCamera(const Camera& camera) : camera_(camera) {}

  /// Follows a frame, with the camera of its attributes.
  void follow(const Frame& frame) {
    camera_ = cameraOf(frame);
    frame_ = frame;
  }
  void place(const Camera& camera) {
    camera_ = camera;
    frame_.reset();
  }
  void resize(int width, int height) {
    camera_.width = width;
    camera_.height = height;
  }
  bool follows() const { return frame_.has_value(); }
  Camera now() const {
    Camera camera = camera_;
    if (frame_) camera.pose = frame_->getPose();
    return camera;
  }

 private:
  Camera camera_;
  std::optional<Frame> frame_;
};

/// The Python object of a viewer: the page in the browser, and pictures of the same scene without a browser.
struct PyViewer : ConfigViewer {
  using ConfigViewer::ConfigViewer;

  std::shared_ptr<SceneTree> scene;        ///< the shown scene
  ViewCamera camera{defaultViewCamera()};  ///< of pictures
  bool camera_is_set = false;
  std::optional<PageCamera> page_camera;  ///< last camera sent to the pages
  bool visuals_only = false;
  int saved = 0;                            ///< number of saved pictures
  std::map<int, Quad> quads;                ///< images on top of the scene
  std::vector<std::string> folders;         ///< of new controls, outermost first
  double distance = PageCamera{}.distance;  ///< m from the camera to the center of rotation
  std::optional<PictureRenderer> pictures;  ///< created with the first picture
  std::optional<CameraRenderer> letters;    ///< of texts in pictures

  /// Sets the camera of all pages, including later ones.
  void aim(const PageCamera& from);

  /// Closes the page; the next one starts with the initial camera.
  void endPage();
};

constexpr int kEscape = 27;  ///< returned at once by views if the parameter `disableGui` is set

/// Opens the page, in a notebook below the cell, with the appearance of the parameters `Render/...` and visualsOnly.
/// Its camera is at a frame `camera_init` when it is first shown, always at a frame `camera_track`, and as calls of the
/// viewer set it. Returns false, without a page, if the parameter `disableGui` is set.
bool openPage(PyViewer& viewer);

/// Stores the message, and opens the page. Returns false, without a page, if `offscreen` is set or openPage opens none.
bool show(PyViewer& viewer, const std::optional<std::string>& message, bool offscreen);

/// Shows another scene, or a motion in it, on the page of `config`. As Config.view and Config.view_path.
int viewOnPage(PyConfig& config, Config shown, bool pause, const std::string& message);
int playOnPage(PyConfig& config, const Config& shown, const ShownMotion& motion, bool pause,
               const std::string& message);

/// Returns the viewer's camera: as set, or as a user has moved the page's since.
Camera cameraNow(PyViewer& viewer);

/// Converts a camera for pages.
PageCamera pageCameraOf(const Camera& camera);

/// Returns the appearance of pages and pictures in the parameters `Render/...`.
Appearance appearanceFromParameters();

/// Checks for Ctrl-C, which throws; otherwise returns false.
bool interrupted();

/// Binds user input on the page, and images on top of it.
void bindViewerInput(nb::module_& m, nb::class_<PyViewer>& viewer);

/// Binds what a program adds to the page: controls, drawings, plots and notifications.
void bindPageContent(nb::module_& m, nb::class_<PyViewer>& viewer);

/// Binds the picture calls of a viewer.
void bindPictures(nb::class_<PyViewer>& viewer);

/// Saves a picture as PNG: to `path` if it ends in .png, else to path + six-digit number + .png. It shows `text`, or
/// the viewer's message. Returns the file.
std::string savePicture(PyViewer& viewer, const std::string& path, int count,
                        const std::optional<std::string>& text = std::nullopt);

}  // namespace kinegraph::python
