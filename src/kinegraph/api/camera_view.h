#pragma once

#include <memory>
#include <optional>

#include "kinegraph/rendering/camera_renderer.h"

namespace kinegraph {

/// Images from cameras in a scene; they need neither display nor browser. It sees the scene as it is whenever an image
/// is computed, and keeps it alive.
class CameraView {
 public:
  explicit CameraView(const Config& config, const RendererOptions& options = {});

  /// Looks from a frame and follows it; its attributes say which camera it is, see cameraOf. Throws FrameNotFound, and
  /// ValueError for attributes that make no sense.
  CameraView& setCamera(const std::string& frame);

  /// Looks from where `camera` is.
  CameraView& setCamera(const Camera& camera);

  Camera camera() const;                                       ///< where it is now
  Vector4d getFxycxy() const { return camera().fxycxy(); }     ///< fx, fy, cx, cy in pixels
  CameraImage computeImageAndDepth(bool visuals_only = true);  ///< see CameraRenderer::render

  /// The id of the frame that each pixel shows (height x width); -1 for the floor and where nothing is.
  std::vector<std::int32_t> computeSegmentationID(bool visuals_only = true);

 private:
  std::shared_ptr<SceneTree> scene_;
  Camera camera_;
  std::optional<Frame> followed_;
  std::unique_ptr<CameraRenderer> renderer_;
};

}  // namespace kinegraph
