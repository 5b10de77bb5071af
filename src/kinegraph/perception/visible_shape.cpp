#include "kinegraph/perception/visible_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/cells.h"
#include "kinegraph/geometry/shapes/convex_hull.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/perception/triangle_tree.h"
#include "kinegraph/rendering/shown_shapes.h"
#include "kinegraph/scene/tree/visual_meshes.h"

namespace kinegraph::inline perception_internal {

namespace {

constexpr int kSamples = 500;   // points of a surface
constexpr double kThin = 1e-9;  // m, lengths that count as zero
constexpr double kTilt = .1;    // rad, that a shape withstands on a face
constexpr int kTilts = 8;
constexpr double kRollHeight = 5e-4;  // m, that a round shape may roll up or down without rolling away
constexpr double kNearFace = .7;      // cosine between a face and the one on which a shape falls
constexpr double kSameFace = .9998;   // cosine between normals of triangles of one face

bool hasJoint(const Frame& frame) { return frame.data().joint && frame.data().joint->dofs() > 0; }

/// The frame and its descendants without a joint in between.
std::vector<Frame> rigidSubtree(const Frame& frame, const std::set<int>& without) {
  std::vector<Frame> frames{frame};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (const Frame& child : frames[i].getChildren()) {
      if (!hasJoint(child) && !without.count(child.id())) frames.push_back(child);
    }
  }
  return frames;
}

/// The shape of a frame as cameras see it; none if they do not.
std::optional<Shape> shownShape(const Frame& frame, VisualMeshes& visuals) {
  const auto& shape = frame.data().shape;
  if (!shape || shape->geometry->type == kCells || servesCollisionsOnly(*shape)) return std::nullopt;
  Shape shown = *shape;
  if (const auto visual = visuals.of(*shape)) shown.geometry = visual;
  const Geometry& geometry = *shown.geometry;
  const ShapeKind& kind = shapeKind(geometry.type);
  const bool has_surface = kind.surface || (geometry.mesh && !geometry.mesh->triangles.empty());
  return has_surface && !kind.is_symbol ? std::optional(shown) : std::nullopt;
}

}  // namespace

bool hasVisibleShape(const Frame& frame, const std::set<int>& without) {
  VisualMeshes visuals;
  const std::vector<Frame> parts = rigidSubtree(frame, without);
  return std::any_of(parts.begin(), parts.end(),
                     [&](const Frame& part) { return shownShape(part, visuals).has_value(); });
}

/// A core swept by a ball (`radius`), or triangles.
struct VisibleShape::Part {
  ShapeCore::Form form = ShapeCore::Form::hull;  ///< point, segment, box or cylinder; others are triangles
  RigidTransform X_FP;
  Vector3d half = Vector3d::Zero();
  double half_length = 0., core_radius = 0., radius = 0.;
  std::shared_ptr<const TriangleTree> triangles = {};

  /// `eye` is in the coordinates of the part.
  SurfaceDistance at(const Vector3d& point, const Vector3d* eye) const;
  SurfaceDistance ofBox(const Vector3d& p, const Vector3d* eye) const;
  SurfaceDistance ofCylinder(const Vector3d& p, const Vector3d* eye) const;
  double extent(const Vector3d& direction) const;
};

SurfaceDistance VisibleShape::Part::ofBox(const Vector3d& p, const Vector3d* eye) const {
  const Vector3d q = p.cwiseAbs() - half, outside = q.cwiseMax(0.);
  SurfaceDistance near;
  int axis;
  const double deepest = q.maxCoeff(&axis), out = outside.norm();
  if ((outside.array() > 0.).count() > 1) {
    near.distance = out - radius;
    near.gradient = (outside / out).cwiseProduct(p.cwiseSign());
    return near;
  }
  double side = p[axis] < 0. ? -1. : 1.;
  near.distance = deepest - radius;
  if (eye && side * (*eye)[axis] < half[axis] + radius) {  // this face cannot be seen: the opposite one
    near.distance = -near.distance - 2. * (half[axis] + radius);
    side = -side;
  }
  near.gradient = side * Vector3d::Unit(axis);
  return near;
}

