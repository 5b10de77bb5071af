#include "kinegraph/viewer/messages/packed_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

#include "kinegraph/viewer/messages/binary_messages.h"

namespace kinegraph::inline viewer_internal {

namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Place = std::array<std::int64_t, 3>;

constexpr double kSteps = 32767.;  // of the grid along the mesh

/// Vertices on a grid; those with the same place and color are one.
struct GridMesh {
  Vector3d origin = Vector3d::Zero();
  double step = 1.;
  std::vector<Place> places;
  std::vector<std::uint32_t> colors;  ///< empty, or one per vertex
  std::vector<Triangle> triangles;
};

struct Bounds {
  Vector3d lowest, size;
};

Bounds boundsOf(const std::vector<Vector3d>& points) {
  Vector3d lowest = points[0], highest = points[0];
  for (const Vector3d& p : points) {
    lowest = lowest.cwiseMin(p);
    highest = highest.cwiseMax(p);
  }
  return {lowest, highest - lowest};
}

Place placeOf(const Vector3d& point, const Vector3d& origin, double step) {
  const Vector3d p = (point - origin) / step;
  return {std::llround(p.x()), std::llround(p.y()), std::llround(p.z())};
}

std::uint32_t wordOf(const std::array<std::uint8_t, 4>& color) {
  std::uint32_t word;
  std::memcpy(&word, color.data(), 4);
  return word;
}

/// Numbers groups of equal entries of (places, colors), ascending. Returns each entry's group, and sets `firsts` to an
/// entry of each group.
std::vector<std::uint32_t> group(const std::vector<Place>& places, const std::vector<std::uint32_t>& colors,
                                 std::vector<std::uint32_t>& firsts) {
  std::vector<std::uint32_t> order(places.size()), groups(places.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) { return std::pair(places[i], colors.empty() ? 0u : colors[i]); };
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || key(order[i]) != key(order[i - 1])) firsts.push_back(order[i]);
    groups[order[i]] = std::uint32_t(firsts.size() - 1);
  }
  return groups;
}

bool isDegenerate(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// Removes repeated triangles.
void keepDistinct(std::vector<Triangle>& triangles) {
  std::vector<std::pair<Triangle, std::size_t>> turned;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Triangle t = triangles[i];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    turned.emplace_back(t, i);
  }
  std::sort(turned.begin(), turned.end());
  const auto last = std::unique(turned.begin(), turned.end(), [](auto& a, auto& b) { return a.first == b.first; });
  triangles.clear();
  for (auto it = turned.begin(); it != last; ++it) triangles.push_back(it->first);
}

GridMesh onGrid(const Mesh& mesh, double cell) {
  const auto [lowest, size] = boundsOf(mesh.vertices);
  GridMesh grid;
  grid.origin = lowest;
  std::vector<Vector3d> points = mesh.vertices;
  std::vector<std::uint32_t> colors;
  if (mesh.colors.size() == points.size()) {
    for (const auto& color : mesh.colors) colors.push_back(wordOf(color));
  }
  std::vector<Triangle> triangles;
  for (const auto& t : mesh.triangles)
    triangles.push_back({std::uint32_t(t[0]), std::uint32_t(t[1]), std::uint32_t(t[2])});
  const auto merge = [&](double step) {
    std::vector<Place> places;
    for (const Vector3d& p : points) places.push_back(placeOf(p, lowest, step));
    std::vector<std::uint32_t> firsts;
    const std::vector<std::uint32_t> groups = group(places, colors, firsts);
    std::vector<Vector3d> means(firsts.size(), Vector3d::Zero());
    std::vector<double> counts(firsts.size(), 0.);
    for (std::size_t i = 0; i < points.size(); ++i) {
      means[groups[i]] += points[i];
      counts[groups[i]] += 1.;
    }
    grid.places.clear();
    std::vector<std::uint32_t> kept;
    for (std::size_t k = 0; k < firsts.size(); ++k) {
      means[k] /= counts[k];
      grid.places.push_back(places[firsts[k]]);
      if (!colors.empty()) kept.push_back(colors[firsts[k]]);
    }
    points = std::move(means);
    colors = std::move(kept);
    for (Triangle& t : triangles) t = {groups[t[0]], groups[t[1]], groups[t[2]]};
    std::erase_if(triangles, isDegenerate);
  };
  if (cell > 0.) {
    merge(cell);
    keepDistinct(triangles);
  }
  grid.step = std::max({cell / 4., size.maxCoeff() / kSteps, 1e-12});
  merge(grid.step);
  grid.colors = std::move(colors);
  grid.triangles = std::move(triangles);
  return grid;
}

