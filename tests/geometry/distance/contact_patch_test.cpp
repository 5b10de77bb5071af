// Witness points of parallel faces, edges, caps and side lines are in the middle of the contact, on hulls as on boxes.
#include "kinegraph/geometry/distance/contact_patch.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "tests/support/geometry_samples.h"

using namespace kinegraph;
using namespace kinegraph::testing;

namespace {

using Body = std::shared_ptr<const CollisionBody>;
constexpr double kPatchExact = 1e-9;

/// A box as the hull of its corners.
Body hullOfBox(const Vector3d& half) {
  auto mesh = std::make_shared<Mesh>();
  for (int i = 0; i < 8; ++i)
    mesh->vertices.push_back(Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).cwiseProduct(half));
  return makeCollisionBody({ShapeType::ssCvx, {0.}, mesh});
}

/// A prism over a regular polygon, its axis along z.
Body prism(int corners, double radius, double half_length) {
  auto mesh = std::make_shared<Mesh>();
  for (int i = 0; i < corners; ++i) {
    const double angle = 2. * M_PI * i / corners;
    for (const double z : {-half_length, half_length})
      mesh->vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
  }
  return makeCollisionBody({ShapeType::ssCvx, {0.}, mesh});
}

Body cylinder(double length, double radius) {
  return makeCollisionBody({ShapeType::cylinder, {length, radius}, nullptr});
}

/// The middle between the witness points.
Vector3d middle(const Body& a, const RigidTransform& X_WA, const Body& b, const RigidTransform& X_WB) {
  const Proximity near = proximity(*a, X_WA, *b, X_WB);
  return .5 * (near.point_a + near.point_b);
}

void expectPoint(const Vector3d& found, const Vector3d& expected, double tolerance) {
  EXPECT_LT((found - expected).norm(), tolerance) << found.transpose() << " instead of " << expected.transpose();
}

}  // namespace

TEST(ContactPatch, HullsThatLieOnEachOtherMeetInTheMiddleOfTheirCommonFace) {
  const Body table = hullOfBox({1, 1, .1}), block = hullOfBox({.2, .1, .1});
  for (const double gap : {.05, -.01}) {
    expectPoint(middle(block, at(.3, .4, .2 + gap), table, at(0, 0, 0)), {.3, .4, .1 + .5 * gap}, kPatchExact);
    expectPoint(middle(table, at(0, 0, 0), block, at(.3, .4, .2 + gap)), {.3, .4, .1 + .5 * gap}, kPatchExact);
    expectPoint(middle(block, at(1.1, 0, .2 + gap), table, at(0, 0, 0)), {.95, 0, .1 + .5 * gap},
                kPatchExact);  // over the edge: x from .9 to 1
  }
}

TEST(ContactPatch, HullsOfBoxesMeetWhereTheBoxesDo) {
  const Body box = makeCollisionBody({ShapeType::box, {.4, .2, .2}, nullptr}), hull = hullOfBox({.2, .1, .1});
  const Body other = makeCollisionBody({ShapeType::box, {.3, .3, .2}, nullptr}), other_hull = hullOfBox({.15, .15, .1});
  Rng rng(3);
  for (int i = 0; i < 100; ++i) {  // faces or edges along faces that are parallel, at places of all kinds
    Matrix3d R = axisRotation(2, rng.uniform(-3., 3.));
    if (i % 3 == 1) R = R * axisRotation(0, .7);
    if (i % 3 == 2) R = R * axisRotation(1, .5);
    const RigidTransform X = at(rng.uniform(-.25, .25), rng.uniform(-.2, .2), rng.uniform(.15, .5), R),
                         world = randomTransform(rng, 1.);
    const Proximity expected = proximity(*box, world * X, *other, world),
                    found = proximity(*hull, world * X, *other_hull, world);
    EXPECT_NEAR(found.distance, expected.distance, kPatchExact) << i;
    if (expected.distance < -.05) continue;  // deep ones have several shortest pushes
    expectPoint(found.point_a, expected.point_a, 1e-7);
    expectPoint(found.point_b, expected.point_b, 1e-7);
  }
}

