#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "kinegraph/rendering/camera.h"
#include "kinegraph/rendering/camera_image.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

struct Letters;

/// Settings of rendered images. The defaults are those of a sensor: fast.
struct RendererOptions {
  int supersampling = 1;                   ///< rendered pixels per pixel and direction, against aliasing
  int slices = 128;                        ///< of balls, cylinders and capsules around the axis; even
  bool shadows = false;                    ///< shadows of the first light; slower
  bool floor = true;                       ///< a square of 10 m at z = 0, visible from above only
  Vector3d background = Vector3d::Ones();  ///< rgb in 0..1
  Vector3d floor_color = Vector3d(.4, .45, .5);
  std::vector<Vector3d> lights{};  ///< positions, m; the first casts shadows; empty: two default lights; at most 8
  bool flat_colors = false;        ///< colors without shading
  bool wireframe = false;          ///< edges of triangles only
  bool operator==(const RendererOptions&) const = default;
};

/// Renders scenes without a display, on a graphics card or in software. The OpenGL context is created with the first
/// image, and meshes are uploaded when they change. Several threads may use it, one at a time.
class CameraRenderer {
 public:
  explicit CameraRenderer(const RendererOptions& options = {});
  ~CameraRenderer();
  CameraRenderer(const CameraRenderer&) = delete;
  CameraRenderer& operator=(const CameraRenderer&) = delete;

  /// Renders colors and depth. `visuals_only` omits markers and transparent shapes. Transparent shapes appear in the
  /// colors but not in the depth. Throws FileError without EGL or a driver, and ValueError for an invalid camera.
  CameraImage render(SceneTree& scene, const Camera& camera, bool visuals_only = true);
  CameraImage render(const Config& config, const Camera& camera, bool visuals_only = true) {
    return render(*config.scene(), camera, visuals_only);
  }

  /// Returns the id of the frame in each pixel (height x width); -1 for the floor and the background.
  std::vector<std::int32_t> segment(SceneTree& scene, const Camera& camera, bool visuals_only = true);
  std::vector<std::int32_t> segment(const Config& config, const Camera& camera, bool visuals_only = true) {
    return segment(*config.scene(), camera, visuals_only);
  }

  /// Renders a text for drawLetters, in lines of 18 pixels and at most `width` pixels wide; lines that exceed `height`
  /// are omitted.
  Letters write(const std::string& text, int width, int height);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kinegraph
