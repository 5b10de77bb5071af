#include "kinegraph/perception/resting_heights.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "kinegraph/perception/occupancy_map.h"

namespace kinegraph {

namespace {

constexpr double kSameHeight = 1e-4;  // m
constexpr double kLevel = .999;       // cosine of the tilt of a box that counts as level

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

std::vector<double> heightsUnder(const Frame& thing, const Frame& support, double height, double reach,
                                 const std::set<int>& things) {
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
  return heights;
}

}  // namespace kinegraph
