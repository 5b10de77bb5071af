#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// The appearance of the scene on pages.
struct Appearance {
  bool visuals_only = false;           ///< omits markers, transparent shapes and messages
  std::optional<Vector3d> background;  ///< rgb in 0..1; without: light or dark, by the user's system
  std::optional<Vector3d> floor;       ///< rgb of a solid floor; without: a grid
  bool has_floor = true;
  bool shadows = true;
  bool text = true;                ///< messages
  std::vector<Vector3d> lights{};  ///< positions, m; the first casts shadows; empty: the default lights
  bool flat_colors = false;        ///< colors without shading
  bool wireframe = false;          ///< edges of triangles only
  bool operator==(const Appearance&) const = default;
};

/// The camera of a page. Its axes: x to the right of the picture, y down, z forward.
struct PageCamera {
  Pose pose{};
  double distance = 2.;        ///< m along z, to the center of rotation
  double focal_length = 0.;    ///< in heights of the picture; 0: the page's default
  double ortho_height = 0.;    ///< if > 0: orthographic, this many m high
  double aspect = 0.;          ///< width over height of the picture, which the page shows completely; 0: any
  double near = 0., far = 0.;  ///< visible range, m along z; 0: the default
};

/// An image on top of the scene.
struct Quad {
  int id = 0;             ///< replaces the quad with the same id
  double x = 0., y = 0.;  ///< of its top left corner, in heights of the window
  double height = .2;     ///< in heights of the window; 0: `zoom` determines the size
  double zoom = 0.;       ///< pixels of the page per pixel of the image, which then covers everything else
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> rgb;  ///< rows x columns x 3
};

/// The point under the pointer.
struct Cursor {
  int frame = -1;
  Vector3d point = Vector3d::Zero(), normal = Vector3d::Zero();  ///< of the surface, world
};

/// A clicked point of the scene.
struct Hit {
  std::string frame;
  Vector3d point = Vector3d::Zero(), normal = Vector3d::Zero();  ///< m, and of length 1, in the world
};

/// The shortest line between two shapes of a collision pair.
struct NearLine {
  Vector3d a, b;      ///< endpoints on the surfaces, world, m
  double distance;    ///< m, negative: penetration depth
  std::string names;  ///< of the frames
};

/// A motion that is sent completely and played in the browser.
struct ShownMotion {
  enum class Start { all, play, pause };  ///< all slices at once, playing, or paused at `first`

  double seconds = 0.;  ///< duration of all slices together
  Start start = Start::all;
  int first = 0;                         ///< first slice shown
  std::vector<std::vector<Pose>> poses;  ///< per slice: world poses of all frames
  MatrixXd q;                            ///< slices x dofs; may be empty
  std::vector<std::string> texts;        ///< per slice, or none
  std::vector<double> violations;        ///< per slice: violation of the constraints; may be empty
  int prefix = 0;                        ///< number of slices before slice 0
  std::vector<std::vector<int>> marked;  ///< per slice: frames of violated constraints; may be empty

  /// Per slice: pairs of shapes that violate a distance constraint; may be empty.
  std::vector<std::vector<NearLine>> touching;

  /// Values per slice, such as an error.
  struct Trace {
    std::string name;
    std::string type;            ///< of the objective: sos, eq ...
    std::vector<double> values;  ///< per slice
  };
  std::vector<Trace> traces;
};

}  // namespace kinegraph
