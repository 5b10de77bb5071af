#include "kinegraph/geometry/shapes/geometry_flaw.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"

namespace kinegraph::inline geometry_internal {

namespace {

std::string sizeFlaw(const Geometry& geometry) {
  const ShapeKind& kind = shapeKind(geometry.type);
  if (!kind.is_symbol && geometry.size.size() < kind.sizes())
    return cat("a ", kind.name, " has ", kind.sizes(), " sizes, got ", geometry.size.size());
  const bool finite = std::ranges::all_of(geometry.size, [](double size) { return std::isfinite(size); });
  return finite ? "" : "its sizes are not finite";
}

std::string meshFlaw(const Mesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint32_t last = std::ranges::max(mesh.triangles[i]);
    if (last >= count) return cat("triangle ", i, " has the vertex ", last, " of ", count);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!mesh.vertices[i].allFinite()) return cat("vertex ", i, " is not finite");
  }
  if (mesh.colors.size() > 1 && mesh.colors.size() != count)
    return cat("it has ", mesh.colors.size(), " colors for ", count, " vertices");
  if (!mesh.texcoords.empty() && mesh.texcoords.size() != count)
    return cat("it has ", mesh.texcoords.size(), " texture coordinates for ", count, " vertices");
  if (!std::ranges::is_sorted(mesh.parts) || (!mesh.parts.empty() && mesh.parts.back() > count))
    return cat("its parts do not ascend within its ", count, " vertices");
  return "";
}

std::string gridFlaw(const Grid& grid) {
  const double needed = double(grid.cells[0]) * double(grid.cells[1]) * double(grid.cells[2]);
  if (std::ranges::min(grid.cells) < 2 || double(grid.values.size()) != needed) {
    return cat("its grid of ", grid.cells[0], " x ", grid.cells[1], " x ", grid.cells[2], " has ", grid.values.size(),
               " values; expected at least 2 x 2 x 2, with one value each");
  }
  const bool finite = std::ranges::all_of(grid.values, [](float value) { return std::isfinite(value); });
  return finite ? "" : "its grid has values that are not finite";
}

}  // namespace

std::string geometryFlaw(const Geometry& geometry) {
  std::string flaw = sizeFlaw(geometry);
  if (flaw.empty() && geometry.mesh) flaw = meshFlaw(*geometry.mesh);
  if (flaw.empty() && geometry.grid) flaw = gridFlaw(*geometry.grid);
  return flaw;
}

}  // namespace kinegraph::inline geometry_internal