SurfaceDistance VisibleShape::Part::ofCylinder(const Vector3d& p, const Vector3d* eye) const {
  const double rho = p.head<2>().norm() + 1e-12;
  const double across = rho - core_radius, along = std::abs(p.z()) - half_length;
  double side = p.z() < 0. ? -1. : 1.;
  const Vector3d radial(p.x() / rho, p.y() / rho, 0.);
  if (across > 0. && along > 0.) {
    const double out = std::hypot(across, along);
    return {out - radius, across / out * radial + along / out * side * Vector3d::UnitZ()};
  }
  if (across > along) return {across - radius, radial};
  SurfaceDistance near{along - radius, {}};
  if (eye && side * eye->z() < half_length + radius) {
    near.distance = -near.distance - 2. * (half_length + radius);
    side = -side;
  }
  near.gradient = side * Vector3d::UnitZ();
  return near;
}

SurfaceDistance VisibleShape::Part::at(const Vector3d& point, const Vector3d* eye) const {
  if (triangles) return triangles->nearest(point, eye);
  const Vector3d p = X_FP.R.transpose() * (point - X_FP.p);
  SurfaceDistance near;
  if (form == ShapeCore::Form::box) {
    near = ofBox(p, eye);
  } else if (form == ShapeCore::Form::cylinder) {
    near = ofCylinder(p, eye);
  } else {
    const Vector3d gap = p - Vector3d(0., 0., std::clamp(p.z(), -half_length, half_length));
    const double length = gap.norm();
    near = {length - radius, length > kThin ? Vector3d(gap / length) : Vector3d(Vector3d::UnitX())};
  }
  near.gradient = X_FP.R * near.gradient;
  return near;
}

double VisibleShape::Part::extent(const Vector3d& direction) const {
  if (triangles) {
    double most = -std::numeric_limits<double>::infinity();
    for (const auto& t : triangles->triangles)
      most = std::max({most, direction.dot(t.a), direction.dot(t.b), direction.dot(t.c)});
    return most;
  }
  const Vector3d d = X_FP.R.transpose() * direction;
  double core = half_length * std::abs(d.z());
  if (form == ShapeCore::Form::box) core = half.dot(d.cwiseAbs());
  if (form == ShapeCore::Form::cylinder) core += core_radius * d.head<2>().norm();
  return X_FP.p.dot(direction) + core + radius;
}

VisibleShape::VisibleShape(const Frame& frame, const std::set<int>& without) {
  const Pose X_WF = frame.getPose();
  std::vector<Mesh> surfaces;
  VisualMeshes visuals;
  for (const Frame& part : rigidSubtree(frame, without)) {
    const std::optional<Shape> shown = shownShape(part, visuals);
    if (!shown) continue;
    const ShapeKind& kind = shapeKind(shown->geometry->type);
    const RigidTransform X_FS = (X_WF.inverse() * part.getPose()).transform();
    Mesh surface = kind.surface ? kind.surface(*shown->geometry) : *shown->geometry->mesh;
    for (Vector3d& vertex : surface.vertices) vertex = X_FS * vertex;
    surfaces.push_back(std::move(surface));
    add(*shown, X_FS, surfaces.back());
    frames_.push_back(part.id());
  }
  if (parts_.empty())
    throw ValueError(cat("registerScene: frame '", frame.getName(),
                         "' has no visible shape; expected a shape of its own or of a frame fixed to it"));
  sample(surfaces);
  if (samples_.empty())
    throw ValueError(cat("registerScene: the shape of frame '", frame.getName(), "' has no surface that cameras see, ",
                         "only points within ", 1e3 * radius_, " mm; sizes and vertices are in meters"));
  findRestingDirections();
}

VisibleShape::~VisibleShape() = default;
VisibleShape::VisibleShape(VisibleShape&&) noexcept = default;

void VisibleShape::add(const Shape& shape, const RigidTransform& X_FS, const Mesh& surface) {
  using Form = ShapeCore::Form;
  const ShapeKind& kind = shapeKind(shape.geometry->type);
  const ShapeCore core = kind.core ? kind.core(*shape.geometry) : ShapeCore{};
  Part part;
  part.X_FP = X_FS;
  if (core.form == Form::point || core.form == Form::segment || core.form == Form::box || core.form == Form::cylinder)
    part.form = core.form;
  part.half = core.half_sides;
  part.half_length = core.half_length;
  part.core_radius = core.core_radius;
  part.radius = core.radius;
  if (part.form == Form::hull) {
    part.triangles = std::make_shared<TriangleTree>(surface);
    part.X_FP = {};  // their vertices are in the frame
  }
  boxes_.conservativeResize(boxes_.rows() + 1, 6);
  for (int axis = 0; axis < 3; ++axis) {
    const double high = part.extent(Vector3d::Unit(axis)), low = -part.extent(-Vector3d::Unit(axis));
    boxes_(boxes_.rows() - 1, axis) = .5 * (high + low);
    boxes_(boxes_.rows() - 1, 3 + axis) = .5 * (high - low) + kThin;
  }
  for (const Vector3d& vertex : surface.vertices) radius_ = std::max(radius_, vertex.norm());
  addHullPoints(part, surface);
  parts_.push_back(std::move(part));
}

