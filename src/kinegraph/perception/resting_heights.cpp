#include "kinegraph/perception/resting_heights.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/perception/occupancy_map.h"
#include "kinegraph/perception/pose_fit.h"

namespace kinegraph::inline perception_internal {

namespace {

constexpr double kSameHeight = 1e-4;  // m
constexpr double kLevel = .999;       // cosine of the tilt of a box that counts as level
constexpr double kStood = .02;        // m, between the bottom of a thing and the top of what it stood on

/// The height of the top of a level box, if it comes within `reach` of a point in the plane.
std::optional<double> topOfBox(const Frame& frame, const Vector3d& near, double reach) {
  const ShapeType type = frame.getShapeType();
  if (type != ShapeType::box && type != ShapeType::ssBox) return std::nullopt;
  const Matrix3d R = frame.getRotationMatrix();
  if (R.row(2).cwiseAbs().maxCoeff() < kLevel) return std::nullopt;
  const std::vector<double>& size = frame.data().shape->geometry->size;
  const Vector3d half = .5 * R.cwiseAbs() * Vector3d(size[0], size[1], size[2]), p = frame.getPosition();
  const bool is_near = std::abs(near.x() - p.x()) < half.x() + reach && std::abs(near.y() - p.y()) < half.y() + reach;
  return is_near ? std::optional(p.z() + half.z()) : std::nullopt;
}

/// The box with sides along the axes of the world that holds a shape.
Eigen::AlignedBox3d boundsOf(const VisibleShape& shape, const RigidTransform& X) {
  Eigen::AlignedBox3d bounds;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d direction = X.R.transpose() * Vector3d::Unit(axis);
    bounds.max()[axis] = X.p[axis] + shape.extent(direction);
    bounds.min()[axis] = X.p[axis] - shape.extent(-direction);
  }
  return bounds;
}

Eigen::AlignedBox3d boundsOf(const Frame& frame) {
  const auto body = frame.data().shape->body();
  const RigidTransform X = frame.getPose().transform();
  const Vector3d center = X * body->boundCenter();
  const Vector3d half = (X.R.cwiseAbs() * body->boundHalf()).array() + body->radius();
  return {center - half, center + half};
}

/// The pose with the nearest stable face down, at the same place.
RigidTransform uprightPose(const VisibleShape& shape, const RigidTransform& X) {
  RigidTransform out = restingPose(shape, X, 0.);
  out.p.z() = X.p.z();
  return out;
}

/// The height of the top of a shape on which a thing stood in its last pose, by their bounds.
std::optional<double> topUnder(const Eigen::AlignedBox3d& thing, const Frame& frame) {
  const auto& shape = frame.data().shape;
  if (!shape || shapeKind(shape->geometry->type).is_symbol || isMoved(frame) ||
      shape->body()->core() == CollisionBody::Core::half_space)
    return std::nullopt;
  const Eigen::AlignedBox3d below = boundsOf(frame);
  const Vector3d middle = thing.center();
  const bool is_over =
      (middle - below.min()).head<2>().minCoeff() > 0. && (below.max() - middle).head<2>().minCoeff() > 0.;
  const double top = below.max().z();
  return is_over && std::abs(thing.min().z() - top) < kStood ? std::optional(top) : std::nullopt;
}

}  // namespace

VisibleShape placeOf(const Frame& frame) {
  std::set<int> on_it;
  for (const Frame& child : frame.getChildren()) {
    if (frame.getShapeType() != ShapeType::none) on_it.insert(child.id());
  }
  return VisibleShape(frame, on_it);
}

double heightOf(const Frame& frame, const VisibleShape& place) {
  return frame.getPosition().z() + place.extent(frame.getRotationMatrix().transpose() * Vector3d::UnitZ());
}

std::vector<double> heightsUnder(const Config& config, const Frame& thing, const VisibleShape& shape,
                                 const Frame& support, double height, double reach, const std::set<int>& things) {
  std::vector<double> heights = {height};
  const auto add = [&](double other) {
    const bool is_new =
        std::ranges::none_of(heights, [&](double known) { return std::abs(known - other) < kSameHeight; });
    if (is_new) heights.push_back(other);
  };
  std::optional<Frame> place = thing.getParent();
  while (place && place->getShapeType() == ShapeType::none) place = place->getParent();
  if (place && place->id() != support.id() && place->getShapeType() != ShapeType::marker)
    add(heightOf(*place, placeOf(*place)));
  for (const Frame& frame : support.getSubtree()) {
    if (things.contains(frame.id()) || isMoved(frame)) continue;
    if (const auto top = topOfBox(frame, thing.getPosition(), reach)) add(*top);
  }
  const Eigen::AlignedBox3d bounds = boundsOf(shape, uprightPose(shape, thing.getPose().transform()));
  for (const Frame& frame : config.getFrames()) {
    if (std::ranges::count(shape.frames(), frame.id()) > 0) continue;
    if (const auto top = topUnder(bounds, frame)) add(*top);
  }
  return heights;
}

double heightOfPlace(const VisibleShape& shape, const RigidTransform& last, const std::vector<double>& heights) {
  const double bottom = boundsOf(shape, uprightPose(shape, last)).min().z();
  return *std::ranges::min_element(heights, {}, [&](double height) { return std::abs(height - bottom); });
}

}  // namespace kinegraph::inline perception_internal
