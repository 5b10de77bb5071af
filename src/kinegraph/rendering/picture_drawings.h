#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "kinegraph/geometry/files/image_file.h"
#include "kinegraph/math/pose.h"
#include "kinegraph/rendering/picture_meshes.h"

namespace kinegraph::inline rendering_internal {

/// A shape of a picture that belongs to no frame, such as an arrow that a program draws on the viewer's page.
struct PictureDrawing {
  enum class Colors { lit, symbol, image };  ///< lit, bright like markers, or exactly those of an image

  std::shared_ptr<const PictureMesh> mesh;  ///< the same object is uploaded once
  Pose pose{};                              ///< in the world
  Vector4d color = Vector4d::Ones();        ///< rgba in 0..1, for meshes without colors of their own
  Colors colors = Colors::symbol;
  double width = 0.;  ///< of lines, pixels; 0: that of lines in scenes
  double size = 0.;   ///< of points, m; 0: some pixels
};

using ColorBytes = std::array<std::uint8_t, 4>;  ///< rgba

/// Returns lines between consecutive pairs of points (m), with one color for each point or none.
PictureMesh linesMesh(const std::vector<Vector3d>& points, const std::vector<ColorBytes>& colors = {});

/// Returns points (m), with one color for each or none.
PictureMesh pointsMesh(const std::vector<Vector3d>& points, const std::vector<ColorBytes>& colors = {});

/// Returns an image at z, its center at x = y = 0, x to the right and y down, seen from both sides. All in m.
PictureMesh imageMesh(Pixels pixels, double width, double height, double z);

}  // namespace kinegraph::inline rendering_internal
