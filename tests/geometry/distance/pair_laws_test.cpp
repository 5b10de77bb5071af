// Laws that distances of all pairs of shape types obey, at random and at degenerate poses, compared with coal.

#include <coal/distance.h>
#include <coal/shape/convex.h>
#include <coal/shape/geometric_shapes.h>
#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "tests/support/geometry_samples.h"

using namespace kinegraph;
using namespace kinegraph::testing;

namespace {

using Body = std::shared_ptr<const CollisionBody>;
using Core = CollisionBody::Core;

constexpr double kExact = 1e-9;

struct Kind {
  std::string name;
  Geometry geometry;
  Body body = makeCollisionBody(geometry);
  bool convex() const { return body->convex(); }
  bool bent() const { return body->core() == Core::cylinder || body->core() == Core::box_ellipsoid; }
  bool grid() const { return body->core() == Core::grid; }
};

Geometry withPoints(ShapeType type, std::vector<Vector3d> points, std::vector<std::uint32_t> parts = {}) {
  Mesh mesh;
  mesh.vertices = std::move(points);
  mesh.parts = std::move(parts);
  return {type, {}, std::make_shared<Mesh>(std::move(mesh))};
}

/// An L of two boxes.
Geometry dividedMesh() {
  std::vector<Vector3d> points;
  for (const Vector3d& p : boxCorners({.2, .05, .05})) points.push_back(p);
  for (const Vector3d& p : boxCorners({.05, .05, .15})) points.push_back(p + Vector3d(.15, 0, .2));
  return withPoints(ShapeType::mesh, points, {0, 8});
}

std::vector<Vector3d> ballPoints(int count, double radius, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) points.push_back(radius * randomVector(rng).normalized());
  return points;
}

/// The distance from a ball, which fills the grid's box in part.
Geometry ballGrid(double radius, int cells) {
  Grid grid;
  grid.cells = {cells, cells, cells};
  const double size = .6;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      for (int k = 0; k < cells; ++k) {
        grid.values.push_back(
            float((Vector3d(i, j, k) * (size / (cells - 1)) - Vector3d::Constant(.5 * size)).norm() - radius));
      }
    }
  }
  return {ShapeType::sdf, {size, size, size}, nullptr, {}, Vector3d::Ones(), std::make_shared<Grid>(grid)};
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> list = {
      {"marker", {ShapeType::marker, {.1}, nullptr}},
      {"sphere", {ShapeType::sphere, {.15}, nullptr}},
      {"capsule", {ShapeType::capsule, {.4, .08}, nullptr}},
      {"box", {ShapeType::box, {.3, .2, .4}, nullptr}},
      {"ssBox", {ShapeType::ssBox, {.3, .25, .4, .05}, nullptr}},
      {"quad", {ShapeType::quad, {.4, .3}, nullptr}},
      {"cylinder", {ShapeType::cylinder, {.4, .15}, nullptr}},
      {"ssCylinder", {ShapeType::ssCylinder, {.4, .2, .05}, nullptr}},
      {"ssBoxElip", {ShapeType::ssBoxElip, {.3, .2, .25, .06, .04, .1, .02}, nullptr}},
      {"ellipsoid", {ShapeType::ssBoxElip, {0, 0, 0, .2, .12, .08, 0.}, nullptr}},
      {"ssCvx", sweptHullOf(boxCorners({.1, .15, .05}), .05)},
      {"mesh", withPoints(ShapeType::mesh, ballPoints(200, .2, 3))},
      {"divided mesh", dividedMesh()},
      {"pointCloud", withPoints(ShapeType::pointCloud, ballPoints(300, .2, 4))},
      {"lines", withPoints(ShapeType::lines, ballPoints(20, .2, 5))},
      {"sdf", ballGrid(.2, 25)},
  };
  return list;
}

struct Sample {
  const Kind &a, &b;
  RigidTransform X_WA, X_WB;
  std::string what;