/// Adds points whose convex hull has the flat faces of a part. Of rounded edges, one point in between is enough.
void VisibleShape::addHullPoints(const Part& part, const Mesh& surface) {
  if (part.form != ShapeCore::Form::box || part.radius <= 0.) {
    hull_points_.insert(hull_points_.end(), surface.vertices.begin(), surface.vertices.end());
    return;
  }
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d side(corner & 1 ? 1. : -1., corner & 2 ? 1. : -1., corner & 4 ? 1. : -1.);
    for (int axes = 1; axes < 8; ++axes) {
      const Vector3d out = Vector3d(axes & 1 ? 1. : 0., axes & 2 ? 1. : 0., axes & 4 ? 1. : 0.).normalized();
      hull_points_.push_back(part.X_FP * side.cwiseProduct(part.half + part.radius * out));
    }
  }
}

EyeInParts VisibleShape::eyeInParts(const Vector3d& eye) const {
  EyeInParts eyes;
  for (const Part& part : parts_) eyes.push_back(part.X_FP.R.transpose() * (eye - part.X_FP.p));
  return eyes;
}

/// The distance of least amount with an eye, else the least distance. Boxes around the parts exclude most of them.
SurfaceDistance VisibleShape::closest(const Vector3d& point, const EyeInParts* eye) const {
  constexpr Eigen::Index kTogether = 32;
  using Gaps = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, kTogether, 1>;
  SurfaceDistance best;
  double bound = best.distance;  // of the distances that matter
  const auto consider = [&](Eigen::Index i) {
    const SurfaceDistance near = parts_[std::size_t(i)].at(point, eye ? &(*eye)[std::size_t(i)] : nullptr);
    if (!(eye ? std::abs(near.distance) < bound : near.distance < best.distance)) return;
    best = near;
    bound = eye ? std::abs(best.distance) : std::max(best.distance, 0.);
  };
  const Eigen::Index count = Eigen::Index(parts_.size());
  for (Eigen::Index from = 0; from < count; from += kTogether) {
    const Eigen::Index size = std::min(kTogether, count - from);
    Gaps gaps = Gaps::Zero(size);  // squared
    for (int axis = 0; axis < 3 && count > 1; ++axis)
      gaps += ((boxes_.col(axis).segment(from, size).array() - point[axis]).abs() -
               boxes_.col(3 + axis).segment(from, size).array())
                  .max(0.)
                  .square();
    Eigen::Index nearest = 0;
    gaps.minCoeff(&nearest);
    consider(from + nearest);
    for (Eigen::Index i = 0; i < size; ++i) {
      if (i != nearest && (gaps[i] <= 0. || gaps[i] < bound * bound)) consider(from + i);
    }
  }
  return best;
}

SurfaceDistance VisibleShape::facing(const Vector3d& point, const EyeInParts& eye) const {
  return closest(point, &eye);
}

SurfaceDistance VisibleShape::nearest(const Vector3d& point) const { return closest(point, nullptr); }

double VisibleShape::extent(const Vector3d& direction) const {
  double most = -std::numeric_limits<double>::infinity();
  for (const Part& part : parts_) most = std::max(most, part.extent(direction));
  return most;
}

bool VisibleShape::seesItself(const Vector3d& point, const Vector3d& eye) const {
  constexpr double kStart = .004, kStep = .002, kHit = -.0005;  // m
  const Vector3d ray = (eye - point).normalized();
  for (double at = kStart; at < 2. * radius_ + kStart;) {
    const double gap = nearest(point + at * ray).distance;
    if (gap < kHit) return false;
    at += std::max(gap, kStep);
  }
  return true;
}

