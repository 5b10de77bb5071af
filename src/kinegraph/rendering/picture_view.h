#pragma once

#include "kinegraph/rendering/gl/gl_program.h"
#include "kinegraph/rendering/picture_renderer.h"
#include "kinegraph/rendering/picture_scene.h"

namespace kinegraph::inline rendering_internal {

/// A part of the floor: a parallelogram around its center.
struct FloorPart {
  Vector3d center, half_x, half_y;  ///< m
};

/// Places of textures in programs of pictures.
struct PictureTextures {
  static constexpr unsigned kPicture = 0, kShadowMap = 1, kSamples = 2, kDepths = 3, kGlass = 4;
};

/// The content and the appearance of a picture.
struct PictureView {
  static constexpr int kFiner = 2;              ///< samples per pixel and direction, against aliasing
  static constexpr double kSolidFloor = -.002;  ///< m, height of a colored floor, below its lines

  PictureScene scene;
  Camera camera;  ///< its pixels are samples
  PictureOptions options;

  /// Without a range of the camera, it fits the scene.
  PictureView(PictureScene shown, const Camera& shown_by, const PictureOptions& chosen);

  /// Sets the parameters of a program. It must be in use.
  void describe(GlProgram& program) const;

  bool hasShadows() const { return options.shadows && !options.flat_colors; }
  Vector3d background() const;  ///< rgb in 0..1
  Vector3d towardsSun() const;
  int lights() const;  ///< number of lights with a direction

  double square() const;       ///< width of the floor's large squares, m
  double floorHeight() const;  ///< of its lines, m
  /// Returns the floor: all of it, or where it has lines.
  FloorPart wholeFloor(double height) const;
  FloorPart linedFloor() const;

 private:
  FloorPart floorAround(double half, double height) const;
};

}  // namespace kinegraph::inline rendering_internal
