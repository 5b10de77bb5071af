#include "kinegraph/geometry/distance/proximity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "tests/support/geometry_samples.h"

using namespace kinegraph;
using namespace kinegraph::testing;

namespace {

using Body = std::shared_ptr<const CollisionBody>;

constexpr double kProximityRounding = 1e-10;
constexpr double kRoundDepth = 1e-4;  // of overlapping round sides, which it approximates by facets
constexpr double kGradient = 1e-4;    // of central differences with that accuracy

Body body(ShapeType type, std::vector<double> size) { return makeCollisionBody({type, std::move(size), nullptr}); }

Body hullBody(const Vector3d& half, double radius) { return makeCollisionBody(sweptHullOf(boxCorners(half), radius)); }

struct Named {
  std::string name;
  Body body;
  bool closed_form;  ///< all pairs of such bodies are computed in closed form
};

const std::vector<Named>& bodies() {
  static const std::vector<Named> list = {
      {"point", pointBody(), true},
      {"sphere", body(ShapeType::sphere, {.15}), true},
      {"capsule", body(ShapeType::capsule, {.4, .08}), true},
      {"box", body(ShapeType::box, {.3, .2, .4}), true},
      {"ssBox", body(ShapeType::ssBox, {.3, .25, .4, .05}), true},
      {"cylinder", body(ShapeType::cylinder, {.4, .15}), false},
      {"ssCylinder", body(ShapeType::ssCylinder, {.4, .2, .05}), false},
      {"ssCvx", hullBody(Vector3d(.1, .15, .05), .05), false},
      {"mesh", hullBody(Vector3d(.12, .1, .2), 0.), false},
  };
  return list;
}

struct Pair {
  const Named &a, &b;
  RigidTransform X_WA, X_WB;
  std::string what;
  double tolerance() const { return a.closed_form && b.closed_form ? kProximityRounding : kGeneral; }
  Proximity near() const { return proximity(*a.body, X_WA, *b.body, X_WB); }
};

/// All pairs of bodies, each at `count` random poses from overlapping to apart.
std::vector<Pair> randomPairs(int count, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Pair> pairs;
  for (const Named& a : bodies()) {
    for (const Named& b : bodies()) {
      for (int i = 0; i < count; ++i) {
        const RigidTransform X_WA = randomTransform(rng, .25), X_WB = randomTransform(rng, .25);
        pairs.push_back({a, b, X_WA, X_WB, cat(a.name, "-", b.name, " ", i)});
      }
    }
  }
  return pairs;
}

}  // namespace

TEST(Proximity, TwoSpheresAreTheDistanceOfTheirCentersMinusTheRadiiApart) {
  const auto a = body(ShapeType::sphere, {.2}), b = body(ShapeType::sphere, {.1});
  for (const double d : {2., .3, .25}) {
    const Proximity near = proximity(*a, at(.6 * d, .8 * d, 0), *b, {});
    EXPECT_NEAR(near.distance, d - .3, kProximityRounding);
    EXPECT_NEAR(near.core_distance, d, kProximityRounding);
    EXPECT_LT((near.normal - Vector3d(.6, .8, 0)).norm(), kProximityRounding);
    EXPECT_LT((near.point_a - (d - .2) * Vector3d(.6, .8, 0)).norm(), kProximityRounding);
    EXPECT_LT((near.point_b - .1 * Vector3d(.6, .8, 0)).norm(), kProximityRounding);
  }
}

TEST(Proximity, ASphereBesideACapsuleIsNearestItsSegmentAndBeyondTheEndItsEnd) {
  const auto sphere = body(ShapeType::sphere, {.1}), capsule = body(ShapeType::capsule, {1., .2});
  const Proximity beside = proximity(*sphere, at(.7, 0, .3), *capsule, {});
  EXPECT_NEAR(beside.distance, .4, kProximityRounding);
  EXPECT_LT((beside.core_b - Vector3d(0, 0, .3)).norm(), kProximityRounding);
  const Proximity beyond = proximity(*sphere, at(.3, 0, .9), *capsule, {});
  EXPECT_NEAR(beyond.distance, .5 - .3, kProximityRounding);
  EXPECT_LT((beyond.core_b - Vector3d(0, 0, .5)).norm(), kProximityRounding);
}

