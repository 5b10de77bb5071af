#include "kinegraph/rendering/camera_renderer.h"

#include <gtest/gtest.h>

#include "kinegraph/scene/config.h"
#include "tests/support/expect_error.h"
#include "tests/support/near.h"

using namespace kinegraph;

namespace {

Camera cameraWith(const std::string& attributes) {
  Config config;
  return cameraOf(config.addFrame("eye", {}, attributes));
}

}  // namespace

TEST(Camera, AttributesOfAFrameDescribeIt) {
  const Camera camera = cameraWith("X: [1 2 3], width: 320, height: 200, focalLength: .8, zRange: [.5 7]");
  EXPECT_EQ(camera.width, 320);
  EXPECT_EQ(camera.height, 200);
  EXPECT_EQ(camera.near, .5);
  EXPECT_EQ(camera.far, 7.);
  EXPECT_TRUE(near(camera.pose.p, Vector3d(1., 2., 3.), 0.));
  EXPECT_TRUE(near(camera.fxycxy(), Vector4d(160., 160., 160., 100.), 1e-12));
}

TEST(Camera, WithoutAttributesItIsTheUsualOne) {
  const Camera camera = cameraWith("");
  EXPECT_EQ(camera.width, 640);
  EXPECT_EQ(camera.height, 480);
  EXPECT_NEAR(camera.focal_length, 1. + std::sqrt(2.), 1e-8);
}

TEST(Camera, TheHeightAngleIsTheVerticalAngleOfTheImage) {
  EXPECT_NEAR(cameraWith("heightAngle: 90").focal_length, .5, 1e-12);
}

TEST(Camera, AHeightInMetersMakesItOrthographic) {
  EXPECT_EQ(cameraWith("orthoAbsHeight: 2.5").ortho_height, 2.5);
  EXPECT_EQ(cameraWith("heightAbs: 1.5").ortho_height, 1.5);
}

TEST(Camera, AttributesThatMakeNoSenseAreRefusedByName) {
  expectError<ValueError>([] { cameraWith("width: [1 2 3]"); }, {"'eye'", "'width'", "a number"});
  expectError<ValueError>([] { cameraWith("zRange: [3 1]"); }, {"'eye'", "zRange", "[3 1]", "near < far"});
  expectError<ValueError>([] { cameraWith("zRange: 3"); }, {"'zRange'", "two numbers"});
  expectError<ValueError>([] { cameraWith("height: 0"); }, {"640 x 0 pixels"});
  expectError<ValueError>([] { cameraWith("width: 1000000"); }, {"8192"});
  expectError<ValueError>([] { cameraWith("focalLength: -1"); }, {"focalLength is -1"});
}

TEST(Camera, LookingAtAPointPutsItOnTheZAxisAndKeepsTheImageUpright) {
  const Vector3d from(2., 5., 1.7), to(0., 0., 1.);
  const Pose X_WC = lookAt(from, to);
  EXPECT_TRUE(near(X_WC.inverse().q * (to - from), Vector3d(0., 0., (to - from).norm()), 1e-12));
  EXPECT_NEAR((X_WC.q * Vector3d::UnitX()).z(), 0., 1e-12);
  EXPECT_LT((X_WC.q * Vector3d::UnitY()).z(), -.9);
}

TEST(Camera, LookingStraightDownAndAtItselfGiveRotations) {
  for (const Vector3d& target : {Vector3d(0., 0., -1.), Vector3d(0., 0., 1.), Vector3d(0., 0., 0.)}) {
    const Matrix3d R = lookAt(Vector3d::Zero(), target).q.toRotationMatrix();
    EXPECT_TRUE(near(R.transpose() * R, Matrix3d::Identity(), 1e-12));
    EXPECT_NEAR(R.determinant(), 1., 1e-12);
  }
}

// The pose that robotic 0.4.2 reports for a viewer that was just opened.
TEST(Camera, AViewStartsWhereTheReferenceDoes) {
  Vector7d expected;
  expected << 2., 5., 1.7, -.12480, .14208, .73774, -.64805;
  Vector7d given = defaultViewCamera().pose.numbers();
  if (given[3] * expected[3] < 0.) given.tail<4>() *= -1.;
  EXPECT_TRUE(near(given, expected, 2e-5));
}
