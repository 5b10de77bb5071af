#pragma once

#include <limits>
#include <vector>

#include "kinegraph/perception/occupancy_map.h"
#include "kinegraph/perception/visible_shape.h"

namespace kinegraph::inline perception_internal {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The directions in which a thing may move: all of them; x, y and rotation about z on a support; along or about one
/// axis of a joint. Displacements are (velocity of the origin, angular velocity) in world axes.
struct PoseFreedom {
  enum class Kind { free, resting, sliding, turning };
  Kind kind = Kind::free;
  Vector3d axis = Vector3d::UnitZ();  ///< of a joint, in the world
  RigidTransform start;               ///< the pose to which the limits of a joint refer
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();

  Eigen::Matrix<double, 6, Eigen::Dynamic> basis() const;

  /// Displaces a pose, within the limits of a joint.
  RigidTransform moved(const RigidTransform& X, const Vector6d& displacement) const;

  bool hasJoint() const { return kind == Kind::sliding || kind == Kind::turning; }
};

/// How a frame of a scene may move: along its own joint, resting, or in all directions. Frames in a hand do not rest.
PoseFreedom freedomOf(const Frame& frame, bool may_rest);

/// The nearest pose in which the shape rests on the horizontal plane at `height`.
RigidTransform restingPose(const VisibleShape& shape, const RigidTransform& X, double height);

/// Points of a fit, and surface points of neighbors to be kept outside of the shape.
struct FitPoints {
  std::vector<ObservedPoint> measured;
  std::vector<Vector3d> keep_out = {};
};

/// Minimizes squared distances of measured points from the surface that faces their camera, with a robust weight whose
/// width falls from `widths.front()` to `widths.back()` (m). Points of the surface in front of the measured depth are
/// drawn to the nearest pixel that is not background. Changes X.
void fitPose(const VisibleShape& shape, const PoseFreedom& freedom, const FitPoints& points,
             const std::vector<ObservedView>& views, const std::vector<double>& widths, int samples, RigidTransform& X);

/// Numbers of surface points that face a camera, by what the camera measured in their direction.
struct SurfaceCounts {
  int agree = 0;                      ///< the surface
  int through = 0;                    ///< something behind it
  int hidden = 0;                     ///< something before it
  int none = 0;                       ///< nothing
  int outside = 0;                    ///< they are not in the image
  std::vector<Vector3d> before = {};  ///< the points measured in front of hidden ones, m, if they were asked for

  int inView() const { return agree + through + hidden + none; }
  int total() const { return inView() + outside; }

  /// 1 if all is as expected, -1.5 if the cameras looked through all of it.
  double score() const;
};

/// `alone` leaves out points that the shape itself hides.
SurfaceCounts countSurface(const VisibleShape& shape, const RigidTransform& X, const std::vector<ObservedView>& views,
                           int samples, bool alone = false);

}  // namespace kinegraph::inline perception_internal