TEST(Proximity, CrossedCapsulesAreNearestWhereTheirAxesPass) {
  const auto capsule = body(ShapeType::capsule, {1., .1});
  const Proximity near = proximity(*capsule, at(.2, .4, .1, axisRotation(0, 2. * std::atan(1.))), *capsule, {});
  EXPECT_NEAR(near.distance, 0., kProximityRounding);
  EXPECT_LT((near.normal - Vector3d::UnitX()).norm(), kProximityRounding);
  EXPECT_LT((near.core_b - Vector3d(0, 0, .1)).norm(), kProximityRounding);
}

TEST(Proximity, ParallelCapsulesAreNearestInTheMiddleOfTheStretchTheyShare) {
  const auto capsule = body(ShapeType::capsule, {1., .1});
  for (const double turn : {0., 4. * std::atan(1.)}) {
    const Proximity near = proximity(*capsule, at(.5, 0, .6, axisRotation(0, turn)), *capsule, {});
    EXPECT_NEAR(near.distance, .3, kProximityRounding);
    EXPECT_LT((near.core_b - Vector3d(0, 0, .3)).norm(), kProximityRounding);  // they share z from .1 to .5
  }
}

TEST(Proximity, ASphereTouchesTheRoundedEdgeOfAnSsBox) {
  const auto sphere = body(ShapeType::sphere, {.1}), box = body(ShapeType::ssBox, {1., 1., 1., .2});
  const Proximity near = proximity(*sphere, at(.6, .7, 0), *box, {});  // the core ends at .3
  EXPECT_NEAR(near.distance, .5 - .3, kProximityRounding);
  EXPECT_LT((near.point_b - Vector3d(.3 + .12, .3 + .16, 0)).norm(), kProximityRounding);
}

TEST(Proximity, BoxesThatOverlapByATenthOfAMeterAreMinusATenthApart) {
  const auto a = body(ShapeType::box, {.4, .4, .4}), b = body(ShapeType::box, {1., 1., 1.});
  EXPECT_NEAR(proximity(*a, at(0, 0, .6), *b, {}).distance, -.1, kProximityRounding);
  EXPECT_NEAR(proximity(*b, {}, *a, at(0, 0, .6)).distance, -.1, kProximityRounding);
  const auto rounded = body(ShapeType::ssBox, {.4, .4, .4, .05});
  EXPECT_NEAR(proximity(*rounded, at(0, 0, .6), *rounded, at(0, 0, .3)).distance, -.1, kProximityRounding);
  EXPECT_NEAR(proximity(*a, at(.1, 0, 0), *b, {}).distance, -.6, kProximityRounding);
}

TEST(Proximity, RoundedBoxesAreAsFarApartAsTheirFaces) {
  // A scene of the language's description: two rounded boxes, one .1 above the other.
  const auto a = body(ShapeType::ssBox, {.4, .4, .2, .05}), c = body(ShapeType::ssBox, {.2, .2, .2, .02});
  const Proximity near = proximity(*a, at(1, 2, 3), *c, at(1, 2, 3.3));
  EXPECT_NEAR(near.distance, .1, kProximityRounding);
  EXPECT_LT((near.point_a - Vector3d(1, 2, 3.1)).norm(), kProximityRounding);
  EXPECT_LT((near.normal + Vector3d::UnitZ()).norm(), kProximityRounding);
}

