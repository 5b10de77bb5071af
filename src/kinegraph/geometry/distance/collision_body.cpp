#include "kinegraph/geometry/distance/collision_body.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/geometry/distance/body_tree.h"
#include "kinegraph/geometry/distance/cell_field.h"
#include "kinegraph/geometry/distance/grid_field.h"
#include "kinegraph/geometry/distance/hull.h"
#include "kinegraph/geometry/shapes/cells.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"

namespace kinegraph {

/// Fills the fields of a body.
class BodyMaker {
 public:
  BodyMaker() : body_(new CollisionBody) {}

  std::shared_ptr<const CollisionBody> take() {
    body_->bound_radius_ += body_->radius_;
    return std::move(body_);
  }

  void sweep(double radius) { body_->radius_ = radius; }

  void setSegment(double half_length) {
    if (half_length <= 0.) return;
    body_->core_ = CollisionBody::Core::segment;
    body_->half_length_ = half_length;
    bound(Vector3d::Zero(), {0., 0., half_length});
  }

  void setBox(const Vector3d& half) {
    body_->core_ = CollisionBody::Core::box;
    body_->half_sides_ = half;
    body_->inner_radius_ = half.minCoeff();
    bound(Vector3d::Zero(), half);
  }

  void setCylinder(double radius, double half_length) {
    body_->core_ = CollisionBody::Core::cylinder;
    body_->core_radius_ = std::max(radius, 1e-9);
    body_->half_length_ = std::max(half_length, 1e-9);
    bound(Vector3d::Zero(), {body_->core_radius_, body_->core_radius_, body_->half_length_});
    body_->bound_radius_ = std::hypot(body_->core_radius_, body_->half_length_);
    body_->inner_radius_ = std::min(body_->core_radius_, body_->half_length_);
  }

  void setBoxEllipsoid(const Vector3d& half, const Vector3d& radii) {
    body_->core_ = CollisionBody::Core::box_ellipsoid;
    body_->half_sides_ = half;
    body_->radii_ = radii;
    bound(Vector3d::Zero(), half + radii);
    body_->bound_radius_ = half.norm() + radii.maxCoeff();
    body_->inner_radius_ = half.minCoeff() + radii.minCoeff();
  }

  void setHalfSpace() {
    constexpr double kReach = 1e4;  // m
    body_->core_ = CollisionBody::Core::half_space;
    bound({0., 0., -kReach}, Vector3d::Constant(kReach));
  }

  void setHull(const std::vector<Vector3d>& points) {
    body_->core_ = CollisionBody::Core::hull;
    boundPoints(points);
    body_->hull_ = makeHull(points, body_->bound_center_, body_->inner_radius_);
  }

  /// `parts` have no rounding; if empty, the parts are the points.
  void setCompound(const std::vector<Vector3d>& points, std::vector<std::shared_ptr<const CollisionBody>> parts) {
    body_->core_ = CollisionBody::Core::compound;
    boundPoints(points);
    const bool are_points = parts.empty();
    body_->tree_ = std::make_unique<BodyTree>(std::move(parts), are_points ? points : std::vector<Vector3d>());
  }

  void setGrid(std::shared_ptr<const Grid> grid, const Vector3d& size) {
    body_->core_ = CollisionBody::Core::grid;
    body_->grid_ = std::make_unique<GridField>(std::move(grid), size);
    bound(Vector3d::Zero(), .5 * size + Vector3d::Constant(body_->grid_->overhang));
  }

  void setCells(const Grid& grid, const Vector3d& size) {
    body_->core_ = CollisionBody::Core::grid;
    body_->grid_ = std::make_unique<GridField>(std::make_unique<CellField>(grid, size));
    bound(Vector3d::Zero(), .5 * size);
  }

 private:
  void bound(const Vector3d& center, const Vector3d& half) {
    body_->bound_center_ = center;
    body_->bound_half_ = half;
    body_->bound_radius_ = half.norm();
  }

