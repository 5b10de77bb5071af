#pragma once

#include <memory>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline geometry_internal {
struct BodyTree;
struct GridField;
}

namespace kinegraph {

/// The corners of a convex polytope, and the neighbors of each if there are many. Local coordinates, m.
struct Hull {
  std::vector<Vector3d> points;
  std::vector<std::uint32_t> neighbors;  ///< neighbors of point i: [first_neighbor[i], first_neighbor[i + 1])
  std::vector<std::uint32_t>
      first_neighbor;  ///< empty for few points, for which search is faster, or for points in one plane

  /// Index of the farthest point along a direction.
  int farthest(const Vector3d& direction) const;
};

/// Geometry for distance computation: a core swept by a ball. Immutable.
///
///   sphere, marker     a point
///   capsule            a segment
///   box, ssBox, quad   a box; so are tensor and an sdf without grid
///   cylinder, ssCylinder   a cylinder
///   ssCvx, mesh        the convex hull of the points
///   mesh with convex parts, pointCloud, lines   a compound: the hulls of the parts, the points, the segments
///   ssBoxElip          the sum of a box and an ellipsoid
///   plane              a half-space: everything below the xy plane; its bounds reach 10 km
///   sdf                a grid: the points where the interpolated grid is not positive
class CollisionBody {
 public:
  /// `segment` and `cylinder` extend along z. All kinds before `compound` are convex and bounded.
  enum class Core { point, segment, box, cylinder, hull, box_ellipsoid, compound, grid, half_space };

  CollisionBody(const CollisionBody&) = delete;
  ~CollisionBody();

  Core core() const { return core_; }
  bool convex() const { return core_ < Core::compound; }
  double radius() const { return radius_; }                  ///< of the ball, m
  double halfLength() const { return half_length_; }         ///< of a segment or cylinder
  double coreRadius() const { return core_radius_; }         ///< of a cylinder
  const Vector3d& halfSides() const { return half_sides_; }  ///< of a box, also of the one in a box_ellipsoid
  const Vector3d& radii() const { return radii_; }           ///< of the ellipsoid in a box_ellipsoid
  const Hull& hull() const { return hull_; }
  const BodyTree& tree() const { return *tree_; }  ///< of a compound
  const GridField& grid() const { return *grid_; }

  const Vector3d& boundCenter() const {
    return bound_center_;
  }  ///< bounding sphere of the whole body, local; middle of the bounding box
  double boundRadius() const { return bound_radius_; }
  const Vector3d& boundHalf() const {
    return bound_half_;
  }  ///< half sides of the core's bounding box about boundCenter()

  /// Radius (m) of a ball about boundCenter() inside a convex core; 0 if unknown.
  double innerRadius() const { return inner_radius_; }

  /// The farthest point of a convex core along a direction. Local coordinates.
  Vector3d support(const Vector3d& direction) const;

 private:
  friend class BodyMaker;
  CollisionBody();

  Core core_ = Core::point;
  double radius_ = 0., half_length_ = 0., core_radius_ = 0.;
  Vector3d half_sides_ = Vector3d::Zero(), radii_ = Vector3d::Zero();
  Vector3d bound_center_ = Vector3d::Zero(), bound_half_ = Vector3d::Zero();
  double bound_radius_ = 0., inner_radius_ = 0.;
  Hull hull_;
  std::unique_ptr<const BodyTree> tree_;
  std::unique_ptr<const GridField> grid_;
};
/// Returns the convex body of a shape, for distances; the origin for a shape without a collision core.
std::shared_ptr<const CollisionBody> makeCollisionBody(const Geometry& geometry);

/// The body of a frame without a shape: its origin.
std::shared_ptr<const CollisionBody> pointBody();

}  // namespace kinegraph