void VisibleShape::sample(const std::vector<Mesh>& surfaces) {
  struct Piece {
    Vector3d a, ab, ac, normal;
  };
  std::vector<Piece> pieces;
  std::vector<double> areas{0.};
  for (const Mesh& mesh : surfaces) {
    for (const auto& corners : mesh.triangles) {
      const Vector3d a = mesh.vertices[corners[0]], ab = mesh.vertices[corners[1]] - a,
                     ac = mesh.vertices[corners[2]] - a;
      const Vector3d normal = ab.cross(ac);
      if (normal.norm() < 1e-14) continue;
      pieces.push_back({a, ab, ac, normal.normalized()});
      areas.push_back(areas.back() + normal.norm());
      middle_ += normal.norm() * (a + (ab + ac) / 3.);
    }
  }
  if (pieces.empty()) return;
  middle_ /= areas.back();
  Rng rng(0);
  for (int tries = 0; tries < 20 * kSamples && int(samples_.size()) < kSamples; ++tries) {
    const auto found = std::upper_bound(areas.begin(), areas.end(), rng.uniform() * areas.back());
    const std::size_t index = std::min(std::size_t(found - areas.begin()), pieces.size()) - 1;
    double u = rng.uniform(), v = rng.uniform();
    if (u + v > 1.) u = 1. - u, v = 1. - v;
    const Piece& piece = pieces[index];
    const Vector3d point = piece.a + u * piece.ab + v * piece.ac;
    if (parts_.size() > 1 && nearest(point + 2e-4 * piece.normal).distance < 0.) continue;  // inside of another part
    samples_.push_back(point);
    normals_.push_back(piece.normal);
  }
}

void VisibleShape::findRestingDirections() {
  if (!spanVolume(hull_points_)) return;
  const Mesh hull = convexHull(hull_points_);
  const Vector3d& middle = middle_;
  struct Face {
    Vector3d normal;
    double offset;
    std::vector<std::array<Vector3d, 3>> triangles;
  };
  std::vector<Face> faces;
  for (const auto& corners : hull.triangles) {
    const std::array<Vector3d, 3> t{hull.vertices[corners[0]], hull.vertices[corners[1]], hull.vertices[corners[2]]};
    const Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]);
    if (n.norm() < 1e-12) continue;
    const Vector3d normal = n.normalized();
    const auto same = std::find_if(faces.begin(), faces.end(), [&](const Face& face) {
      return face.normal.dot(normal) > kSameFace && std::abs(face.normal.dot(t[0]) - face.offset) < 1e-4;
    });
    if (same == faces.end()) {
      faces.push_back({normal, normal.dot(t[0]), {t}});
    } else {
      same->triangles.push_back(t);
    }
  }
  const auto height = [&](const Vector3d& down) { return extent(down) - down.dot(middle); };
  const auto keepsStanding = [&](const Vector3d& down) {
    const Vector3d side = down.unitOrthogonal(), other = down.cross(side);
    for (int i = 0; i < kTilts; ++i) {
      const double angle = 2. * std::numbers::pi * i / kTilts;
      const Vector3d towards = std::cos(angle) * side + std::sin(angle) * other;
      if (height(std::cos(kTilt) * down + std::sin(kTilt) * towards) < height(down) - 1e-9) return false;
    }
    return true;
  };
  std::vector<Vector3d> stable;
  for (const Face& face : faces) {  // the center is above the face
    const Vector3d foot = middle + (face.offset - face.normal.dot(middle)) * face.normal;
    for (const auto& t : face.triangles) {
      bool inside = true;
      for (int i = 0; i < 3; ++i) {
        const Vector3d edge = t[std::size_t((i + 1) % 3)] - t[std::size_t(i)];
        inside &= edge.cross(foot - t[std::size_t(i)]).dot(face.normal) > -1e-9;
      }
      if (!inside) continue;
      stable.push_back(face.normal);
      break;
    }
  }
  // On a facet of a rounded edge, a shape would tip over at the slightest tilt, and lie lower then.
  for (const Vector3d& down : stable) {
    const bool may_fall = std::ranges::any_of(stable, [&](const Vector3d& other) {
      return other.dot(down) > kNearFace && height(other) < height(down) - kRollHeight;
    });
    if (!may_fall || keepsStanding(down)) resting_.push_back(down);
  }
}

}  // namespace kinegraph::inline perception_internal