TEST(Proximity, ASphereSeesTheSideTheCapAndTheRimOfACylinder) {
  const auto sphere = body(ShapeType::sphere, {.1}), cylinder = body(ShapeType::cylinder, {1., .3});
  EXPECT_NEAR(proximity(*sphere, at(0, .8, .2), *cylinder, {}).distance, .4, kGeneral);
  EXPECT_NEAR(proximity(*sphere, at(.1, .1, .9), *cylinder, {}).distance, .3, kGeneral);
  const Proximity rim = proximity(*sphere, at(.6, 0, .9), *cylinder, {});
  EXPECT_NEAR(rim.distance, .5 - .1, kGeneral);
  EXPECT_LT((rim.point_b - Vector3d(.3, 0, .5)).norm(), 1e-4);
  EXPECT_NEAR(proximity(*sphere, at(0, 0, .45), *cylinder, {}).distance, -.15, kGeneral);
}

TEST(Proximity, AHullOfBoxCornersIsTheBox) {
  const auto hull = hullBody(Vector3d(.15, .1, .05), .05), box = body(ShapeType::ssBox, {.4, .3, .2, .05});
  for (const Pair& pair : randomPairs(3, 1)) {
    const double with_hull = proximity(*pair.a.body, pair.X_WA, *hull, pair.X_WB).distance;
    const double with_box = proximity(*pair.a.body, pair.X_WA, *box, pair.X_WB).distance;
    EXPECT_NEAR(with_hull, with_box, kGeneral) << pair.what;
  }
}

TEST(Proximity, SwappingTheBodiesSwapsThePointsAndNegatesTheNormal) {
  for (const Pair& pair : randomPairs(10, 2)) {
    const Proximity ab = pair.near(), ba = proximity(*pair.b.body, pair.X_WB, *pair.a.body, pair.X_WA);
    EXPECT_NEAR(ab.distance, ba.distance, pair.tolerance()) << pair.what;
    if (ab.core_distance < 1e-3) continue;  // two pushes may be equally short
    EXPECT_LT((ab.normal + ba.normal).norm(), 1e3 * pair.tolerance()) << pair.what;
  }
}

TEST(Proximity, MovingBothBodiesTogetherMovesThePointsWithThem) {
  Rng rng(3);
  for (const Pair& pair : randomPairs(10, 3)) {
    const RigidTransform X = randomTransform(rng);
    const Proximity resting = pair.near(), moved = proximity(*pair.a.body, X * pair.X_WA, *pair.b.body, X * pair.X_WB);
    EXPECT_NEAR(moved.distance, resting.distance, pair.tolerance()) << pair.what;
    if (resting.core_distance < 1e-3) continue;
    EXPECT_LT((moved.normal - X.R * resting.normal).norm(), 1e3 * pair.tolerance()) << pair.what;
    EXPECT_LT((moved.point_a - X * resting.point_a).norm(), 1e4 * pair.tolerance()) << pair.what;
  }
}

TEST(Proximity, WitnessPointsLieTheDistanceApartAlongTheUnitNormal) {
  for (const Pair& pair : randomPairs(20, 4)) {
    const Proximity near = pair.near();
    EXPECT_NEAR(near.normal.norm(), 1., kProximityRounding) << pair.what;
    EXPECT_NEAR(near.normal.dot(near.point_a - near.point_b), near.distance, pair.tolerance()) << pair.what;
    EXPECT_NEAR((near.point_a - near.point_b).norm(), std::abs(near.distance), 2. * pair.tolerance()) << pair.what;
    EXPECT_NEAR(near.normal.dot(near.core_a - near.core_b), near.core_distance, pair.tolerance()) << pair.what;
  }
}

TEST(Proximity, WitnessPointsLieOnTheSurfaces) {
  for (const Pair& pair : randomPairs(10, 5)) {
    const Proximity near = pair.near();
    if (near.core_distance < 1e-3) continue;
    const auto height = [](const Vector3d& p, const Body& body, const RigidTransform& X) {
      return proximity(*pointBody(), at(p.x(), p.y(), p.z()), *body, X).distance;
    };
    EXPECT_NEAR(height(near.point_a, pair.a.body, pair.X_WA), 0., 2. * kGeneral) << pair.what;
    EXPECT_NEAR(height(near.point_b, pair.b.body, pair.X_WB), 0., 2. * kGeneral) << pair.what;
  }
}

