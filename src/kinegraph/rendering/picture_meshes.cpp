#include "kinegraph/rendering/picture_meshes.h"

#include <cmath>
#include <numbers>

#include "kinegraph/rendering/render_mesh.h"

namespace kinegraph::inline rendering_internal {

namespace {

constexpr int kParts = 56;  ///< facets around an axis, as many as on the page for close views
constexpr int kAroundArrows = 24;

/// A point of a profile that is rotated about z, with the normal there.
struct ProfilePoint {
  double r, z, normal_r, normal_z;
};

void addVertex(std::vector<float>& vertices, const Vector3d& position, const Vector3d& normal) {
  for (const double x : position) vertices.push_back(float(x));
  for (const double x : normal) vertices.push_back(float(x));
  vertices.insert(vertices.end(), {0.f, 0.f});
}

/// Adds the surface of rotation of a profile, which runs upwards on the outside. Two points at the same place make an
/// edge.
void addRotated(std::vector<float>& vertices, const std::vector<ProfilePoint>& profile, int parts = kParts) {
  const auto at = [&](const ProfilePoint& p, int part) {
    const double angle = 2. * std::numbers::pi * part / parts;
    return std::pair(Vector3d(p.r * std::cos(angle), p.r * std::sin(angle), p.z),
                     Vector3d(p.normal_r * std::cos(angle), p.normal_r * std::sin(angle), p.normal_z));
  };
  const auto add = [&](const std::pair<Vector3d, Vector3d>& vertex) {
    addVertex(vertices, vertex.first, vertex.second);
  };
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const ProfilePoint &low = profile[i], &high = profile[i + 1];
    if (std::hypot(high.r - low.r, high.z - low.z) < 1e-12) continue;
    for (int part = 0; part < parts; ++part) {
      const auto a = at(low, part), b = at(low, part + 1), c = at(high, part + 1), d = at(high, part);
      if (low.r > 0.) {
        add(a);
        add(b);
        add(c);
      }
      if (high.r > 0.) {
        add(a);
        add(c);
        add(d);
      }
    }
  }
}

/// Two half balls, their centers at a distance `length` along z.
std::vector<ProfilePoint> capsuleProfile(double length, double radius) {
  std::vector<ProfilePoint> profile;
  for (const double side : {-1., 1.}) {
    for (int i = 0; i <= kParts / 4; ++i) {
      const double angle = (side < 0. ? i - kParts / 4 : i) * 2. * std::numbers::pi / kParts;
      const double c = std::max(0., std::cos(angle)), s = std::sin(angle);
      profile.push_back({c < 1e-9 ? 0. : radius * c, radius * s + side * .5 * length, c, s});
    }
  }
  return profile;
}

std::vector<ProfilePoint> cylinderProfile(double low, double high, double radius) {
  return {{0., low, 0., -1.},     {radius, low, 0., -1.}, {radius, low, 1., 0.},
          {radius, high, 1., 0.}, {radius, high, 0., 1.}, {0., high, 0., 1.}};
}

void addBox(std::vector<float>& vertices, const Vector3d& half) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1., 1.}) {
      const Vector3d normal = side * Vector3d::Unit(axis), u = Vector3d::Unit((axis + 1) % 3), v = normal.cross(u);
      for (const auto& [a, b] : {std::pair(-1., -1.), {1., -1.}, {1., 1.}, {-1., -1.}, {1., 1.}, {-1., 1.}})
        addVertex(vertices, half.cwiseProduct(normal + a * u + b * v), normal);
    }
  }
}

Vector3d colorOf(const Mesh& mesh, std::size_t i) {
  const auto& c = mesh.colors[mesh.colors.size() == 1 ? 0 : i];
  return linearColor(Vector3d(c[0], c[1], c[2]) / 255.);
}

void addNumbers(std::vector<float>& vertices, const Vector3d& numbers) {
  for (const double x : numbers) vertices.push_back(float(x));
}

void addLines(PictureMesh& picture, const Mesh& mesh) {
  for (std::size_t i = 0; i + 1 < mesh.vertices.size(); i += 2) {
    for (const auto& [end, side] : {std::pair(0, -1), {0, 1}, {1, 1}, {0, -1}, {1, 1}, {1, -1}}) {
      addNumbers(picture.vertices, mesh.vertices[i]);
      addNumbers(picture.vertices, mesh.vertices[i + 1]);
      picture.vertices.insert(picture.vertices.end(), {float(end), float(side)});
      addNumbers(picture.vertices,
                 picture.has_colors ? colorOf(mesh, i + std::size_t(end)) : Vector3d(Vector3d::Ones()));
    }
  }
}

void addSurface(PictureMesh& picture, const RenderMesh& mesh) {
  const int first = int(picture.vertices.size()) / picture.stride();
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const float *p = &mesh.vertices[std::size_t(3 * mesh.faces[i])],
                *n = &mesh.normals[std::size_t(3 * mesh.face_normals[i])];
    picture.vertices.insert(picture.vertices.end(), p, p + 3);
    picture.vertices.insert(picture.vertices.end(), n, n + 3);
    if (mesh.image) {
      const float* at = &mesh.texcoords[std::size_t(2 * mesh.face_normals[i])];
      picture.vertices.insert(picture.vertices.end(), at, at + 2);
    } else {
      picture.vertices.insert(picture.vertices.end(), {0.f, 0.f});
    }
  }
  picture.parts.push_back({first, int(mesh.faces.size()), mesh.color, mesh.image});
}