  Proximity near() const { return proximity(*a.body, X_WA, *b.body, X_WB); }
  bool grid() const { return a.grid() || b.grid(); }
  bool bent() const { return a.bent() || b.bent(); }
  /// The tolerance of distances if several pushes are equally short.
  double slack(const Proximity& near) const {
    if (grid()) return 1e-6;
    return bent() && near.core_distance < 0. ? 2e-5 : kExact;
  }
};

/// Every pair of kinds at random poses, and with faces, edges and centers that meet.
std::vector<Sample> samples(int random, std::uint64_t seed, bool degenerate) {
  Rng rng(seed);
  std::vector<Sample> list;
  const Matrix3d quarter = axisRotation(0, 2. * std::atan(1.));
  const RigidTransform places[] = {{},
                                   {Matrix3d::Identity(), {.15, 0, 0}},
                                   {Matrix3d::Identity(), {0, 0, .4}},
                                   {Matrix3d::Identity(), {0, 0, 1e-12}},
                                   {quarter, {0, 0, .4}},
                                   {Matrix3d::Identity(), {.15, .1, .2}},
                                   {quarter, {.5, .5, 0}},
                                   {axisRotation(1, 1e-9), {.1, .1, .45}}};
  for (const Kind& a : kinds()) {
    for (const Kind& b : kinds()) {
      const auto add = [&](const RigidTransform& X_WA, const RigidTransform& X_WB, const std::string& where) {
        list.push_back({a, b, X_WA, X_WB, cat(a.name, "-", b.name, " ", where)});
      };
      for (int i = 0; i < random; ++i) {
        const RigidTransform X_WA = randomTransform(rng, .25), X_WB = randomTransform(rng, .25);
        add(X_WA, X_WB, std::to_string(i));
      }
      if (!degenerate) continue;
      for (const RigidTransform& X : places) add(X, {}, cat("at ", X.p.transpose()));
    }
  }
  return list;
}

double heightAbove(const Vector3d& point, const Body& body, const RigidTransform& X) {
  return proximity(*pointBody(), {Matrix3d::Identity(), point}, *body, X).distance;
}

std::unique_ptr<coal::CollisionGeometry> coalCore(const CollisionBody& body) {
  switch (body.core()) {
    case Core::point:
      return std::make_unique<coal::Sphere>(0.);
    case Core::segment:
      return std::make_unique<coal::Capsule>(0., 2. * body.halfLength());
    case Core::box:
      return std::make_unique<coal::Box>(2. * body.halfSides());
    case Core::cylinder:
      return std::make_unique<coal::Cylinder>(body.coreRadius(), 2. * body.halfLength());
    case Core::hull: {
      const auto& points = body.hull().points;
      auto copy = std::make_shared<std::vector<coal::Vec3s>>(points.begin(), points.end());
      return std::unique_ptr<coal::CollisionGeometry>(
          coal::ConvexBase::convexHull(copy, unsigned(points.size()), false));
    }
    case Core::box_ellipsoid:
      if (body.halfSides().norm() == 0.) return std::make_unique<coal::Ellipsoid>(body.radii());
      return nullptr;
    default:
      return nullptr;
  }
}

double coalDistance(const Sample& sample, const coal::CollisionGeometry& a, const coal::CollisionGeometry& b) {
  coal::DistanceRequest request;
  request.enable_signed_distance = true;
  request.gjk_tolerance = 1e-10;
  request.epa_max_iterations = 512;
  request.epa_tolerance = 1e-6;
  coal::DistanceResult result;
  const coal::Transform3s T_a(sample.X_WA.R, sample.X_WA.p), T_b(sample.X_WB.R, sample.X_WB.p);
  return coal::distance(&a, T_a, &b, T_b, request, result) - sample.a.body->radius() - sample.b.body->radius();
}

}  // namespace

