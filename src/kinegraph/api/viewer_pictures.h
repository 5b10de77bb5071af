#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "kinegraph/api/page_drawings.h"
#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/rendering/picture_renderer.h"
#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph::inline api_internal {

/// A fixed camera, or one that follows a frame.
class ViewCamera {
 public:
  explicit ViewCamera(const Camera& camera) : camera_(camera) {}

  /// Follows a frame, with the camera of its attributes. Without the frame, the camera stays where it was last.
  void follow(const std::shared_ptr<SceneTree>& scene, const FrameData& frame);
  void place(const Camera& camera) {
    camera_ = camera;
    frame_.reset();
  }
  void resize(int width, int height) {
    camera_.width = width;
    camera_.height = height;
  }
  bool follows() const { return !frame_.expired(); }
  Camera now();

 private:
  Camera camera_;
  std::weak_ptr<SceneTree> scene_;  ///< of the frame; the scene may own the viewer
  std::weak_ptr<FrameData> frame_;
};

/// What a picture shows.
struct PictureContent {
  std::shared_ptr<SceneTree> scene;
  Camera camera;
  double distance;  ///< m from the camera to the center of rotation
  Appearance appearance;
  PageDrawings::Listed drawings;
  std::map<int, Quad> quads;
  bool has_depth;
};

/// Converts a camera for pages.
PageCamera pageCameraOf(const Camera& camera);

/// The pictures of a viewer, drawn without a browser, and their camera.
class ViewerPictures {
 public:
  explicit ViewerPictures(ConfigViewer& viewer) : viewer_(viewer) {}

  /// Returns what the page shows now. With `has_depth`, without drawings.
  PictureContent content(bool has_depth = false);

  /// Renders it, with a text in the corner. The depth is empty unless asked for. Changes nothing else, so that other
  /// threads may call this viewer meanwhile, if they do not change the scene.
  CameraImage draw(const PictureContent& content, const std::string& text);

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
  std::mutex drawing_;                       ///< for what is below
  PageDrawings drawings_;
  std::optional<PictureRenderer> renderer_;
  std::optional<CameraRenderer> writer_;  ///< of texts
};

}  // namespace kinegraph::inline api_internal
