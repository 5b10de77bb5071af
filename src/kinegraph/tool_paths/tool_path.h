#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// A pose on a tool path; without a rotation, the tool keeps the rotation that it has.
struct ToolWaypoint {
  Vector3d p = Vector3d::Zero();
  std::optional<Quaterniond> rotation = {};

  ToolWaypoint() = default;
  ToolWaypoint(const Vector3d& position) : p(position) {}
  ToolWaypoint(const Pose& pose) : p(pose.p), rotation(pose.q) {}
};

/// A part of a tool path, from the end of the part before.
struct ToolPathElement {
  enum class Kind {
    line,    ///< straight to waypoints[0]; the tool rotates at a constant rate
    arc,     ///< a circular arc through the position of waypoints[0] to waypoints[1]
    circle,  ///< about an axis through a center by an angle, perhaps as a helix; the tool keeps its rotation
    spline,  ///< a cubic spline through all waypoints
    rows,    ///< dense samples of a smooth curve, to which a spline is fitted; the first row is its start
  };
  Kind kind = Kind::line;
  std::vector<ToolWaypoint> waypoints = {};
  Vector3d center = Vector3d::Zero(), axis = Vector3d::UnitZ();  ///< of a circle
  double angle = 0.;                                             ///< of a circle, rad
  double advance = 0.;                                           ///< of a circle along its axis, m: a helix
  double blend = 0.;  ///< radius (m) around the start of the element within which a smooth curve replaces the corner
  double speed = 0.;  ///< of the tool, m/s; 0: that of planToolPath
};

/// A curve of poses that a frame, the tool, follows: lines, arcs, circles, splines, and dense rows of poses or points.
///
///     ToolPath seam("pen");
///     seam.start(first).line(second).arc(via, third, .01).free();
///
/// Poses are in the coordinates of the world or of another frame, which may move. The place of the tool on the path is
/// its distance along the curve in m; a rotation on the spot counts .1 m per rad.
class ToolPath {
 public:
  /// `frame` moves; poses are in the coordinates of `relative_to`, "" for the world. Either may move.
  explicit ToolPath(std::string frame, std::string relative_to = {});

  /// The same from dense rows: points (K, 3) in m with normals (K, 3), the direction of the tool's z axis, or poses (K,
  /// 7) and no normals. The tool's x axis turns as little as possible about the normals. Throws ValueError for other
  /// shapes, fewer than two rows, numbers that are not finite, and normals without a direction.
  static ToolPath along(std::string frame, const MatrixXd& points, const MatrixXd& normals = {},
                        std::string relative_to = {});

  /// Reads rows of 3 (x y z), 6 (with a normal) or 7 numbers (x y z qw qx qy qz) from a file, separated by commas,
  /// semicolons or spaces. Columns are in this order, unless a first line names them: x y z, and nx ny nz or qw qx qy
  /// qz, in any order. Names may have a unit, such as x_mm or X [mm], and columns with other names are ignored with a
  /// line in `warnings`. Other first lines without numbers are skipped, and so is the text behind #. Files with the
  /// extension .nc, .ngc, .gcode, .gc, .tap or .cnc are read by `readGcode`. Throws FileError if it cannot be read, and
  /// ParseError with line and column for other content.
  static ToolPath read(const std::string& file, std::string frame, std::string relative_to = {});

  /// Reads a program of G-code: G0 to G3 with the planes G17 to G19, arcs and helices by I J K or R. Units are mm
  /// (G21, the default) or inch (G20), F is per minute. It also knows G90 and G91, G90.1 (absolute centers), G61 and
  /// G64 P. The tool keeps its rotation. Moves with G0, and those before the first F, have the speed of planToolPath.
  /// Corners have a blend with the radius `blend` (m) until G64 P or G61 sets another one. The path starts where the
  /// first moves that name all axes end; axes that are named later start at 0. Moves to places of the machine (G28,
  /// G30, G53), tool lengths (G43), and spindle, coolant, tool and dwell commands are ignored with a line in
  /// `warnings`. Throws FileError if it cannot be read, and ParseError with line and column for words that it does not
  /// know.
  static ToolPath readGcode(const std::string& file, std::string frame, std::string relative_to = {},
                            double blend = 0.);

