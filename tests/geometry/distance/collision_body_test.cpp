#include "kinegraph/geometry/distance/collision_body.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/geometry/shapes/tessellation.h"
#include "tests/support/geometry_samples.h"

using namespace kinegraph;
using namespace kinegraph::testing;
using Core = CollisionBody::Core;

namespace {

constexpr double kBodyRounding = 1e-9;
constexpr double kHair = 3e-6;  // by which hulls without volume are thickened

std::vector<Geometry> solidShapes() {
  return {{ShapeType::box, {.1, .2, .3}, nullptr},
          {ShapeType::sphere, {.2}, nullptr},
          {ShapeType::capsule, {.4, .1}, nullptr},
          {ShapeType::cylinder, {.4, .1}, nullptr},
          {ShapeType::ssBox, {.4, .3, .2, .05}, nullptr},
          {ShapeType::ssCylinder, {.4, .2, .05}, nullptr},
          {ShapeType::ssBoxElip, {.4, .3, .2, .05, .1, .02, .01}, nullptr},
          sweptHullOf(boxCorners(Vector3d(.1, .2, .3)), .05)};
}

double distanceTo(const CollisionBody& body, const Vector3d& point) {
  return proximity(*pointBody(), {Matrix3d::Identity(), point}, body, {}).distance;
}

}  // namespace

TEST(CollisionBody, RoundShapesAreCoresSweptByABall) {
  const auto sphere = makeCollisionBody({ShapeType::sphere, {.2}, nullptr});
  EXPECT_EQ(sphere->core(), Core::point);
  EXPECT_EQ(sphere->radius(), .2);
  const auto capsule = makeCollisionBody({ShapeType::capsule, {.4, .1}, nullptr});
  EXPECT_EQ(capsule->core(), Core::segment);
  EXPECT_EQ(capsule->halfLength(), .2);
  EXPECT_EQ(capsule->radius(), .1);
  const auto rounded = makeCollisionBody({ShapeType::ssBox, {.4, .3, .2, .05}, nullptr});
  EXPECT_EQ(rounded->core(), Core::box);
  EXPECT_EQ(rounded->radius(), .05);
  EXPECT_LT((rounded->halfSides() - Vector3d(.15, .1, .05)).norm(), 1e-15);
}

TEST(CollisionBody, ACapsuleWithoutLengthIsASphere) {
  const auto capsule = makeCollisionBody({ShapeType::capsule, {0., .1}, nullptr});
  EXPECT_EQ(capsule->core(), Core::point);
  EXPECT_NEAR(distanceTo(*capsule, Vector3d(0, .3, .4)), .4, kBodyRounding);
}

TEST(CollisionBody, ShapesWithoutExtentAreAPoint) {
  for (const ShapeType type :
       {ShapeType::none, ShapeType::marker, ShapeType::camera, ShapeType::mesh, ShapeType::pointCloud}) {
    const auto body = makeCollisionBody({type, {}, nullptr});
    EXPECT_EQ(body->core(), Core::point);
    EXPECT_EQ(body->boundRadius(), 0.);
    EXPECT_NEAR(distanceTo(*body, Vector3d(.3, 0, .4)), .5, kBodyRounding);
  }
}

TEST(CollisionBody, BoundingSphereHoldsTheSurfaceOfEveryShape) {
  for (const Geometry& geometry : solidShapes()) {
    const auto body = makeCollisionBody(geometry);
    for (const Vector3d& p : tessellate(geometry).vertices) {
      EXPECT_LE((p - body->boundCenter()).norm(), body->boundRadius() + kBodyRounding) << shapeTypeName(geometry.type);
    }
  }
}

TEST(CollisionBody, InnerBallIsAsDeepAsTheMiddleIs) {
  Rng rng(1);
  std::vector<Vector3d> corners;  // of a lump beside the origin
  for (int i = 0; i < 100; ++i)
    corners.push_back(Vector3d(.5 + .2 * rng.normal(), .1 * rng.normal(), .2 * rng.normal()));
  std::vector<Geometry> shapes = solidShapes();
  shapes.push_back(sweptHullOf(corners, .02));
  for (const Geometry& geometry : shapes) {
    const auto body = makeCollisionBody(geometry);
    const double depth = -distanceTo(*body, body->boundCenter()), inner = body->innerRadius() + body->radius();
    EXPECT_LE(inner, depth + 1e-7) << shapeTypeName(geometry.type);
    EXPECT_GT(inner, .0) << shapeTypeName(geometry.type);
    if (geometry.type != ShapeType::ssBoxElip) EXPECT_NEAR(inner, depth, 1e-6) << shapeTypeName(geometry.type);
  }
  const auto flat = makeCollisionBody(sweptHullOf({{0, 0, 0}, {.2, 0, 0}, {0, .2, 0}}, .01));
  EXPECT_EQ(flat->innerRadius(), 0.);
}

TEST(CollisionBody, VerticesOfTheDrawnSurfaceLieOnTheBodyThatDistancesAreComputedWith) {
  for (const Geometry& geometry : solidShapes()) {
    const auto body = makeCollisionBody(geometry);
    for (const Vector3d& p : tessellate(geometry).vertices) {
      EXPECT_NEAR(distanceTo(*body, p), 0., 1e-7) << shapeTypeName(geometry.type) << " at " << p.transpose();
    }
  }
}

TEST(CollisionBody, PointsBesideTheOriginBoundAsTightlyAsAtIt) {
  std::vector<Vector3d> corners = boxCorners(Vector3d(.1, .2, .3));
  for (Vector3d& p : corners) p += Vector3d(5, 6, 7);
  const auto body = makeCollisionBody(sweptHullOf(corners, .05));
  EXPECT_LT((body->boundCenter() - Vector3d(5, 6, 7)).norm(), kBodyRounding);
  EXPECT_NEAR(body->boundRadius(), Vector3d(.1, .2, .3).norm() + .05, kBodyRounding);
}

TEST(CollisionBody, PointsWithoutVolumeMakeABodyToo) {
  const double r = .05;
  const std::vector<std::vector<Vector3d>> flat = {{{.1, .2, .3}},
                                                   {{0, 0, 0}, {.2, 0, 0}},
                                                   {{0, 0, 0}, {.2, 0, 0}, {0, .2, 0}},
                                                   {{0, 0, 0}, {.2, 0, 0}, {0, .2, 0}, {.2, .2, 0}, {.1, .1, 0}},
                                                   {{0, 0, 0}, {.1, .2, 0}, {.2, .4, 0}, {.3, .6, 0}},
                                                   std::vector<Vector3d>(5, Vector3d(.1, .2, .3))};
  for (const auto& points : flat) {
    const auto body = makeCollisionBody(sweptHullOf(points, r));
    for (const Vector3d& p : points) EXPECT_NEAR(distanceTo(*body, p + Vector3d(0, 0, 1)), 1. - r, kHair);
  }
}

TEST(CollisionBody, AMeshIsItsConvexHull) {
  Mesh dented;  // a box with a dent in its top
  dented.vertices = boxCorners(Vector3d(.1, .1, .1));
  dented.vertices.emplace_back(0., 0., .05);
  const auto body = makeCollisionBody({ShapeType::mesh, {}, std::make_shared<Mesh>(dented)});
  EXPECT_NEAR(distanceTo(*body, Vector3d(0, 0, .3)), .2, 1e-7);
}
