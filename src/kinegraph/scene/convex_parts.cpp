#include "kinegraph/scene/convex_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/h5_file.h"
#include "kinegraph/geometry/files/mesh_file.h"
#include "kinegraph/geometry/shapes/convex_hull.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

namespace {

/// For each vertex, the index of its convex part.
std::vector<std::uint32_t> partNumbers(const Mesh& mesh) {
  std::vector<std::uint32_t> part(mesh.vertices.size());
  if (!mesh.parts.empty()) {
    for (std::size_t v = 0; v < part.size(); ++v) {
      const auto next = std::upper_bound(mesh.parts.begin(), mesh.parts.end(), std::uint32_t(v));
      part[v] = std::uint32_t(std::max<std::ptrdiff_t>(next - mesh.parts.begin(), 1) - 1);
    }
    return part;
  }
  std::iota(part.begin(), part.end(), 0u);
  const auto representative = [&](std::uint32_t v) {
    while (part[v] != v) v = part[v] = part[part[v]];
    return v;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    part[representative(b)] = representative(a);
    part[representative(c)] = representative(a);
  }
  std::vector<std::uint32_t> number(part.size(), ~0u);
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < part.size(); ++v) {
    std::uint32_t& n = number[representative(v)];
    if (n == ~0u) n = count++;
  }
  std::vector<std::uint32_t> numbers(part.size());
  for (std::uint32_t v = 0; v < part.size(); ++v) numbers[v] = number[representative(v)];
  return numbers;
}

}  // namespace

std::vector<Mesh> convexParts(const Mesh& mesh) {
  const std::vector<std::uint32_t> number = partNumbers(mesh);
  const std::size_t count = std::max<std::size_t>(
      mesh.parts.size(), number.empty() ? 0 : *std::max_element(number.begin(), number.end()) + 1);
  std::vector<Mesh> parts(count);
  std::vector<std::uint32_t> place(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    Mesh& part = parts[number[v]];
    place[v] = std::uint32_t(part.vertices.size());
    part.vertices.push_back(mesh.vertices[v]);
    if (mesh.colors.size() == mesh.vertices.size()) part.colors.push_back(mesh.colors[v]);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    if (number[a] == number[b] && number[b] == number[c])
      parts[number[a]].triangles.push_back({place[a], place[b], place[c]});
  }
  return parts;
}

std::vector<Frame> splitIntoConvexParts(Frame& frame) {
  const auto shape = frame.data().shape;
  if (!shape || shape->geometry->type != ShapeType::mesh || !shape->geometry->mesh) {
    throw ValueError(cat("convertDecomposedShapeToChildFrames: frame '", frame.getName(), "' has no mesh"));
  }
  std::vector<Frame> children;
  const std::vector<Mesh> parts = convexParts(*shape->geometry->mesh);
  SceneTree& scene = *frame.scene();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].vertices.size() < 4 || !spanVolume(parts[i].vertices)) continue;
    Frame child(frame.scene(), scene.add(cat(frame.getName(), "_", i), &frame.data()));
    child.setMesh(convexHull(parts[i].vertices));
    child.data().shape->color = shape->color;
    child.data().shape->contact = shape->contact;
    children.push_back(child);
  }
  frame.data().shape.reset();
  scene.structureChanged();
  return children;
}

std::vector<Vector3d> shrunkHull(const Mesh& hull, double distance) {
  const std::size_t n = hull.vertices.size();
  std::vector<std::vector<Vector3d>> normals(n);
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : hull.vertices) middle += p / double(n);
  for (const auto& triangle : hull.triangles) {
    const Vector3d &a = hull.vertices[triangle[0]], &b = hull.vertices[triangle[1]], &c = hull.vertices[triangle[2]];
    const Vector3d normal = (b - a).cross(c - a).normalized();
    for (std::uint32_t v : triangle) {
      const bool known = std::any_of(normals[v].begin(), normals[v].end(),
                                     [&](const Vector3d& m) { return m.dot(normal) > 1. - 1e-6; });
      if (!known) normals[v].push_back(normal);
    }
  }
  std::vector<Vector3d> points;
  for (std::size_t v = 0; v < n; ++v) {
    const Vector3d& p = hull.vertices[v];
    Vector3d mean = Vector3d::Zero();
    for (const Vector3d& normal : normals[v]) mean += normal;
    double least = 1.;  // distance gained from the least favorable face per unit step along the mean
    if (mean.norm() > 1e-9) mean.normalize();
    for (const Vector3d& normal : normals[v]) least = std::min(least, mean.dot(normal));
    const double room = .5 * (p - middle).norm();
    points.push_back(p - std::min(distance / std::max(least, .1), room) * mean);
  }
  return points;
}

