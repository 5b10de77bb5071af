#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/geometry/distance/core_pair.h"

namespace kinegraph::inline geometry_internal {

namespace {

constexpr int kMaxVertices = kMaxMinkowskiPoints, kMaxFaces = 2 * kMaxVertices + 64, kMaxEdges = kMaxFaces;

class Polytope {
 public:
  explicit Polytope(const CorePair& pair) : pair_(pair), scale_(pair.scale()) {}

  Deepest shortestPush(const Simplex& start) {
    start_ = start;
    if (!makeTetrahedron()) return flat();
    const bool curved = pair_.curved();
    const double exact = (curved ? 1e-9 : 1e-13) * scale_, near = 1e-2 * scale_, same = 1e-5 * scale_;
    bool refined = false;
    while (true) {
      const int face = nearestFace();
      if (face < 0) break;
      const Vector3d m = faces_[face].normal;
      const MinkowskiPoint point = pair_.support(m);
      const double height = m.dot(point.w), low = faces_[face].offset;
      Deepest candidate = atFace(face, m, height);
      const bool better = curved && height - low <= near && refine(pair_, candidate);
      if (candidate.height < best_.height) {
        best_ = candidate;
        refined = better;
      }
      if (height - low <= exact || (refined && best_.height - low <= same)) break;
      if (!expand(face, point)) break;
    }
    if (!curved) refine(pair_, best_);
    findWitnesses(pair_, {vertices_.data(), std::size_t(count_)}, best_);
    return best_;
  }

 private:
  struct Face {
    int corners[3];
    Vector3d normal;
    double offset;  ///< of its plane from the origin; infinite for a degenerate face
  };

  Deepest atFace(int face, const Vector3d& m, double height) const {
    Deepest deepest{m, height, {}};
    for (const int corner : faces_[face].corners) deepest.points.add(vertices_[corner]);
    bool inside;
    deepest.points.reduce(inside);
    return deepest;
  }

  /// Completes GJK's final points to a tetrahedron. Returns false if the difference has no volume.
  bool makeTetrahedron() {
    const double eps = 1e-9 * scale_;
    const auto addFarthest = [&](const Vector3d& direction, const auto& height) {
      for (const double sign : {1., -1.}) {
        const MinkowskiPoint point = pair_.support(sign * direction);
        if (height(point.w) <= eps) continue;
        vertices_[count_++] = point;
        return true;
      }
      return false;
    };
    for (int i = 0; i < start_.size; ++i) tryCorner(start_.points[std::size_t(i)], eps);
    if (count_ == 0) vertices_[count_++] = pair_.support(Vector3d::UnitX());
    for (int axis = 0; count_ == 1 && axis < 3; ++axis) {
      addFarthest(Vector3d::Unit(axis), [&](const Vector3d& w) { return (w - vertices_[0].w).norm(); });
    }
    if (count_ == 1) return false;
    const Vector3d along = (vertices_[1].w - vertices_[0].w).normalized(), side = along.unitOrthogonal();
    for (int k = 0; count_ == 2 && k < 3; ++k) {
      const Vector3d direction = std::cos(1.1 * k) * side + std::sin(1.1 * k) * along.cross(side);
      addFarthest(direction, [&](const Vector3d& w) { return along.cross(w - vertices_[0].w).norm(); });
    }
    if (count_ == 2) return false;
    const Vector3d normal = (vertices_[1].w - vertices_[0].w).cross(vertices_[2].w - vertices_[0].w).normalized();
    if (count_ == 3) addFarthest(normal, [&](const Vector3d& w) { return std::abs(normal.dot(w - vertices_[0].w)); });
    if (count_ == 3) return false;
    static constexpr int kCorners[4][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    const bool flipped = normal.dot(vertices_[3].w - vertices_[0].w) > 0.;
    for (const auto& c : kCorners) {
      if (flipped) {
        addFace(c[0], c[2], c[1]);
      } else {
        addFace(c[0], c[1], c[2]);
      }
    }
    return true;
  }

  /// Adds a point unless it is in the span of the present ones.
  void tryCorner(const MinkowskiPoint& point, double eps) {
    const Vector3d d = count_ == 0 ? Vector3d(Vector3d::Zero()) : Vector3d(point.w - vertices_[0].w);
    bool apart = count_ == 0 || d.norm() > eps;
    if (count_ >= 2) apart = (vertices_[1].w - vertices_[0].w).normalized().cross(d).norm() > eps;
    if (count_ >= 3) {
      const Vector3d normal = (vertices_[1].w - vertices_[0].w).cross(vertices_[2].w - vertices_[0].w).normalized();
      apart = std::abs(normal.dot(d)) > eps;
    }
    if (apart) vertices_[count_++] = point;
  }

  /// The push across a difference that is a point, a line or a plane through the origin.
  Deepest flat() const {
    Vector3d m = Vector3d::UnitZ();
    if (count_ == 2) m = (vertices_[1].w - vertices_[0].w).unitOrthogonal();
    if (count_ >= 3) m = (vertices_[1].w - vertices_[0].w).cross(vertices_[2].w - vertices_[0].w).normalized();
    double height = m.dot(pair_.support(m).w);
    const double other = -m.dot(pair_.support(-m).w);
    if (-other < height) {
      m = -m;
      height = -other;
    }
    Deepest deepest{m, height, start_};
    if (start_.size == 4) {
      bool inside;
      deepest.points.size = 3;
      deepest.points.reduce(inside);
    }
    return deepest;
  }

  int nearestFace() const {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < face_count_; ++i) {
      if (faces_[i].offset >= least) continue;
      least = faces_[i].offset;
      best = i;
    }
    return best;
  }