  /// Sets the first pose. Without it, the path starts at the pose of the tool at the time of planning.
  ToolPath& start(const ToolWaypoint& pose);

  /// Appends a straight line. `blend` (m) is the radius of the sphere around the corner at its start within which a
  /// curve with continuous curvature replaces the corner; 0 stops there. Radii that overlap are reduced, and corners
  /// beside splines and rows are not blended, each with a line in the `warnings` of the plan.
  ToolPath& line(const ToolWaypoint& to, double blend = 0.);

  /// Appends a circular arc through `via` to a pose. Throws ValueError when planned if the points are on a line.
  ToolPath& arc(const Vector3d& via, const ToolWaypoint& to, double blend = 0.);

  /// Appends a circle, or a part of it by `angle` (rad), about an axis through `center`. With `advance` (m) along the
  /// axis it is a helix.
  ToolPath& circle(const Vector3d& center, const Vector3d& axis, double angle, double blend = 0., double advance = 0.);

  /// Appends a cubic spline through the present end and all of these waypoints.
  ToolPath& spline(std::vector<ToolWaypoint> waypoints);

  /// Sets the speed of the tool on the elements that are appended from now on, m/s; 0 for that of planToolPath. Throws
  /// ValueError for negative numbers.
  ToolPath& speed(double speed);

  /// Frees the rotation about an axis of the tool (0 x, 1 y, 2 z), at all places. It is an angle (rad) from the poses
  /// of the path, within `range`, the whole turn without one. The angle `prefer` is kept all along if a motion can do
  /// so; else it costs little. Throws ValueError for other axes, an empty range, and preferred angles outside of it.
  ToolPath& free(int about = 2, std::optional<std::pair<double, double>> range = {}, std::optional<double> prefer = {});

  /// Allows the free axis to lean by at most `angle` (rad, below pi / 2) from its direction, in a cone. Calls `free` if
  /// no axis is free yet.
  ToolPath& tilt(double angle);

  /// Leans the tool of all rows that have normals so far: the z axis turns by `travel` (rad) towards the direction of
  /// the path, then by `work` (rad) to its left, seen along the path with z up. Both are below pi / 2. In the words of
  /// welding they are the travel angle and the work angle. `tilt` allows deviations instead. Throws ValueError for
  /// other angles, without such rows, and for normals along the path.
  ToolPath& lean(double travel, double work = 0.);

  /// All members, for storage.
  struct Parts {
    std::string frame = {}, relative_to = {};
    std::optional<ToolWaypoint> first = {};
    std::vector<ToolPathElement> elements = {};
    int free_axis = -1;                                   ///< 0 x, 1 y, 2 z; -1: the rotation is given
    double cone = 0.;                                     ///< rad
    double speed = 0.;                                    ///< of elements that are appended, m/s
    std::optional<std::pair<double, double>> range = {};  ///< rad; none: a whole turn
    std::optional<double> prefer = {};                    ///< rad
    std::vector<std::string> warnings = {};
  };
  const std::string& frame() const { return parts_.frame; }
  const std::string& relativeTo() const { return parts_.relative_to; }
  const std::optional<ToolWaypoint>& first() const { return parts_.first; }
  const std::vector<ToolPathElement>& elements() const { return parts_.elements; }
  int freeAxis() const { return parts_.free_axis; }                                       ///< -1: the rotation is given
  double cone() const { return parts_.cone; }                                             ///< rad
  const std::optional<std::pair<double, double>>& range() const { return parts_.range; }  ///< rad; none: a whole turn
  const std::optional<double>& preferred() const { return parts_.prefer; }                ///< rad
  const std::vector<std::string>& warnings() const {
    return parts_.warnings;
  }  ///< of the file that was read, and of angles that may be in degrees

  const Parts& parts() const { return parts_; }
  static ToolPath fromParts(Parts parts);  ///< throws ValueError for impossible ones

  std::string str() const;  ///< "3 elements of 'pen' relative to 'part', free about z, tilt 0.26 rad"

 private:
  ToolPath& append(ToolPathElement element);

  Parts parts_;
};

}  // namespace kinegraph
