#include "kinegraph/geometry/shapes/convex_hull.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace kinegraph::inline geometry_internal {

namespace {

/// A run of the library qhull: the hull of points, with triangulated facets.
class Qhull {
 public:
  explicit Qhull(const std::vector<Vector3d>& points) : coordinates_(points) {
    char* text = nullptr;
    std::size_t length = 0;
    std::FILE* messages = open_memstream(&text, &length);
    qh_zero(&qh_, messages);
    char command[] = "qhull Qt";
    const int status =
        qh_new_qhull(&qh_, 3, int(points.size()), coordinates_[0].data(), False, command, nullptr, messages);
    std::fclose(messages);
    const std::string said(text, length);
    std::free(text);
    if (status == qh_ERRnone) return;
    release();
    throw ValueError(
        cat("the convex hull of ", points.size(), " points cannot be built: ", said.substr(0, said.find('\n'))));
  }
  ~Qhull() { release(); }
  Qhull(const Qhull&) = delete;

  const qhT* operator->() const { return &qh_; }
  std::size_t indexOf(const vertexT& vertex) const { return std::size_t(vertex.point - coordinates_[0].data()) / 3; }

 private:
  void release() {
    int left = 0, total = 0;
    qh_freeqhull(&qh_, !qh_ALL);
    qh_memfreeshort(&qh_, &left, &total);
  }

  std::vector<Vector3d> coordinates_;  ///< qhull requires mutable coordinates
  qhT qh_;
};

/// The point with the largest `height`.
template <class Height>
Vector3d highest(const std::vector<Vector3d>& points, const Height& height) {
  return *std::max_element(points.begin(), points.end(),
                           [&](const Vector3d& p, const Vector3d& q) { return height(p) < height(q); });
}

}  // namespace

bool spanVolume(const std::vector<Vector3d>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite())
      throw ValueError(cat("point ", i, " of a hull is (", points[i].transpose(), "); expected finite coordinates"));
  }
  if (points.size() < 4) return false;
  // The tallest tetrahedron over the largest triangle on the longest edge from the first point.
  const Vector3d a = points[0];
  const Vector3d b = highest(points, [&](const Vector3d& p) { return (p - a).squaredNorm(); }) - a;
  const Vector3d c = highest(points, [&](const Vector3d& p) { return (p - a).cross(b).squaredNorm(); }) - a;
  const Vector3d across = b.cross(c),
                 d = highest(points, [&](const Vector3d&p) { return std::abs((p - a).dot(across)); }) - a;
  const double extent = b.norm(), rounding = 1e-9 * extent + 1e-13 * a.norm();
  return across.norm() > rounding * extent && std::abs(d.dot(across)) > rounding * across.norm();
}

Mesh convexHull(const std::vector<Vector3d>& points) {
  if (points.size() < 4) throw ValueError(cat("a convex hull needs at least 4 points, got ", points.size()));
  if (!spanVolume(points)) throw ValueError(cat("the ", points.size(), " points of a convex hull lie in one plane"));
  Qhull qhull(points);
  std::vector<std::uint32_t> index_of(points.size());  // from input points to vertices
  Mesh mesh;
  for (const vertexT* vertex = qhull->vertex_list; vertex && vertex->next; vertex = vertex->next) {
    const std::size_t point = qhull.indexOf(*vertex);
    index_of[point] = std::uint32_t(mesh.vertices.size());
    mesh.vertices.push_back(points[point]);
  }
  Vector3d center = Vector3d::Zero();
  for (const Vector3d& vertex : mesh.vertices) center += vertex / double(mesh.vertices.size());
  for (const facetT* facet = qhull->facet_list; facet && facet->next; facet = facet->next) {
    if (!facet->good) continue;
    std::array<std::uint32_t, 3> triangle;
    for (int k = 0; k < 3; ++k)
      triangle[std::size_t(k)] = index_of[qhull.indexOf(*static_cast<const vertexT*>(facet->vertices->e[k].p))];
    const Vector3d a = mesh.vertices[triangle[0]], b = mesh.vertices[triangle[1]], c = mesh.vertices[triangle[2]];
    if ((b - a).cross(c - b).dot((a + b + c) / 3. - center) < 0.) std::swap(triangle[0], triangle[1]);
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace kinegraph::inline geometry_internal
