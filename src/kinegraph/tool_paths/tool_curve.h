#pragma once

#include <string>
#include <vector>

#include "kinegraph/tool_paths/plan_tool_path.h"
#include "kinegraph/tool_paths/tool_path.h"

namespace kinegraph::inline tool_paths_internal {

/// Desired position (m) and unit x and z axes of the tool.
struct ToolTarget {
  Vector3d p, x, z;

  Pose pose() const;
  ToolTarget() = default;
  explicit ToolTarget(const VectorXd& y) : p(y.head<3>()), x(y.segment<3>(3)), z(y.segment<3>(6)) {}

  /// A unit axis of the tool (0 x, 1 y, 2 z).
  Vector3d axis(int number) const { return number == 0 ? x : number == 2 ? z : Vector3d(z.cross(x)); }
};

/// Allowed deviation of the tool from its curve, or of the curve from rows.
struct ToolTolerance {
  double position = 2e-5;  ///< m
  double rotation = 8e-5;  ///< rad
};

/// The curve of a ToolPath by its length s, 0 <= s <= length() (m): position, x axis and z axis of the tool as cubic
/// pieces. |dp/ds| is near 1; a rotation on the spot counts kOnTheSpot m per rad.
class ToolCurve {
 public:
  static constexpr double kOnTheSpot = .1;
  static constexpr double kLongest = 1e4;  ///< m

  /// `present` is the pose of the tool relative to the path's reference frame; the path starts there unless it has a
  /// start. Rows are fitted to within `tolerance`. `approach` and `retract` (m) add
  /// lines along the free axis, or z, of the tool to both ends; negative lengths are against the axis. Throws
  /// ValueError for paths without length or longer than kLongest, and arcs without a center.
  ToolCurve(const ToolPath& path, const Pose& present, const ToolTolerance& tolerance, double approach = 0.,
            double retract = 0.);

  double length() const { return pieces_.length; }
  double approachEnd() const { return approach_end_; }    ///< s at which the path proper starts
  double retractStart() const { return retract_start_; }  ///< s at which it ends
  const CubicPieces& pieces() const { return pieces_; }
  ToolTarget at(double s) const { return ToolTarget(pieces_.eval(s)); }

  /// Places at which the tool has to stop, ascending, without the ends.
  std::vector<double> corners() const;

  /// Bounds of the distance (m) and the rotation (rad) between the pieces and the curve they stand for. For rows, the
  /// curve is the polyline.
  const ToolTolerance& fitError() const { return fit_error_; }

  /// The speed that the path has at s, m/s; 0 if it has none.
  double speedAt(double s) const;

  /// Places at which that speed changes, ascending.
  std::vector<double> speedChanges() const;

  /// The largest speed of the path, and `otherwise` where it has none, m/s.
  double largestSpeed(double otherwise) const;

  /// Messages about blends that were made smaller.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// The same curve from its end to its start.
  ToolCurve reversed() const;

 private:
  ToolCurve() = default;

  CubicPieces pieces_;
  ToolTolerance fit_error_{0., 0.};
  double approach_end_ = 0., retract_start_ = 0.;
  std::vector<std::string> warnings_;
  struct SpeedSection {
    double begin, speed;
  };
  std::vector<SpeedSection> speeds_;  ///< neighbors differ
};

}  // namespace kinegraph::inline tool_paths_internal
