#include "kinegraph/geometry/shapes/shape_kinds.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/geometry/distance/collision_body.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/geometry/shapes/tessellation.h"
#include "tests/support/mesh_laws.h"

using namespace kinegraph;

namespace {

/// A shape of each kind, with sizes that fit each other and the mesh or grid that it takes.
Geometry sampleOf(const ShapeKind& kind) {
  Geometry geometry;
  geometry.type = kind.type;
  for (std::size_t i = 0; i < kind.sizes(); ++i) geometry.size.push_back(.6 / double(1 + i));
  geometry.size = checkedSize(kind.type, geometry.size, nullptr);
  if (kind.hasPoints()) {
    Mesh mesh;
    mesh.vertices = {{0., 0., 0.}, {.3, 0., 0.}, {0., .3, 0.}, {0., 0., .3}};
    if (kind.type == ShapeType::mesh) mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    geometry.mesh = std::make_shared<Mesh>(std::move(mesh));
  }
  return geometry;
}

std::pair<Vector3d, Vector3d> boundsOf(const Mesh& mesh) {
  Vector3d low = mesh.vertices[0], high = low;
  for (const Vector3d& p : mesh.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {low, high};
}

}  // namespace

TEST(ShapeKinds, RowsStandInTheOrderOfTheirNumbersAndAreComplete) {
  int number = 0;
  for (const ShapeKind& kind : shapeKinds()) {
    EXPECT_EQ(int(kind.type), number++) << kind.name;
    EXPECT_FALSE(kind.name.empty());
    EXPECT_EQ(&shapeKind(kind.type), &kind) << kind.name;
    EXPECT_NE(kind.is_symbol, kind.core != nullptr) << kind.name << ": bodies collide, symbols do not";
    EXPECT_FALSE(kind.is_symbol && kind.has_inertia) << kind.name;
  }
  EXPECT_EQ(shapeKind(ShapeType::none).name, "none");
  EXPECT_THROW(shapeKind(ShapeType(number)), ValueError);
  EXPECT_THROW(shapeKind(ShapeType(-2)), ValueError);
}

TEST(ShapeKinds, AShapeCollidesWithinTheBoundsOfItsSurfaceAndReachesThem) {
  for (const ShapeKind& kind : shapeKinds()) {
    if (!kind.surface || !kind.core || kind.type == ShapeType::plane) continue;  // a plane is endless
    const Geometry geometry = sampleOf(kind);
    const auto [low, high] = boundsOf(tessellate(geometry));
    const auto body = makeCollisionBody(geometry);
    ASSERT_TRUE(body->convex()) << kind.name;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d out = Vector3d::Unit(axis);
      EXPECT_NEAR(body->support(out)[axis] + body->radius(), high[axis], kMergeGrid) << kind.name;
      EXPECT_NEAR(body->support(-out)[axis] - body->radius(), low[axis], kMergeGrid) << kind.name;
    }
  }
}

TEST(ShapeKinds, TheExtentIsThatOfTheSurface) {
  int told = 0;
  for (const ShapeKind& kind : shapeKinds()) {
    if (!kind.extent) continue;
    const Geometry geometry = sampleOf(kind);
    const auto [low, high] = boundsOf(tessellate(geometry));
    EXPECT_NEAR((kind.extent(geometry.size) - (high - low)).norm(), 0., kMergeGrid) << kind.name;
    EXPECT_EQ(shapeHeight(kind.type, geometry.size), kind.extent(geometry.size).z()) << kind.name;
    ++told;
  }
  EXPECT_EQ(told, 6);
  EXPECT_EQ(shapeHeight(ShapeType::none, {}), 0.);
  EXPECT_EQ(shapeHeight(ShapeType::marker, {.1}), 0.);
}

TEST(ShapeKinds, ABodyHasTheExtentThatItsFirstSizesSay) {
  using Body = ShapeKind::Body;
  int told = 0;
  for (const ShapeKind& kind : shapeKinds()) {
    if (kind.body == Body::other) continue;
    const std::vector<double> size = sampleOf(kind).size;
    const double across = 2. * size[kind.body == Body::ball ? 0 : 1];
    const Vector3d expected = kind.body == Body::box        ? Vector3d(size[0], size[1], size[2])
                              : kind.body == Body::ball     ? Vector3d::Constant(across).eval()
                              : kind.body == Body::cylinder ? Vector3d(across, across, size[0])
                                                            : Vector3d(across, across, size[0] + across);
    EXPECT_EQ(kind.extent(size), expected) << kind.name;
    ++told;
  }
  EXPECT_EQ(told, 6);
}

TEST(ShapeKinds, AnExactShellIsThatOfTheFacetsGiveOrTakeTheirCoarseness) {
  for (const ShapeKind& kind : shapeKinds()) {
    if (!kind.shell) continue;
    const Geometry geometry = sampleOf(kind);
    Geometry facets{ShapeType::mesh, {}, std::make_shared<Mesh>(tessellate(geometry))};
    const ShellMass exact = shellMass(geometry), of_facets = shellMass(facets);
    EXPECT_NEAR(of_facets.area / exact.area, 1., .03) << kind.name;
    EXPECT_LT((of_facets.inertia_per_mass - exact.inertia_per_mass).norm(), .03 * exact.inertia_per_mass.norm())
        << kind.name;
  }
}
