#include "kinegraph/geometry/shapes/convex_hull.h"

#include <coal/shape/convex.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "kinegraph/common/errors.h"
#include "tests/support/geometry_samples.h"
#include "tests/support/mesh_laws.h"

using namespace kinegraph;
using namespace kinegraph::testing;

namespace {

constexpr double kHullRounding = 1e-10;

/// The largest height of a point above the plane of a triangle, m.
double farthestOutside(const Mesh& hull, const std::vector<Vector3d>& points) {
  double farthest = -1.;
  for (const auto& [i, j, k] : hull.triangles) {
    const Vector3d a = hull.vertices[i], normal = (hull.vertices[j] - a).cross(hull.vertices[k] - a).normalized();
    for (const Vector3d& p : points) farthest = std::max(farthest, normal.dot(p - a));
  }
  return farthest;
}

}  // namespace

TEST(ConvexHull, HullOfABoxWithPointsInsideIsTheBox) {
  Rng rng(1);
  const Vector3d half(.5, .4, .3);
  std::vector<Vector3d> points = boxCorners(half);
  for (int i = 0; i < 50; ++i)
    points.push_back(half.cwiseProduct(Vector3d(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1))));
  const Mesh hull = convexHull(points);
  EXPECT_EQ(hull.vertices.size(), 8u);
  EXPECT_EQ(hull.triangles.size(), 12u);
  EXPECT_NEAR(volume(hull), 8. * half.prod(), kHullRounding);
}

TEST(ConvexHull, ContainsAllItsPointsAndIsClosedAndOutward) {
  Rng rng(2);
  for (const int count : {4, 5, 20, 300}) {
    std::vector<Vector3d> points;
    for (int i = 0; i < count; ++i) points.push_back(Vector3d(1, 2, 3) + randomVector(rng));
    const Mesh hull = convexHull(points);
    EXPECT_LT(farthestOutside(hull, points), kHullRounding);
    EXPECT_EQ(openEdges(hull), 0);
    EXPECT_GT(volume(hull), 0.);
  }
}

TEST(ConvexHull, VerticesAreGivenPoints) {
  Rng rng(3);
  std::vector<Vector3d> points;
  for (int i = 0; i < 40; ++i) points.push_back(randomVector(rng));
  for (const Vector3d& vertex : convexHull(points).vertices) {
    EXPECT_TRUE(std::any_of(points.begin(), points.end(), [&](const Vector3d& p) { return p == vertex; }));
  }
}

TEST(ConvexHull, AHullIsItsOwnHull) {
  Rng rng(4);
  std::vector<Vector3d> points;
  for (int i = 0; i < 60; ++i) points.push_back(randomVector(rng));
  const Mesh once = convexHull(points), twice = convexHull(once.vertices);
  EXPECT_EQ(twice.vertices.size(), once.vertices.size());
  EXPECT_NEAR(volume(twice), volume(once), kHullRounding);
}

TEST(ConvexHull, RepeatedPointsDoNotChangeIt) {
  std::vector<Vector3d> points = boxCorners(Vector3d(1, 1, 1));
  for (int i = 0; i < 8; ++i) points.push_back(points[i]);
  EXPECT_NEAR(volume(convexHull(points)), 8., kHullRounding);
}

TEST(ConvexHull, TooFewPointsAndPointsInAPlaneOnALineOrInOnePlaceAreRefused) {
  EXPECT_THROW(convexHull({}), ValueError);
  EXPECT_THROW(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), ValueError);
  EXPECT_THROW(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {.5, .5, 0}}), ValueError);
  EXPECT_THROW(convexHull({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}}), ValueError);
  EXPECT_THROW(convexHull(std::vector<Vector3d>(6, Vector3d(1, 2, 3))), ValueError);
}

TEST(ConvexHull, PointsThatAreNotFiniteAreRefused) {
  std::vector<Vector3d> points = boxCorners(Vector3d(1, 1, 1));
  points.emplace_back(0., std::numeric_limits<double>::quiet_NaN(), 0.);
  EXPECT_THROW(convexHull(points), ValueError);
  points.back().y() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(convexHull(points), ValueError);
}

TEST(ConvexHull, HasTheCornersAndTrianglesThatCoalFindsInTheSameOrder) {
  Rng rng(7);
  for (const int count : {4, 8, 60, 500}) {
    std::vector<Vector3d> points;
    for (int i = 0; i < count; ++i) points.push_back(randomVector(rng));
    auto copy = std::make_shared<std::vector<coal::Vec3s>>(points.begin(), points.end());
    const std::unique_ptr<coal::ConvexBase> base(coal::ConvexBase::convexHull(copy, unsigned(count), true));
    const auto& expected = dynamic_cast<const coal::Convex<coal::Triangle>&>(*base);
    const Mesh hull = convexHull(points);
    ASSERT_EQ(hull.vertices.size(), expected.num_points);
    ASSERT_EQ(hull.triangles.size(), expected.num_polygons);
    for (unsigned i = 0; i < expected.num_points; ++i) EXPECT_EQ(hull.vertices[i], (*expected.points)[i]);
    for (unsigned i = 0; i < expected.num_polygons; ++i) {
      for (unsigned k = 0; k < 3; ++k) EXPECT_EQ(hull.triangles[i][k], (*expected.polygons)[i][k]) << i;
    }
  }
}
