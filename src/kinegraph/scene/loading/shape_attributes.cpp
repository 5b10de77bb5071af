#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/grid_file.h"
#include "kinegraph/geometry/files/image_file.h"
#include "kinegraph/geometry/files/mesh_cache.h"
#include "kinegraph/geometry/files/mesh_file.h"
#include "kinegraph/geometry/shapes/isosurface.h"
#include "kinegraph/geometry/shapes/scale_mesh.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/geometry/shapes/textured_surface.h"
#include "kinegraph/scene/loading/attributes.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

namespace {

constexpr double kMaxRopeSegments = 10000.;

std::vector<Vector3d> triples(const std::vector<double>& v) {
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i + 2 < v.size(); i += 3) points.emplace_back(v[i], v[i + 1], v[i + 2]);
  return points;
}

bool isJointType(const std::string& word) {
  try {
    return jointTypeFromName(word) != JointType::none;
  } catch (const ValueError&) {
    return false;
  }
}

/// Throws ValueError for an unknown shape; the message points out a joint type.
ShapeType shapeTypeOf(const std::string& word) {
  try {
    return shapeTypeFromName(word);
  } catch (const ValueError&) {
    if (isJointType(word)) throw ValueError(cat("'", word, "' is a joint type; write joint: ", word));
    throw;
  }
}

bool hasGrid(const Geometry& geometry) { return shapeKind(geometry.type).data == ShapeKind::Data::grid; }

bool isMeshFile(const Node& node) { return node.value.as<AngleText>() || node.value.as<std::string>(); }

}  // namespace

bool AttributeReader::readShapeType(Geometry& geometry) {
  const Node* node = find({"shape", "type"});
  return node && guarded(*node, [&] {
           if (const double* code = node->value.as<double>()) {
             if (!(*code >= 0. && *code <= 1000.)) throw ValueError(cat("shape type ", *code, " does not exist"));
             geometry.type = ShapeType(int(*code));
             shapeTypeName(geometry.type);  // throws for other numbers
           } else if (const std::string* word = node->value.as<std::string>()) {
             geometry.type = shapeTypeOf(*word);
           } else {
             throw ValueError(cat("expected a shape type, got ", describe(node->value)));
           }
         });
}

bool AttributeReader::readMesh(Geometry& geometry) {
  const Node* node = find({"mesh", "mesh_decomp", "mesh_points"});
  return guarded(*node, [&] {
    const std::string file = path(*node);
    Vector3d factors = Vector3d::Ones();
    if (const Node* scale = find({"meshscale"})) {
      const auto s = numbers(*scale).value_or(std::vector<double>{1.});
      if (s.size() == 1 || s.size() == 3) {
        factors = s.size() == 3 ? Vector3d(s[0], s[1], s[2]) : Vector3d::Constant(s[0]).eval();
        geometry.mesh_scale = factors;
      } else {
        error(*scale, cat("expected 1 or 3 numbers, got ", s.size()));
      }
    }
    std::shared_ptr<const Mesh> mesh;
    try {
      if (node->key == "mesh") mesh = sharedMeshFile(file, factors);
      if (!mesh) mesh = std::make_shared<Mesh>(readH5Mesh(file, node->key == "mesh_decomp" ? "decomp" : "points"));
    } catch (const FileError& e) {
      throw FileError(cat(e.what(), std::string(e.what()).ends_with("does not exist") ? similarFilesHint(file) : ""));
    }
    if (node->key != "mesh" && factors != Vector3d::Ones()) {
      Mesh scaled = *mesh;
      scaleMesh(scaled, factors);
      mesh = std::make_shared<Mesh>(std::move(scaled));
    }
    geometry.type = mesh->triangles.empty() ? ShapeType::pointCloud : ShapeType::mesh;
    if (node->key == "mesh") geometry.mesh_file = file;
    geometry.mesh = std::move(mesh);
  });
}

/// Reads the core points of a convex shape: numbers, or the points of a mesh file.
bool AttributeReader::readCore(Geometry& geometry) {
  const Node* node = find({"core"});
  return guarded(*node, [&] {
    Mesh core;
    if (isMeshFile(*node)) {
      core.vertices = sharedMeshFile(path(*node))->vertices;
    } else if (const auto v = numbers(*node)) {
      if (v->size() < 3 || v->size() % 3 != 0) throw ValueError(cat("expected n x 3 numbers, got ", v->size()));
      core.vertices = triples(*v);
    }
    geometry.mesh = std::make_shared<Mesh>(std::move(core));
  });
}

/// Reads `mesh_rope: [x y z n]`: points on the segment from the origin to x y z.
bool AttributeReader::readRope(Geometry& geometry) {
  const Node* node = find({"mesh_rope"});
  const auto v = numbers(*node);
  if (!v) return false;
  if (v->size() != 4 || !((*v)[3] >= 1. && (*v)[3] <= kMaxRopeSegments)) {
    error(*node, cat("expected [x y z n] with n segments to the point x y z, n from 1 to ", kMaxRopeSegments));
    return false;
  }
  Mesh rope;
  const int segments = int((*v)[3]);
  for (int i = 0; i <= segments; ++i) rope.vertices.push_back(Vector3d((*v)[0], (*v)[1], (*v)[2]) * i / segments);
  geometry.mesh = std::make_shared<Mesh>(std::move(rope));
  return true;
}