  bool addFace(int i, int j, int k) {
    if (face_count_ == kMaxFaces) return false;
    Face& face = faces_[face_count_++];
    face.corners[0] = i;
    face.corners[1] = j;
    face.corners[2] = k;
    const Vector3d &a = vertices_[i].w, &b = vertices_[j].w, &c = vertices_[k].w;
    // The edges at the corner with the widest angle give the least rounding.
    const Vector3d ab = b - a, bc = c - b, ca = a - c;
    const double lab = ab.squaredNorm(), lbc = bc.squaredNorm(), lca = ca.squaredNorm();
    const Vector3d n = lab >= lbc && lab >= lca ? Vector3d(bc.cross(ca))
                       : lbc >= lca             ? Vector3d(ca.cross(ab))
                                                : Vector3d(ab.cross(bc));
    const double area = n.norm();
    if (area > 1e-14 * std::max({lab, lbc, lca})) {
      face.normal = n / area;
      face.offset = std::min({face.normal.dot(a), face.normal.dot(b), face.normal.dot(c)});
    } else {
      face.normal.setZero();
      face.offset = std::numeric_limits<double>::infinity();
    }
    return true;
  }

  /// Adds a point beyond `from`: replaces the visible faces by faces to their rim. Returns false without room or
  /// gain.
  bool expand(int from, const MinkowskiPoint& point) {
    if (count_ == kMaxVertices) return false;
    const int added = count_;
    vertices_[count_++] = point;
    edge_count_ = 0;
    const double eps = 1e-14 * scale_;
    for (int i = face_count_ - 1; i >= 0; --i) {
      const Face& face = faces_[i];
      const bool seen =
          i == from || (std::isfinite(face.offset) ? face.normal.dot(point.w) > face.offset + eps : seesThin(face));
      if (!seen) continue;
      for (int k = 0; k < 3; ++k) {
        if (!addEdge(face.corners[k], face.corners[(k + 1) % 3])) return false;
      }
      faces_[i] = faces_[--face_count_];
      if (from == face_count_) from = i;
    }
    for (int e = 0; e < edge_count_; ++e) {
      if (!addFace(edges_[e].first, edges_[e].second, added)) return false;
    }
    return edge_count_ > 0;
  }

  /// A degenerate face follows its neighbors: it counts as visible if two of its edges are already on the rim.
  bool seesThin(const Face& face) const {
    int shared = 0;
    for (int k = 0; k < 3; ++k) {
      for (int e = 0; e < edge_count_; ++e) {
        shared += edges_[e].first == face.corners[(k + 1) % 3] && edges_[e].second == face.corners[k];
      }
    }
    return shared >= 2;
  }

  /// Adds an edge to the rim; an edge shared by two visible faces is removed.
  bool addEdge(int i, int j) {
    for (int e = 0; e < edge_count_; ++e) {
      if (edges_[e].first != j || edges_[e].second != i) continue;
      edges_[e] = edges_[--edge_count_];
      return true;
    }
    if (edge_count_ == kMaxEdges) return false;
    edges_[edge_count_++] = {i, j};
    return true;
  }

  const CorePair& pair_;
  double scale_;
  Simplex start_;
  std::array<MinkowskiPoint, kMaxVertices> vertices_;
  std::array<Face, kMaxFaces> faces_;
  std::array<std::pair<int, int>, kMaxEdges> edges_;
  int count_ = 0, face_count_ = 0, edge_count_ = 0;
  Deepest best_{Vector3d::UnitZ(), std::numeric_limits<double>::infinity(), {}};
};

}  // namespace

Deepest shortestPush(const CorePair& pair, const Simplex& start) { return Polytope(pair).shortestPush(start); }

}  // namespace kinegraph::inline geometry_internal
