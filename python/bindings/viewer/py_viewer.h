#pragma once

#include <map>
#include <memory>
#include <optional>

#include "bindings.h"
#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph::python {

/// A camera that stays where it is, or that follows a frame.
class ViewCamera {
 public:
  explicit ViewCamera(const Camera& camera) : camera_(camera) {}

  /// Takes the camera that the frame describes, at the frame's pose from now on.
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

/// What Python calls a viewer: the page in the browser, and pictures of the same scene that need no browser.
struct PyViewer : ConfigViewer {
  using ConfigViewer::ConfigViewer;

  std::shared_ptr<SceneTree> scene;        ///< what is shown
  ViewCamera camera{defaultViewCamera()};  ///< of pictures
  bool camera_is_set = false;
  std::optional<PageCamera> page_camera;  ///< where pages were told to look from
  bool visuals_only = false;
  int saved = 0;                           ///< pictures
  std::map<int, Quad> quads;               ///< pictures on top of the scene
  std::optional<CameraRenderer> renderer;  ///< made for the first picture
  RendererOptions renderer_options;        ///< what it was made with

  /// Pages look from there, those that are opened later as well.
  void aim(const PageCamera& from);

  /// Ends the page; the next one begins as the first did.
  void endPage();
};

constexpr int kEscape = 27;  ///< the key that views return at once where parameter `disableGui` is set

/// Starts the page, if it does not run, below the cell in a notebook, with the look that parameters `Render/...` and
/// visualsOnly say. It looks from a frame `camera_init` when it is first shown, always from a frame `camera_track`, and
/// from where calls of the viewer said. False, and no page, where parameter `disableGui` is set.
bool openPage(PyViewer& viewer);

/// Remembers the message, and opens the page; false, and no page, if `offscreen` or where openPage opens none.
bool show(PyViewer& viewer, const std::optional<std::string>& message, bool offscreen);

/// Where the viewer looks from: as it was told, or where a person has turned the page to since.
Camera cameraNow(PyViewer& viewer);

/// What pages are told of a camera.
PageCamera pageCameraOf(const Camera& camera);

/// How parameters `Render/...` say that pages and pictures look.
Appearance appearanceFromParameters();

/// True if people can stop the waiting: never, but Ctrl-C throws.
bool interrupted();

/// What people do on the page, and pictures on top of it.
void bindViewerInput(nb::module_& m, nb::class_<PyViewer>& viewer);

/// The picture calls of a viewer.
void bindPictures(nb::class_<PyViewer>& viewer);

/// Saves a picture as PNG: as `path` if that ends in .png, else as path + number of six digits + .png. `text` is on it,
/// or the viewer's message. Returns the file.
std::string savePicture(PyViewer& viewer, const std::string& path, int count,
                        const std::optional<std::string>& text = std::nullopt);

}  // namespace kinegraph::python
