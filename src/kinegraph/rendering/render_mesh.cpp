#include "kinegraph/rendering/render_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "kinegraph/geometry/shapes/tessellation.h"

namespace kinegraph::inline rendering_internal {

namespace {

constexpr double kPointRadius = .002;  // m
constexpr double kCosCrease = .766;    // cosine of 40 degrees
constexpr std::size_t kMaxColors = 64;

using Triangle = std::array<std::uint32_t, 3>;
using Color = std::array<std::uint8_t, 4>;

/// Adds the hull of a cross-section that is extruded from a to b.
void addTriangles(Mesh& mesh, const std::vector<Vector3d>& corners, const std::vector<Triangle>& triangles,
                  const Color* color) {
  const auto first = std::uint32_t(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  for (const Triangle& t : triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  if (color) mesh.colors.insert(mesh.colors.end(), corners.size(), *color);
}

Mesh octahedra(const Mesh& points) {
  static const std::vector<Triangle> kFaces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                               {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  const bool colored = points.colors.size() == points.vertices.size();
  Mesh mesh;
  for (std::size_t i = 0; i < points.vertices.size(); ++i) {
    std::vector<Vector3d> corners;
    for (int axis = 0; axis < 3; ++axis) {
      for (double side : {1., -1.}) corners.push_back(points.vertices[i] + side * kPointRadius * Vector3d::Unit(axis));
    }
    addTriangles(mesh, corners, kFaces, colored ? &points.colors[i] : nullptr);
  }
  if (!colored) mesh.colors = points.colors;
  return mesh;
}

Mesh prisms(const Mesh& lines) {
  static const std::vector<Triangle> kFaces = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4},
                                               {2, 0, 3}, {2, 3, 5}, {2, 1, 0}, {3, 4, 5}};
  const bool colored = lines.colors.size() == lines.vertices.size();
  Mesh mesh;
  for (std::size_t i = 0; i + 1 < lines.vertices.size(); i += 2) {
    const Vector3d &a = lines.vertices[i], &b = lines.vertices[i + 1];
    if ((b - a).norm() < 1e-9) continue;
    const Vector3d axis = (b - a).normalized(), u = axis.unitOrthogonal(), v = axis.cross(u);
    std::vector<Vector3d> corners;
    for (const Vector3d& end : {a, b}) {
      for (int k = 0; k < 3; ++k)
        corners.push_back(end + kPointRadius * (std::cos(2.0944 * k) * u + std::sin(2.0944 * k) * v));
    }
    addTriangles(mesh, corners, kFaces, colored ? &lines.colors[i] : nullptr);
  }
  if (!colored) mesh.colors = lines.colors;
  return mesh;
}

Mesh surfaceOf(const Geometry& geometry) {
  const Mesh* mesh = geometry.mesh.get();
  switch (geometry.type) {
    case ShapeType::lines:
      return mesh ? prisms(*mesh) : Mesh{};
    case ShapeType::pointCloud:
      return mesh ? octahedra(*mesh) : Mesh{};
    case ShapeType::mesh:
      return !mesh ? Mesh{} : mesh->triangles.empty() ? octahedra(*mesh) : *mesh;
    default:
      return tessellate(geometry);
  }
}

/// Returns for each vertex the first one at the same position.
std::vector<std::uint32_t> mergedVertices(const std::vector<Vector3d>& vertices) {
  std::map<std::tuple<double, double, double>, std::uint32_t> first;
  std::vector<std::uint32_t> merged(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vector3d& p = vertices[i];
    merged[i] = first.try_emplace({p.x(), p.y(), p.z()}, std::uint32_t(i)).first->second;
  }
  return merged;
}

/// Returns whether each edge of each triangle belongs to exactly one other triangle, in the opposite direction.
bool isClosed(const std::vector<Triangle>& triangles) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> open;
  for (const Triangle& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      if (open.erase({b, a}) == 0) open.emplace(a, b);
    }
  }
  return open.empty();
}

/// The paint of triangles: an image of the mesh, or a color.
using Paint = std::pair<const TexturedTriangles*, Color>;

/// Groups triangles by paint; a mesh without own colors is one group without color.
std::map<Paint, std::vector<std::size_t>> groupByPaint(const Mesh& mesh, const std::vector<std::size_t>& triangles,
                                                       bool colored) {
  for (int coarse = 0;; ++coarse) {
    std::map<Paint, std::vector<std::size_t>> groups;
    for (const std::size_t i : triangles) {
      Paint paint{};
      const auto behind =
          std::upper_bound(mesh.textures.begin(), mesh.textures.end(), i,
                           [](std::size_t triangle, const TexturedTriangles& t) { return triangle < t.first; });
      if (behind != mesh.textures.begin() && i < std::size_t((behind - 1)->first) + (behind - 1)->count)
        paint.first = &*(behind - 1);
      if (colored && !paint.first) paint.second = mesh.colors[mesh.triangles[i][0]];
      for (std::uint8_t& channel : paint.second) channel = std::uint8_t(channel >> coarse << coarse);
      groups[paint].push_back(i);
    }
    if (groups.size() <= kMaxColors + mesh.textures.size()) return groups;
  }
}

}  // namespace