TEST(PairScalings, WitnessPointsAreTheDistanceApartAlongTheUnitNormal) {
  for (const Sample& sample : samples(8, 1, true)) {
    const Proximity near = sample.near();
    ASSERT_TRUE(std::isfinite(near.distance) && near.point_a.allFinite() && near.point_b.allFinite()) << sample.what;
    EXPECT_NEAR(near.normal.norm(), 1., kExact) << sample.what;
    EXPECT_LT((near.point_a - near.point_b - near.distance * near.normal).norm(), kExact) << sample.what;
    EXPECT_LT((near.core_a - near.core_b - near.core_distance * near.normal).norm(), kExact) << sample.what;
  }
}

TEST(PairScalings, WitnessPointsLieOnTheSurfaces) {
  for (const Sample& sample : samples(8, 2, true)) {
    if (sample.grid()) continue;
    const Proximity near = sample.near();
    const double tolerance = sample.bent() && near.core_distance < 0. ? 1e-4 : 1e-7;
    // A point of a compound's part may lie within another part.
    for (const auto& [point, kind, X] :
         {std::tie(near.point_a, sample.a, sample.X_WA), std::tie(near.point_b, sample.b, sample.X_WB)}) {
      const double height = heightAbove(point, kind.body, X);
      EXPECT_LT(height, tolerance) << sample.what << " " << near.distance;
      if (kind.convex() || near.distance > 0.) {
        EXPECT_GT(height, -tolerance) << sample.what << " " << near.distance;
      }
    }
  }
}

TEST(PairScalings, SwappingTheBodiesSwapsThePointsAndNegatesTheNormal) {
  for (const Sample& sample : samples(10, 3, true)) {
    const Proximity ab = sample.near(), ba = proximity(*sample.b.body, sample.X_WB, *sample.a.body, sample.X_WA);
    EXPECT_NEAR(ab.distance, ba.distance, sample.slack(ab)) << sample.what;
  }
  for (const Sample& sample : samples(10, 4, false)) {
    const Proximity ab = sample.near(), ba = proximity(*sample.b.body, sample.X_WB, *sample.a.body, sample.X_WA);
    if (ab.core_distance < 1e-3 || sample.grid()) continue;  // two pushes may be equally short
    EXPECT_LT((ab.normal + ba.normal).norm(), 1e-7) << sample.what;
    EXPECT_LT((ab.point_a - ba.point_b).norm(), 1e-6) << sample.what;
  }
}

TEST(PairScalings, MovingBothBodiesTogetherMovesThePointsWithThem) {
  Rng rng(5);
  for (const Sample& sample : samples(6, 5, false)) {
    const RigidTransform X = randomTransform(rng);
    const Proximity near = sample.near(),
                    moved = proximity(*sample.a.body, X * sample.X_WA, *sample.b.body, X * sample.X_WB);
    EXPECT_NEAR(moved.distance, near.distance, sample.slack(near)) << sample.what;
    if (near.core_distance < 1e-3 || sample.grid()) continue;
    EXPECT_LT((moved.normal - X.R * near.normal).norm(), 1e-7) << sample.what;
    EXPECT_LT((moved.point_a - X * near.point_a).norm(), 1e-6) << sample.what;
  }
}

TEST(PairScalings, TheNormalAndTheWitnessPointGiveTheGradientOfTheDistance) {
  Rng rng(6);
  const double h = 1e-6;
  int used = 0, all = 0;
  for (const Sample& sample : samples(12, 6, false)) {
    const Proximity near = sample.near();
    const Vector3d v = randomVector(rng).normalized(), w = randomVector(rng).normalized();
    const auto moved = [&](double step) {
      const RigidTransform X{rotationBy(step * w) * sample.X_WA.R, sample.X_WA.p + step * v};
      return proximity(*sample.a.body, X, *sample.b.body, sample.X_WB).distance;
    };
    const double forward = (moved(h) - near.distance) / h, backward = (near.distance - moved(-h)) / h;
    ++all;
    if (std::abs(forward - backward) > 1e-3) continue;  // a kink
    ++used;
    const double expected = near.rate * near.normal.dot(v + w.cross(near.point_a - sample.X_WA.p));
    EXPECT_NEAR(.5 * (forward + backward), expected, sample.grid() ? 1e-3 : 1e-6)
        << sample.what << " at " << near.distance;
  }
  EXPECT_GT(used, all * 95 / 100);
}

