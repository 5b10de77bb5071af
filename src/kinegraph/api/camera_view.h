#pragma once

#include <memory>
#include <optional>

#include "kinegraph/rendering/camera_renderer.h"

namespace kinegraph {

/// Renders images from cameras in a scene, without display or browser. It uses the scene's state at each call, and
/// keeps the scene alive.
class CameraView {
 public:
  explicit CameraView(const Config& config, const RendererOptions& options = {});

  /// Attaches the camera to a frame, whose attributes define it, see cameraOf. Throws FrameNotFound, and ValueError for
  /// invalid attributes.
  CameraView& setCamera(const std::string& frame);

  /// Sets a fixed camera.
  CameraView& setCamera(const Camera& camera);

  Camera camera() const;                                       ///< with its present pose
  Vector4d getFxycxy() const { return camera().fxycxy(); }     ///< fx, fy, cx, cy in pixels
  CameraImage computeImageAndDepth(bool visuals_only = true);  ///< see CameraRenderer::render

  /// Returns the id of the frame in each pixel (height x width); -1 for the floor and the background.
  std::vector<std::int32_t> computeSegmentationID(bool visuals_only = true);

 private:
  std::shared_ptr<SceneTree> scene_;
  Camera camera_;
  std::optional<Frame> followed_;
  std::unique_ptr<CameraRenderer> renderer_;
};

}  // namespace kinegraph
