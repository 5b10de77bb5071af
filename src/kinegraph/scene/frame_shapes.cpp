#include "kinegraph/scene/frame_setters.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/image_file.h"
#include "kinegraph/geometry/files/mesh_cache.h"
#include "kinegraph/geometry/shapes/cells.h"
#include "kinegraph/geometry/shapes/isosurface.h"
#include "kinegraph/geometry/shapes/scale_mesh.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/geometry/shapes/textured_surface.h"
#include "kinegraph/scene/collisions.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

void setLines(Frame& frame, const std::vector<Vector3d>& points, const PointColors& colors, bool connected) {
  const std::size_t n = points.size();
  if (n < 2 || (!connected && n % 2 != 0)) {
    throw ValueError(cat("setLines of frame '", frame.getName(), "': got ", n, " points; expected ",
                         connected ? "at least 2" : "an even number of them, two per line"));
  }
  if (colors.size() > 1 && colors.size() != n) {
    throw ValueError(
        cat("setLines of frame '", frame.getName(), "': got ", colors.size(), " colors for ", n, " points"));
  }
  Geometry geometry;
  geometry.type = ShapeType::lines;
  Mesh mesh;
  const bool colored = colors.size() == n;
  for (std::size_t i = 0; i < n; ++i) {
    const bool twice = connected && i > 0 && i + 1 < n;  // an inner point ends one segment and starts the next
    mesh.vertices.insert(mesh.vertices.end(), twice ? 2 : 1, points[i]);
    if (colored) mesh.colors.insert(mesh.colors.end(), twice ? 2 : 1, colors[i]);
  }
  if (!colored) mesh.colors = colors;
  geometry.mesh = std::make_shared<Mesh>(std::move(mesh));
  frame.setGeometry(std::move(geometry));
}

void setMeshFile(Frame& frame, const std::string& path, double scale) {
  if (!(std::isfinite(scale) && scale != 0.)) {
    throw ValueError(
        cat("setMeshFile of frame '", frame.getName(), "': scale ", scale, " is not a finite number other than 0"));
  }
  const std::string absolute = resolvePath(path, ".");
  if (absolute.empty()) throw FileError(cat("mesh file '", path, "': the package is not installed"));
  Geometry geometry;
  Mesh mesh = *sharedMeshFile(absolute);
  scaleMesh(mesh, Vector3d::Constant(scale));
  geometry.type = mesh.triangles.empty() ? ShapeType::pointCloud : ShapeType::mesh;
  geometry.mesh_file = absolute;
  geometry.mesh_scale.setConstant(scale);
  geometry.mesh = std::make_shared<Mesh>(std::move(mesh));
  frame.setGeometry(std::move(geometry));
}

void setTexture(Frame& frame, const std::string& path, const std::vector<double>& texcoords) {
  const std::shared_ptr<Shape>& shape = frame.data().shape;
  if (!shape) throw ValueError(cat("setTextureFile: frame '", frame.getName(), "' has no shape"));
  const std::string absolute = resolvePath(path, ".");
  std::shared_ptr<const Image> image = readImageFile(absolute.empty() ? path : absolute);
  Node node;
  if (!texcoords.empty()) {
    const std::size_t vertices = shape->geometry->mesh ? shape->geometry->mesh->vertices.size() : 0;
    if (texcoords.size() != 2 * vertices) {
      throw ValueError(cat("setTextureFile: frame '", frame.getName(), "' has ",
                           vertices == 0 ? "no mesh" : cat("a mesh of ", vertices, " vertices"), ", and got ",
                           texcoords.size(), " texture coordinates; expected 2 per vertex"));
    }
    shape->geometry = withTexcoords(*shape->geometry, texcoords);
    node.key = "texcoords";
    node.value.data = NumberArray{texcoords, 1};
    frame.editAttributes().set(node);
  }
  shape->texture = std::move(image);
  node.key = "texture";
  node.value.data = AngleText{absolute};
  frame.editAttributes().set(node);
  frame.scene()->looksChanged(*shape);
}

namespace {

void setGrid(Frame& frame, ShapeType type, Grid grid, const Vector3d& size) {
  checkGrid(grid);
  Geometry geometry;
  geometry.type = type;
  geometry.size = checkedSize(type, {size.begin(), size.end()}, nullptr);
  geometry.grid = std::make_shared<Grid>(std::move(grid));
  frame.setGeometry(std::move(geometry));
}

}  // namespace

void setTensor(Frame& frame, Grid grid, const Vector3d& size) {
  setGrid(frame, ShapeType::tensor, std::move(grid), size);
}

void setSdf(Frame& frame, Grid grid, const Vector3d& size) { setGrid(frame, ShapeType::sdf, std::move(grid), size); }

void setCells(Frame& frame, Grid grid, const Vector3d& size) {
  checkCells(grid, size);
  setGrid(frame, kCells, std::move(grid), size);
}

void setImplicitSurface(Frame& frame, const Grid& grid, const Vector3d& size, int blur, double resample) {
  checkedSize(ShapeType::tensor, {size.begin(), size.end()}, nullptr);
  if (blur < 0) throw ValueError(cat("setImplicitSurface: blur ", blur, " is negative"));
  Grid values = blurred(grid, blur);
  if (resample > 0.) {
    std::array<int, 3> cells;
    for (int k = 0; k < 3; ++k) cells[k] = std::clamp(int(std::lround(size[k] / resample)) + 1, 2, 1000);
    values = resampled(values, cells);
  }
  Mesh surface = isosurface(values, size);
  if (surface.triangles.empty()) {
    throw ValueError(cat("setImplicitSurface of frame '", frame.getName(),
                         "': the grid values never cross zero; expected a sign change at the surface"));
  }
  frame.setMesh(std::move(surface));
}

}  // namespace kinegraph
