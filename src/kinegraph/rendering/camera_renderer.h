#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "kinegraph/common/random.h"
#include "kinegraph/math/pose.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/scene/frame.h"

namespace kinegraph::inline rendering_internal {
struct Letters;
}

namespace kinegraph {

/// An image of a camera. Rows run from top to bottom.
struct CameraImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< height x width x 3
  std::vector<float> depth;       ///< height x width, m along the camera's z; -1 for the background
};

/// Averages the colors of factor x factor pixels; the depth is that of their middle pixel.
CameraImage shrunk(const CameraImage& fine, int factor);

/// A pinhole or orthographic camera. Its axes: x to the right of the image, y down, z forward.
/// The center of the image is on the z axis; pixels are square.
struct Camera {
  Pose pose;        ///< in the world
  int width = 640;  ///< pixels
  int height = 480;
  double focal_length = 2.41421356;  ///< in image heights: fx = fy = focal_length * height pixels
  double ortho_height = 0.;          ///< if > 0: orthographic, this many m high
  double near = .1, far = 10.;       ///< visible range, m along z
  bool has_range = false;            ///< `near` and `far` were set explicitly: pages are limited to them, too

  /// fx, fy, cx, cy in pixels.
  Vector4d fxycxy() const { return {focal_length * height, focal_length * height, .5 * width, .5 * height}; }

  /// Throws ValueError for invalid sizes, focal lengths and ranges.
  void validate() const;
};

/// Reads a camera from a frame's attributes, at the frame's pose: `focalLength`, `heightAngle` (the image's vertical
/// angle, degrees) or `orthoAbsHeight` / `heightAbs` (m); `width`, `height`, `zRange` [near far]. The defaults are
/// those of Camera. Throws ValueError for invalid attributes.
Camera cameraOf(const Frame& frame);

/// Tells whether a frame describes a camera: its shape is `camera`, or it has one of these attributes.
bool isCamera(const Frame& frame);

/// The initial camera of a viewer: 600 x 500 pixels, from (2, 5, 1.7) towards (0, 0, 1).
Camera defaultViewCamera();
/// A ball around everything that a picture shows.
struct ShownBall {
  Vector3d center;  ///< m, in the world
  double radius;    ///< m
};

/// Returns a ball around all visible surfaces, or nothing without any.
std::optional<ShownBall> shownBall(const Config& config);

/// Returns the camera, moved along its line of sight so that the visible scene just fills the image, with a suitable
/// range. Returns it unchanged for an empty scene.
Camera fitted(Camera camera, const Config& config);

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

/// Converts a depth image to points in the camera's frame, height x width x 3: X = (column - cx) d / fx,
/// Y = (row - cy) d / fy, Z = d. Negative depths give zero. `fxycxy` is fx fy cx cy in pixels.
std::vector<double> depthToPoints(const float* depth, int height, int width, const Vector4d& fxycxy);

/// Parameters of the errors of a stereo camera.
struct DepthNoise {
  double baseline = .03;  ///< distance of its two eyes, m
  double overall = .02;   ///< scale of the noise, relative to depth squared, 1/m
  double wide = 4.;       ///< share of the noise that is smooth over 10 pixels
  double local = .4;      ///< share over 3 pixels
  double pixel = .04;     ///< share of independent pixels
  double no_depth = 3.;   ///< m, assumed depth of the background

  /// Throws ValueError for numbers that are negative or not finite.
  void validate() const;
};

/// Adds the errors of a stereo camera to `depth`, an image of `camera`. `other_eye` is the depth from `noise.baseline`
/// to the right. Pixels visible to one eye only (the depths differ by more than 5 cm) become -1; the others get noise
/// that grows with the square of the depth.
void addDepthNoise(std::vector<float>& depth, const std::vector<float>& other_eye, const Camera& camera,
                   const DepthNoise& noise, Rng& rng);

/// Returns the camera of the other eye.
Camera otherEye(const Camera& camera, const DepthNoise& noise);

}  // namespace kinegraph