/// Fills in the box, and the one part of shapes without parts.
PictureMesh completed(PictureMesh picture) {
  const std::size_t stride = std::size_t(picture.stride());
  if (picture.parts.empty() && !picture.vertices.empty())
    picture.parts.push_back({0, int(picture.vertices.size() / stride)});
  for (std::size_t i = 0; i < picture.vertices.size(); i += stride) {
    const Vector3d p = Eigen::Map<const Eigen::Vector3f>(&picture.vertices[i]).cast<double>();
    picture.lower = i == 0 ? p : Vector3d(picture.lower.cwiseMin(p));
    picture.upper = i == 0 ? p : Vector3d(picture.upper.cwiseMax(p));
    if (picture.kind != PictureMesh::Kind::lines) continue;
    const Vector3d q = Eigen::Map<const Eigen::Vector3f>(&picture.vertices[i + 3]).cast<double>();
    picture.lower = picture.lower.cwiseMin(q);
    picture.upper = picture.upper.cwiseMax(q);
  }
  return picture;
}

}  // namespace

Vector3d linearColor(const Vector3d& rgb) {
  return rgb.unaryExpr([](double x) { return x <= .04045 ? x / 12.92 : std::pow((x + .055) / 1.055, 2.4); });
}

Vector3d encodedColor(const Vector3d& linear) {
  return linear.unaryExpr([](double x) { return x <= .0031308 ? 12.92 * x : 1.055 * std::pow(x, 1. / 2.4) - .055; });
}

PictureMesh pictureMesh(const Geometry& geometry) {
  PictureMesh picture;
  const std::vector<double>& s = geometry.size;
  const Mesh* mesh = geometry.mesh.get();
  picture.has_colors = mesh && !mesh->colors.empty() && mesh->colors.size() == mesh->vertices.size();
  const bool is_points =
      mesh && mesh->triangles.empty() && (geometry.type == ShapeType::pointCloud || geometry.type == ShapeType::mesh);
  if (geometry.type == ShapeType::lines || is_points) {
    picture.kind = is_points ? PictureMesh::Kind::points : PictureMesh::Kind::lines;
    if (!mesh) return picture;
    picture.has_colors = picture.has_colors || mesh->colors.size() == 1;
    if (!is_points) addLines(picture, *mesh);
    for (std::size_t i = 0; is_points && i < mesh->vertices.size(); ++i) {
      addNumbers(picture.vertices, mesh->vertices[i]);
      addNumbers(picture.vertices, picture.has_colors ? colorOf(*mesh, i) : Vector3d(Vector3d::Ones()));
    }
    return completed(std::move(picture));
  }
  switch (geometry.type) {
    case ShapeType::box:
    case ShapeType::sdf:
    case ShapeType::tensor:
      addBox(picture.vertices, .5 * Vector3d(s[0], s[1], s[2]));
      break;
    case ShapeType::sphere:
      addRotated(picture.vertices, capsuleProfile(0., s[0]));
      break;
    case ShapeType::capsule:
      addRotated(picture.vertices, capsuleProfile(s[0], s[1]));
      break;
    case ShapeType::cylinder:
      addRotated(picture.vertices, cylinderProfile(-.5 * s[0], .5 * s[0], s[1]));
      break;
    default:
      picture.is_file = mesh != nullptr || geometry.type == ShapeType::quad;
      for (const RenderMesh& part : renderMeshes(geometry)) addSurface(picture, part);
  }
  return completed(std::move(picture));
}

PictureMesh arrowMesh(const Vector3d& at, const Vector3d& vector, double thickness) {
  PictureMesh picture;
  const double length = vector.norm();
  if (!(length > 0.)) return picture;
  const double head = std::min(.4 * length, 4. * thickness), slope = std::atan2(1.2 * thickness, head);
  std::vector<float> arrow;  // along z
  addRotated(arrow, cylinderProfile(0., length - head, .5 * thickness), kAroundArrows);
  addRotated(arrow,
             {{0., length - head, 0., -1.},
              {1.2 * thickness, length - head, 0., -1.},
              {1.2 * thickness, length - head, std::cos(slope), std::sin(slope)},
              {0., length, std::cos(slope), std::sin(slope)}},
             kAroundArrows);
  const Eigen::Quaterniond q = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), vector);
  for (std::size_t i = 0; i < arrow.size(); i += std::size_t(picture.stride())) {
    const auto turned = [&](std::size_t j) {
      return Vector3d(q * Eigen::Map<const Eigen::Vector3f>(&arrow[j]).cast<double>());
    };
    addVertex(picture.vertices, at + turned(i), turned(i + 3));
  }
  return completed(std::move(picture));
}

PictureMesh markerMesh(double length) {
  PictureMesh picture;
  const Vector3d colors[] = {{.839, .271, .271}, {.247, .612, .294}, {.231, .435, .839}};
  std::vector<float> arrow;  // along z
  addRotated(arrow, cylinderProfile(0., .8 * length, .02 * length), kAroundArrows);
  addRotated(arrow,
             {{0., .8 * length, 0., -1.},
              {.06 * length, .8 * length, 0., -1.},
              {.06 * length, .8 * length, 1., 0.},
              {0., length, 1., 0.}},
             kAroundArrows);
  const std::size_t stride = std::size_t(picture.stride());
  for (int axis = 0; axis < 3; ++axis) {
    const int first = int(picture.vertices.size() / stride);
    for (std::size_t i = 0; i < arrow.size(); i += stride) {
      for (const std::size_t j : {i, i + 3}) {
        Vector3d turned;
        for (int k = 0; k < 3; ++k) turned[(axis + 1 + k) % 3] = double(arrow[j + std::size_t(k)]);
        addNumbers(picture.vertices, turned);
      }
      picture.vertices.insert(picture.vertices.end(), {0.f, 0.f});
    }
    Vector4d color;
    color << colors[axis], 1.;
    picture.parts.push_back({first, int(arrow.size() / stride), color});
  }
  return completed(std::move(picture));
}

}  // namespace kinegraph::inline rendering_internal
