#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>

#include "bindings.h"
#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/geometry/shapes/convex_hull.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/geometry/shapes/tessellation.h"
#include "kinegraph/scene/frame_shapes.h"

namespace kinegraph::python {

namespace {

using OptionalNumbers = const std::optional<Numbers>&;

/// Mesh of a shape in local coordinates: its own, or its surface as triangles.
Mesh meshOf(const Frame& frame) {
  const auto& shape = frame.data().shape;
  if (!shape) return {};
  const Geometry& geometry = *shape->geometry;
  if (geometry.mesh && geometry.type != ShapeType::ssCvx) return *geometry.mesh;
  return tessellate(geometry);
}

Array meshPoints(const Mesh& mesh) {
  NewArray array = newArray(mesh.vertices.size(), 3);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) std::copy_n(mesh.vertices[i].data(), 3, array.data + 3 * i);
  return array.array;
}

/// (m, 3), or (m, 2) for lines: which points belong together.
IndexArray meshTriangles(const Frame& frame, const Mesh& mesh) {
  const bool lines = frame.getShapeType() == ShapeType::lines;
  NewArray array = newArray(lines ? mesh.vertices.size() / 2 : mesh.triangles.size(), lines ? 2 : 3);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) std::copy_n(mesh.triangles[i].data(), 3, array.data + 3 * i);
  if (lines) {
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) array.data[i] = double(i);
  }
  return IndexArray(array.array.attr("astype")("uint32"));
}

/// A row per color, rgb, or rgba if any is transparent: the mesh's own, or the frame's.
ByteArray meshColors(const Frame& frame, const Mesh& mesh) {
  PointColors colors = mesh.colors;
  const auto& shape = frame.data().shape;
  if (colors.empty() && shape && shape->color) {
    colors.emplace_back();
    for (int i = 0; i < 4; ++i) colors[0][i] = std::uint8_t(std::lround(255. * std::clamp((*shape->color)[i], 0., 1.)));
  }
  const bool opaque = std::all_of(colors.begin(), colors.end(), [](const auto& c) { return c[3] == 255; });
  const std::size_t columns = opaque ? 3 : 4;
  NewArray array = newArray(colors.size(), columns);
  for (std::size_t i = 0; i < colors.size(); ++i) std::copy_n(colors[i].data(), columns, array.data + columns * i);
  return ByteArray(array.array.attr("astype")("uint8"));
}

std::vector<Vector3d> points(const Numbers& numbers, const char* what) {
  if (numbers.values.size() % 3 != 0) throw ValueError(cat(what, " are n x 3 numbers, got ", numbers.values.size()));
  if (!numbers.values.allFinite()) throw ValueError(cat(what, " have numbers that are not finite"));
  std::vector<Vector3d> list(numbers.values.size() / 3);
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = numbers.values.segment<3>(3 * Eigen::Index(i));
  return list;
}

/// Colors of n points, 0..255: rows of 3 or 4 numbers, or one such row for all.
PointColors colorsOf(OptionalNumbers numbers, std::size_t n) {
  if (!numbers || numbers->values.size() == 0) return {};
  const std::size_t size = std::size_t(numbers->values.size());
  std::size_t columns = numbers->rank == 2 ? numbers->columns() : size;
  if (numbers->rank < 2 && size == 3 * n && n > 1) columns = 3;
  if ((columns != 3 && columns != 4) || (size != columns && size != columns * n)) {
    throw ValueError(cat("got ", size, " color numbers for ", n,
                         " points; expected 3 (rgb) or 4 (rgba) per point, or of one color, in 0..255"));
  }
  PointColors colors(size / columns, {0, 0, 0, 255});
  for (std::size_t i = 0; i < size; ++i) {
    const double x = numbers->values[Eigen::Index(i)];
    if (!(x >= 0. && x <= 255.)) throw ValueError(cat("color number ", x, " is not in 0..255"));
    colors[i / columns][i % columns] = std::uint8_t(std::lround(x));
  }
  return colors;
}

/// Whole numbers from 0 to below `limit`.
std::vector<std::uint32_t> indices(const Numbers& numbers, std::size_t limit, const char* what) {
  std::vector<std::uint32_t> list;
  for (double index : numbers.values) {
    if (!(index >= 0. && index < double(limit)) || index != std::floor(index)) {
      throw ValueError(cat(what, " name vertex ", index, "; there are ", limit));
    }
    list.push_back(std::uint32_t(index));
  }
  return list;
}

Frame& setMesh(Frame& frame, const Numbers& vertices, const Numbers& triangles, OptionalNumbers colors,
               OptionalNumbers parts) {
  Mesh mesh;
  mesh.vertices = points(vertices, "mesh vertices");
  mesh.colors = colorsOf(colors, mesh.vertices.size());
  const std::vector<std::uint32_t> corners = indices(triangles, mesh.vertices.size(), "mesh triangles");
  if (corners.size() % 3 != 0) throw ValueError(cat("mesh triangles are m x 3 indices, got ", corners.size()));
  for (std::size_t i = 0; i < corners.size(); i += 3)
    mesh.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
  if (parts) mesh.parts = indices(*parts, mesh.vertices.size() + 1, "convex parts");
  if (!std::is_sorted(mesh.parts.begin(), mesh.parts.end()))
    throw ValueError("cvxParts are vertex indices in ascending order");
  return frame.setMesh(std::move(mesh));
}

