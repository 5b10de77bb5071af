#include "kinegraph/rendering/framing.h"

#include <gtest/gtest.h>

#include "kinegraph/base/random.h"
#include "kinegraph/base/text.h"
#include "tests/support/near.h"

using namespace kinegraph;

TEST(Framing, WhatIsFaintAndCollidesIsNotShown) {
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
    const ShownBall ball = *shownBall(C);
    double largest = 0.;
    for (int i = 0; i < 5; ++i) {
      const Vector3d p = fit.pose.inverse() * C.getFrame(cat("box", i)).getPosition();
      EXPECT_GT(p.z(), fit.near);
      EXPECT_LT(p.z(), fit.far);
      EXPECT_LT(std::abs(p.x() / p.z() * fit.focal_length * fit.height), .5 * fit.width);
      EXPECT_LT(std::abs(p.y() / p.z() * fit.focal_length), .5);
      largest = std::max({largest, (C.getFrame(cat("box", i)).getPosition() - ball.center).norm()});
    }
    EXPECT_GT(largest, .4 * ball.radius);
  }
}

TEST(Framing, NothingToSeeLeavesTheCamera) {
  EXPECT_TRUE(near(fitted(defaultViewCamera(), Config()).pose.p, defaultViewCamera().pose.p, 0.));
}
