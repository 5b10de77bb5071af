#include "kinegraph/rendering/camera_renderer.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "kinegraph/common/text.h"
#include "tests/support/near.h"

using namespace kinegraph;

TEST(Framing, FaintCollisionShapesAreNotShown) {
  Config C;
  C.addFrame("hull", {}, "shape: sphere, size: [9], color: [1 0 0 .2], contact: 1");
  EXPECT_FALSE(shownBall(C));
  C.addFrame("glass", {}, "shape: sphere, size: [.5], color: [1 0 0 .2], X: [1 2 3]");
  ASSERT_TRUE(shownBall(C));
  EXPECT_TRUE(near(shownBall(C)->center, Vector3d(1., 2., 3.), .01));
  EXPECT_NEAR(shownBall(C)->radius, .5, .05);
}

TEST(Framing, AllIsInThePictureAndFillsIt) {
  Rng rng(4);
  for (int round = 0; round < 50; ++round) {
    Config C;
    const double size = std::pow(10., rng.uniform(-2., 3.));
    for (int i = 0; i < 5; ++i) {
      const Vector3d at = size * Vector3d(rng.normal(), rng.normal(), rng.normal());
      C.addFrame(cat("box", i), {}, cat("shape: box, size: [", size, " ", size, " ", size, "]")).setPosition(at);
    }
    Camera camera = defaultViewCamera();
    camera.width = round % 2 ? 300 : 900;
    const Camera fit = fitted(camera, C);
    EXPECT_TRUE(fit.pose.q.isApprox(camera.pose.q));
    Eigen::Vector2d largest = Eigen::Vector2d::Zero();  // halves of the image
    for (int i = 0; i < 5; ++i) {
      for (int corner = 0; corner < 8; ++corner) {
        const Vector3d offset(corner & 1 ? .5 : -.5, corner & 2 ? .5 : -.5, corner & 4 ? .5 : -.5);
        const Vector3d at = C.getFrame(cat("box", i)).getPosition() + size * offset;
        const Vector3d p = fit.pose.q.inverse() * (at - fit.pose.p);
        EXPECT_GT(p.z(), fit.near);
        EXPECT_LT(p.z(), fit.far);
        const Eigen::Vector2d seen = p.head<2>() / p.z() * fit.focal_length;
        largest = largest.cwiseMax(Eigen::Vector2d(2. * seen.x() * fit.height / fit.width, 2. * seen.y()).cwiseAbs());
      }
    }
    EXPECT_LT(largest.maxCoeff(), .93);
    EXPECT_GT(largest.maxCoeff(), .9);
  }
}

TEST(Framing, OrthographicCamerasToo) {
  Config C;
  C.addFrame("box", {}, "shape: box, size: [1 1 1], X: [5 6 7]");
  Camera camera;
  camera.pose.q = Quaterniond(Eigen::AngleAxisd(.3, Vector3d::UnitX()));
  camera.ortho_height = 100.;
  const Camera fit = fitted(camera, C);
  EXPECT_GT(fit.ortho_height, 1.);
  EXPECT_LT(fit.ortho_height, 2.);
  const Vector3d middle = fit.pose.q.inverse() * (Vector3d(5., 6., 7.) - fit.pose.p);
  EXPECT_TRUE(near(Vector3d(middle.x(), middle.y(), 0.), Vector3d::Zero(), 1e-9));
  EXPECT_GT(middle.z(), fit.near + .5);
}

TEST(Framing, NothingToSeeLeavesTheCamera) {
  EXPECT_TRUE(near(fitted(defaultViewCamera(), Config()).pose.p, defaultViewCamera().pose.p, 0.));
}