/// Reads an inline mesh: `vertices: [x y z ...]`, `triangles: [i j k ...]`, `vertex_colors: [r g b a ...]`, and
/// `mesh_parts: [i ...]`, the first vertices of its convex parts.
bool AttributeReader::readVertices(Geometry& geometry) {
  bool good = true;
  const auto list = [&](const char* key, std::size_t columns, double lowest, double highest) {
    const Node* node = find({key});
    std::vector<double> v = node ? numbers(*node).value_or(std::vector<double>{}) : std::vector<double>{};
    const bool in_range = std::all_of(v.begin(), v.end(), [&](double x) { return x >= lowest && x <= highest; });
    if (v.size() % columns == 0 && in_range) return v;
    error(*node, cat("expected n x ", columns, " numbers", lowest == 0. ? cat(" in 0..", highest) : ""));
    good = false;
    return std::vector<double>();
  };
  const double any = std::numeric_limits<double>::max();
  Mesh mesh;
  mesh.vertices = triples(list("vertices", 3, -any, any));
  const std::vector<double> t = list("triangles", 3, 0., double(mesh.vertices.size()) - 1.);
  for (std::size_t i = 0; i < t.size(); i += 3) {
    mesh.triangles.push_back({std::uint32_t(t[i]), std::uint32_t(t[i + 1]), std::uint32_t(t[i + 2])});
  }
  const std::vector<double> c = list("vertex_colors", 4, 0., 255.);
  for (std::size_t i = 0; i < c.size(); i += 4) {
    mesh.colors.push_back({std::uint8_t(c[i]), std::uint8_t(c[i + 1]), std::uint8_t(c[i + 2]), std::uint8_t(c[i + 3])});
  }
  for (const double first : list("mesh_parts", 1, 0., double(mesh.vertices.size()) - 1.))
    mesh.parts.push_back(std::uint32_t(first));
  if (!std::is_sorted(mesh.parts.begin(), mesh.parts.end())) {
    error(*find({"mesh_parts"}), "the first vertices of the parts must ascend");
    good = false;
  }
  geometry.mesh = std::make_shared<Mesh>(std::move(mesh));
  return good;
}

/// Reads `grid_cells: [nx ny nz], grid_values: [...]`: a grid over the box of `size`, last index fastest.
bool AttributeReader::readGrid(Geometry& geometry) {
  const Node* node = find({"grid_values"});
  return guarded(*node, [&] {
    const Node* cells_node = find({"grid_cells"});
    const auto cells = cells_node ? numbers(*cells_node).value_or(std::vector<double>{}) : std::vector<double>{};
    const auto values = numbers(*node).value_or(std::vector<double>{});
    const bool good = cells.size() == 3 && std::all_of(cells.begin(), cells.end(), [](double n) {
                        return n >= 2. && n <= 1e6 && n == std::floor(n);
                      });
    if (!good) throw ValueError("needs grid_cells: [nx ny nz], each at least 2");
    Grid grid;
    if (cells[0] * cells[1] * cells[2] != double(values.size())) {
      throw ValueError(cat("expected ", cells[0], " x ", cells[1], " x ", cells[2], " numbers, got ", values.size()));
    }
    for (int axis = 0; axis < 3; ++axis) grid.cells[axis] = int(cells[axis]);
    grid.values.assign(values.begin(), values.end());
    checkGrid(grid);
    geometry.grid = std::make_shared<Grid>(std::move(grid));
  });
}

/// Reads `sdf: <file>`: a grid of numbers and the box it fills.
bool AttributeReader::readGridOf(const Node& file, Geometry& geometry) {
  return guarded(file, [&] {
    GridFile read = readGridFile(path(file));
    if (geometry.type == ShapeType::none) geometry.type = ShapeType::sdf;
    if (!hasGrid(geometry)) {
      throw ValueError(cat("a ", shapeTypeName(geometry.type), " has no grid; expected shape: sdf or tensor"));
    }
    geometry.size = {read.size.x(), read.size.y(), read.size.z()};
    geometry.grid = std::make_shared<Grid>(std::move(read.grid));
  });
}

bool AttributeReader::readSize(Geometry& geometry) {
  const Node* size = find({"size"});
  if (!size && geometry.grid && !geometry.size.empty()) return true;  // the size comes from the file
  const Node& blamed = size ? *size : *find({"shape", "type", "mesh", "mesh_decomp", "mesh_points"});
  const auto given = size ? numbers(*size) : std::vector<double>{};
  return given && guarded(blamed, [&] {
           std::string enlarged;
           try {
             geometry.size = checkedSize(geometry.type, *given, &enlarged);
           } catch (const ValueError& e) {
             throw ValueError(cat(e.what(), size ? bracketHint(*size) : ""));
           }
           if (!enlarged.empty()) warning(blamed, enlarged);
         });
}

