#pragma once

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
  std::shared_ptr<SceneTree> scene;           ///< what is shown
  ViewCamera camera{defaultViewCamera()};     ///< of pictures
  bool camera_is_set = false;
  bool visuals_only = false;
  Look look;                                  ///< of the page
  int saved = 0;                              ///< pictures
  int quads = 0;                              ///< pictures on top of the scene: the next id
  std::optional<CameraRenderer> renderer;     ///< made for the first picture
};

/// What people do on the page, and pictures on top of it.
void bindViewerInput(nb::module_& m, nb::class_<PyViewer>& viewer);

/// Starts the page, if it does not run, with the look that parameters `Render/...` and visualsOnly say. It looks from a frame
/// `camera_init` when it is first shown, and always from a frame `camera_track`.
void preparePage(PyViewer& viewer);

/// The picture calls of a viewer.
void bindPictures(nb::class_<PyViewer>& viewer);

/// Saves a picture as PNG: as `path` if that ends in .png, else as path + number of six digits + .png. Returns the file.
std::string savePicture(PyViewer& viewer, const std::string& path, int count);

}  // namespace kinegraph::python