Frame& setConvexMesh(Frame& frame, const Numbers& core, OptionalNumbers colors, double radius) {
  std::vector<Vector3d> corners = points(core, "core points");
  const PointColors given = colorsOf(colors, corners.size());
  if (radius == 0.) {
    Mesh hull = convexHull(corners);
    if (given.size() == 1) hull.colors = given;
    frame.setMesh(std::move(hull));
  } else {
    frame.setConvexCore(std::move(corners), radius);
  }
  if (!given.empty()) {  // a hull has fewer vertices than it was made from: it gets their mean color
    Vector4d mean = Vector4d::Zero();
    for (const auto& c : given) mean += Vector4d(c[0], c[1], c[2], c[3]) / (255. * double(given.size()));
    frame.setColor({mean[0], mean[1], mean[2], mean[3]});
  }
  return frame;
}

Frame& setPointCloud(Frame& frame, const Numbers& cloud, OptionalNumbers colors) {
  Mesh mesh;
  mesh.vertices = points(cloud, "points");
  mesh.colors = colorsOf(colors, mesh.vertices.size());
  return frame.setMesh(std::move(mesh));
}

Frame& setLinesOf(Frame& frame, const Numbers& vertices, OptionalNumbers colors, bool connected) {
  const std::vector<Vector3d> ends = points(vertices, "line points");
  setLines(frame, ends, colorsOf(colors, ends.size()), connected);
  return frame;
}

Grid gridOf(nb::handle data, const char* call) {
  const nb::object array = nb::module_::import_("numpy").attr("ascontiguousarray")(data, "dtype"_a = "float64");
  const auto shape = nb::cast<std::vector<int>>(array.attr("shape"));
  Numbers numbers;
  if (shape.size() != 3 || !readNumbers(array, numbers)) {
    throw ValueError(cat(call, ": the grid has ", shape.size(), " dimensions; expected a 3-D array of numbers"));
  }
  Grid grid;
  grid.cells = {shape[0], shape[1], shape[2]};
  grid.values.assign(numbers.values.begin(), numbers.values.end());
  return grid;
}

Vector3d boxSize(const Numbers& size, const char* call) {
  if (size.values.size() != 3)
    throw ValueError(cat(call, ": size is 3 numbers, the extent of the grid in m; got ", size.values.size()));
  return size.values;
}

std::string pathText(nb::handle path) { return nb::cast<std::string>(nb::module_::import_("os").attr("fspath")(path)); }

constexpr auto kChain = nb::rv_policy::none;  // setters return the very object they were called on

