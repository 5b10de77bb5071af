#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/geometry/shapes/tessellation.h"
#include "kinegraph/scene/frame_setters.h"
#include "kinegraph/scene/loading/unit_questions.h"
#include "scene/shapes_docs.h"

namespace kinegraph::python {

namespace {

/// Sets a shape, and warns of sizes that are mended, as the reader does.
Frame& setShape(Frame& frame, ShapeType type, const Numbers& size) {
  frame.setShape(type, size.list());
  std::string warning;
  checkedSize(type, size.list(), &warning);
  if (!warning.empty()) emitWarning(cat("setShape: frame '", frame.getName(), "': ", warning));
  if (const std::string question = askAboutSize(frame.data()); !question.empty()) emitWarning("setShape: " + question);
  return frame;
}

/// Mesh of a shape in local coordinates: its own, or its triangulated surface.
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

/// Vertex indices of the triangles, (m, 3), or of the line segments, (m, 2).
IndexArray meshTriangles(const Frame& frame, const Mesh& mesh) {
  const bool lines = frame.getShapeType() == ShapeType::lines;
  NewArray array = newArray(lines ? mesh.vertices.size() / 2 : mesh.triangles.size(), lines ? 2 : 3);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) std::copy_n(mesh.triangles[i].data(), 3, array.data + 3 * i);
  if (lines) {
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) array.data[i] = double(i);
  }
  return IndexArray(array.array.attr("astype")("uint32"));
}

/// One color per row, rgb, or rgba if any is transparent: the mesh's own, or the frame's.
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

void bindSurfaces(nb::class_<Frame>& frame) {
  frame
      .def(
          "getMeshPoints", [](const Frame& f) { return meshPoints(meshOf(f)); },
          "Returns the vertices of the shape's surface, shape (n, 3), in the frame's coordinates, m.")
      .def(
          "getMeshTriangles", [](const Frame& f) { return meshTriangles(f, meshOf(f)); },
          docs::shapes::getMeshTriangles)
      .def(
          "getMeshColors", [](const Frame& f) { return meshColors(f, meshOf(f)); }, docs::shapes::getMeshColors)
      .def(
          "getMesh",
          [](const Frame& f) {
            const Mesh mesh = meshOf(f);
            return nb::typed<nb::tuple, Array, IndexArray, ByteArray>(
                nb::make_tuple(meshPoints(mesh), meshTriangles(f, mesh), meshColors(f, mesh)));
          },
          docs::shapes::getMesh);
}

}  // namespace

void bindShapes(nb::class_<Frame>& frame) {
  frame
      .def(
          "setShape", [](Frame& f, ShapeType type, const Numbers& size) -> Frame& { return setShape(f, type, size); },
          "type"_a, "size"_a, kChain, docs::shapes::setShape)
      .def(
          "setShape",
          [](Frame& f, const std::string& type, const Numbers& size) -> Frame& {
            return setShape(f, shapeTypeFromName(type), size);
          },
          "type"_a, "size"_a, kChain, docs::shapes::setShapeByName)
      .def(
          "setColor",
          [](Frame& f, const Numbers& color) -> Frame& {
            f.setColor(color.list());
            if ((color.values.array() > 1.).any())
              emitWarning("color has numbers above 1; expected 0..1 (divide values of 0..255 by 255)");
            return f;
          },
          "color"_a, kChain, docs::shapes::setColor)
      .def(
          "setContact", [](Frame& f, int contact) -> Frame& { return f.setContact(contact); }, "contact"_a, kChain,
          docs::shapes::setContact)
      .def("getShapeType", &Frame::getShapeType, "Returns the shape type, an ST; ST.none without a shape.")
      .def(
          "getSize", [](const Frame& f) { return toNumpy(f.getSize().data(), f.getSize().size()); },
          "Returns the sizes as in setShape, shape (k,), m; empty without a shape.");
  bindSurfaces(frame);
  bindMeshes(frame);
}

}  // namespace kinegraph::python
