#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "kinegraph/rendering/gl/gl_frame.h"
#include "kinegraph/rendering/gl/gl_program.h"
#include "kinegraph/rendering/picture_view.h"

namespace kinegraph::inline rendering_internal {

/// The depths that the sun sees, in a square map around the scene. Its context must be in use for all calls.
class SunShadows {
 public:
  SunShadows();

  /// Draws the map, unless no shape that casts shadows has moved since it was drawn.
  void draw(const PictureView& view);

  /// Sets the parameters of a program that asks for the sun's light. Without shadows, everything is in light.
  void describe(GlProgram& program, bool has_shadows) const;

  /// Returns a part of the floor with all shadows on it.
  FloorPart shadedFloor(const PictureView& view) const;

  unsigned map() const { return frame_.depth(); }  ///< texture

 private:
  using Caster = std::pair<std::uint64_t, Eigen::Matrix4d>;  ///< the shape, and the matrix from it to the map

  void place(const PictureView& view);
  void clear(const Vector3d& lower, const Vector3d& upper);

  GlProgram program_;
  GlFrame frame_;
  Eigen::Matrix4d to_map_ = Eigen::Matrix4d::Identity(), to_shadow_ = to_map_;
  Vector3d lower_ = Vector3d::Zero(), upper_ = Vector3d::Ones();  ///< of all casters, on the map
  double normal_bias_ = 0.;
  std::vector<Caster> drawn_;
  bool is_clear_ = false;
};

}  // namespace kinegraph::inline rendering_internal