void bindMeshes(nb::class_<Frame>& frame) {
  frame
      .def("setMesh", setMesh, "vertices"_a, "triangles"_a, "colors"_a = nb::none(), "cvxParts"_a = nb::none(), kChain,
           "Gives the frame a mesh: vertices (n, 3) in m, triangles (m, 3). colors: (n, 3) or (n, 4), or one row for "
           "all, in 0..255.\n"
           "cvxParts: index of the first vertex of each convex part. ArgumentError for indices that name no vertex.")
      .def(
          "setMeshFile",
          [](Frame& f, nb::handle file, double scale) -> Frame& { return setMeshFile(f, pathText(file), scale), f; },
          "filename"_a, "scale"_a = 1., kChain,
          "Gives the frame the mesh of a file (h5, ply, stl, obj, dae, ...), scaled. FileError if it cannot be read.")
      .def(
          "setTextureFile",
          [](Frame& f, nb::handle image, OptionalNumbers uv) -> Frame& {
            return setTexture(f, pathText(image), uv ? uv->list() : std::vector<double>{}), f;
          },
          "image_filename"_a, "texCoords"_a = nb::none(), kChain,
          "Covers the frame's shape with a picture, PNG or JPEG. texCoords: (n, 2), where each vertex of its mesh is "
          "in the picture:\n"
          "to the right and up, in 0..1. Without them the mesh's own count; on other shapes the picture covers every "
          "side of a box, a\n"
          "quad, or goes once around z. FileError if the file is missing or of another kind; ArgumentError without a "
          "shape.")
      .def("setConvexMesh", setConvexMesh, "points"_a, "colors"_a = nb::none(), "radius"_a = 0., kChain,
           "Gives the frame the convex hull of points (n, 3), m: as a mesh, or, with a radius (m), as ssCvx swept by a "
           "ball.\n"
           "The hull has one color, the mean of those given (0..255).")
      .def(
          "setPointCloud",
          [](Frame& f, const Numbers& cloud, OptionalNumbers colors, nb::object) -> Frame& {
            return setPointCloud(f, cloud, colors);
          },
          "points"_a, "colors"_a = nb::none(), "normals"_a = nb::none(), kChain,
          "Gives the frame points (n, 3), m. colors: (n, 3) or (n, 4), or one row, in 0..255. Normals are accepted and "
          "not used.")
      .def("setLines", setLinesOf, "verts"_a, "colors"_a = nb::none(), "singleConnectedLine"_a = false, kChain,
           "Gives the frame line segments between consecutive pairs of points (n, 3), m, or with singleConnectedLine "
           "one line\n"
           "through all. colors as for setPointCloud.")
      .def(
          "setMeshAsLines",
          [](Frame& f, const Numbers& lines) -> Frame& { return setLinesOf(f, lines, std::nullopt, false); }, "lines"_a,
          kChain, "setLines with a flat list of numbers: x y z of both ends, line after line, m.")
      .def(
          "setTensorShape",
          [](Frame& f, nb::handle data, const Numbers& size) -> Frame& {
            return setTensor(f, gridOf(data, "setTensorShape"), boxSize(size, "setTensorShape")), f;
          },
          "data"_a, "size"_a, kChain,
          "Gives the frame a grid of numbers (nx, ny, nz) in a box of size (3,), m. It is drawn as the box.")
      .def(
          "setSdf",
          [](Frame& f, nb::handle data, const Numbers& size) -> Frame& {
            return setSdf(f, gridOf(data, "setSdf"), boxSize(size, "setSdf")), f;
          },
          "data"_a, "size"_a, kChain,
          "Gives the frame the solid where a grid (nx, ny, nz) in a box of size (3,), m, is not positive. Outside of "
          "the solid\n"
          "the values are its distance, m; collisions and distances interpolate them. The viewer draws the box.")
      .def(
          "setImplicitSurface",
          [](Frame& f, nb::handle data, const Numbers& size, int blur, double resample) -> Frame& {
            const char* call = "setImplicitSurface";
            return setImplicitSurface(f, gridOf(data, call), boxSize(size, call), blur, resample), f;
          },
          "data"_a, "size"_a, "blur"_a = 0, "resample"_a = -1., kChain,
          "Gives the frame the surface where a grid (nx, ny, nz) in a box of size (3,), m, is zero; normals point to "
          "larger values.\n"
          "blur: how often values are averaged with their neighbors. resample: cell size in m to interpolate to, if > "
          "0.\n"
          "ArgumentError if the values are nowhere zero.")
      .def(
          "convertDecomposedShapeToChildFrames", [](Frame& f) -> Frame& { return splitIntoConvexParts(f), f; }, kChain,
          "Gives every convex part of the mesh (cvxParts, or what its triangles connect) to a child <name>_<i> as its "
          "convex hull,\n"
          "with the color and contact flag; the frame loses its shape. ArgumentError without a mesh.")
      .def(
          "getMeshPoints", [](const Frame& f) { return meshPoints(meshOf(f)); },
          "Vertices of the shape's surface, (n, 3), in the frame, m.")
      .def(
          "getMeshTriangles", [](const Frame& f) { return meshTriangles(f, meshOf(f)); },
          "Triangles of the shape's surface, (m, 3) uint32; of lines: their ends, (m, 2).")
      .def(
          "getMeshColors", [](const Frame& f) { return meshColors(f, meshOf(f)); },
          "Colors, (n, 3) or (n, 4) uint8: one per vertex, or one row with the frame's color; (0, 3) if it has none.")
      .def(
          "getMesh",
          [](const Frame& f) {
            const Mesh mesh = meshOf(f);
            return nb::typed<nb::tuple, Array, IndexArray, ByteArray>(
                nb::make_tuple(meshPoints(mesh), meshTriangles(f, mesh), meshColors(f, mesh)));
          },
          "getMeshPoints, getMeshTriangles and getMeshColors together.");
}

}  // namespace

void bindShapes(nb::class_<Frame>& frame) {
  frame
      .def(
          "setShape",
          [](Frame& f, ShapeType type, const Numbers& size) -> Frame& { return f.setShape(type, size.list()); },
          "type"_a, "size"_a, kChain,
          "Gives the frame a shape. Sizes in m: box [x y z], ssBox [x y z radius], sphere [r], capsule and cylinder\n"
          "[length r], marker [length], quad [x y].")
      .def(
          "setShape",
          [](Frame& f, const std::string& type, const Numbers& size) -> Frame& {
            return f.setShape(shapeTypeFromName(type), size.list());
          },
          "type"_a, "size"_a, kChain, "The same with the type's name.")
      .def(
          "setColor", [](Frame& f, const Numbers& color) -> Frame& { return f.setColor(color.list()); }, "color"_a,
          kChain, "Gray, gray and alpha, rgb, or rgba; in 0..1.")
      .def(
          "setContact", [](Frame& f, int contact) -> Frame& { return f.setContact(contact); }, "contact"_a, kChain,
          "0: never collides; 1: with everything outside of its link; -k: not with links within k joints above.")
      .def("getShapeType", &Frame::getShapeType, "Its ST; ST.none without a shape.")
      .def(
          "getSize", [](const Frame& f) { return toNumpy(f.getSize().data(), f.getSize().size()); },
          "Sizes as for setShape; empty without a shape.");
  bindMeshes(frame);
}

}  // namespace kinegraph::python