std::vector<RenderMesh> renderMeshes(const Geometry& geometry) {
  const Mesh mesh = surfaceOf(geometry);
  const std::vector<std::uint32_t> merged = mergedVertices(mesh.vertices);

  // triangles over merged vertices; those without area are dropped
  std::vector<Triangle> corners(mesh.triangles.size());
  std::vector<Vector3d> areas(mesh.triangles.size());
  std::vector<std::size_t> used;
  std::vector<std::vector<std::size_t>> at_vertex(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) corners[i][k] = merged[mesh.triangles[i][k]];
    const Vector3d& a = mesh.vertices[corners[i][0]];
    areas[i] = (mesh.vertices[corners[i][1]] - a).cross(mesh.vertices[corners[i][2]] - a);
    if (areas[i].norm() < 1e-16) continue;
    used.push_back(i);
    for (const std::uint32_t v : corners[i]) at_vertex[v].push_back(i);
  }
  if (used.empty()) return {};
  std::vector<Triangle> surface;
  for (const std::size_t i : used) surface.push_back(corners[i]);
  const bool both_sides = !isClosed(surface);

  // the normal at a corner: of the adjacent faces that no sharp edge separates
  const auto cornerNormal = [&](std::size_t triangle, std::uint32_t vertex) {
    const Vector3d own = areas[triangle].normalized();
    Vector3d sum = Vector3d::Zero();
    for (const std::size_t other : at_vertex[vertex]) {
      if (areas[other].normalized().dot(own) > kCosCrease) sum += areas[other];
    }
    return Vector3d(sum.normalized());
  };

  const bool colored = !mesh.colors.empty() && mesh.colors.size() == mesh.vertices.size();
  std::vector<RenderMesh> parts;
  for (const auto& [paint, triangles] : groupByPaint(mesh, used, colored)) {
    const auto& [texture, color] = paint;
    RenderMesh part;
    if (texture) {
      part.image = texture->image;
      part.color = Vector4d::Ones();
    } else if (colored || mesh.colors.size() == 1) {
      const Color& c = colored ? color : mesh.colors[0];
      part.color = Vector4d(c[0], c[1], c[2], c[3]) / 255.;
    }
    std::map<std::uint32_t, int> index;
    for (const std::size_t i : triangles) {
      std::array<int, 3> vertices, normals;
      for (int k = 0; k < 3; ++k) {
        const auto [place, is_new] = index.try_emplace(corners[i][k], int(index.size()));
        vertices[k] = place->second;
        if (is_new) {
          for (const double x : mesh.vertices[corners[i][k]]) part.vertices.push_back(float(x));
        }
        normals[k] = int(part.normals.size() / 3);
        for (const double x : cornerNormal(i, corners[i][k])) part.normals.push_back(float(x));
        if (!texture) continue;
        const auto [right, up] = mesh.texcoords[mesh.triangles[i][k]];
        part.texcoords.insert(part.texcoords.end(), {right, 1.f - up});
      }
      part.faces.insert(part.faces.end(), vertices.begin(), vertices.end());
      part.face_normals.insert(part.face_normals.end(), normals.begin(), normals.end());
      if (!both_sides) continue;
      for (int k = 2; k >= 0; --k) {
        part.faces.push_back(vertices[k]);
        part.face_normals.push_back(int(part.normals.size() / 3));
        for (int j = 0; j < 3; ++j) part.normals.push_back(-part.normals[3 * normals[k] + j]);
        for (int j = 0; texture && j < 2; ++j) part.texcoords.push_back(part.texcoords[2 * normals[k] + j]);
      }
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace kinegraph::inline rendering_internal