void makeMeshesConvex(SceneTree& scene, double radius) {
  if (!(radius >= 0.) || !std::isfinite(radius))
    throw ValueError(cat("makeMeshesSSCvx: radius ", radius, " m is not zero or positive"));
  for (const auto& frame : scene.frames()) {
    if (!frame->shape || frame->shape->geometry->type != ShapeType::mesh || !frame->shape->geometry->mesh) continue;
    const Mesh& mesh = *frame->shape->geometry->mesh;
    if (mesh.vertices.size() < 4 || !spanVolume(mesh.vertices)) continue;
    Geometry geometry;
    geometry.type = ShapeType::ssCvx;
    geometry.size = {radius};
    Mesh core;
    core.vertices = shrunkHull(convexHull(mesh.vertices), radius);
    geometry.mesh = std::make_shared<Mesh>(std::move(core));
    frame->shape->geometry = std::make_shared<Geometry>(std::move(geometry));
    scene.looksChanged(*frame->shape);
  }
  scene.structureChanged();
}

namespace {

Inertia readInertia(const H5File& file, const std::string& path) {
  const auto numbers = [&](const char* name, std::initializer_list<std::size_t> counts) {
    std::vector<double> v = file.dataset(cat("inertia/", name)).numbers;
    if (std::find(counts.begin(), counts.end(), v.size()) != counts.end()) return v;
    throw FileError(cat("'", path, "': inertia/", name, " has ", v.size(), " numbers"));
  };
  Inertia inertia;
  inertia.mass = numbers("mass", {1})[0];
  if (file.contains("inertia/com")) inertia.com = Eigen::Map<const Vector3d>(numbers("com", {3}).data());
  if (file.contains("inertia/tensor")) {
    const std::vector<double> m = numbers("tensor", {3, 9});
    if (m.size() == 3) {
      inertia.matrix = Vector3d(m[0], m[1], m[2]).asDiagonal();
    } else {
      inertia.matrix = Eigen::Map<const Matrix3d>(m.data()).transpose();
    }
  }
  return inertia;
}

}  // namespace

Frame addH5Object(Config& config, const std::string& name, const std::string& path) {
  const H5File file(path);
  const auto read = [&](const char* group) {
    return file.contains(group) ? std::optional(readH5Mesh(path, group)) : std::nullopt;
  };
  std::optional<Mesh> mesh = read("mesh"), points = read("points"), decomposition = read("decomp");
  std::optional<Inertia> inertia;
  if (file.contains("inertia/mass")) inertia = readInertia(file, path);
  if (!mesh && !points && !decomposition && !inertia) {
    throw FileError(
        cat("'", path, "' holds none of the groups mesh, points, decomp, inertia; it has ", join(file.entries())));
  }
  if (config.findFrame(name)) throw ValueError(cat("addH5Object: a frame named '", name, "' already exists"));
  Frame base = config.addFrame(name);
  base.data().inertia = inertia;
  if (mesh) config.addFrame(name + "_mesh", name).setMesh(std::move(*mesh));
  if (points) {
    points->triangles.clear();
    config.addFrame(name + "_pts", name).setMesh(std::move(*points));
  }
  if (decomposition) {
    Frame parts = config.addFrame(name + "_decomp", name).setMesh(std::move(*decomposition));
    parts.setContact(1);
    splitIntoConvexParts(parts);
  }
  return base;
}

}  // namespace kinegraph::inline scene_internal
