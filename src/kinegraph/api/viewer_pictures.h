#pragma once

#include <optional>
#include <string>

#include "kinegraph/api/page_drawings.h"
#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/rendering/picture_renderer.h"
#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph {

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

/// Converts a camera for pages.
PageCamera pageCameraOf(const Camera& camera);

/// The pictures of a viewer, drawn without a browser, and their camera.
class ViewerPictures {
 public:
  explicit ViewerPictures(ConfigViewer& viewer) : viewer_(viewer) {}

  /// Renders what the page shows, with a text in the corner. The depth is empty unless asked for; it has no drawings.
  CameraImage draw(const std::string& text, bool has_depth = false);

  /// Returns the file of a picture; see ConfigViewer::savePng.
  std::string fileOf(const std::string& path, int count);

  /// Returns the camera: as set, at a frame `camera_init` at first, at a frame `camera_track` always, or as a user has
  /// moved the page's.
  Camera camera();
  void place(const Camera& camera, double distance = 0.);  ///< distance of the page's center of rotation, m; 0: kept
  void follow(const Frame& frame);
  void lookFrom(const Vector3d& position, const Vector3d& target);
  void focus(const Vector3d& point, double height);
  Vector3d fit();
  void resize(int width, int height);

  /// Sets the camera of the pages, if a frame determines it and has moved.
  void aimPage();

  /// Sets the initial camera.
  void reset();

 private:
  std::shared_ptr<SceneTree> scene() const;  ///< throws ValueError without one
  bool startCamera();
  void aim(const PageCamera& page);

  ConfigViewer& viewer_;
  ViewCamera camera_{defaultViewCamera()};
  bool camera_is_set_ = false;
  std::optional<PageCamera> page_camera_;    ///< last camera sent to the pages
  double distance_ = PageCamera{}.distance;  ///< m from the camera to the center of rotation
  int saved_ = 0;                            ///< number of saved pictures
  PageDrawings drawings_;
  std::optional<PictureRenderer> renderer_;
  std::optional<CameraRenderer> writer_;  ///< of texts
};

}  // namespace kinegraph
