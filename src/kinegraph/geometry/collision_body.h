#pragma once

#include <memory>

#include "kinegraph/geometry/geometry.h"

namespace kinegraph {

/// What distances are computed with: a convex core swept by a ball. Immutable.
///
/// sphere, marker: a point; capsule: a segment; box, ssBox: a box; cylinder, ssCylinder: a cylinder; mesh, pointCloud,
/// ssCvx: the convex hull of the points; ssBoxElip: the hull of its surface points.
class CollisionBody {
 public:
  enum class Core { point, segment, box, cylinder, other };  ///< `segment` and `cylinder` run along z

  CollisionBody(const CollisionBody&) = delete;
  ~CollisionBody();

  Core core() const { return core_; }
  double radius() const { return radius_; }            ///< of the ball, m
  double halfLength() const { return half_length_; }   ///< of a segment or cylinder
  double coreRadius() const { return core_radius_; }   ///< of a cylinder
  const Vector3d& halfSides() const { return half_sides_; }  ///< of a box
  const Vector3d& boundCenter() const { return bound_center_; }  ///< bounding sphere of the whole body, local
  double boundRadius() const { return bound_radius_; }

  struct Convex;  ///< the core as the general algorithm sees it
  const Convex& convex() const { return *convex_; }

 private:
  friend std::shared_ptr<const CollisionBody> makeCollisionBody(const Geometry&);
  friend std::shared_ptr<const CollisionBody> pointBody();
  CollisionBody();

  Core core_ = Core::point;
  double radius_ = 0., half_length_ = 0., core_radius_ = 0.;
  Vector3d half_sides_ = Vector3d::Zero(), bound_center_ = Vector3d::Zero();
  double bound_radius_ = 0.;
  std::unique_ptr<Convex> convex_;
};

std::shared_ptr<const CollisionBody> makeCollisionBody(const Geometry& geometry);

/// The body of a frame without a shape: its origin.
std::shared_ptr<const CollisionBody> pointBody();

}  // namespace kinegraph
