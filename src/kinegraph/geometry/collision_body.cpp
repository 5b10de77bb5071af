#include "kinegraph/geometry/collision_body.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/base/errors.h"
#include "kinegraph/geometry/collision_body_convex.h"
#include "kinegraph/geometry/convex_hull.h"
#include "kinegraph/geometry/tessellation.h"

namespace kinegraph {

namespace {

/// The hull of points; where they lie in a plane or fewer, a hull that is thickened by a hair.
std::unique_ptr<coal::CollisionGeometry> hullOf(const std::vector<Vector3d>& points) {
  if (spanVolume(points)) {
    auto given = std::make_shared<std::vector<coal::Vec3s>>(points.begin(), points.end());
    return std::unique_ptr<coal::CollisionGeometry>(coal::ConvexBase::convexHull(given, unsigned(points.size()), false));
  }
  auto thick = std::make_shared<std::vector<coal::Vec3s>>();
  const double hair = 1e-6;
  for (const Vector3d& p : points) {
    for (int i = 0; i < 4; ++i) {
      const double sign = i & 1 ? 1. : -1.;
      thick->push_back(p + hair * (i < 2 ? Vector3d(1, 0, sign) : Vector3d(-1, sign, 0)));
    }
  }
  return std::unique_ptr<coal::CollisionGeometry>(coal::ConvexBase::convexHull(thick, unsigned(thick->size()), false));
}

}  // namespace

CollisionBody::CollisionBody() : convex_(std::make_unique<Convex>()) {}

CollisionBody::~CollisionBody() = default;

std::shared_ptr<const CollisionBody> makeCollisionBody(const Geometry& geometry) {
  const std::shared_ptr<CollisionBody> body(new CollisionBody);
  const std::vector<double>& s = geometry.size;
  const auto setBox = [&](const Vector3d& half) {
    body->core_ = CollisionBody::Core::box;
    body->half_sides_ = half;
    body->convex_->shape = std::make_unique<coal::Box>(2. * half.x(), 2. * half.y(), 2. * half.z());
    body->bound_radius_ = half.norm();
  };
  const auto setHull = [&](const std::vector<Vector3d>& points) {
    body->core_ = CollisionBody::Core::other;
    Vector3d low = points.front(), high = points.front();
    for (const Vector3d& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    body->bound_center_ = .5 * (low + high);
    for (const Vector3d& p : points) body->bound_radius_ = std::max(body->bound_radius_, (p - body->bound_center_).norm());
    body->convex_->shape = hullOf(points);
  };
  switch (geometry.type) {
    case ShapeType::sphere: body->radius_ = s[0]; break;
    case ShapeType::capsule:
      body->radius_ = s[1];
      body->half_length_ = body->bound_radius_ = .5 * s[0];
      if (s[0] > 0.) body->core_ = CollisionBody::Core::segment;
      break;
    case ShapeType::box:
    case ShapeType::sdf:
    case ShapeType::tensor: setBox(.5 * Vector3d(s[0], s[1], s[2])); break;
    case ShapeType::quad: setBox(.5 * Vector3d(s[0], s[1], 0.)); break;
    case ShapeType::ssBox:
      body->radius_ = s[3];
      setBox(.5 * Vector3d(s[0], s[1], s[2]) - Vector3d::Constant(s[3]));
      break;
    case ShapeType::cylinder:
    case ShapeType::ssCylinder: {
      const double r = geometry.type == ShapeType::ssCylinder ? s[2] : 0.;
      body->radius_ = r;
      body->core_ = CollisionBody::Core::cylinder;
      body->core_radius_ = std::max(s[1] - r, 1e-9);
      body->half_length_ = std::max(.5 * s[0] - r, 1e-9);
      body->convex_->shape = std::make_unique<coal::Cylinder>(body->core_radius_, 2. * body->half_length_);
      body->bound_radius_ = std::hypot(body->core_radius_, body->half_length_);
      break;
    }
    case ShapeType::ssCvx:
    case ShapeType::mesh:
    case ShapeType::pointCloud:
    case ShapeType::lines:
      if (geometry.type == ShapeType::ssCvx) body->radius_ = s[0];
      if (geometry.mesh && !geometry.mesh->vertices.empty()) setHull(geometry.mesh->vertices);
      break;
    case ShapeType::ssBoxElip: setHull(tessellate(geometry).vertices); break;
    case ShapeType::none:
    case ShapeType::marker:
    case ShapeType::camera: break;
  }
  if (body->core_ == CollisionBody::Core::point) {
    body->convex_->shape = std::make_unique<coal::Sphere>(0.);
  } else if (body->core_ == CollisionBody::Core::segment) {
    body->convex_->shape = std::make_unique<coal::Capsule>(0., 2. * body->half_length_);
  }
  body->bound_radius_ += body->radius_;
  return body;
}

std::shared_ptr<const CollisionBody> pointBody() {
  static const std::shared_ptr<const CollisionBody> body = makeCollisionBody(Geometry{});
  return body;
}

}  // namespace kinegraph