  void boundPoints(const std::vector<Vector3d>& points) {
    Vector3d low = points.front(), high = points.front();
    for (const Vector3d& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    bound(.5 * (low + high), .5 * (high - low));
    body_->bound_radius_ = 0.;
    for (const Vector3d& p : points) {
      body_->bound_radius_ = std::max(body_->bound_radius_, (p - body_->bound_center_).norm());
    }
  }

  std::shared_ptr<CollisionBody> body_;
};

namespace {

using Parts = std::vector<std::shared_ptr<const CollisionBody>>;

std::shared_ptr<const CollisionBody> hullBody(const std::vector<Vector3d>& points) {
  BodyMaker maker;
  maker.setHull(points);
  return maker.take();
}

/// Hulls of a mesh's convex parts.
Parts hullsOfParts(const Mesh& mesh) {
  Parts parts;
  for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
    const std::size_t first = mesh.parts[i],
                      last = i + 1 < mesh.parts.size() ? mesh.parts[i + 1] : mesh.vertices.size();
    if (first < last) parts.push_back(hullBody({mesh.vertices.begin() + first, mesh.vertices.begin() + last}));
  }
  return parts;
}

/// One segment per pair of vertices.
Parts segments(const Mesh& mesh) {
  Parts parts;
  for (std::size_t i = 0; i + 1 < mesh.vertices.size(); i += 2) {
    parts.push_back(hullBody({mesh.vertices[i], mesh.vertices[i + 1]}));
  }
  return parts;
}

/// Fewer than two parts are replaced by the hull of all points.
void setParts(BodyMaker& maker, const Mesh& mesh, Parts parts) {
  if (parts.size() < 2) return maker.setHull(mesh.vertices);
  maker.setCompound(mesh.vertices, std::move(parts));
}

void setVertices(BodyMaker& maker, ShapeCore::Form form, const Geometry& geometry) {
  if (!geometry.mesh || geometry.mesh->vertices.empty()) return;
  const Mesh& mesh = *geometry.mesh;
  switch (form) {
    case ShapeCore::Form::points:
      return maker.setCompound(mesh.vertices, {});
    case ShapeCore::Form::hulls_of_parts:
      return setParts(maker, mesh, hullsOfParts(mesh));
    case ShapeCore::Form::segments:
      return setParts(maker, mesh, segments(mesh));
    default:
      return maker.setHull(mesh.vertices);
  }
}

}  // namespace

CollisionBody::CollisionBody() = default;

CollisionBody::~CollisionBody() = default;

Vector3d CollisionBody::support(const Vector3d& direction) const {
  switch (core_) {
    case Core::segment:
      return {0., 0., std::copysign(half_length_, direction.z())};
    case Core::box:
      return half_sides_.binaryExpr(direction, [](double h, double d) { return std::copysign(h, d); });
    case Core::cylinder: {
      const double across = std::hypot(direction.x(), direction.y()), z = std::copysign(half_length_, direction.z());
      if (across == 0.) return {core_radius_, 0., z};
      const double scale = core_radius_ / across;
      return {scale * direction.x(), scale * direction.y(), z};
    }
    case Core::hull:
      return hull_.points[std::size_t(hull_.farthest(direction))];
    case Core::box_ellipsoid: {
      const Vector3d corner = half_sides_.binaryExpr(direction, [](double h, double d) { return std::copysign(h, d); });
      const Vector3d scaled = radii_.cwiseProduct(direction);
      const double norm = scaled.norm();
      return norm > 0. ? Vector3d(corner + radii_.cwiseProduct(scaled) / norm) : corner;
    }
    default:
      return Vector3d::Zero();
  }
}

std::shared_ptr<const CollisionBody> makeCollisionBody(const Geometry& geometry) {
  const ShapeKind& kind = shapeKind(geometry.type);
  const ShapeCore core = kind.core ? kind.core(geometry) : ShapeCore{};
  BodyMaker maker;
  maker.sweep(core.radius);
  switch (core.form) {
    case ShapeCore::Form::point:
      break;
    case ShapeCore::Form::segment:
      maker.setSegment(core.half_length);
      break;
    case ShapeCore::Form::box:
      maker.setBox(core.half_sides);
      break;
    case ShapeCore::Form::cylinder:
      maker.setCylinder(core.core_radius, core.half_length);
      break;
    case ShapeCore::Form::box_ellipsoid:
      maker.setBoxEllipsoid(core.half_sides, core.radii);
      break;
    case ShapeCore::Form::half_space:
      maker.setHalfSpace();
      break;
    case ShapeCore::Form::grid:
      if (geometry.type == kCells) {
        maker.setCells(*geometry.grid, {geometry.size[0], geometry.size[1], geometry.size[2]});
      } else {
        maker.setGrid(geometry.grid, {geometry.size[0], geometry.size[1], geometry.size[2]});
      }
      break;
    default:
      setVertices(maker, core.form, geometry);
  }
  return maker.take();
}

std::shared_ptr<const CollisionBody> pointBody() {
  static const std::shared_ptr<const CollisionBody> body = makeCollisionBody(Geometry{});
  return body;
}

}  // namespace kinegraph
