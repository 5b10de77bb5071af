#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// How pages show what they show. Changes nothing of what is shown.
struct Look {
  bool visuals_only = false;           ///< no markers, transparent shapes and messages
  std::optional<Vector3d> background;  ///< rgb in 0..1; without: as the reader's system says, light or dark
  std::optional<Vector3d> floor;       ///< rgb of a solid floor; without: a grid
  bool has_floor = true;
  bool shadows = true;
  bool text = true;                ///< messages
  std::vector<Vector3d> lights{};  ///< where they are, m; the first casts shadows; empty: as usual
  bool flat_colors = false;        ///< as they are given, without light
  bool wireframe = false;          ///< edges of triangles only
  bool operator==(const Look&) const = default;
};

/// Where a page looks from. Its axes: x to the right of the picture, y down, z forward.
struct PageCamera {
  Pose pose{};
  double distance = 2.;        ///< m along z: of what the page turns about
  double focal_length = 0.;    ///< in heights of the picture; 0: the page's own
  double ortho_height = 0.;    ///< if > 0: orthographic, this many m high
  double aspect = 0.;          ///< width over height of the picture, which the page shows all of; 0: any
  double near = 0., far = 0.;  ///< m along z: what is seen lies in between; 0: as usual
};

/// A picture on top of the scene.
struct Quad {
  int id = 0;             ///< one with the same id is replaced
  double x = 0., y = 0.;  ///< of its top left corner, in heights of the window
  double height = .2;     ///< in heights of the window; 0: `zoom` counts
  double zoom = 0.;       ///< pixels of the page for one of the picture; the picture is then all there is to see
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> rgb;  ///< rows x columns x 3
};

/// What is under the pointer.
struct Cursor {
  int frame = -1;
  Vector3d point = Vector3d::Zero(), normal = Vector3d::Zero();  ///< of the surface, world
};

}  // namespace kinegraph
