#include "kinegraph/geometry/distance/closed_form/box_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace kinegraph::inline geometry_internal {

namespace {

/// Half the derivative by s of the squared distance from c + s d to the box |x| <= h. Increases with s.
double slope(const Vector3d& c, const Vector3d& d, const Vector3d& h, double s) {
  double sum = 0.;
  for (int i = 0; i < 3; ++i) {
    const double x = c[i] + s * d[i];
    sum += d[i] * (x - std::clamp(x, -h[i], h[i]));
  }
  return sum;
}

/// The middle of the s in [-half, half] that minimize the distance of c + s d to the box. The slope is linear between
/// consecutive crossings of face planes.
double nearestParameter(const Vector3d& c, const Vector3d& d, const Vector3d& h, double half) {
  std::array<double, 8> knots{-half};
  int count = 1;
  for (int i = 0; i < 3; ++i) {
    if (d[i] == 0.) continue;
    for (const double face : {-h[i], h[i]}) {
      const double s = (face - c[i]) / d[i];
      if (!(s > -half && s < half)) continue;
      int place = count++;
      for (; place > 1 && knots[place - 1] > s; --place) knots[place] = knots[place - 1];
      knots[place] = s;
    }
  }
  knots[count++] = half;
  double low = -half, high = -half, before = slope(c, d, h, -half);
  for (int i = 1; i < count && before <= 0.; ++i) {
    const double after = slope(c, d, h, knots[i]);
    if (before < 0.) {
      low = high = after > 0. ? knots[i - 1] - before * (knots[i] - knots[i - 1]) / (after - before) : knots[i];
    } else if (after == 0.) {
      high = knots[i];
    }
    before = after;
  }
  return .5 * (low + high);
}

/// `d` with components below the rounding threshold set to zero.
Vector3d snapped(const Vector3d& d) {
  return d.unaryExpr([](double x) { return std::abs(x) <= kParallel ? 0. : x; });
}

/// The shortest push that moves the segment c + s d out of the box, as a unit direction.
struct Push {
  Vector3d normal;
  double depth = std::numeric_limits<double>::infinity();
  int face = -1;  ///< axis of the face, or -1: across the box edge along `edge`
  int edge = -1;
};

Push shortestPush(const Vector3d& c, const Vector3d& d, const Vector3d& h, double half) {
  Push push;
  for (int i = 0; i < 3; ++i) {
    const double depth = h[i] + half * std::abs(d[i]) - std::abs(c[i]);
    if (depth < push.depth) push = {signOf(c[i]) * Vector3d::Unit(i), depth, i, -1};
  }
  const double margin = 1e-12 * (half + h.sum());
  for (int i = 0; i < 3; ++i) {
    Vector3d normal = Vector3d::Unit(i).cross(d);
    const double norm = normal.norm();
    if (norm < 1e-8) continue;
    normal /= norm * signOf(normal.dot(c));
    const double depth = h.dot(normal.cwiseAbs()) + half * std::abs(normal.dot(d)) - normal.dot(c);
    if (depth < push.depth - margin) push = {normal, depth, -1, i};
  }
  return push;
}

/// The parameter of the segment's witness point for that push.
double pushedParameter(const Vector3d& c, const Vector3d& d, const Vector3d& h, double half, const Push& push) {
  if (push.face < 0) {  // the segment's point nearest to the line of the box edge
    Vector3d corner;
    for (int j = 0; j < 3; ++j) corner[j] = j == push.edge ? 0. : signOf(push.normal[j]) * h[j];
    const Vector3d across = d.cross(Vector3d::Unit(push.edge));
    return std::clamp((corner - c).cross(Vector3d::Unit(push.edge)).dot(across) / across.squaredNorm(), -half, half);
  }
  if (std::abs(d[push.face]) > kParallel) return -half * signOf(d[push.face] * push.normal[push.face]);
  double low = -half, high = half;  // limits of the part of the segment below the face
  for (int j = 0; j < 3; ++j) {
    if (j == push.face || std::abs(d[j]) <= kParallel) continue;
    const double s = (-h[j] - c[j]) / d[j], t = (h[j] - c[j]) / d[j];
    low = std::max(low, std::min(s, t));
    high = std::min(high, std::max(s, t));
  }
  return std::clamp(.5 * (low + high), -half, half);
}

}  // namespace

NearestPoints pointToBox(const Vector3d& point, const BoxCore& box) {
  const Vector3d p = box.X_WB.R.transpose() * (point - box.X_WB.p), &h = box.half;
  const Vector3d gap = p - p.cwiseMax(-h).cwiseMin(h);
  const double distance = gap.norm();
  NearestPoints near;
  near.point_a = point;
  if (distance > 0.) {
    near.distance = distance;
    near.normal = box.X_WB.R * (gap / distance);
  } else {
    int face;
    near.distance = -(h - p.cwiseAbs()).minCoeff(&face);
    near.normal = signOf(p[face]) * box.X_WB.R.col(face);
  }
  near.point_b = point - near.distance * near.normal;
  return near;
}

NearestPoints segmentToBox(const SegmentCore& segment, const BoxCore& box) {
  const Matrix3d& R = box.X_WB.R;
  const Vector3d c = R.transpose() * (segment.center - box.X_WB.p), d = R.transpose() * segment.axis, &h = box.half;
  const Vector3d flat = snapped(d);
  const double s = nearestParameter(c, d, h, segment.half);
  const Vector3d p = c + s * d, gap = p - p.cwiseMax(-h).cwiseMin(h);
  const double distance = gap.norm();
  NearestPoints near;
  if (distance > 1e-14 * (segment.half + h.sum())) {
    near.distance = distance;
    near.normal = R * (gap / distance);
    near.point_a = segment.at(flat == d ? s : nearestParameter(c, flat, h, segment.half));
  } else {
    const Push push = shortestPush(c, d, h, segment.half);
    near.distance = -push.depth;
    near.normal = R * push.normal;
    near.point_a = segment.at(pushedParameter(c, d, h, segment.half, push));
  }
  near.point_b = near.point_a - near.distance * near.normal;
  return near;
}

}  // namespace kinegraph::inline geometry_internal
