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
  int saved = 0;                              ///< pictures
  CameraRenderer renderer{{.supersampling = 2}};
};

/// The picture calls of a viewer.
void bindPictures(nb::class_<PyViewer>& viewer);

/// Saves a picture as PNG: as `path` if that ends in .png, else as path + number of six digits + .png. Returns the file.
std::string savePicture(PyViewer& viewer, const std::string& path, int count);

}  // namespace kinegraph::python
