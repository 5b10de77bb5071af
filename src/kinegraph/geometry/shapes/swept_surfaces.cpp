#include "kinegraph/geometry/shapes/swept_surfaces.h"

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "kinegraph/geometry/shapes/convex_hull.h"

namespace kinegraph::inline geometry_internal {

namespace {

constexpr int kQuarter = 6;  ///< facets per quarter circle

/// Merges coincident vertices and drops degenerate triangles.
class MeshBuilder {
 public:
  std::uint32_t vertex(const Vector3d& p) {
    const auto key = std::make_tuple(std::llround(p.x() * 1e9), std::llround(p.y() * 1e9), std::llround(p.z() * 1e9));
    const auto [place, is_new] = index_.try_emplace(key, std::uint32_t(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(p);
    return place->second;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) mesh_.triangles.push_back({a, b, c});
  }
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  Mesh take() { return std::move(mesh_); }

 private:
  Mesh mesh_;
  std::map<std::tuple<long long, long long, long long>, std::uint32_t> index_;
};

}  // namespace

/// A sphere cut into octants that are moved to the corners.
Mesh roundedBox(const Vector3d& h, double r) {
  MeshBuilder builder;
  const int k = kQuarter, rows = 2 * (k + 1), columns = 4 * (k + 1);
  const auto point = [&](int row, int column) {
    const int quadrant = column / (k + 1), half = row / (k + 1);
    const double turn = .5 * std::numbers::pi / k;
    const double azimuth = turn * (quadrant * k + column % (k + 1));
    const double polar = turn * (half * k + row % (k + 1));
    const double sx = quadrant == 0 || quadrant == 3 ? 1. : -1., sy = quadrant < 2 ? 1. : -1.,
                 sz = half == 0 ? 1. : -1.;
    const Vector3d n(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
    return builder.vertex(h.cwiseProduct(Vector3d(sx, sy, sz)) + r * n);
  };
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int next = (column + 1) % columns;
      builder.quad(point(row, column), point(row + 1, column), point(row + 1, next), point(row, next));
    }
  }
  builder.quad(point(0, 0), point(0, k + 1), point(0, 2 * (k + 1)), point(0, 3 * (k + 1)));
  const int last = rows - 1;
  builder.quad(point(last, 3 * (k + 1)), point(last, 2 * (k + 1)), point(last, k + 1), point(last, 0));
  return builder.take();
}

namespace {

/// Revolves a profile of (radius, z), from the top of the axis to the bottom, about z.
Mesh revolve(const std::vector<std::pair<double, double>>& profile) {
  MeshBuilder builder;
  const int sides = 4 * kQuarter;
  const auto point = [&](std::size_t i, int side) {
    const double angle = 2. * std::numbers::pi * (side % sides) / sides;
    return builder.vertex({profile[i].first * std::cos(angle), profile[i].first * std::sin(angle), profile[i].second});
  };
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    for (int side = 0; side < sides; ++side) {
      builder.quad(point(i, side), point(i + 1, side), point(i + 1, side + 1), point(i, side + 1));
    }
  }
  return builder.take();
}

}  // namespace

Mesh roundedCylinder(double length, double radius, double r) {
  std::vector<std::pair<double, double>> profile = {{0., .5 * length}};
  const int steps = r > 0. ? kQuarter : 0;
  for (int half : {1, -1}) {
    for (int i = 0; i <= steps; ++i) {
      const double angle = .5 * std::numbers::pi * (half > 0 ? i : steps - i) / std::max(steps, 1);
      profile.emplace_back(radius - r + r * (steps ? std::sin(angle) : 0.),
                           half * (.5 * length - r + r * (steps ? std::cos(angle) : 0.)));
    }
  }
  profile.emplace_back(0., -.5 * length);
  return revolve(profile);
}

Mesh sweptHull(const std::vector<Vector3d>& core, const std::function<Vector3d(const Vector3d&)>& support) {
  const Mesh directions = roundedBox(Vector3d::Zero(), 1.);
  std::vector<Vector3d> points;
  for (const Vector3d& n : directions.vertices) {
    for (const Vector3d& corner : core) points.push_back(corner + support(n));
  }
  return convexHull(points);
}

std::vector<Vector3d> boxCorners(const Vector3d& h) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 8; ++i)
    points.emplace_back(i & 1 ? h.x() : -h.x(), i & 2 ? h.y() : -h.y(), i & 4 ? h.z() : -h.z());
  return points;
}

}  // namespace kinegraph::inline geometry_internal
