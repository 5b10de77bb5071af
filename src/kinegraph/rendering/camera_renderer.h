#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "kinegraph/rendering/camera.h"
#include "kinegraph/rendering/letters.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// How pictures look. The defaults are a sensor's: fast.
struct RendererOptions {
  int supersampling = 1;                   ///< pixels drawn per pixel, across and down, against jagged edges
  int slices = 128;                        ///< around balls, cylinders and capsules; even
  bool shadows = false;                    ///< of the first light; costs time
  bool floor = true;                       ///< a square of 10 m at z = 0, seen from above only
  Vector3d background = Vector3d::Ones();  ///< rgb in 0..1
  Vector3d floor_color = Vector3d(.4, .45, .5);
  std::vector<Vector3d> lights{};  ///< where they are, m; the first casts shadows; empty: two as usual; at most 8
  bool flat_colors = false;        ///< as they are given, without light
  bool wireframe = false;          ///< edges of triangles only
  bool operator==(const RendererOptions&) const = default;
};

/// What a camera sees. Rows run from top to bottom.
struct CameraImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< height x width x 3
  std::vector<float> depth;       ///< height x width, m along the camera's z; -1 where nothing is
};

/// Renders scenes without a display, on a graphics card or in software. The OpenGL context is made at the first image,
/// and meshes are uploaded when they change. May be used from several threads, one at a time.
class CameraRenderer {
 public:
  explicit CameraRenderer(const RendererOptions& options = {});
  ~CameraRenderer();
  CameraRenderer(const CameraRenderer&) = delete;
  CameraRenderer& operator=(const CameraRenderer&) = delete;

  /// Colors and depth. `visuals_only` leaves out markers and what is transparent. Transparent things show in the
  /// colors and not in the depth. Throws FileError without EGL or a driver; ValueError for an impossible camera.
  CameraImage render(SceneTree& scene, const Camera& camera, bool visuals_only = true);
  CameraImage render(const Config& config, const Camera& camera, bool visuals_only = true) {
    return render(*config.scene(), camera, visuals_only);
  }

  /// Which frame each pixel shows: its id; -1 for the floor and where nothing is. height x width.
  std::vector<std::int32_t> segment(SceneTree& scene, const Camera& camera, bool visuals_only = true);
  std::vector<std::int32_t> segment(const Config& config, const Camera& camera, bool visuals_only = true) {
    return segment(*config.scene(), camera, visuals_only);
  }

  /// A text in lines of 18 pixels, at most `width` pixels wide, for drawLetters; as many lines as `height` has room
  /// for.
  Letters write(const std::string& text, int width, int height);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kinegraph
