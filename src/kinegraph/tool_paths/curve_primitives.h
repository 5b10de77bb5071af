#pragma once

#include <functional>
#include <string>
#include <vector>

#include "kinegraph/tool_paths/tool_curve.h"
#include "kinegraph/tool_paths/tool_path.h"

namespace kinegraph::inline tool_paths_internal {

/// A smooth part of a tool curve over a parameter t, in m or nearly so.
struct CurvePrimitive {
  double from = 0., to = 0.;
  std::function<VectorXd(double)> at;  ///< position, x axis, z axis; defined beyond both ends, too
  std::vector<double> knots;           ///< of t, ascending, from `from` to `to`
  double spacing = 0.;                 ///< between evenly spaced knots, if `knots` is empty
  bool may_blend = false;
  double speed = 0.;  ///< of the tool, m/s; 0: that of the call

  std::vector<double> allKnots() const;
};

/// Collects the primitives of a ToolPath.
class PrimitiveList {
 public:
  PrimitiveList(const Pose& start, const ToolTolerance& tolerance) : now_(start), tolerance_(tolerance) {}

  void add(const ToolPathElement& element, std::size_t number);
  void lineTo(const Pose& to, double blend = 0.);

  /// Marks the start of the path proper, behind an approach.
  void startPath() { is_first_ = true; }

  const Pose& now() const { return now_; }

  std::vector<CurvePrimitive> all;
  std::vector<std::string> warnings;

  static constexpr double kHermiteError = 1e-7;  ///< m or rad, of a Hermite piece

  ToolTolerance fit_error{kHermiteError, kHermiteError};  ///< bounds of the deviation of the primitives from the path

 private:
  Pose resolved(const ToolWaypoint& waypoint) const { return {waypoint.p, waypoint.rotation.value_or(now_.q)}; }
  void append(CurvePrimitive primitive, double blend);
  void circular(const ToolPathElement& element, const Vector3d& axis, double angle, const Quaterniond& to);
  void arc(const ToolPathElement& element);
  void spline(const ToolPathElement& element);
  void rows(const ToolPathElement& element);
  void fit(const std::vector<double>& t, const MatrixXd& y);

  Pose now_;
  ToolTolerance tolerance_;
  double speed_ = 0.;       // of the present element
  std::size_t number_ = 0;  // of the present element
  bool is_first_ = true;    // the path proper has no primitive yet
};

}  // namespace kinegraph::inline tool_paths_internal
