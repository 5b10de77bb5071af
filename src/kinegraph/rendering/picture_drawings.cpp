#include "kinegraph/rendering/picture_drawings.h"

#include <utility>

namespace kinegraph::inline rendering_internal {

namespace {

PictureMesh vertexMesh(ShapeType type, const std::vector<Vector3d>& points, const std::vector<ColorBytes>& colors) {
  Mesh mesh;
  mesh.vertices = points;
  mesh.colors = colors;
  return pictureMesh({type, {}, std::make_shared<Mesh>(std::move(mesh))});
}

}  // namespace

PictureMesh linesMesh(const std::vector<Vector3d>& points, const std::vector<ColorBytes>& colors) {
  return vertexMesh(ShapeType::lines, points, colors);
}

PictureMesh pointsMesh(const std::vector<Vector3d>& points, const std::vector<ColorBytes>& colors) {
  return vertexMesh(ShapeType::pointCloud, points, colors);
}

PictureMesh imageMesh(Pixels pixels, double width, double height, double z) {
  PictureMesh picture;
  const auto add = [&](double x, double y, double side) {
    for (const double number : {x * width, y * height, z, 0., 0., side, x + .5, y + .5})
      picture.vertices.push_back(float(number));
  };
  for (const double side : {1., -1.}) {
    for (const auto& [x, y] : {std::pair(-.5, -.5), {.5, -.5}, {.5, .5}, {-.5, -.5}, {.5, .5}, {-.5, .5}})
      side > 0. ? add(x, y, side) : add(y, x, side);
  }
  picture.is_file = true;
  picture.lower = {-.5 * width, -.5 * height, z};
  picture.upper = {.5 * width, .5 * height, z};
  picture.parts.push_back({0, 12, std::nullopt, nullptr, std::make_shared<Pixels>(std::move(pixels))});
  return picture;
}

}  // namespace kinegraph::inline rendering_internal
