#include "kinegraph/geometry/distance/shared_body.h"

#include <gtest/gtest.h>

namespace kinegraph {
namespace {

Geometry tetrahedronOf(double size) {
  Mesh mesh;
  mesh.vertices = {Vector3d::Zero(), size * Vector3d::UnitX(), size * Vector3d::UnitY(), size * Vector3d::UnitZ()};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return {ShapeType::mesh, {}, std::make_shared<const Mesh>(std::move(mesh))};
}

TEST(SharedCollisionBody, BelongsToAllShapesOfAMeshWhileItIsUsed) {
  const Geometry visual = tetrahedronOf(1.), collision = visual, other = tetrahedronOf(1.);
  EXPECT_FALSE(hasSharedBody(visual));
  auto body = sharedCollisionBody(visual);
  EXPECT_EQ(sharedCollisionBody(collision), body);
  EXPECT_NE(sharedCollisionBody(other), body);
  EXPECT_TRUE(hasSharedBody(collision));
  EXPECT_EQ(body->boundRadius(), makeCollisionBody(visual)->boundRadius());
  body.reset();
  EXPECT_FALSE(hasSharedBody(visual));
}

TEST(SharedCollisionBody, IsNeverThatOfAMeshThatIsGone) {
  for (int i = 1; i < 500; ++i) {  // addresses are used again
    EXPECT_NEAR(sharedCollisionBody(tetrahedronOf(i))->support(Vector3d::UnitX()).x(), i, 1e-12);
  }
}

}  // namespace
}  // namespace kinegraph