TEST(PairScalings, NoPushAlongOtherDirectionsPartsConvexBodiesSooner) {
  Rng rng(7);
  for (const Sample& sample : samples(8, 7, true)) {
    const Proximity near = sample.near();
    if (!sample.a.convex() || !sample.b.convex() || near.distance > -1e-3) continue;
    const auto after = [&](const Vector3d& push) {
      return proximity(*sample.a.body, {sample.X_WA.R, sample.X_WA.p + push}, *sample.b.body, sample.X_WB).distance;
    };
    EXPECT_GT(after((-near.distance + 1e-7) * near.normal), 0.) << sample.what << " at " << near.distance;
    for (int i = 0; i < 10; ++i) {
      const Vector3d direction = (near.normal + randomVector(rng, i < 5 ? .05 : 2.)).normalized();
      EXPECT_LT(after((-near.distance - 3e-5) * direction), 0.) << sample.what << " at " << near.distance;
    }
  }
}

TEST(PairScalings, ConvexPairsAreAsFarApartAsCoalSays) {
  int apart = 0, deep = 0;
  for (const Sample& sample : samples(15, 8, false)) {
    if (!sample.a.convex() || !sample.b.convex()) continue;
    const auto a = coalCore(*sample.a.body), b = coalCore(*sample.b.body);
    if (!a || !b) continue;
    const Proximity near = sample.near();
    const double expected = coalDistance(sample, *a, *b);
    if (near.core_distance > 0.) {
      EXPECT_NEAR(near.distance, expected, 1e-6) << sample.what;
      ++apart;
    } else if (expected > -sample.a.body->boundRadius() - sample.b.body->boundRadius()) {  // it may fail
      // Its push may be longer than need be.
      EXPECT_GT(near.distance, expected - 1e-5) << sample.what;
      if (!sample.bent()) {
        EXPECT_NEAR(near.distance, expected, 1e-5) << sample.what;
      }
      ++deep;
    }
  }
  EXPECT_GT(apart, 500);
  EXPECT_GT(deep, 150);
}

TEST(PairScalings, ACompoundIsAsNearAsItsNearestPart) {
  for (const Sample& sample : samples(10, 9, false)) {
    if (sample.a.name != "pointCloud" || !sample.b.convex()) continue;
    double least = 1e9;
    for (const Vector3d& p : sample.a.geometry.mesh->vertices)
      least = std::min(least, heightAbove(sample.X_WA * p, sample.b.body, sample.X_WB));
    EXPECT_NEAR(sample.near().distance, least, sample.slack(sample.near())) << sample.what;
  }
}

TEST(PairScalings, ADistanceGridOfABallIsTheBallToTheAccuracyOfTheGrid) {
  const Body ball = makeCollisionBody({ShapeType::sphere, {.2}, nullptr});
  int used = 0;
  for (const Sample& sample : samples(20, 10, false)) {
    if (!sample.b.grid() || !sample.a.convex()) continue;
    const Proximity near = sample.near(), exact = proximity(*sample.a.body, sample.X_WA, *ball, sample.X_WB);
    const double deepest = std::max(exact.core_distance - .2, -.2);
    if (deepest < -.1) continue;  // the field is not smooth at the center, and the grid rounds it
    // Beyond the box the field stays below the distance.
    const auto outsideBox = [&](const Vector3d& p) {
      return ((sample.X_WB.inverse() * p).cwiseAbs().array() > .3).any();
    };
    const bool outside = outsideBox(exact.core_a) || outsideBox(near.core_a);
    ++used;
    EXPECT_LT(near.distance, exact.distance + 2e-3) << sample.what;
    if (!outside) {
      EXPECT_GT(near.distance, exact.distance - 2e-3) << sample.what;
    }
  }
  EXPECT_GT(used, 60);
}