TEST(Proximity, TheNormalAndTheWitnessPointGiveTheGradientOfTheDistance) {
  Rng rng(6);
  const double h = 1e-5;
  int checked = 0, all = 0;
  for (const Pair& pair : randomPairs(6, 6)) {
    const Proximity near = pair.near();
    const Vector3d v = randomVector(rng).normalized(), w = randomVector(rng).normalized();
    const auto moved = [&](double step) {
      const Matrix3d turn = rotationBy(step * w);
      const RigidTransform X{turn * pair.X_WA.R, pair.X_WA.p + step * v};
      return proximity(*pair.a.body, X, *pair.b.body, pair.X_WB).distance;
    };
    const double forward = (moved(h) - near.distance) / h, backward = (near.distance - moved(-h)) / h;
    ++all;
    if (std::abs(forward - backward) > kGradient * 10.) continue;  // a kink
    ++checked;
    const double expected = near.normal.dot(v + w.cross(near.point_a - pair.X_WA.p));
    EXPECT_NEAR(.5 * (forward + backward), expected,
                pair.tolerance() == kProximityRounding ? kGradient : 20. * kGradient)
        << pair.what;
  }
  EXPECT_GT(checked, all * 8 / 10);
}

TEST(Proximity, DegenerateContactsGiveFiniteNumbers) {
  const std::vector<RigidTransform> places = {
      at(0, 0, 0),  at(.15, 0, 0),   at(.3, 0, 0),    at(0, 0, .4),
      at(0, 0, .2), at(0, 0, 1e-12), at(.15, .1, .2), at(0, 0, .4, axisRotation(0, 2. * std::atan(1.)))};
  for (const Named& a : bodies()) {
    for (const Named& b : bodies()) {
      for (const RigidTransform& X_WA : places) {
        const Proximity near = proximity(*a.body, X_WA, *b.body, {});
        EXPECT_TRUE(std::isfinite(near.distance)) << a.name << "-" << b.name << " at " << X_WA.p.transpose();
        EXPECT_TRUE(near.point_a.allFinite() && near.point_b.allFinite()) << a.name << "-" << b.name;
        EXPECT_NEAR(near.normal.norm(), 1., kProximityRounding)
            << a.name << "-" << b.name << " at " << X_WA.p.transpose();
      }
    }
  }
}

TEST(Proximity, CoincidingBodiesAreAsDeepAsTheShortestPush) {
  const std::vector<std::pair<std::string, double>> depths = {{"sphere", .3}, {"capsule", .16}, {"box", .2},
                                                              {"ssBox", .25}, {"cylinder", .3}, {"ssCylinder", .4},
                                                              {"ssCvx", .2},  {"mesh", .2}};
  for (const auto& [name, depth] : depths) {
    for (const Named& named : bodies()) {
      if (named.name != name) continue;
      EXPECT_NEAR(proximity(*named.body, {}, *named.body, {}).distance, -depth, kRoundDepth) << name;
    }
  }
}

TEST(PointToCore, IsTheDistanceOfAPointFromTheCoreOrLessForHulls) {
  Rng rng(8);
  int outside = 0, inside = 0;
  for (const Named& named : bodies()) {
    for (int i = 0; i < 200; ++i) {
      const RigidTransform X = randomTransform(rng, .1);
      const Vector3d point = randomVector(rng, .3);
      const double bound = std::sqrt(squaredPointToCore(*named.body, X, point));
      const double exact =
          std::max(proximity(*pointBody(), {Matrix3d::Identity(), point}, *named.body, X).core_distance, 0.);
      if (named.body->core() == CollisionBody::Core::hull) {
        EXPECT_LE(bound, exact + kGeneral) << named.name;
      } else {
        EXPECT_NEAR(bound, exact, kProximityRounding) << named.name;
      }
      ++(bound > 0. ? outside : inside);
    }
  }
  EXPECT_GT(outside, 500);
  EXPECT_GT(inside, 30);
}
