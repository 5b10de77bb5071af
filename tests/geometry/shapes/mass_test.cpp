#include "kinegraph/geometry/shapes/mass.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/geometry/shapes/tessellation.h"
#include "tests/support/geometry_samples.h"
#include "tests/support/mesh_laws.h"

using namespace kinegraph;
using namespace kinegraph::testing;
using std::numbers::pi;

namespace {

constexpr double kMassRounding = 1e-12;

Geometry meshOf(Mesh mesh) { return {ShapeType::mesh, {}, std::make_shared<Mesh>(std::move(mesh))}; }

Mesh moved(Mesh mesh, const RigidTransform& X) {
  for (Vector3d& p : mesh.vertices) p = X * p;
  return mesh;
}

}  // namespace

TEST(ShellMass, OfACubeIsFiveEighteenthsOfTheSquaredSide) {
  const ShellMass shell = shellMass({ShapeType::box, {.3, .3, .3}, nullptr});
  EXPECT_NEAR(shell.area, 6. * .09, kMassRounding);
  EXPECT_LT(shell.com.norm(), kMassRounding);
  EXPECT_LT((shell.inertia_per_mass - 5. / 18. * .09 * Matrix3d::Identity()).norm(), kMassRounding);
}

TEST(ShellMass, OfASphereIsTwoThirdsOfTheSquaredRadius) {
  const ShellMass shell = shellMass({ShapeType::sphere, {.2}, nullptr});
  EXPECT_NEAR(shell.area, 4. * pi * .04, kMassRounding);
  EXPECT_LT((shell.inertia_per_mass - 2. / 3. * .04 * Matrix3d::Identity()).norm(), kMassRounding);
}

TEST(ShellMass, OfABoxIsThatOfItsTriangles) {
  const Geometry box{ShapeType::box, {.1, .2, .3}, nullptr};
  const ShellMass closed_form = shellMass(box), triangles = shellMass(meshOf(tessellate(box)));
  EXPECT_NEAR(closed_form.area, triangles.area, kMassRounding);
  EXPECT_LT((closed_form.com - triangles.com).norm(), kMassRounding);
  EXPECT_LT((closed_form.inertia_per_mass - triangles.inertia_per_mass).norm(), kMassRounding);
}

TEST(ShellMass, OfAFlatBoxIsThatOfARectangle) {
  const ShellMass shell = shellMass({ShapeType::box, {.3, .2, 0.}, nullptr});
  const Vector3d expected(.04 / 12., .09 / 12., .13 / 12.);
  EXPECT_LT((shell.inertia_per_mass - Matrix3d(expected.asDiagonal())).norm(), kMassRounding);
}

TEST(ShellMass, OfACylinderIsThatOfATubeWithTwoDiscsWithinTheFacets) {
  const double L = .4, r = .1, tube = 2. * pi * r * L, discs = 2. * pi * r * r, area = tube + discs;
  const double axial = (tube * r * r + discs * r * r / 2.) / area;
  const double lateral = (tube * (r * r / 2. + L * L / 12.) + discs * (r * r / 4. + L * L / 4.)) / area;
  const ShellMass shell = shellMass({ShapeType::cylinder, {L, r}, nullptr});
  EXPECT_NEAR(shell.area, area, kFacets * area);
  EXPECT_NEAR(shell.inertia_per_mass(0, 0), lateral, kFacets * lateral);
  EXPECT_NEAR(shell.inertia_per_mass(1, 1), shell.inertia_per_mass(0, 0), kMassRounding);
  EXPECT_NEAR(shell.inertia_per_mass(2, 2), axial, kFacets * axial);
}

TEST(ShellMass, MovesWithTheMesh) {
  Rng rng(1);
  const Mesh mesh = tessellate({ShapeType::ssBox, {.4, .3, .2, .05}, nullptr});
  const ShellMass resting = shellMass(meshOf(mesh));
  for (int i = 0; i < 10; ++i) {
    const RigidTransform X = randomTransform(rng);
    const ShellMass shell = shellMass(meshOf(moved(mesh, X)));
    EXPECT_NEAR(shell.area, resting.area, kMassRounding);
    EXPECT_LT((shell.com - X * resting.com).norm(), kMassRounding);
    EXPECT_LT((shell.inertia_per_mass - X.R * resting.inertia_per_mass * X.R.transpose()).norm(), kMassRounding);
  }
}

TEST(ShellMass, InertiaIsPositiveAndObeysTheTriangleInequality) {
  const std::vector<Geometry> shapes = {{ShapeType::capsule, {.4, .1}, nullptr},
                                        {ShapeType::ssCylinder, {.4, .2, .05}, nullptr},
                                        {ShapeType::ssBoxElip, {.4, .3, .2, .05, .1, .02, .01}, nullptr},
                                        {ShapeType::quad, {.4, .3}, nullptr},
                                        sweptHullOf(boxCorners(Vector3d(.1, .2, .3)), .05)};
  for (const Geometry& geometry : shapes) {
    const Vector3d moments =
        Eigen::SelfAdjointEigenSolver<Matrix3d>(shellMass(geometry).inertia_per_mass).eigenvalues();
    EXPECT_GT(moments[0], 0.);
    EXPECT_LE(moments[2], moments[0] + moments[1] + kMassRounding);
  }
}

TEST(ShellMass, ShapesWithoutSurfaceOrAreaAreRefused) {
  EXPECT_THROW(shellMass({ShapeType::marker, {.1}, nullptr}), ValueError);
  EXPECT_THROW(shellMass({ShapeType::camera, {}, nullptr}), ValueError);
  EXPECT_THROW(shellMass({ShapeType::none, {}, nullptr}), ValueError);
  Mesh needle;
  needle.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  needle.triangles = {{0, 1, 2}};
  EXPECT_THROW(shellMass(meshOf(needle)), ValueError);
}

TEST(ShellMass, ABoxWithoutSizeIsRefused) {
  EXPECT_THROW(shellMass({ShapeType::box, {0., 0., 0.}, nullptr}), ValueError);
}
