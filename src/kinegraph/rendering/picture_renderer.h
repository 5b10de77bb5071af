#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline rendering_internal {
struct PictureDrawing;
}

namespace kinegraph {

/// The appearance of pictures. The defaults are those of the viewer's page in daylight.
struct PictureOptions {
  bool has_floor = true;                     ///< lines and shadows at z = 0; it is deep from above, not from below
  bool shadows = true;                       ///< of the first light
  std::optional<Vector3d> background = {};   ///< rgb in 0..1; without: light gray
  std::optional<Vector3d> floor_color = {};  ///< rgb of a solid floor; without: lines only
  std::vector<Vector3d> lights = {};         ///< positions, m; empty: a sun and a weaker light; at most 8
  bool flat_colors = false;                  ///< colors without shading
  bool wireframe = false;                    ///< edges of triangles only
  double distance = 1.5;                     ///< m from the camera to its target, for the size of the squares
  bool has_depth = true;                     ///< computes depths; without, those of the image are empty
  void validate() const;                     ///< throws ValueError
};

/// Draws scenes as the viewer's page shows them, without a browser or display: the same lights, soft shadows, surfaces,
/// floor and visible shapes. It draws on a graphics card or in software. The OpenGL context is created with the first
/// picture. Several threads may use it, one at a time. For images of a sensor, use CameraRenderer.
class PictureRenderer {
 public:
  PictureRenderer();
  ~PictureRenderer();
  PictureRenderer(const PictureRenderer&) = delete;
  PictureRenderer& operator=(const PictureRenderer&) = delete;

  /// Renders colors and depth. `visuals_only` omits markers and transparent shapes. Transparent shapes appear in the
  /// colors but not in the depth. The range of the camera applies if `has_range`; otherwise the range fits the scene.
  /// Throws FileError without EGL or a driver, and ValueError for an invalid camera.
  CameraImage render(SceneTree& scene, const Camera& camera, const PictureOptions& options = {},
                     bool visuals_only = false);
  CameraImage render(const Config& config, const Camera& camera, const PictureOptions& options = {},
                     bool visuals_only = false) {
    return render(*config.scene(), camera, options, visuals_only);
  }

  /// Renders drawings, too, which belong to no frame.
  CameraImage render(SceneTree& scene, const std::vector<PictureDrawing>& drawings, const Camera& camera,
                     const PictureOptions& options, bool visuals_only);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kinegraph
