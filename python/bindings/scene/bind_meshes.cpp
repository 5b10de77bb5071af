#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/convex_hull.h"
#include "kinegraph/scene/convex_parts.h"
#include "kinegraph/scene/frame_setters.h"
#include "scene/meshes_docs.h"
#include "scene/point_arguments.h"

namespace kinegraph::python {

namespace {

using OptionalNumbers = const std::optional<Numbers>&;

/// Reads whole numbers from 0 to `limit` - 1.
std::vector<std::uint32_t> indices(const Numbers& numbers, std::size_t limit, const char* what) {
  std::vector<std::uint32_t> list;
  for (double index : numbers.values) {
    if (!(index >= 0. && index < double(limit)) || index != std::floor(index)) {
      throw ValueError(cat(what, " refer to vertex ", index, "; expected an index below ", limit));
    }
    list.push_back(std::uint32_t(index));
  }
  return list;
}

Frame& setMesh(Frame& frame, const Numbers& vertices, const Numbers& triangles, OptionalNumbers colors,
               OptionalNumbers parts) {
  Mesh mesh;
  mesh.vertices = pointList(vertices, "mesh vertices");
  mesh.colors = colorsOf(colors, mesh.vertices.size());
  const std::vector<std::uint32_t> corners = indices(triangles, mesh.vertices.size(), "mesh triangles");
  if (corners.size() % 3 != 0) throw ValueError(cat("mesh triangles are m x 3 indices, got ", corners.size()));
  for (std::size_t i = 0; i < corners.size(); i += 3)
    mesh.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
  if (parts) mesh.parts = indices(*parts, mesh.vertices.size() + 1, "convex parts");
  if (!std::is_sorted(mesh.parts.begin(), mesh.parts.end()))
    throw ValueError("cvxParts are not ascending; expected vertex indices in ascending order");
  return frame.setMesh(std::move(mesh));
}

Frame& setConvexMesh(Frame& frame, const Numbers& core, OptionalNumbers colors, double radius) {
  std::vector<Vector3d> corners = pointList(core, "core points");
  const PointColors given = colorsOf(colors, corners.size());
  if (radius == 0.) {
    Mesh hull = convexHull(corners);
    if (given.size() == 1) hull.colors = given;
    frame.setMesh(std::move(hull));
  } else {
    frame.setConvexCore(std::move(corners), radius);
  }
  if (!given.empty()) {  // a hull has fewer vertices than input points: it gets their mean color
    Vector4d mean = Vector4d::Zero();
    for (const auto& c : given) mean += Vector4d(c[0], c[1], c[2], c[3]) / (255. * double(given.size()));
    frame.setColor({mean[0], mean[1], mean[2], mean[3]});
  }
  return frame;
}

Frame& setPointCloud(Frame& frame, const Numbers& cloud, OptionalNumbers colors) {
  Mesh mesh;
  mesh.vertices = pointList(cloud, "points");
  mesh.colors = colorsOf(colors, mesh.vertices.size());
  return frame.setMesh(std::move(mesh));
}

Frame& setLinesOf(Frame& frame, const Numbers& vertices, OptionalNumbers colors, bool connected) {
  const std::vector<Vector3d> ends = pointList(vertices, "line points");
  setLines(frame, ends, colorsOf(colors, ends.size()), connected);
  return frame;
}

Grid gridOf(const ArrayArgument& data, const char* call) {
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
    throw ValueError(cat(call, ": expected 3 numbers for size, the extent of the grid in m; got ", size.values.size()));
  return size.values;
}

void bindGrids(nb::class_<Frame>& frame) {
  frame
      .def(
          "setTensorShape",
          [](Frame& f, const ArrayArgument& data, const Numbers& size) -> Frame& {
            return setTensor(f, gridOf(data, "setTensorShape"), boxSize(size, "setTensorShape")), f;
          },
          "data"_a, "size"_a, kChain, docs::meshes::setTensorShape)
      .def(
          "setSdf",
          [](Frame& f, const ArrayArgument& data, const Numbers& size) -> Frame& {
            return setSdf(f, gridOf(data, "setSdf"), boxSize(size, "setSdf")), f;
          },
          "data"_a, "size"_a, kChain, docs::meshes::setSdf)
      .def(
          "setImplicitSurface",
          [](Frame& f, const ArrayArgument& data, const Numbers& size, int blur, double resample) -> Frame& {
            const char* call = "setImplicitSurface";
            return setImplicitSurface(f, gridOf(data, call), boxSize(size, call), blur, resample), f;
          },
          "data"_a, "size"_a, "blur"_a = 0, "resample"_a = -1., kChain, docs::meshes::setImplicitSurface);
}

}  // namespace

void bindMeshes(nb::class_<Frame>& frame) {
  frame
      .def("setMesh", setMesh, "vertices"_a, "triangles"_a, "colors"_a = nb::none(), "cvxParts"_a = nb::none(), kChain,
           docs::meshes::setMesh)
      .def(
          "setMeshFile",
          [](Frame& f, const PathText& file, double scale) -> Frame& { return setMeshFile(f, file.text, scale), f; },
          "filename"_a, "scale"_a = 1., kChain, docs::meshes::setMeshFile)
      .def(
          "setTextureFile",
          [](Frame& f, const PathText& image, OptionalNumbers uv) -> Frame& {
            return setTexture(f, image.text, uv ? uv->list() : std::vector<double>{}), f;
          },
          "image_filename"_a, "texCoords"_a = nb::none(), kChain, docs::meshes::setTextureFile)
      .def("setConvexMesh", setConvexMesh, "points"_a, "colors"_a = nb::none(), "radius"_a = 0., kChain,
           docs::meshes::setConvexMesh)
      .def(
          "setPointCloud",
          [](Frame& f, const Numbers& cloud, OptionalNumbers colors, nb::object) -> Frame& {
            return setPointCloud(f, cloud, colors);
          },
          "points"_a, "colors"_a = nb::none(), "normals"_a = nb::none(), kChain, docs::meshes::setPointCloud)
      .def("setLines", setLinesOf, "verts"_a, "colors"_a = nb::none(), "singleConnectedLine"_a = false, kChain,
           docs::meshes::setLines)
      .def(
          "setMeshAsLines",
          [](Frame& f, const Numbers& lines) -> Frame& { return setLinesOf(f, lines, std::nullopt, false); }, "lines"_a,
          kChain, docs::meshes::setMeshAsLines)
      .def(
          "convertDecomposedShapeToChildFrames", [](Frame& f) -> Frame& { return splitIntoConvexParts(f), f; }, kChain,
          docs::meshes::convertDecomposedShapeToChildFrames);
  bindGrids(frame);
}

}  // namespace kinegraph::python