TEST(ContactPatch, EdgesAlongEachOtherMeetInTheMiddleOfTheirOverlap) {
  const Matrix3d upright = axisRotation(0, M_PI / 4);  // an edge below
  const Body bar = hullOfBox({.5, .1, .1});
  const double height = .2 * std::sqrt(2.) + .03;
  expectPoint(middle(bar, at(.6, 0, height, upright), bar, at(0, 0, 0, upright)), {.3, 0, .5 * height},
              kPatchExact);  // x from .1 to .5
  const Matrix3d across = axisRotation(2, M_PI / 2) * upright;
  expectPoint(middle(bar, at(.2, .3, height, across), bar, at(0, 0, 0, upright)), {.2, 0, .5 * height}, kPatchExact);
}

TEST(ContactPatch, CylindersStandOnTheMiddleOfWhatTheyTouch) {
  const Body table = hullOfBox({1, 1, .1}), can = cylinder(.2, .1), post = prism(6, .1, .1);
  for (const double gap : {.02, -.005}) {
    expectPoint(middle(can, at(.3, .4, .2 + gap), table, at(0, 0, 0)), {.3, .4, .1 + .5 * gap}, kPatchExact);
    expectPoint(middle(post, at(.3, .4, .2 + gap), table, at(0, 0, 0)), {.3, .4, .1 + .5 * gap}, kPatchExact);
    expectPoint(middle(can, at(.3, .4, .2 + gap), can, at(.3, .4, 0)), {.3, .4, .1 + .5 * gap}, kPatchExact);
    expectPoint(middle(can, at(.1, 0, .2 + gap), can, at(0, 0, 0)), {.05, 0, .1 + .5 * gap},
                1e-3);  // in the overlap of two discs
  }
  const Matrix3d lying = axisRotation(0, M_PI / 2);
  expectPoint(middle(can, at(.3, .4, .22, lying), table, at(0, 0, 0)), {.3, .4, .11}, kPatchExact);
  expectPoint(middle(can, at(.3, 1.05, .22, lying), table, at(0, 0, 0)), {.3, .975, .11},
              kPatchExact);  // y from .95 to 1
  expectPoint(middle(can, at(0, .1, .21, lying), can, at(0, 0, 0, lying)), {0, .05, .105}, kPatchExact);
}

TEST(ContactPatch, OfManyCornersIsFoundByWalkingAlongTheRim) {
  const Body drum = prism(40, .3, .1), plate = prism(5, .2, .05);
  ASSERT_FALSE(drum->hull().first_neighbor.empty());
  expectPoint(middle(plate, at(.05, -.02, .16), drum, at(0, 0, 0)), {.05, -.02, .105}, kPatchExact);
  expectPoint(middle(drum, at(0, 0, .25), drum, at(0, 0, 0)), {0, 0, .125}, kPatchExact);
}

TEST(ContactPatch, StaysThroughTheStepsOfFiniteDifferences) {
  const Body table = hullOfBox({1, 1, .1}), block = hullOfBox({.2, .1, .1});
  const Vector3d level = middle(block, at(.3, .4, .25), table, at(0, 0, 0));
  for (const double tilt : {1e-6, -1e-6, 3e-7}) {
    expectPoint(middle(block, at(.3, .4, .25, axisRotation(0, tilt)), table, at(0, 0, 0)), level, 1e-6);
    expectPoint(middle(block, at(.3, .4, .25, axisRotation(1, tilt)), table, at(0, 0, 0)), level, 1e-6);
  }
  EXPECT_NEAR(middle(block, at(.3, .4, .25, axisRotation(0, .01)), table, at(0, 0, 0)).y(), .3,
              2e-3);  // tilted: the lower edge
}
