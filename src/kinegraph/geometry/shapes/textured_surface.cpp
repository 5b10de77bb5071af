#include "kinegraph/geometry/shapes/textured_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/geometry/shapes/tessellation.h"

namespace kinegraph::inline geometry_internal {

namespace {

using Place = std::array<float, 2>;
using Corners = std::array<Vector3d, 3>;

Place place(double right, double up) { return {float(right), float(up)}; }

/// Texture coordinates of a triangle on a surface around the z axis: angle and height. The seam is at y = 0, x < 0.
std::array<Place, 3> around(const Corners& corners, double low, double high) {
  std::array<double, 3> turn{};
  std::array<bool, 3> on_axis{};
  for (std::size_t k = 0; k < 3; ++k) {
    on_axis[k] = std::hypot(corners[k].x(), corners[k].y()) < 1e-9 * (high - low);
    turn[k] = .5 + std::atan2(corners[k].y(), corners[k].x()) / (2. * std::numbers::pi);
  }
  double most = 0.;
  for (std::size_t k = 0; k < 3; ++k) most = on_axis[k] ? most : std::max(most, turn[k]);
  double sum = 0.;
  int count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (on_axis[k]) continue;
    if (most - turn[k] > .5) turn[k] += 1.;  // across the seam
    sum += turn[k];
    ++count;
  }
  std::array<Place, 3> places;
  for (std::size_t k = 0; k < 3; ++k) {
    if (on_axis[k] && count > 0) turn[k] = sum / count;
    places[k] = place(turn[k], (corners[k].z() - low) / (high - low));
  }
  return places;
}

/// Texture coordinates of a triangle projected along the axis that it faces most, relative to the shape's extent.
std::array<Place, 3> seenAlongAxis(const Corners& corners, const Vector3d& low, const Vector3d& size) {
  const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const Vector3d outward = (normal[axis] < 0. ? -1. : 1.) * Vector3d::Unit(axis);
  const Vector3d up = axis == 2 ? Vector3d::UnitY() : Vector3d::UnitZ(), right = up.cross(outward);
  std::array<Place, 3> places;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d in_unit = (corners[k] - low).cwiseQuotient(size) - Vector3d::Constant(.5);
    places[k] = place(.5 + in_unit.dot(right), .5 + in_unit.dot(up));
  }
  return places;
}

}  // namespace

Mesh texturedSurface(const Geometry& geometry, std::shared_ptr<const Image> image,
                     const std::array<double, 2>& repeat) {
  const Mesh surface = tessellate(geometry);
  if (surface.triangles.empty() || !image) return surface;
  Mesh mesh;
  if (surface.texcoords.size() == surface.vertices.size()) {
    mesh = surface;
  } else {  // separate corners for each triangle
    const bool round = shapeKind(geometry.type).is_round;
    Vector3d low = surface.vertices[0], high = low;
    for (const Vector3d& p : surface.vertices) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const Vector3d size = (high - low).cwiseMax(1e-12);
    for (const auto& triangle : surface.triangles) {
      const Corners corners = {surface.vertices[triangle[0]], surface.vertices[triangle[1]],
                               surface.vertices[triangle[2]]};
      const auto first = std::uint32_t(mesh.vertices.size());
      mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
      const auto places = round ? around(corners, low.z(), high.z()) : seenAlongAxis(corners, low, size);
      mesh.texcoords.insert(mesh.texcoords.end(), places.begin(), places.end());
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
  }
  for (Place& uv : mesh.texcoords) uv = place(repeat[0] * uv[0], repeat[1] * uv[1]);
  mesh.textures = {{0, std::uint32_t(mesh.triangles.size()), std::move(image)}};
  return mesh;
}

std::shared_ptr<const Geometry> withTexcoords(const Geometry& geometry, const std::vector<double>& numbers) {
  auto covered = std::make_shared<Geometry>(geometry);
  Mesh mesh = *geometry.mesh;
  mesh.texcoords.clear();
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) mesh.texcoords.push_back(place(numbers[i], numbers[i + 1]));
  covered->mesh = std::make_shared<Mesh>(std::move(mesh));
  return covered;
}

}  // namespace kinegraph::inline geometry_internal
