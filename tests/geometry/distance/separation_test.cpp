#include "kinegraph/geometry/distance/separation.h"

#include <gtest/gtest.h>

#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "tests/support/geometry_samples.h"

using namespace kinegraph;
using namespace kinegraph::testing;

namespace {

constexpr double kHidden = 1e-6;  ///< m: distances of round sides are known to that

std::vector<std::shared_ptr<const CollisionBody>> separableBodies() {
  const auto of = [](ShapeType type, std::vector<double> size) {
    return makeCollisionBody({type, std::move(size), nullptr});
  };
  Rng rng(3);
  std::vector<Vector3d> ball;  // enough corners for a walk along neighbors
  for (int i = 0; i < 200; ++i) ball.push_back(.2 * Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized());
  return {of(ShapeType::sphere, {.15}),
          of(ShapeType::capsule, {.4, .08}),
          of(ShapeType::box, {.3, .2, .4}),
          of(ShapeType::ssBox, {.3, .25, .4, .05}),
          of(ShapeType::cylinder, {.4, .15}),
          makeCollisionBody(sweptHullOf(boxCorners(Vector3d(.1, .15, .05)), .05)),
          makeCollisionBody(sweptHullOf(ball, 0.))};
}

}  // namespace

TEST(Separation, SaysWhatDistancesSayAndShowsIt) {
  Rng rng(4);
  int apart = 0, near = 0;
  const auto bodies = separableBodies();
  for (const auto& a : bodies) {
    for (const auto& b : bodies) {
      SupportCorners corners;  // of pairs before, too
      for (int i = 0; i < 60; ++i) {
        const RigidTransform X_WA = randomTransform(rng, .3), X_WB = randomTransform(rng, .3);
        const double distance = proximity(*a, X_WA, *b, X_WB).distance;
        for (const double margin : {0., .05, distance - kHidden, distance + kHidden}) {
          if (margin < 0. || std::abs(distance - margin) < .5 * kHidden) continue;
          const auto found = separation(*a, X_WA, *b, X_WB, margin, corners);
          if (!found) continue;
          EXPECT_EQ(found->apart, distance >= margin) << distance << " " << margin;
          (found->apart ? apart : near) += 1;
          if (!found->apart) continue;
          const Vector3d in_a = -(X_WA.R.transpose() * found->normal), in_b = X_WB.R.transpose() * found->normal;
          const double gap = found->normal.dot(X_WA * a->support(in_a) - X_WB * b->support(in_b));
          EXPECT_GE(gap, margin + a->radius() + b->radius() - 1e-12);
        }
      }
    }
  }
  EXPECT_GT(apart, 2000);
  EXPECT_GT(near, 2000);
}

TEST(Separation, SaysNothingOfOverlaps) {
  const auto box = makeCollisionBody({ShapeType::box, {.3, .2, .4}, nullptr});
  SupportCorners corners;
  EXPECT_FALSE(separation(*box, {}, *box, {}, -.01, corners));
}