/// Walks over a surface from triangle to triangle.
class SurfaceWriter {
 public:
  explicit SurfaceWriter(const GridMesh& mesh) : mesh_(mesh), number_(mesh.places.size(), kNone) {
    done_.assign(mesh.triangles.size(), false);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k)
        edges_.emplace_back(edge(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]), std::uint32_t(3 * t + k));
    }
    std::sort(edges_.begin(), edges_.end());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (!done_[t]) writeFrom(t);
    }
  }

  std::string symbols;
  std::vector<std::uint32_t> references;
  std::vector<Place> differences;     ///< per written vertex
  std::vector<std::uint32_t> colors;  ///< per written vertex, or empty

 private:
  static constexpr std::uint32_t kNone = ~0u;
  struct Gate {
    std::uint32_t a, b, opposite;  ///< the next triangle has the edge from a to b
  };

  static std::uint64_t edge(std::uint32_t a, std::uint32_t b) { return std::uint64_t(a) << 32 | b; }

  void writeFrom(std::size_t start) {
    done_[start] = true;
    const Triangle& t = mesh_.triangles[start];
    for (const std::uint32_t vertex : t) write(vertex, last_ == kNone ? Place{} : mesh_.places[last_]);
    std::vector<Gate> gates{{t[1], t[0], t[2]}, {t[2], t[1], t[0]}, {t[0], t[2], t[1]}};
    while (!gates.empty()) {
      const auto [a, b, opposite] = gates.back();
      gates.pop_back();
      const std::uint32_t corner = nextCorner(a, b);
      if (corner == kNone) {
        symbols += char(0);
        continue;
      }
      done_[corner / 3] = true;
      const std::uint32_t vertex = mesh_.triangles[corner / 3][(corner + 2) % 3];
      Place expected;
      for (std::size_t k = 0; k < 3; ++k)
        expected[k] = mesh_.places[a][k] + mesh_.places[b][k] - mesh_.places[opposite][k];
      write(vertex, expected);
      gates.push_back({vertex, b, a});
      gates.push_back({a, vertex, b});
    }
  }

  /// Returns the corner at which an unwritten triangle has the edge, or kNone.
  std::uint32_t nextCorner(std::uint32_t a, std::uint32_t b) const {
    const std::uint64_t wanted = edge(a, b);
    for (auto at = std::lower_bound(edges_.begin(), edges_.end(), std::pair(wanted, 0u));
         at != edges_.end() && at->first == wanted; ++at) {
      if (!done_[at->second / 3]) return at->second;
    }
    return kNone;
  }

  void write(std::uint32_t vertex, const Place& expected) {
    last_ = vertex;
    if (number_[vertex] != kNone) {
      symbols += char(2);
      references.push_back(written_ - 1 - number_[vertex]);
      return;
    }
    symbols += char(1);
    number_[vertex] = written_++;
    Place difference = mesh_.places[vertex];
    for (std::size_t k = 0; k < 3; ++k) difference[k] -= expected[k];
    differences.push_back(difference);
    if (!mesh_.colors.empty()) colors.push_back(mesh_.colors[vertex]);
  }

  const GridMesh& mesh_;
  std::vector<std::uint32_t> number_;  ///< per vertex of the mesh: its number in the message
  std::vector<char> done_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> edges_;  ///< (edge, 3 * triangle + corner), sorted
  std::uint32_t written_ = 0, last_ = kNone;
};

void appendPlane(std::string& data, const std::vector<std::uint32_t>& words, int plane) {
  for (const std::uint32_t word : words) data += char(word >> (8 * plane) & 0xff);
}

}  // namespace

std::string packMesh(int number, const Mesh& mesh, double cell) {
  const GridMesh grid = onGrid(mesh, cell);
  const SurfaceWriter surface(grid);
  std::string data;
  appendBytes(data, BinaryKind::surface);
  for (const std::size_t count : {std::size_t(number), surface.differences.size(), grid.triangles.size(),
                                  surface.colors.size(), surface.symbols.size(), surface.references.size()})
    appendBytes(data, std::uint32_t(count));
  for (int k = 0; k < 3; ++k) appendBytes(data, float(grid.origin[k]));
  appendBytes(data, float(grid.step));
  data += surface.symbols;
  for (int plane = 0; plane < 3; ++plane) appendPlane(data, surface.references, plane);
  std::vector<std::uint32_t> codes;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Place& difference : surface.differences) {
      const std::int64_t x = difference[k];
      codes.push_back(std::uint32_t(x < 0 ? -2 * x - 1 : 2 * x));
    }
  }
  for (int plane = 0; plane < 3; ++plane) appendPlane(data, codes, plane);
  for (int plane = 0; plane < 4; ++plane) appendPlane(data, surface.colors, plane);
  return data;
}

}  // namespace kinegraph::inline viewer_internal
