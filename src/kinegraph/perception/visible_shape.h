#pragma once

#include <limits>
#include <memory>
#include <set>
#include <vector>

#include "kinegraph/scene/frame.h"

namespace kinegraph::inline perception_internal {

struct TriangleTree;

/// The signed distance of a point from a surface, m, and its gradient, a unit vector.
struct SurfaceDistance {
  double distance = std::numeric_limits<double>::infinity();
  Vector3d gradient = Vector3d::UnitZ();
};

/// Whether a frame, or one that is rigidly attached to it, has a shape that cameras see. Leaves out the frames
/// `without` and what is attached to them.
bool hasVisibleShape(const Frame& frame, const std::set<int>& without);

/// A camera's position, in the coordinates of each part of a VisibleShape.
using EyeInParts = std::vector<Vector3d>;

/// The surface of a frame and of what is rigidly attached to it, as cameras see it. Boxes, balls, capsules and
/// cylinders are exact; other shapes are their triangles. Coordinates of the frame, m.
class VisibleShape {
 public:
  /// Leaves out the frames `without` and what is attached to them. Throws ValueError if nothing visible is left.
  explicit VisibleShape(const Frame& frame, const std::set<int>& without = {});
  ~VisibleShape();
  VisibleShape(VisibleShape&&) noexcept;

  /// The position of a camera, for `facing`.
  EyeInParts eyeInParts(const Vector3d& eye) const;

  /// Distance from the part of the surface that faces the eye. The nearest surface of a thin wall may be its far side,
  /// which no camera has measured. The distance is infinite if no surface faces the eye.
  SurfaceDistance facing(const Vector3d& point, const EyeInParts& eye) const;

  /// Distance from the surface, negative inside.
  SurfaceDistance nearest(const Vector3d& point) const;

  /// The largest extent along a unit direction, from the origin.
  double extent(const Vector3d& direction) const;

  /// Whether nothing of the shape lies between a point of its surface and the eye.
  bool seesItself(const Vector3d& point, const Vector3d& eye) const;

  double radius() const { return radius_; }  ///< of a ball about the origin that holds the shape

  const Vector3d& middle() const { return middle_; }  ///< of the surface

  /// Points of the surface with outward normals, uniform and in random order.
  const std::vector<Vector3d>& samples() const { return samples_; }
  const std::vector<Vector3d>& normals() const { return normals_; }

  /// Directions that may point down if it rests on a plane: outward normals of stable faces of the convex hull.
  const std::vector<Vector3d>& restingDirections() const { return resting_; }

  /// Ids of the frames whose shapes it has.
  const std::vector<int>& frames() const { return frames_; }

 private:
  struct Part;
  SurfaceDistance closest(const Vector3d& point, const EyeInParts* eye) const;
  void add(const Shape& shape, const RigidTransform& X_FS, const Mesh& surface);
  void addHullPoints(const Part& part, const Mesh& surface);
  void sample(const std::vector<Mesh>& surfaces);
  void findRestingDirections();

  std::vector<Part> parts_;
  MatrixXd boxes_ = MatrixXd(0, 6);  ///< center and half sides of the box that holds a part, parallel to the axes
  std::vector<int> frames_;
  std::vector<Vector3d> samples_, normals_, resting_, hull_points_;
  Vector3d middle_ = Vector3d::Zero();
  double radius_ = 0.;
};

}  // namespace kinegraph::inline perception_internal