/// Reads type, mesh and size. Returns false after an error.
bool AttributeReader::readGeometry(Geometry& geometry) {
  if (find({"shape", "type"}) && !readShapeType(geometry)) return false;
  bool good = true;
  if (find({"mesh", "mesh_decomp", "mesh_points"})) {
    good = readMesh(geometry);
  } else if (shapeKind(geometry.type).data == ShapeKind::Data::core_points && find({"core"})) {
    good = readCore(geometry);
  } else if (find({"vertices"})) {
    good = readVertices(geometry);
  } else if (find({"mesh_rope"})) {
    good = readRope(geometry);
  }
  if (const Node* file = find({"sdf"})) {
    good = readGridOf(*file, geometry) && good;
  } else if (hasGrid(geometry) && find({"grid_values"})) {
    good = readGrid(geometry) && good;
  }
  return good && readSize(geometry);
}

void AttributeReader::applyShape(FrameData& frame) {
  if (find({"shape", "type", "mesh", "mesh_decomp", "mesh_points", "sdf"})) {
    Geometry geometry;
    if (!readGeometry(geometry)) return;
    frame.shape = std::make_shared<Shape>();
    frame.shape->geometry = std::make_shared<Geometry>(std::move(geometry));
    frame.tree->looksChanged(*frame.shape);
  }
  if (!frame.shape) {
    const Node* stray = find({"size", "contact"});
    if (stray && !find({"mimic_shape"})) warning(*stray, cat("'", stray->key, "' has no effect without a shape"));
    return;
  }
  if (const Node* color = find({"color"})) {
    const auto c = numbers(*color);
    const std::size_t n = c ? c->size() : 0;
    if (c && (n < 1 || n > 4))
      error(*color, cat("expected 1 (gray), 2 (gray alpha), 3 (rgb) or 4 (rgba) numbers, got ", n));
    if (n == 1 || n == 2) frame.shape->color = Vector4d((*c)[0], (*c)[0], (*c)[0], n == 2 ? (*c)[1] : 1.);
    if (n == 3 || n == 4) frame.shape->color = Vector4d((*c)[0], (*c)[1], (*c)[2], n == 4 ? (*c)[3] : 1.);
    if (frame.shape->color && !frame.shape->color->allFinite()) error(*color, "expected finite numbers");
    if (c && std::any_of(c->begin(), c->end(), [](double x) { return x > 1.5; }))
      warning(*color, "color has numbers above 1; expected 0..1 (divide values of 0..255 by 255)");
  }
  if (const Node* contact = find({"contact"})) {
    const double flag = number(*contact).value_or(0.);
    if (!(std::abs(flag) <= 1000.)) return error(*contact, "expected a number from -1000 to 1000");
    frame.shape->contact = int(flag);
  }
  if (const Node* mesh = find({"visual_mesh"})) {  // may be missing: the shape itself is shown instead
    guarded(*mesh, [&] { frame.shape->visual_mesh = resolvePath(pathText(*mesh), folder_); });
  }
  if (const auto pose = readPose({"visual_pose"})) frame.shape->visual_pose = *pose;
  applyTexture(*frame.shape);
}

/// Reads `texture: <image>`, `texcoords: [right up ...]` per vertex of a mesh, and `texture_repeat: [right up]`. An
/// unreadable picture causes a warning, and the shape shows its color.
void AttributeReader::applyTexture(Shape& shape) {
  if (const Node* node = find({"texcoords"})) {
    const std::vector<double> uv = numbers(*node).value_or(std::vector<double>{});
    const std::size_t vertices = shape.geometry->mesh ? shape.geometry->mesh->vertices.size() : 0;
    if (vertices == 0) return warning(*node, "'texcoords' has no effect: the shape has no vertices");
    if (uv.size() != 2 * vertices)
      return error(*node, cat("expected 2 numbers for each of ", vertices, " vertices, got ", uv.size()));
    shape.geometry = withTexcoords(*shape.geometry, uv);
  }
  if (const Node* node = find({"texture_repeat"})) {
    const std::vector<double> times = numbers(*node).value_or(std::vector<double>{});
    const bool good = (times.size() == 1 || times.size() == 2) &&
                      std::all_of(times.begin(), times.end(), [](double x) { return std::isfinite(x); });
    if (!good)
      return error(*node,
                   cat("expected 1 or 2 finite numbers, the repetitions of the picture to the right and up; got ",
                       times.size()));
    shape.texture_repeat = {times.front(), times.back()};
  }
  const Node* node = find({"texture"});
  if (!node) return;
  try {
    shape.texture = readImageFile(path(*node));
  } catch (const Error& e) {
    const bool missing = std::string(e.what()).ends_with("does not exist");
    warning(*node, cat("texture: ", e.what(), missing ? similarFilesHint(resolvePath(pathText(*node), folder_)) : ""));
  }
}

}  // namespace kinegraph::inline scene_internal
